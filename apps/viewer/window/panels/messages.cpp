// What commands answered: done for some seconds, mistakes until they are closed.
#include <algorithm>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {

void showMessages(Desk& desk, const Frame& frame, double now) {
  std::erase_if(desk.messages, [now](const Message& message) { return !message.error && now > message.until; });
  float top = 12;
  const bool right = frame.selected.has_value() && desk.panelShown;
  const float from = desk.panelShown ? kPanelWidth + 30 : 20;
  const float width = std::max(220.0f, float(desk.size.width) - from - (right ? 340.0f : 20.0f));
  int number = 0;
  for (Message& message : desk.messages) {
    ImGui::SetNextWindowPos(ImVec2(from + width / 2, top), 0, ImVec2(0.5f, 0));
    ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(width, 400));
    ImGui::PushStyleColor(ImGuiCol_WindowBg,
                          message.error ? ImVec4(0.42f, 0.11f, 0.09f, 0.96f) : ImVec4(0.11f, 0.16f, 0.13f, 0.92f));
    const std::string name = "message" + std::to_string(number++);
    constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                        ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                        ImGuiWindowFlags_NoFocusOnAppearing;
    if (ImGui::Begin(name.c_str(), nullptr, kFlags)) {
      cover(desk);
      ImGui::PushTextWrapPos(width - 30);
      ImGui::TextUnformatted(message.text.c_str());
      for (const std::string& detail : message.details) ImGui::BulletText("%s", detail.c_str());
      ImGui::PopTextWrapPos();
      if (message.error && ImGui::SmallButton("Close")) message = {"", {}, false, 0};
      top += ImGui::GetWindowHeight() + 6;
    }
    ImGui::End();
    ImGui::PopStyleColor();
  }
}

}  // namespace brickfall::viewer
