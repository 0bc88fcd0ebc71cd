// summary.json: the figures of a run for people and scripts. docs/summary.md explains each key.
#pragma once
#include <cstdint>
#include <string>

#include "cli/metrics.h"
#include "cli/series.h"

namespace brickfall::cli {

struct Summary {
  std::string scene;
  std::uint64_t seed = 0;
  std::uint64_t stateHash = 0;
  double timeStep = 0;  // s
  int threads = 1;
  double wallClockSeconds = 0;
  RunFigures figures;
  std::string file;  // the scene file, absolute; "-": standard input
};

// Ends with a line break.
std::string toJson(const Summary& summary);
// The summary that a take has: without what the run cost and on how many threads, so that the same run gives the same bytes;
// with the series, as lists by column under "series".
std::string toTakeJson(const Summary& summary, const std::vector<SeriesColumn>& series);

// Of a take, whoever wrote it: the summary without its series (empty: there is none), and the series (none: it has none).
struct TakeSummary {
  std::string summary;
  std::vector<SeriesColumn> series;
};
TakeSummary readTakeSummary(const std::string& json);
// Whether a summary.json is that of the same run, with its cost besides.
bool hasCostOf(const std::string& summaryJson, const std::string& takeSummary);

}  // namespace brickfall::cli
