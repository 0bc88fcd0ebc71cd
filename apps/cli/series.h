// The figures of a run over time: one row a frame of the take. docs/series.md says what each column means.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "brickfall/export.h"
#include "brickfall/scene.h"
#include "cli/metrics.h"

namespace brickfall::cli {

using SeriesColumn = TakeColumn;

class RunSeries {
 public:
  // The first row: the world as it is.
  RunSeries(const SceneRun& run, const RunMetrics& metrics);
  // After every step and its metrics.
  void afterStep(const SceneRun& run, const StepReport& report, const RunMetrics& metrics);
  // All of the same length. A run of more than 40 000 frames has every second of them, or every fourth ...
  const std::vector<SeriesColumn>& columns() const { return columns_; }

 private:
  void countBreaks(const World& world);
  void addRow(const SceneRun& run, double time, const RunMetrics& metrics);
  void halve();

  double framesPerSecond_;
  double nextFrame_ = 1;
  std::uint64_t frame_ = 0, every_ = 1;
  double brokenMortar_ = 0, brokenJoints_ = 0;
  std::vector<float> forces_;  // N, on each body, by BodyId::index
  std::vector<SeriesColumn> columns_;
};

// One line of names, one line a row.
std::string toCsv(const std::vector<SeriesColumn>& columns);

}  // namespace brickfall::cli
