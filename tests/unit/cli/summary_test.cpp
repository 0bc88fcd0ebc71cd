#include "cli/summary.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace brickfall::cli {
namespace {

using nlohmann::json;

TEST(Summary, hasEveryKeyInItsUnit) {
  Summary summary;
  summary.scene = "wall";
  summary.seed = 7;
  summary.stateHash = 0xabc;
  summary.timeStep = 1.0 / 60;
  summary.threads = 2;
  summary.wallClockSeconds = 3;
  summary.figures.steps = 600;
  summary.figures.simulatedSeconds = 10;
  summary.figures.stepMilliseconds = {2, 1.5, 4, 9};
  summary.figures.stageMilliseconds[int(Stage::solve)] = 1.25;
  summary.figures.bricksMoved50mm = 12;
  summary.figures.penetrationMean = 1.23456789e-5;
  const json parsed = json::parse(toJson(summary));
  EXPECT_EQ(parsed["scene"], "wall");
  EXPECT_EQ(parsed["seed"], 7);
  EXPECT_EQ(parsed["state_hash"], "0000000000000abc");
  EXPECT_EQ(parsed["dt_s"], 1.0 / 60);
  EXPECT_EQ(parsed["threads"], 2);
  EXPECT_EQ(parsed["steps"], 600);
  EXPECT_NEAR(parsed["realtime_factor"].get<double>(), 10 / (600 * 0.002), 1e-5);
  EXPECT_EQ(parsed["step_ms"]["p95"], 4);
  EXPECT_EQ(parsed["stage_ms"].size(), std::size_t(kStageCount));
  EXPECT_EQ(parsed["stage_ms"]["solve"], 1.25);
  EXPECT_EQ(parsed["bricks_moved_50mm"], 12);
  EXPECT_EQ(parsed["penetration_mean_m"], 1.23457e-5);
}

TEST(Summary, staysValidWhateverIsInIt) {
  Summary summary;
  summary.scene = "a\"b\\\n\xff";
  summary.figures.displacementMax = std::numeric_limits<double>::quiet_NaN();
  summary.figures.sagMax = std::numeric_limits<double>::infinity();
  const json parsed = json::parse(toJson(summary));
  EXPECT_TRUE(parsed["displacement_max_m"].is_null());
  EXPECT_TRUE(parsed["sag_max_m"].is_null());
  EXPECT_EQ(parsed["realtime_factor"], 0);
}

}  // namespace
}  // namespace brickfall::cli
