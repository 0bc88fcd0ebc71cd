// Keys and mouse, from the tables that act on them.
#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

void showKeys(std::string_view group) {
  heading(std::string(group).c_str());
  for (const KeyBinding& binding : keyBindings()) {
    if (binding.group != group) continue;
    ImGui::TextColored(ImVec4(0.93f, 0.66f, 0.52f, 1), "%s", std::string(binding.key).c_str());
    ImGui::SameLine(96);
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(std::string(binding.help).c_str());
    ImGui::PopTextWrapPos();
  }
}

}  // namespace

void showHelp(Desk& desk) {
  const ImVec2 size(std::min(1080.0f, float(desk.size.width) - 40), std::min(640.0f, float(desk.size.height) - 40));
  ImGui::SetNextWindowPos(ImVec2(float(desk.size.width) / 2, float(desk.size.height) / 2), 0, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(size);
  if (ImGui::Begin("Help", &desk.helpShown, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize)) {
    cover(desk);
    ImGui::Columns(size.x > 700 ? 3 : 1, nullptr, false);
    heading("Mouse");
    for (const MouseBinding& binding : mouseBindings()) {
      ImGui::TextColored(ImVec4(0.93f, 0.66f, 0.52f, 1), "%s", std::string(binding.button).c_str());
      ImGui::PushTextWrapPos(0);
      ImGui::TextUnformatted(std::string(binding.help).c_str());
      ImGui::PopTextWrapPos();
    }
    std::string_view group;
    for (const KeyBinding& binding : keyBindings()) {
      if (binding.group == group) continue;
      group = binding.group;
      if (group == "Hands" || group == "View") ImGui::NextColumn();
      showKeys(group);
    }
    ImGui::Columns(1);
  }
  ImGui::End();
}

}  // namespace brickfall::viewer
