// Answers of commands: done for some seconds, mistakes until they are closed. And how to begin, before anything has happened.
#include <algorithm>
#include <vector>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                    ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoFocusOnAppearing;

// Of the window's width: what panels leave.
struct Room {
  float from = 0, width = 0;
};
Room roomOf(const Desk& desk, const Frame& frame) {
  const bool right = frame.selected.has_value() && desk.panelShown;
  Room room;
  room.from = desk.panelShown ? kPanelWidth + 30 : 20;
  room.width = std::max(220.0f, float(desk.size.width) - room.from - (right ? 340.0f : 20.0f));
  return room;
}

void showBeginning(const Desk& desk, const Frame& frame, const Room& room) {
  const RunStatus& status = frame.status;
  const bool begun = status.running || status.step > 0 || !status.undo.empty() || !status.loading.empty();
  if (begun || !frame.info || frame.info->kind == RunKind::nothing) return;
  const bool take = frame.info->kind == RunKind::take;
  const std::vector<const char*> parts = {take ? "Space plays it" : "Space runs it",
                                          take ? "" : "F or a click shoots a ball", "F1: all keys and help"};
  const float bottom = float(desk.size.height) - (desk.panelShown ? kBarHeight + 22 : 14);
  ImGui::SetNextWindowPos(ImVec2(room.from + room.width / 2, bottom), 0, ImVec2(0.5f, 1));
  ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(room.width, 100));
  if (ImGui::Begin("beginning", nullptr, kFlags | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoBringToFrontOnFocus)) {
    // In one line, or in several where that is too long; never broken within a part.
    float used = 0;
    for (const char* part : parts) {
      const float gap = 28, wide = ImGui::CalcTextSize(part).x;
      if (wide == 0) continue;
      const bool fits = used > 0 && used + gap + wide <= room.width - 30;
      if (fits) ImGui::SameLine(0, gap);
      used = fits ? used + gap + wide : wide;
      ImGui::TextUnformatted(part);
    }
  }
  ImGui::End();
}

}  // namespace

void showMessages(Desk& desk, const Frame& frame, double now) {
  std::erase_if(desk.messages, [now](const Message& message) { return !message.error && now > message.until; });
  float top = 12;
  const Room room = roomOf(desk, frame);
  if (!desk.helpShown && !desk.filesShown) showBeginning(desk, frame, room);
  int number = 0;
  for (Message& message : desk.messages) {
    ImGui::SetNextWindowPos(ImVec2(room.from + room.width / 2, top), 0, ImVec2(0.5f, 0));
    ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(room.width, 400));
    ImGui::PushStyleColor(ImGuiCol_WindowBg,
                          message.error ? ImVec4(0.42f, 0.11f, 0.09f, 0.96f) : ImVec4(0.11f, 0.16f, 0.13f, 0.92f));
    const std::string name = "message" + std::to_string(number++);
    if (ImGui::Begin(name.c_str(), nullptr, kFlags)) {
      cover(desk);
      ImGui::PushTextWrapPos(room.width - 30);
      ImGui::TextUnformatted(message.text.c_str());
      for (const std::string& detail : message.details) {
        ImGui::Bullet();
        ImGui::TextUnformatted(detail.c_str());
      }
      ImGui::PopTextWrapPos();
      if (message.error && ImGui::SmallButton("Close")) message = {"", {}, false, 0};
      if (!message.text.empty() && message.error) note(desk, "Close");
      top += ImGui::GetWindowHeight() + 6;
    }
    ImGui::End();
    ImGui::PopStyleColor();
  }
}

}  // namespace brickfall::viewer
