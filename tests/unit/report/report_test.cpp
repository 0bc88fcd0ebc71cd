// The report's system: what it does right (a cube falls to the ground), what it does as described (a wall of 100 bricks
// stands for some seconds, then falls by itself), and that each part is a part.
#include "brickfall/report.h"

#include <gtest/gtest.h>

#include "support/lab_scenes.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

ReportBody brick(std::uint64_t id, Vec3 half, Vec3 at) {
  ReportBody b;
  b.id = id;
  b.halfExtents = half;
  b.state.position = at;
  double m = 1900 * 8 * half.x * half.y * half.z;
  Vec3 s = scaled(half, half);
  b.mass = {m, diagonal(Vec3{s.y + s.z, s.z + s.x, s.x + s.y} * (m / 3))};
  return b;
}
ReportBody ground() {
  ReportBody g;
  g.id = 1;
  g.mass.mass = 0;
  g.halfExtents = {20, 1, 20};
  g.state.position = {0, -1, 0};
  return g;
}
std::vector<ReportBody> wall() {
  std::vector<ReportBody> bodies{ground()};
  for (const auto& b : lab::wall(10, 10, 0, {})) bodies.push_back(brick(bodies.size() + 1, b.half, b.centre));
  return bodies;
}
// s until a brick is further than 50 mm from its place; -1 if none is after `seconds`.
double fallsAfter(const ReportSettings& settings, double seconds) {
  ReportSystem system(settings);
  std::vector<ReportBody> bodies = wall(), start = bodies;
  for (int i = 1; i <= seconds * 60; i++) {
    system.step(bodies, {0, -kG, 0}, kDt);
    for (std::size_t k = 0; k < bodies.size(); k++)
      if (!(length(bodies[k].state.position - start[k].state.position) < 0.05)) return i * kDt;
  }
  return -1;
}

TEST(Report, ACubeFallsToTheGroundAndStaysThere) {
  ReportSystem system(ReportSettings{});
  std::vector<ReportBody> bodies{ground(), brick(2, {0.5, 0.5, 0.5}, {0, 2.5, 0})};
  int hits = 0;
  for (int i = 0; i < 180; i++) {
    system.step(bodies, {0, -kG, 0}, kDt);
    hits += system.collisions();
  }
  EXPECT_GT(hits, 10);
  EXPECT_GT(bodies[1].state.position.y, 0.3);
  EXPECT_LT(bodies[1].state.position.y, 1.2);
}

TEST(Report, TheWallStandsForSomeSecondsAndFallsByItself) {
  double after = fallsAfter({}, 10);
  EXPECT_GT(after, 1);
  EXPECT_LT(after, 9);
}

TEST(Report, EveryPartChangesWhatHappens) {
  std::vector<double> sums;
  for (int part = -1; part < 6; part++) {
    ReportSettings s;
    bool* parts[] = {&s.allAxes, &s.lastAxis, &s.restitution, &s.friction, &s.manifold, &s.warmStarting};
    if (part >= 0) *parts[part] = true;
    ReportSystem system(s);
    std::vector<ReportBody> bodies = wall();
    // A brick thrown in.
    bodies.push_back(brick(1000, {0.1, 0.1, 0.1}, {1, 0.4, 1}));
    bodies.back().state.velocity = {0, 0, -8};
    for (int i = 0; i < 60; i++) system.step(bodies, {0, -kG, 0}, kDt);
    double sum = 0;
    for (const ReportBody& b : bodies) sum += length(b.state.position) + length(b.state.velocity);
    for (double other : sums) EXPECT_NE(sum, other) << "part " << part;
    sums.push_back(sum);
  }
}

// What is missing beyond the six parts: sweeps enough to bring the load of all courses to the ground.
TEST(Report, AllPartsCarryTheWallOnlyWithManySweeps) {
  ReportSettings all;
  all.allAxes = all.lastAxis = all.restitution = all.friction = all.manifold = true;
  double after = fallsAfter(all, 1);
  EXPECT_GT(after, 0);
  EXPECT_LT(after, 0.2) << "one sweep, nothing remembered";
  all.warmStarting = true;
  after = fallsAfter(all, 2);
  EXPECT_GT(after, 0.3) << "ten sweeps";
  all.sweeps = 100;
  EXPECT_EQ(fallsAfter(all, 1.5), -1);
}

// Energy from nothing, most of it in spins: impulses count the speeds of the centres only.
TEST(Report, SpinsPileUpInTheWallThatSeemsToStand) {
  ReportSystem system(ReportSettings{});
  std::vector<ReportBody> bodies = wall();
  for (int i = 0; i < 60; i++) system.step(bodies, {0, -kG, 0}, kDt);
  double way = 0, spin = 0;
  for (const ReportBody& b : bodies) {
    if (!(b.mass.mass > 0)) continue;
    double moving = 0.5 * b.mass.mass * lengthSquared(b.state.velocity);
    way += moving;
    spin += kineticEnergy(b.state, b.mass) - moving;
  }
  EXPECT_GT(spin, 1000);
  EXPECT_GT(spin, 5 * way);
}

TEST(Report, RunsAsAMethodOfTheWorldWithTheSameBits) {
  WorldDef def;
  def.method = Method::report;
  std::uint64_t hash = 0;
  for (int run = 0; run < 2; run++) {
    World world = makeWorld(def);
    addGround(world, 0.6);
    BodyId first = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 1, 0}));
    add(world, bodyOf(sphereOf(0.1), {0.05, 2, 0}));
    for (int i = 0; i < 120; i++) ASSERT_TRUE(world.step(kDt).ok());
    EXPECT_LT(world.state(first)->position.y, 0.5);
    EXPECT_TRUE(world.validate().empty());
    if (run == 1) {
      EXPECT_EQ(world.stateHash(), hash);
    }
    hash = world.stateHash();
  }
}

TEST(Report, BadSettingsAreNamed) {
  WorldDef def;
  def.report.sweeps = 0;
  Result<World> world = World::create(def);
  ASSERT_FALSE(world.ok());
  EXPECT_NE(world.error().message.find("report.sweeps"), std::string::npos) << world.error().message;
}

}  // namespace
}  // namespace brickfall
