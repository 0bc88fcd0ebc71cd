// A recorded list of calls, played into a fresh world, gives the same bits in every step: what replays and lockstep
// networking stand on.
#include "support/input_list.h"

#include <array>

#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

constexpr int kSteps = 200;

TEST(InputList, playedIntoAFreshWorldGivesTheSameBits) {
  for (int seed : {1, 2, 3}) {
    const InputList list = randomInputs(seed, kSteps);
    World first = makeWorld(), second = makeWorld();
    const Played a = play(list, first), b = play(list, second);
    ASSERT_EQ(a.hashes.size(), std::size_t(kSteps));
    EXPECT_EQ(a.hashes, b.hashes) << "seed " << seed;
    EXPECT_EQ(a.refused, b.refused);
    EXPECT_NE(a.hashes[0], a.hashes.back());
    expectSound(first);
  }
}

TEST(InputList, threadsDoNotMatter) {
  WorldDef def;
  def.threads = 4;
  const InputList list = randomInputs(4, kSteps);
  World one = makeWorld(), four = makeWorld(def);
  EXPECT_EQ(play(list, one).hashes, play(list, four).hashes);
}

// Otherwise the tests above could pass with a list of which nothing is done.
TEST(InputList, everyKindOfCallIsMadeAndTaken) {
  std::array<int, std::size_t(InputKind::count)> made{};
  const InputList list = randomInputs(1, kSteps);
  for (const Input& input : list.inputs()) made[std::size_t(input.kind)]++;
  for (std::size_t kind = 0; kind < made.size(); kind++) EXPECT_GT(made[kind], 0) << "kind " << kind;
  World world = makeWorld();
  const Played played = play(list, world);
  EXPECT_LT(played.refused, int(list.inputs().size()) / 3);  // some bodies are gone, or of another type
}

TEST(InputList, oneOtherCallIsSeen) {
  InputList list = randomInputs(1, 20), other = list;
  list.call(InputKind::impulse, 5, {1e-6, 0, 0});
  other.call(InputKind::impulse, 5, {2e-6, 0, 0});
  list.step(kDt);
  other.step(kDt);
  World a = makeWorld(), b = makeWorld();
  EXPECT_NE(play(list, a).hashes.back(), play(other, b).hashes.back());
}

}  // namespace
}  // namespace brickfall
