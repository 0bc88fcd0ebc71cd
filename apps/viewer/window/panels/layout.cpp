#include <imgui.h>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

constexpr ImGuiWindowFlags kInPlace = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings;

using Show = void (*)(Desk&, const Frame&);
struct Tab {
  const char* name;
  Show show;
};
constexpr Tab kTabs[] = {{"Scenes", showScenes},     {"Tools", showTools},     {"Views", showViews},
                         {"Settings", showSettings}, {"Figures", showFigures}, {"Events", showEvents}};

void showTabs(Desk& desk, const Frame& frame) {
  desk.figuresShown = false;
  const float margin = 10;
  ImGui::SetNextWindowPos(ImVec2(margin, margin));
  ImGui::SetNextWindowSize(ImVec2(std::min(kPanelWidth, float(desk.size.width) - 2 * margin),
                                  float(desk.size.height) - kBarHeight - 3 * margin));
  if (ImGui::Begin("panel", nullptr, kInPlace)) {
    cover(desk);
    // Two rows of three: six names do not fit beside each other.
    static int open = 0;
    const float width = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    for (int i = 0; i < int(std::size(kTabs)); i++) {
      if (i % 3 != 0) ImGui::SameLine();
      const bool chosen = open == i;
      const ImVec4 accent = ImGui::GetStyleColorVec4(ImGuiCol_TabActive);
      if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, accent);
      if (chosen) ImGui::PushStyleColor(ImGuiCol_ButtonHovered, accent);
      if (ImGui::Button(kTabs[i].name, ImVec2(width, 0))) open = i;
      note(desk, kTabs[i].name);
      if (chosen) ImGui::PopStyleColor(2);
    }
    ImGui::Separator();
    ImGui::BeginChild("content", ImVec2(0, 0), false, ImGuiWindowFlags_NoBackground);
    kTabs[open].show(desk, frame);
    ImGui::EndChild();
  }
  ImGui::End();
}

}  // namespace

void showPanel(Desk& desk, const Frame& frame, double now) {
  desk.places.clear();
  desk.covers.clear();
  desk.figuresShown = false;
  if (desk.panelShown) {
    showTabs(desk, frame);
    showTimeBar(desk, frame);
    if (frame.selected) showBody(desk, frame);
  }
  if (desk.view.mortar != MortarView::none) showMortarLegend(desk, frame);
  if (frame.selected && desk.panelShown) showContactNumbers(desk, frame);
  if (desk.helpShown) showHelp(desk);
  if (desk.filesShown) showFiles(desk);
  showMessages(desk, frame, now);
}

}  // namespace brickfall::viewer
