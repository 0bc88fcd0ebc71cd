// Row 18u: nothing comes from nothing, in worlds of any bodies at any speed (law/random_world.h).
#include "law/law.h"
#include "law/random_world.h"
#include "law/sweeps.h"

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <thread>

namespace brickfall::law {

namespace {

constexpr double kGain = 1e-3;      // of the energy at the start
constexpr double kMomentum = 1e-9;  // of the largest momentum of a body

// Worlds of one kind in which something was wrong.
struct Count {
  int gained = 0, pushed = 0, spun = 0, through = 0, deep = 0, lost = 0;
  double gain = 0, push = 0, spin = 0;
};

void countWorld(RandomKind kind, int number, Count& out) {
  RandomWorld random = drawWorld(kind, number);
  const RandomOutcome found = runWorld(random);
  EXPECT_LE(found.gain, kGain) << random.text;
  EXPECT_TRUE(found.finite) << random.text;
  // So that it can be looked at.
  if (found.through > 0 || found.deep > 1) std::printf("    through or deep: %s\n", random.text.c_str());
  out.gained += found.gain > kGain;
  out.gain = std::max(out.gain, found.gain);
  out.through += found.through > 0;
  out.deep += found.deep > 1;
  out.lost += !found.finite;
  if (kind != RandomKind::space) return;
  EXPECT_LE(found.linear, kMomentum) << random.text;
  EXPECT_LE(found.angular, kMomentum) << random.text;
  out.pushed += found.linear > kMomentum;
  out.spun += found.angular > kMomentum;
  out.push = std::max(out.push, found.linear);
  out.spin = std::max(out.spin, found.angular);
}

void add(const Count& from, Count& to) {
  to.gained += from.gained, to.pushed += from.pushed, to.spun += from.spun;
  to.through += from.through, to.deep += from.deep, to.lost += from.lost;
  to.gain = std::max(to.gain, from.gain);
  to.push = std::max(to.push, from.push), to.spin = std::max(to.spin, from.spin);
}

// On as many threads as `make validate` says (JOBS); sums and worst cases do not depend on it.
Count countWorlds(RandomKind kind, int cases) {
  const char* jobs = std::getenv("BRICKFALL_VALIDATION_JOBS");
  std::vector<Count> found(std::size_t(std::max(1, jobs ? std::atoi(jobs) : 1)));
  std::atomic<int> next = 0;
  const auto work = [&](Count& mine) {
    for (int i; (i = next++) < cases;) countWorld(kind, i, mine);
  };
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < found.size(); i++) others.emplace_back(work, std::ref(found[i]));
  work(found[0]);
  for (std::thread& other : others) other.join();
  Count out;
  for (const Count& one : found) add(one, out);
  return out;
}

}  // namespace

void sweepRandomWorlds(int cases) {
  for (int k = 0; k < kRandomKinds; k++) {
    const RandomKind kind = RandomKind(k);
    const Count c = countWorlds(kind, cases);
    const std::string where = std::string(nameOf(kind)) + label(", %g worlds: ", cases);
    // Known: fewer than one world in 200 of these; the tests hold the engine to that.
    const double few = std::max(1.0, cases / 200.0);
    atMost(where + "most energy gained / that of the start", 0, c.gain, kGain, "");
    atMost(where + "worlds that gain more than 0.001", 0, c.gained, 0, "");
    atMost(where + "worlds in which a body goes through", 0, c.through, 0, "", few);
    atMost(where + "worlds left with an overlap over 5 mm and 5 % of the size", 0, c.deep, 0, "", few);
    atMost(where + "worlds with a body that is lost", 0, c.lost, 0, "");
    if (kind != RandomKind::space) continue;
    atMost(where + "linear momentum", 0, c.push, kMomentum, "");
    atMost(where + "worlds with angular momentum off by more than 1e-9", 0, c.spun, 0, "");
    atMost(where + "angular momentum", 0, c.spin, kMomentum, "");
  }
}

}  // namespace brickfall::law
