// The bar at the bottom: running, stepping, the speed, and the line of time.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

void showButtons(Desk& desk, const RunStatus& status) {
  actionButton(desk, Action::runOrPause, status.running ? "Pause" : "Run", ImVec2(76, 0));
  ImGui::SameLine();
  actionButton(desk, Action::stepBack, "< Step");
  ImGui::SameLine();
  actionButton(desk, Action::step, "Step >");
  ImGui::SameLine();
  actionButton(desk, Action::restart, "Restart");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(150);
  auto speed = float(status.speed);
  if (slider("##speed", speed, float(kSlowest), float(kFastest), "x %.2f", ImGuiSliderFlags_Logarithmic)) {
    // The middle of a slider is hard to meet.
    if (std::fabs(speed - 1) < 0.06f) speed = 1;
    desk.send(SetSpeed{speed});
  }
  note(desk, "speed");
  hint("Slow motion and fast forward: the time step stays the same");
}

void showState(const Frame& frame) {
  const RunStatus& status = frame.status;
  ImGui::AlignTextToFramePadding();
  if (!status.loading.empty()) {
    ImGui::TextDisabled("loading %s ...", status.loading.c_str());
  } else if (!status.recording.empty()) {
    ImGui::TextColored(ImVec4(1, 0.35f, 0.3f, 1), "recording");
  } else if (status.running && status.reachedSpeed > 0 && status.reachedSpeed < 0.9 * status.speed) {
    ImGui::TextDisabled("x %.2f reached", status.reachedSpeed);
    hint("The simulation takes longer than the time that it simulates: it is slower, not coarser");
  } else {
    ImGui::TextDisabled("%s", status.running ? "" : "paused");
  }
}

}  // namespace

void showTimeBar(Desk& desk, const Frame& frame) {
  const RunStatus& status = frame.status;
  ImGui::SetNextWindowPos(ImVec2(10, float(desk.size.height) - kBarHeight - 10));
  ImGui::SetNextWindowSize(ImVec2(float(desk.size.width) - 20, kBarHeight));
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                                      ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoScrollbar |
                                      ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("time", nullptr, kFlags)) {
    cover(desk);
    showButtons(desk, status);
    ImGui::SameLine();
    showState(frame);
    const bool take = frame.info && frame.info->kind == RunKind::take;
    const double latest = std::max(status.latest, status.time);
    const double end = std::max(latest, status.earliest + 1e-3);
    auto time = float(status.time);
    ImGui::SetNextItemWidth(-1);
    const std::string text = fmt::format("{:.2f} s{}", status.time, take ? fmt::format(" of {:.2f} s", latest) : "");
    if (slider("##time", time, float(status.earliest), float(end), text.c_str())) {
      // A float is coarser than the times: its ends are what they stand for.
      const double wanted = time >= float(end) ? latest : time <= float(status.earliest) ? status.earliest : time;
      desk.send(Rewind{std::clamp(wanted, status.earliest, latest)});
    }
    note(desk, "time");
    hint(take ? "Any moment of the take" : "Back to any of the last 30 s; it goes on from there exactly as it did");
  }
  ImGui::End();
}

}  // namespace brickfall::viewer
