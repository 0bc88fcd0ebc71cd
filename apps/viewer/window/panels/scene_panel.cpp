// What can be opened.
#include <fmt/format.h>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

std::string shortened(const std::string& text, float room) {
  if (ImGui::CalcTextSize(text.c_str()).x <= room) return text;
  std::string out = text;
  while (out.size() > 4 && ImGui::CalcTextSize((out + "...").c_str()).x > room) out.pop_back();
  return out + "...";
}

void showEntry(Desk& desk, const Frame& frame, const MenuEntry& entry) {
  const bool open = frame.info && frame.info->name == entry.scene;
  ImGui::PushID(entry.label.c_str());
  if (open) ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(ImGuiCol_HeaderHovered));
  if (ImGui::Selectable("##entry", open, 0, ImVec2(0, 40))) desk.send(Open{entry.scene, {}, false});
  if (open) ImGui::PopStyleColor();
  note(desk, ("scene:" + entry.scene).c_str());
  const ImVec2 at = ImGui::GetItemRectMin();
  const float room = ImGui::GetItemRectSize().x - 16;
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const std::string label = shortened(entry.label, room), title = shortened(entry.hint, room);
  list.AddText(ImVec2(at.x + 8, at.y + 3), ImGui::GetColorU32(ImGuiCol_Text), label.c_str());
  list.AddText(ImVec2(at.x + 8, at.y + 21), ImGui::GetColorU32(ImGuiCol_TextDisabled), title.c_str());
  if (label != entry.label || title != entry.hint) hint(entry.label + "\n" + entry.hint);
  ImGui::PopID();
}

}  // namespace

void showScenes(Desk& desk, const Frame& frame) {
  if (frame.info && frame.info->kind != RunKind::nothing) {
    heading(frame.info->title.empty() ? frame.info->name.c_str() : frame.info->title.c_str());
    if (!frame.info->description.empty()) {
      ImGui::PushTextWrapPos(0);
      ImGui::TextDisabled("%s", frame.info->description.c_str());
      ImGui::PopTextWrapPos();
    }
  }
  for (const MenuGroup& group : desk.menu) {
    heading(group.label.c_str());
    ImGui::PushID(group.label.c_str());
    for (const MenuEntry& entry : group.entries) showEntry(desk, frame, entry);
    ImGui::PopID();
  }
  heading("A file");
  actionButton(desk, Action::openScene, "Open a file ...", ImVec2(-1, 0));
  ImGui::TextDisabled("or drop it onto the window");
}

}  // namespace brickfall::viewer
