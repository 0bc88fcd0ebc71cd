// kill -9 at 100 seeded moments, from the start of the process to past its end: under the final names there are whole files
// only, and from the recording `brickfall replay` makes the results up to the last whole frame.
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <memory>
#include <random>

#include "bad_input/cli/command_fixture.h"
#include "bad_input/cli/left_files.h"
#include "brickfall/take.h"

namespace brickfall::test {
namespace {

constexpr int kKills = 100, kAtOnce = 4;

struct Victim {
  std::unique_ptr<Process> process;
  std::filesystem::path folder;
  double moment = 0;  // seconds of processor time: how busy the machine is does not matter
};

struct Counts {
  int killed = 0, ended = 0, nothing = 0, cutOff = 0, whole = 0, html = 0, torn = 0;
};

class Kill : public Command {
 protected:
  static std::vector<std::string> scene() {
    return {"run", "wall", "--set", "wall.mortar=lime", "--seconds", "1.5", "-o", "out", "--quiet", "--threads", "1"};
  }

  // Of one whole run.
  double processorSecondsOfRun() const {
    std::filesystem::create_directory(folder_ / "first");
    Process process(folder_ / "first", scene());
    double seconds = 0;
    while (process.running()) {
      seconds = std::max(seconds, process.processorSeconds());
      usleep(200);
    }
    EXPECT_EQ(process.finish().exitCode, 0);
    return seconds;
  }

  void look(const std::filesystem::path& folder, Counts& counts) const {
    EXPECT_EQ(problemOfFiles(folder / "out", true), "") << folder;
    const bool whole = std::filesystem::exists(folder / "out/wall.take");
    const std::string take = whole ? "out/wall.take" : "out/wall.take.part";
    counts.html += std::filesystem::exists(folder / "out/replay.html");
    if (!whole && !std::filesystem::exists(folder / take)) {
      counts.nothing++;
      return;
    }
    const Finished again = runCommand(folder, {"replay", take, "-o", "again", "--quiet"});
    const Result<TakeReader> opened = TakeReader::open((folder / take).string());
    if (!opened || opened->frameCount() == 0) {  // killed between making the file and its first frame
      EXPECT_EQ(again.exitCode, 3);
      EXPECT_TRUE(isOneComplaint(again.errors, {take}));
      counts.nothing++;
      return;
    }
    (whole ? counts.whole : counts.cutOff)++;
    counts.torn += opened->tornBytes() > 0;
    EXPECT_TRUE(opened->complete() || !whole) << "finished, and killed before it got its name: whole as well";
    EXPECT_EQ(again.exitCode, 0) << again.errors;
    if (opened->complete())
      EXPECT_EQ(again.errors, "");
    else
      EXPECT_TRUE(isOneComplaint(
          again.errors, {take, "cut off: its " + std::to_string(opened->frameCount()) + " whole frames", "are lost"}));
    for (std::size_t i = 0; i < opened->frameCount(); i++) EXPECT_TRUE(opened->frame(i)) << folder << i;
    EXPECT_EQ(problemOfFiles(folder / "again", false), "");
    EXPECT_TRUE(std::filesystem::exists(folder / "again/replay.html"));
    EXPECT_TRUE(std::filesystem::exists(folder / "again/wall.glb"));
  }
};

TEST_F(Kill, atAHundredMomentsLeavesWholeFilesAndATakeThatReplays) {
  // The least of three: what another job takes of the caches makes a run dearer, and moments would lie after its end.
  const double whole = std::min({processorSecondsOfRun(), processorSecondsOfRun(), processorSecondsOfRun()});
  ASSERT_GT(whole, 0);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> moment(0, 1.1 * whole);
  std::vector<Victim> victims;
  Counts counts;
  int started = 0;
  // All runs first, then a look at what they left: looking takes longer than the runs do.
  std::vector<std::filesystem::path> folders;
  while (started < kKills || !victims.empty()) {
    while (started < kKills && int(victims.size()) < kAtOnce) {
      Victim victim;
      victim.folder = folder_ / std::to_string(started++);
      victim.moment = moment(random);
      std::filesystem::create_directory(victim.folder);
      victim.process = std::make_unique<Process>(victim.folder, scene());
      victims.push_back(std::move(victim));
    }
    std::erase_if(victims, [&](Victim& victim) {
      if (victim.process->running() && victim.process->processorSeconds() < victim.moment) return false;
      victim.process->send(SIGKILL);
      const Finished end = victim.process->finish();
      EXPECT_TRUE(end.signal == SIGKILL || end.exitCode == 0) << end.errors;
      (end.signal == SIGKILL ? counts.killed : counts.ended)++;
      folders.push_back(victim.folder);
      return true;
    });
    usleep(200);
  }
  for (const std::filesystem::path& folder : folders) look(folder, counts);
  std::printf(
      "%d killed in %.0f ms of processor time, %d ended before: %d before the first frame, %d takes cut off (%d torn), "
      "%d whole, %d pages\n",
      counts.killed, whole * 1e3, counts.ended, counts.nothing, counts.cutOff, counts.torn, counts.whole, counts.html);
  EXPECT_EQ(counts.killed + counts.ended, kKills);
  EXPECT_GE(counts.killed, 50);
  EXPECT_GE(counts.cutOff, 20);
  EXPECT_GE(counts.whole, 1);
}

}  // namespace
}  // namespace brickfall::test
