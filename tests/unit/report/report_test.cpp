// The report's system: what it does right (a cube falls to the ground), what it does as described (a wall of 100 bricks
// stands for some seconds, then falls by itself), and that each part is a part.
#include "report/report_system.h"

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

TEST(Report, RunsOverAWorldWithTheSameBits) {
  std::uint64_t hash = 0;
  for (int run = 0; run < 2; run++) {
    World world = makeWorld();
    addGround(world, 0.6);
    BodyId first = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 1, 0}));
    add(world, bodyOf(sphereOf(0.1), {0.05, 2, 0}));
    ReportRun reported = std::move(ReportRun::create({})).value();
    Result<StepReport> report = reported.step(world, kDt);
    for (int i = 1; i < 120; i++) report = reported.step(world, kDt);
    ASSERT_TRUE(report.ok());
    EXPECT_EQ(report->stepIndex, 120u);
    EXPECT_NEAR(report->time, 2, 1e-12);
    EXPECT_EQ(report->bodies, 2);
    EXPECT_EQ(world.stepCount(), 0u) << "its clock is the world's own";
    EXPECT_LT(world.state(first)->position.y, 0.5);
    EXPECT_TRUE(world.validate().empty());
    if (run == 1) {
      EXPECT_EQ(world.stateHash(), hash);
    }
    hash = world.stateHash();
  }
}

// Through the world's calls and back nothing is lost: the same motion as of the system alone, bit for bit.
TEST(Report, TheWorldKeepsEveryBitOfTheMotion) {
  World world = makeWorld();
  std::vector<ReportBody> bodies;
  std::vector<BodyId> ids;
  for (const auto& b : lab::wall(4, 4, 0, {})) {
    BodyDef def = bodyOf(boxOf(b.half, 1900), b.centre);
    def.angularVelocity = {0.3, 0.2, 0.1};
    ids.push_back(add(world, def));
    bodies.push_back(brick(ids.back().index, b.half, b.centre));
    const MassProperties mass = *world.massProperties(ids.back());
    bodies.back().mass = {mass.mass, mass.inertia};
    bodies.back().state.angularVelocity = def.angularVelocity;
  }
  ReportSystem system(ReportSettings{});
  ReportRun run = std::move(ReportRun::create({})).value();
  for (int i = 0; i < 90; i++) {
    system.step(bodies, world.gravity(), kDt);
    ASSERT_TRUE(run.step(world, kDt).ok());
  }
  for (std::size_t k = 0; k < ids.size(); k++) {
    const BodyState s = *world.state(ids[k]);
    EXPECT_EQ(s.centreOfMass, bodies[k].state.position) << k;
    EXPECT_EQ(s.linearVelocity, bodies[k].state.velocity) << k;
    EXPECT_EQ(s.rotation.x, bodies[k].state.rotation.x) << k;
    EXPECT_EQ(s.rotation.w, bodies[k].state.rotation.w) << k;
  }
}

TEST(Report, FixedBodiesStayAndKinematicOnesGoTheirWay) {
  World world = makeWorld();
  BodyId fixed = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 5, 0}, BodyType::fixed));
  BodyDef def = bodyOf(boxOf({0.1, 0.1, 0.1}), {3, 5, 0}, BodyType::kinematic);
  def.linearVelocity = {1, 0, 0};
  BodyId kinematic = add(world, def);
  ReportRun run = std::move(ReportRun::create({})).value();
  ASSERT_TRUE(run.step(world, 0.5, 2).ok());
  EXPECT_EQ(world.state(fixed)->position, (Vec3{0, 5, 0}));
  EXPECT_NEAR(world.state(kinematic)->position.x, 3.5, 1e-12);
  EXPECT_NEAR(world.state(kinematic)->position.y, 5, 1e-12);
}

// Beyond 1e6 m a world puts no body.
TEST(Report, WhatTheWorldRefusesIsLeftOut) {
  World world = makeWorld();
  BodyId body = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 5, 0}));
  BodyId other = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {9, 5, 0}));
  ASSERT_TRUE(world.setLinearVelocity(body, {9e4, 0, 0}).ok());
  ReportRun run = std::move(ReportRun::create({})).value();
  for (int i = 0; i < 15; i++) ASSERT_TRUE(run.step(world, 1).ok());
  ASSERT_TRUE(world.setTransform(body, {999'999, 0, 0}, {}).ok());
  Result<StepReport> report = run.step(world, 1);
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report->quarantined, std::vector<BodyId>{body});
  EXPECT_EQ(world.state(body)->position.x, 999'999);
  EXPECT_EQ(world.state(body)->linearVelocity, Vec3{});
  double height = world.state(other)->position.y;
  report = run.step(world, 1);
  EXPECT_TRUE(report->quarantined.empty());
  EXPECT_LT(world.state(other)->position.y, height) << "the others go on";
  EXPECT_EQ(world.state(body)->position.x, 999'999);
}

TEST(Report, BadSettingsAreNamed) {
  ReportSettings settings;
  settings.sweeps = 0;
  Result<ReportRun> run = ReportRun::create(settings);
  ASSERT_FALSE(run.ok());
  EXPECT_NE(run.error().message.find("report.sweeps"), std::string::npos) << run.error().message;
  settings = {};
  settings.damping = -1;
  EXPECT_FALSE(ReportRun::create(settings).ok());
  World world = makeWorld();
  run = ReportRun::create({});
  EXPECT_EQ(run->step(world, 0).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(run->step(world, kDt, 0).error().code, ErrorCode::invalidArgument);
}

}  // namespace
}  // namespace brickfall
