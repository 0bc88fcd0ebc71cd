// Ctrl-C: what was simulated is kept, in every form.
#include <unistd.h>

#include <csignal>
#include <nlohmann/json.hpp>

#include "bad_input/cli/command_fixture.h"
#include "brickfall/take.h"

namespace brickfall::test {
namespace {

class Interrupt : public Command {
 protected:
  // Waits until the run has recorded something, however long that takes; false if it ended by itself before.
  bool waitForTake(Process& process, const std::string& name, std::uintmax_t bytes) const {
    while (process.running()) {
      std::error_code error;
      const auto size = std::filesystem::file_size(folder_ / name, error);
      if (!error && size > bytes) return true;
      usleep(5000);
    }
    return false;
  }
};

TEST_F(Interrupt, endsTheRunAndWritesEverything) {
  for (const auto& [signal, code] : {std::pair{SIGINT, 130}, std::pair{SIGTERM, 143}, std::pair{SIGHUP, 129}}) {
    std::filesystem::remove_all(folder_ / "out");
    Process process(folder_, {"run", "cube", "--seconds", "100000"});
    ASSERT_TRUE(waitForTake(process, "out/cube/cube.take.part", 4000)) << process.finish().errors;
    process.send(signal);
    const Finished ended = process.finish();
    EXPECT_EQ(ended.exitCode, code) << ended.errors;
    EXPECT_TRUE(isOneComplaint(ended.errors, {"interrupted after", "is kept"}));

    const auto summary = nlohmann::json::parse(read("out/cube/summary.json"));
    EXPECT_GT(summary["steps"].get<int>(), 0);
    EXPECT_LT(summary["simulated_s"].get<double>(), 100000);
    EXPECT_TRUE(exists("out/cube/replay.html"));
    EXPECT_TRUE(exists("out/cube/cube.glb"));
    const Result<TakeReader> take = TakeReader::open((folder_ / "out/cube/cube.take").string());
    ASSERT_TRUE(take) << take.error().message;
    EXPECT_TRUE(take->complete());
    EXPECT_GT(take->frameCount(), 1u);
    EXPECT_FALSE(exists("out/cube/cube.take.part"));
  }
}

TEST_F(Interrupt, aKilledRunLeavesATakeThatOpens) {
  Process process(folder_, {"run", "cube", "--seconds", "100000"});
  ASSERT_TRUE(waitForTake(process, "out/cube/cube.take.part", 4000)) << process.finish().errors;
  process.send(SIGKILL);
  EXPECT_EQ(process.finish().signal, SIGKILL);
  EXPECT_FALSE(exists("out/cube/cube.take")) << "under its name a take is whole";
  const Finished missing = run({"replay", "out/cube/cube.take"});
  EXPECT_EQ(missing.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(missing.errors, {"No such file", "cut off left 'out/cube/cube.take.part'"}));
  const Finished again = run({"replay", "out/cube/cube.take.part", "-o", "again"});
  EXPECT_EQ(again.exitCode, 0) << again.errors;
  EXPECT_TRUE(isOneComplaint(again.errors, {"cut off", "whole frames up to", "bytes of a torn one"}));
  EXPECT_TRUE(exists("again/replay.html"));
}

}  // namespace
}  // namespace brickfall::test
