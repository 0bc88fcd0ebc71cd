// The scale of colours for mortar.
#include <fmt/format.h>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {

void showMortarLegend(Desk& desk, const Frame& frame) {
  constexpr int kSteps = 40;
  constexpr float kWidth = 300, kBar = 14, kMargin = 10;
  const bool damage = desk.view.mortar == MortarView::damage;
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_AlwaysAutoResize;
  const float left = desk.panelShown ? kPanelWidth + 2 * kMargin : kMargin;
  const float low = float(desk.size.height) - (desk.panelShown ? kBarHeight + 2 * kMargin : kMargin);
  ImGui::SetNextWindowPos(ImVec2(left, low), ImGuiCond_Always, ImVec2(0, 1));
  if (ImGui::Begin("mortar legend", nullptr, kFlags)) {
    cover(desk);
    note(desk, "mortar legend");
    ImGui::TextUnformatted(damage ? "Mortar: damage, share of its energy that is spent"
                                  : "Mortar: utilisation, load over strength");
    const ImVec2 at = ImGui::GetCursorScreenPos();
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    for (int i = 0; i < kSteps; i++) {
      const std::uint32_t colour = scaleColour((i + 0.5) / kSteps);
      draw.AddRectFilled(ImVec2(at.x + kWidth * float(i) / kSteps, at.y),
                         ImVec2(at.x + kWidth * float(i + 1) / kSteps, at.y + kBar),
                         IM_COL32(colour >> 16 & 255, colour >> 8 & 255, colour & 255, 255));
    }
    ImGui::Dummy(ImVec2(kWidth, kBar));
    const ImVec2 below = ImGui::GetCursorScreenPos();
    for (int quarter = 0; quarter <= 4; quarter++) {
      const std::string text = fmt::format("{}", 25 * quarter);
      const float width = ImGui::CalcTextSize(text.c_str()).x;
      const float x = at.x + kWidth * float(quarter) / 4 - width * float(quarter) / 4;
      draw.AddText(ImVec2(x, below.y), ImGui::GetColorU32(ImGuiCol_Text), text.c_str());
    }
    ImGui::Dummy(ImVec2(kWidth, ImGui::GetTextLineHeight()));
    int broken = 0;
    for (const FrameMortar& joint : frame.mortar) broken += joint.damage >= 1;
    if (frame.mortar.empty())
      ImGui::TextDisabled("There is no mortar here");
    else
      ImGui::TextDisabled("%% of each joint; %d of %d broken%s", broken, int(frame.mortar.size()),
                          damage ? "" : ", not shown");
  }
  ImGui::End();
}

}  // namespace brickfall::viewer
