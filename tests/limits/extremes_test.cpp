// Mass ratios, overlap at the start, and more bodies than may be.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// Largest way of a body of a column of 1 m cubes with these densities after five seconds, m.
double columnMoves(const std::vector<double>& densities) {
  World world = awakeWorld();
  addGround(world);
  std::vector<BodyId> bodies;
  for (std::size_t i = 0; i < densities.size(); i++)
    bodies.push_back(add(world, bodyOf(boxOf({0.5, 0.5, 0.5}, densities[i]), {0, 0.5 + double(i), 0})));
  for (int i = 0; i < 300; i++) EXPECT_TRUE(world.step(kDt).ok());
  expectSound(world);
  double most = 0;
  for (std::size_t i = 0; i < bodies.size(); i++)
    most = std::max(most, length(world.state(bodies[i])->position - Vec3{0, 0.5 + double(i), 0}));
  return most;
}

TEST(Limits, LightOnHeavyStandsAtAnyRatio) {
  for (double ratio : {1e3, 1e4, 1e5, 1e6}) EXPECT_LT(columnMoves({ratio, 1, 1, 1, 1, 1}), 1e-4) << ratio;
}

// A joint's stiffness is that of the lighter body, so what a heavy one presses it in by grows with the ratio.
TEST(Limits, HeavyOnLightStandsUpToTenThousand) {
  for (double ratio : {1e2, 1e3, 1e4}) {
    double moved = columnMoves({1, 1, 1, 1, 1, ratio});
    EXPECT_LT(moved, 3e-6 * ratio) << ratio;
  }
}

TEST(Limits, HeavyOnLightBeyondStaysFinite) {
  for (double ratio : {1e5, 1e6}) EXPECT_LT(columnMoves({1, 1, 1, 1, 1, ratio}), 10) << ratio;
}

// Bodies that begin inside each other part slowly instead of exploding.
TEST(Limits, OverlapAtTheStartPartsWithoutABang) {
  for (double overlap : {0.1, 0.3, 0.5, 0.9}) {
    SCOPED_TRACE(overlap);
    World world = awakeWorld();
    addGround(world);
    std::vector<BodyId> bodies;
    for (int i = 0; i < 3; i++) bodies.push_back(addBox(world, {0.1, 0.1, 0.1}, {0, 0.1 + 0.2 * i * (1 - overlap), 0}));
    double fastest = 0;
    for (int i = 0; i < 300; i++) {
      ASSERT_TRUE(world.step(kDt).ok());
      for (BodyId body : bodies) fastest = std::max(fastest, length(world.state(body)->linearVelocity));
    }
    EXPECT_LT(fastest, 3) << "m/s";
    expectSound(world);
  }
}

TEST(Limits, MaxBodiesIsReachedAndNotPassed) {
  WorldDef def;
  def.maxBodies = 20000;
  World world = makeWorld(def);
  BodyDef brick = bodyOf(boxOf({0.1, 0.03, 0.05}), {});
  for (int i = 0; i < def.maxBodies; i++) {
    brick.position = {double(i % 200), double(i / 200 % 10), double(i / 2000)};
    ASSERT_TRUE(world.createBody(brick).ok()) << i;
  }
  Result<BodyId> more = world.createBody(brick);
  ASSERT_FALSE(more.ok());
  EXPECT_EQ(more.error().code, ErrorCode::limitExceeded);
  EXPECT_NE(more.error().message.find("20000"), std::string::npos) << more.error().message;
}

}  // namespace
}  // namespace brickfall
