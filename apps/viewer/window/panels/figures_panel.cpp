// Counters of the step and where its time goes.
#include <fmt/format.h>

#include <algorithm>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

template <class Value> void plot(const Frame& frame, const char* name, const char* unit, Value value) {
  std::vector<float> values;
  for (const StepSample& sample : frame.samples) values.push_back(float(value(sample)));
  const float most = values.empty() ? 0 : *std::max_element(values.begin(), values.end());
  const float last = values.empty() ? 0 : values.back();
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(150);
  ImGui::Text("%s", numberText(last, unit).c_str());
  ImGui::SameLine();
  ImGui::TextDisabled("most %s", numberText(most).c_str());
  ImGui::PlotLines(("##" + std::string(name)).c_str(), values.data(), int(values.size()), 0, nullptr, 0,
                   std::max(most * 1.1f, 1e-3f), ImVec2(ImGui::GetContentRegionAvail().x, 38));
}

void showStages(const Frame& frame) {
  std::array<float, kStageCount> mean{};
  for (const StepSample& sample : frame.samples) {
    for (int i = 0; i < kStageCount; i++) mean[i] += sample.stageMilliseconds[i] / float(frame.samples.size());
  }
  const float most = std::max(*std::max_element(mean.begin(), mean.end()), 1e-4f);
  heading("Stages of the step, mean");
  for (int i = 0; i < kStageCount; i++) {
    const std::string name(kStageNames[i]);
    ImGui::TextDisabled("%s", name.c_str());
    ImGui::SameLine(90);
    ImGui::ProgressBar(mean[i] / most, ImVec2(-1, 16), fmt::format("{:.3f} ms", mean[i]).c_str());
  }
}

}  // namespace

void showFigures(Desk& desk, const Frame& frame) {
  desk.figuresShown = true;
  if (!frame.report) {
    ImGui::TextWrapped(frame.info && frame.info->kind == RunKind::take
                           ? "A take has poses and forces, no figures of the step."
                           : "Nothing has been simulated yet.");
    return;
  }
  const StepReport& report = *frame.report;
  row("Bodies", fmt::format("{} ({} awake)", report.bodies, report.awakeBodies));
  row("Islands", fmt::format("{} ({} at rest)", report.islands, report.restingIslands));
  row("Contact points", fmt::format("{} ({} press)", report.contactPoints, report.touchingPoints));
  row("Cycles", fmt::format("{}", report.cycles));
  row("Reached speed", fmt::format("{:.2f} of {:.2f}", frame.status.reachedSpeed, frame.status.speed));
  row("Kept for rewinding", fmt::format("{:.1f} MB", double(frame.status.historyBytes) / 1e6));
  heading("The last steps");
  plot(frame, "One step", "ms", [](const StepSample& sample) { return sample.milliseconds; });
  plot(frame, "Awake bodies", "", [](const StepSample& sample) { return sample.awakeBodies; });
  plot(frame, "Contact points", "", [](const StepSample& sample) { return sample.contactPoints; });
  plot(frame, "Islands", "", [](const StepSample& sample) { return sample.islands; });
  plot(frame, "Cycles", "", [](const StepSample& sample) { return sample.cycles; });
  if (!frame.samples.empty()) showStages(frame);
}

}  // namespace brickfall::viewer
