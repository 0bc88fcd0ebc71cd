// What has happened, newest first.
#include <fmt/format.h>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

ImVec4 colourOf(LogKind kind) {
  switch (kind) {
    case LogKind::error:
      return {1, 0.45f, 0.40f, 1};
    case LogKind::warning:
    case LogKind::quarantine:
      return {1, 0.80f, 0.40f, 1};
    case LogKind::hit:
      return {0.95f, 0.62f, 0.45f, 1};
    case LogKind::asleep:
    case LogKind::awake:
      return {0.55f, 0.70f, 0.95f, 1};
    default:
      return ImGui::GetStyleColorVec4(ImGuiCol_Text);
  }
}

}  // namespace

void showEvents(Desk&, const Frame& frame) {
  static bool hits = true;
  ImGui::Checkbox("Hits", &hits);
  ImGui::SameLine();
  ImGui::TextDisabled("newest first");
  if (frame.log->empty()) ImGui::TextDisabled("Nothing yet.");
  for (auto line = frame.log->rbegin(); line != frame.log->rend(); ++line) {
    if (line->kind == LogKind::hit && !hits) continue;
    ImGui::TextDisabled("%6.2f s", line->time);
    ImGui::SameLine(70);
    ImGui::PushTextWrapPos(0);
    ImGui::PushStyleColor(ImGuiCol_Text, colourOf(line->kind));
    ImGui::TextUnformatted(line->text.c_str());
    ImGui::PopStyleColor();
    ImGui::PopTextWrapPos();
  }
}

}  // namespace brickfall::viewer
