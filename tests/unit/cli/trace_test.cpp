// Traces as files: read back as they were written, refused with the line that is wrong, and compared to the first difference.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "brickfall/scene.h"
#include "cli/commands.h"
#include "cli/trace_file.h"

namespace brickfall::cli {
namespace {

Trace sample() {
  Trace t{"wall", 7, 1.0 / 60, {}};
  for (std::uint64_t step = 1; step <= 3; step++)
    for (const char* stage : {"given", "pairs", "solve"}) {
      t.stages.push_back({step, 0, stage, step * 1000 + t.stages.size(), {}});
      if (step == 2) t.stages.back().items = {{"a brick", 1}, {"a brick | ground", 2}};
    }
  return t;
}

TEST(TraceFile, readsWhatWasWritten) {
  const std::string text = toText(sample());
  const Result<Trace> read = parseTrace(text, "x.trace");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_TRUE(read->complete);
  EXPECT_EQ(read->timeStep, 1.0 / 60);
  EXPECT_EQ(toText(*read), text);
  EXPECT_FALSE(firstParting(sample(), *read));
}

TEST(TraceFile, everyPrefixIsReadOrRefused) {
  const std::string text = toText(sample());
  std::size_t stages = 0;
  for (std::size_t n = 0; n <= text.size(); n++) {
    const Result<Trace> read = parseTrace(std::string_view(text).substr(0, n), "x.trace");
    if (!read) {
      EXPECT_LT(n, text.find('\n') + 1) << read.error().message;
      continue;
    }
    EXPECT_EQ(read->complete, n == text.size());
    EXPECT_GE(read->stages.size(), stages);
    stages = read->stages.size();
  }
  EXPECT_EQ(stages, sample().stages.size());
}

TEST(TraceFile, mistakesAreNamedByLine) {
  const std::pair<const char*, const char*> cases[] = {
      {"", "x.trace:1: found nothing"},
      {"a wall\n", "x.trace:1: found \"a wall\", expected \"brickfall-trace 1\""},
      {"brickfall-trace 1\nseed two\n", "x.trace:2: found \"seed two\""},
      {"brickfall-trace 1\ntime_step -1\n", "x.trace:2:"},
      {"brickfall-trace 1\nstep 0 0 given 0000000000000001\n", "x.trace:2: found \"step 0 0 given"},
      {"brickfall-trace 1\nstep 1 0 given 12\n", "expected step NUMBER SUBSTEP STAGE HASH"},
      {"brickfall-trace 1\nstep 1 0 given 000000000000000g\n", "x.trace:2:"},
      {"brickfall-trace 1\nitem 0000000000000001 b\n", "expected item HASH NAME, after a step"},
      {"brickfall-trace 1\nend\nend\n", "x.trace:3: found more text"},
      {"brickfall-trace 1\nstage\n", "expected scene, seed, time_step, step, item or end"},
  };
  for (const auto& [text, words] : cases) {
    const Result<Trace> read = parseTrace(text, "x.trace");
    ASSERT_FALSE(read.ok()) << text;
    EXPECT_NE(read.error().message.find(words), std::string::npos) << read.error().message;
  }
}

TEST(TraceFile, theFirstDifferenceIsFound) {
  const Trace a = sample();
  for (std::size_t i = 0; i < a.stages.size(); i++) {
    Trace b = a;
    b.stages[i].hash++;
    const std::optional<Parting> parting = firstParting(a, b);
    ASSERT_TRUE(parting);
    EXPECT_EQ(parting->step, a.stages[i].step);
    EXPECT_EQ(parting->stage, a.stages[i].stage);
    EXPECT_FALSE(parting->ended);
    EXPECT_EQ(parting->hasItems, a.stages[i].step == 2);
  }
  Trace other = a, longer = a;
  other.stages[4].hash++;
  other.stages[4].items[1].hash++;
  EXPECT_EQ(firstParting(a, other)->item, "a brick | ground");
  longer.stages.push_back({4, 0, "given", 1, {}});
  EXPECT_TRUE(firstParting(a, longer)->ended);
  EXPECT_EQ(firstParting(longer, a)->step, 4u);
}

// The commands themselves, on the shipped cube.
class TraceCommands : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) / ("brickfall_trace_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  int write(const std::string& name, std::optional<std::uint64_t> items, const char* density = nullptr) const {
    TraceCommand command;
    command.scene = "cube";
    command.output = path(name);
    command.seconds = 0.8;
    command.itemsOfStep = items;
    command.quiet = true;
    if (density) command.overrides.push_back({"world.air_density", density});
    return trace(command);
  }
  std::string compare(const std::string& a, const std::string& b, int expected) const {
    testing::internal::CaptureStdout();
    EXPECT_EQ(compareTraces(path(a), path(b)), expected);
    std::fflush(stdout);
    return testing::internal::GetCapturedStdout();
  }
  std::filesystem::path folder_;
};

TEST_F(TraceCommands, equalRunsAreTheSame) {
  ASSERT_EQ(write("a.trace", {}), kOk);
  ASSERT_EQ(write("b.trace", {}), kOk);
  EXPECT_NE(compare("a.trace", "b.trace", kOk).find("the same in all 48 steps"), std::string::npos);
}

TEST_F(TraceCommands, aRunThatWasChangedIsFound) {
  ASSERT_EQ(write("a.trace", 17), kOk);
  // One bit of a hash, as if the solve of step 17 had computed otherwise from there on.
  std::ifstream file(path("a.trace"));
  std::stringstream text;
  text << file.rdbuf();
  Result<Trace> changed = parseTrace(text.str(), "a.trace");
  ASSERT_TRUE(changed.ok());
  for (TraceStage& s : changed->stages)
    if (s.step > 17 || (s.step == 17 && s.stage == "store")) {
      s.hash ^= 1;
      for (TraceItem& item : s.items) item.hash ^= item.name == "cube";
    }
  std::ofstream(path("b.trace")) << toText(*changed);
  const std::string told = compare("a.trace", "b.trace", kParted);
  EXPECT_NE(told.find("step 17 (0.283333 s), substep 0, stage store"), std::string::npos) << told;
  EXPECT_NE(told.find("first to differ: cube"), std::string::npos) << told;
}

TEST_F(TraceCommands, filesThatCannotBeCompared) {
  ASSERT_EQ(write("a.trace", {}), kOk);
  std::ofstream(path("bad.trace")) << "not a trace\n";
  std::ofstream(path("other.trace")) << "brickfall-trace 1\nscene wall\nseed 1\ntime_step 0.01\nend\n";
  testing::internal::CaptureStderr();
  compare("a.trace", "missing.trace", kFileError);
  compare("a.trace", "bad.trace", kBadInput);
  compare("a.trace", "other.trace", kBadInput);
  const std::string errors = testing::internal::GetCapturedStderr();
  EXPECT_NE(errors.find("cannot read trace"), std::string::npos) << errors;
  EXPECT_NE(errors.find("bad.trace:1: found \"not a trace\""), std::string::npos) << errors;
  EXPECT_NE(errors.find("only traces of one scene"), std::string::npos) << errors;
}

}  // namespace
}  // namespace brickfall::cli
