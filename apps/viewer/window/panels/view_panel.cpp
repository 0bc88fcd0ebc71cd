// How the scene is shown.
#include <fmt/format.h>

#include "viewer_window/debug_layers.h"
#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

void check(Desk& desk, const char* label, bool& value, Action action, const char* what) {
  ImGui::Checkbox(label, &value);
  note(desk, label);
  hint(fmt::format("{} ({})", what, bindingOf(action).key));
}

void swatch(std::uint32_t colour, const char* text) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float size = ImGui::GetTextLineHeight();
  const ImU32 shown = IM_COL32(colour >> 16 & 255, colour >> 8 & 255, colour & 255, 255);
  ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(at.x + 24, at.y + 2), ImVec2(at.x + 24 + size - 4, at.y + size - 2),
                                            shown, 3);
  ImGui::Dummy(ImVec2(24 + size, size));
  ImGui::SameLine();
  ImGui::TextDisabled("%s", text);
}

}  // namespace

void showViews(Desk& desk, const Frame& frame) {
  ViewOptions& view = desk.view;
  heading("Colours");
  check(desk, "Colliding bodies red", view.collisions, Action::collisions,
        "As in the report: red while it is in contact");
  if (view.collisions) {
    swatch(0xE0261C, "bright: was hit; paler: touches");
  }
  check(desk, "Islands", view.islands, Action::islands, "What hangs together by contacts, a colour each");
  if (view.islands) ImGui::TextDisabled("      %d islands awake", frame.islands);
  check(desk, "Asleep", view.asleep, Action::asleep, "Bodies at rest that cost nothing");
  if (view.asleep) {
    swatch(0x4F7CC4, "asleep");
    swatch(0xE0A030, "held until its launch");
  }
  heading("Drawing");
  check(desk, "Polygons", view.wireframe, Action::wireframe, "As in the report: edges of the triangles, without light");
  ImGui::Checkbox("Dust", &view.dust);
  ImGui::SetNextItemWidth(170);
  if (ImGui::BeginCombo("Shadows", nameOf(view.shadows))) {
    for (int i = 0; i < kShadowChoiceCount; i++) {
      if (ImGui::Selectable(nameOf(ShadowChoice(i)), int(view.shadows) == i)) view.shadows = ShadowChoice(i);
    }
    ImGui::EndCombo();
  }
  note(desk, "Shadows");
  heading("Layers");
  check(desk, "Collider shapes", view.colliders, Action::colliders,
        "What collides: green awake, blue asleep, grey fixed");
  check(desk, "Bounds", view.bounds, Action::boundsTree, "Boxes that the broad phase keeps for each shape");
  if (frame.bounds.size() > kMostBounds)
    ImGui::TextDisabled("      the first %d of %d", int(kMostBounds), int(frame.bounds.size()));
  check(desk, "Contact points", view.contacts, Action::contactPoints, "Normals by force, and friction");
  if (view.contacts) {
    swatch(0xFF5030, "normal force");
    swatch(0xFFE060, "friction");
    swatch(0x60D0FF, "near, not pressing");
  }
  ImGui::SetNextItemWidth(170);
  if (ImGui::BeginCombo("Mortar", viewer::nameOf(view.mortar))) {
    for (int i = 0; i < kMortarViewCount; i++)
      if (ImGui::Selectable(viewer::nameOf(MortarView(i)), int(view.mortar) == i)) view.mortar = MortarView(i);
    ImGui::EndCombo();
  }
  note(desk, "Mortar");
  hint(fmt::format("Joints by how much of their strength they use, or by damage ({})", bindingOf(Action::mortar).key));
  heading("Picture");
  row("Drawn by", desk.card);
  row("Frames a second", fmt::format("{:.0f}", desk.framesPerSecond));
  row("One picture", fmt::format("{:.1f} ms", desk.drawMilliseconds));
}

}  // namespace brickfall::viewer
