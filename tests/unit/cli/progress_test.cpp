#include "cli/progress.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace brickfall::cli {
namespace {

TEST(Progress, durationsReadWell) {
  EXPECT_EQ(durationText(0.42), "0.4 s");
  EXPECT_EQ(durationText(9.96), "10 s");
  EXPECT_EQ(durationText(59.4), "59 s");
  EXPECT_EQ(durationText(185), "3 min 5 s");
  EXPECT_EQ(durationText(7800), "2 h 10 min");
  EXPECT_EQ(durationText(0.0 / 0.0), "very long");
  EXPECT_EQ(durationText(1e300), "very long");
}

TEST(Progress, textTellsSpeedAndWhatIsLeft) {
  const std::string text = progressText({2, 10, 120, 0.5});
  EXPECT_NE(text.find("2.00 of 10 s"), std::string::npos) << text;
  EXPECT_NE(text.find("240 steps/s"), std::string::npos) << text;
  EXPECT_NE(text.find("4.0 x real time"), std::string::npos) << text;
  EXPECT_NE(text.find("2.0 s left"), std::string::npos) << text;
}

TEST(Progress, countedWorkTellsWhatIsLeft) {
  EXPECT_EQ(workText({"picture", 0, 300, 0, 0}), "picture 0 of 300");
  EXPECT_EQ(workText({"picture", 100, 300, 0, 50}), "picture 100 of 300  0.50 s each  1 min 40 s left");
  EXPECT_EQ(workText({"picture", 100, 300, 90, 20}), "picture 100 of 300  2.00 s each  6 min 40 s left")
      << "those of an earlier run say nothing of the speed";
  EXPECT_EQ(workText({"step", 500, 1000, 0, 1}), "step 500 of 1000  2.00 ms each  1.0 s left");
  EXPECT_EQ(workText({"picture", 300, 300, 300, 1}), "picture 300 of 300");
  EXPECT_NE(workLine({"picture", 150, 300, 0, 50}, 200).find("[###############               ]"), std::string::npos);
  testing::internal::CaptureStdout();
  ProgressDisplay display(ProgressDisplay::Mode::plain);
  for (std::uint64_t i = 1; i <= 40; i++) display.updateWork({"picture", i, 40, 0, double(i)});
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 10) << said;
}

TEST(Progress, nothingIsDividedByZero) {
  EXPECT_EQ(progressText({0, 10, 0, 0}), "  0.00 of 10 s");
  EXPECT_EQ(progressText({0, 0, 0, 0}), "  0.00 of 0 s");
}

TEST(Progress, lineFitsTheTerminal) {
  const ProgressState state{5, 10, 300, 1};
  for (int columns : {0, 1, 10, 40, 80, 200}) EXPECT_LE(int(progressLine(state, columns).size()), columns);
  EXPECT_NE(progressLine(state, 200).find("[###############               ]"), std::string::npos);
  EXPECT_EQ(progressLine(state, 40).find('['), std::string::npos);
}

// One plain line a tenth, the last one included, however the steps fall.
TEST(Progress, plainModeSaysEveryTenthOnce) {
  for (int steps : {7, 10, 600}) {
    testing::internal::CaptureStdout();
    ProgressDisplay display(ProgressDisplay::Mode::plain);
    for (int i = 1; i <= steps; i++) display.update({i * (1.0 / 60), steps * (1.0 / 60), std::uint64_t(i), i * 0.01});
    display.finish();
    const std::string said = testing::internal::GetCapturedStdout();
    const auto lines = std::count(said.begin(), said.end(), '\n');
    EXPECT_EQ(lines, std::min(steps, 10)) << said;
    EXPECT_EQ(said.find('\r'), std::string::npos);
    EXPECT_NE(said.find("100 %"), std::string::npos) << said;
  }
}

TEST(Progress, silentModeSaysNothing) {
  testing::internal::CaptureStdout();
  ProgressDisplay display(ProgressDisplay::Mode::silent);
  display.update({10, 10, 600, 1});
  display.update("writing", 0.5);
  display.finish();
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST(Progress, liveModeStaysOnOneLineAndClearsIt) {
  testing::internal::CaptureStdout();
  ProgressDisplay display(ProgressDisplay::Mode::live);
  for (int i = 1; i <= 600; i++) display.update({i / 60.0, 10, std::uint64_t(i), i * 0.001});
  display.finish();
  const std::string said = testing::internal::GetCapturedStdout();
  EXPECT_EQ(said.find('\n'), std::string::npos);
  // 0.6 s by the clock, drawn at most every 0.1 s and once at the end.
  EXPECT_LE(std::count(said.begin(), said.end(), '\r'), 9);
  EXPECT_TRUE(said.ends_with("\r\x1b[K"));
}

}  // namespace
}  // namespace brickfall::cli
