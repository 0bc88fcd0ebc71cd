// Islands that don't touch know nothing of each other: in whatever order their bodies are made, and whatever was made and
// destroyed before, each body goes the same way bit for bit.
#include <algorithm>
#include <array>
#include <cstring>
#include <map>

#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

struct Piece {
  int group, number;  // of the group
  BodyDef def;
};

// Groups 30 m apart (what rolls out of a heap comes 6 m far): stacks that stand, topple, fall or are hit, a heap of mixed
// shapes, a ball that rolls.
std::vector<Piece> pieces() {
  std::vector<Piece> out;
  int group = 0, number = 0;
  auto place = [&](const ShapeDef& shape, Vec3 at, Vec3 velocity = {}, Quat rotation = {}) {
    BodyDef d = bodyOf(shape, at + Vec3{30.0 * group, 0, 0});
    d.linearVelocity = velocity;
    d.rotation = rotation;
    out.push_back({group, number++, d});
  };
  auto next = [&] {
    group++;
    number = 0;
  };
  for (int i = 0; i < 6; i++) place(boxOf({.2, .1, .1}), {0.02 * (i % 2), .1 + .2 * i, 0});
  next();
  for (int i = 0; i < 5; i++) place(boxOf({.2, .1, .1}), {0.12 * i, .1 + .2 * i, 0});  // leans too far
  next();
  for (int i = 0; i < 4; i++) place(boxOf({.1, .1, .1}), {0, .1 + .2 * i, 0});
  place(sphereOf(0.1, 4000), {-1, 0.5, 0}, {6, 1, 0});
  next();
  for (int i = 0; i < 8; i++) {
    const ShapeDef shapes[] = {boxOf({.1, .12, .15}), sphereOf(.1), capsuleOf(.08, .1), hullOf(.15)};
    ShapeDef shape = shapes[i % 4];
    shape.material.restitution = 0.3;
    place(shape, {.05 * (i % 3), .3 + .3 * i, .04 * (i % 2)}, {}, turn({1, 2, 3}, 25 * i));
  }
  next();
  place(sphereOf(0.2), {0, 0.2, 0}, {0, 0, 1});
  return out;
}

using Key = std::pair<int, int>;
using States = std::vector<std::map<Key, std::array<double, 13>>>;  // by step

std::array<double, 13> stateOf(const World& world, BodyId body) {
  const BodyState s = *world.state(body);
  return {s.position.x,        s.position.y,        s.position.z,       s.rotation.x,       s.rotation.y,
          s.rotation.z,        s.rotation.w,        s.linearVelocity.x, s.linearVelocity.y, s.linearVelocity.z,
          s.angularVelocity.x, s.angularVelocity.y, s.angularVelocity.z};
}

States statesOf(const std::vector<Piece>& order, bool sleep, int destroyedBefore, int steps) {
  WorldDef def;
  def.enableSleep = sleep;
  World world = makeWorld(def);
  addGround(world);
  std::vector<BodyId> old;
  for (int i = 0; i < destroyedBefore; i++) old.push_back(addBox(world, {.1, .1, .1}, {100.0 + i, 5, 0}));
  for (BodyId body : old) EXPECT_TRUE(world.destroyBody(body).ok());
  std::vector<std::pair<Key, BodyId>> bodies;
  for (const Piece& p : order) bodies.push_back({{p.group, p.number}, add(world, p.def)});
  States out;
  for (int i = 0; i < steps; i++) {
    stepSound(world);
    out.emplace_back();
    for (const auto& [key, body] : bodies) out.back()[key] = stateOf(world, body);
  }
  return out;
}

// The first body that differs, as text; empty if every bit is the same.
std::string firstDifference(const States& a, const States& b) {
  for (std::size_t step = 0; step < a.size(); step++)
    for (const auto& [key, state] : a[step])
      if (std::memcmp(state.data(), b[step].at(key).data(), sizeof state) != 0)
        return "step " + std::to_string(step) + ", group " + std::to_string(key.first) + ", body " +
               std::to_string(key.second);
  return "";
}

TEST(CreationOrder, ofIslandsThatDoNotTouchDoesNotMatter) {
  const std::vector<Piece> given = pieces();
  const int steps = 180;
  for (bool sleep : {true, false}) {
    const States wanted = statesOf(given, sleep, 0, steps);
    EXPECT_NE(wanted.front(), wanted.back());
    std::vector<Piece> order = given;
    // Groups the other way round; each keeps its own order.
    std::stable_sort(order.begin(), order.end(), [](const Piece& a, const Piece& b) { return a.group > b.group; });
    EXPECT_EQ(firstDifference(wanted, statesOf(order, sleep, 0, steps)), "") << "groups reversed, sleep " << sleep;
    // One body of each group in turn.
    std::stable_sort(order.begin(), order.end(), [](const Piece& a, const Piece& b) { return a.number < b.number; });
    EXPECT_EQ(firstDifference(wanted, statesOf(order, sleep, 0, steps)), "") << "groups interleaved, sleep " << sleep;
    // Any merging of the groups.
    lab::LabRandom random(7);
    for (int trial = 0; trial < 3; trial++) {
      std::vector<std::vector<Piece>> left(5);
      for (const Piece& p : given) left[std::size_t(p.group)].push_back(p);
      order.clear();
      while (order.size() < given.size()) {
        auto& group = left[std::size_t(random.unit() * 5)];
        if (group.empty()) continue;
        order.push_back(group.front());
        group.erase(group.begin());
      }
      EXPECT_EQ(firstDifference(wanted, statesOf(order, sleep, trial, steps)), "") << "merge " << trial;
    }
  }
}

TEST(CreationOrder, slotsUsedAgainDoNotMatterEither) {
  const std::vector<Piece> given = pieces();
  EXPECT_EQ(firstDifference(statesOf(given, true, 0, 120), statesOf(given, true, 1, 120)), "");
}

// The comparison itself: inside an island the order does matter, and is seen.
TEST(CreationOrder, insideAnIslandIsSeen) {
  std::vector<Piece> order = pieces();
  const States wanted = statesOf(order, true, 0, 180);
  std::reverse(order.begin(), order.end());
  EXPECT_NE(firstDifference(wanted, statesOf(order, true, 0, 180)), "");
}

}  // namespace
}  // namespace brickfall
