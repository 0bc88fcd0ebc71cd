// How far a core gets: what it cannot reach is told without a search, and that must cut off no way that ends at something.
#include "world/core_sweep.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/queries.h"
#include "math/random.h"
#include "unit/world/shape_data.h"

namespace brickfall {
namespace {

using namespace test;

Sweep straight(Vec3 from, Vec3 way) { return {{from, {}}, way, {}, false}; }

TEST(CoreWay, EndsAtTheSamePlaceHoweverFarItWouldGo) {
  const ShapeData ball = boxShape({0.05, 0.05, 0.05}), wall = boxShape({0.1, 1, 1});
  const double room = 0.5 - 0.1 - kCoreShare * 0.05;  // m, of the core's surface
  const double met = room - kCoreShare * 0.05;        // it stops a radius before
  for (double length : {met * 0.5, met - 1e-4, met + 1e-4, met * 1.1, 1.0, 3.0}) {
    double share = coreWay(ball, straight({-0.5, 0, 0}, {length, 0, 0}), wall, straight({}, {}));
    if (length < met)
      EXPECT_EQ(share, 1) << length;
    else
      EXPECT_NEAR(share * length, met, 1e-5) << length;
  }
}

TEST(CoreWay, DependsOnTheWayAgainstEachOtherOnly) {
  const ShapeData ball = boxShape({0.05, 0.05, 0.05}), wall = boxShape({0.1, 1, 1});
  for (Vec3 common : {Vec3{}, Vec3{100, 0, 0}, Vec3{-3, 50, 7}}) {
    double apart = coreWay(ball, straight({-0.5, 0, 0}, common + Vec3{0.1, 0, 0}), wall, straight({}, common));
    double meets = coreWay(ball, straight({-0.5, 0, 0}, common + Vec3{1, 0, 0}), wall, straight({}, common));
    EXPECT_EQ(apart, 1);
    EXPECT_LT(meets, 0.5);
  }
}

// Neither goes anywhere: a head at the end of a handle swings against a post, and a bar that turns against what stays.
TEST(CoreWay, TurningAloneReachesIt) {
  const Vec3 turn{0, 0, 1};
  ShapeData head = boxShape({0.05, 0.05, 0.05});
  head.middle = {0.5, 0, 0};
  double swung = coreWay(head, {{}, {}, turn, true}, boxShape({0.05, 0.05, 1}), straight({0.35, 0.35, 0}, {}));
  EXPECT_GT(swung, 0.5);
  EXPECT_LT(swung, 0.785);  // rad, of the post's middle
  const ShapeData ball = boxShape({0.05, 0.05, 0.05}), bar = boxShape({1, 0.05, 0.05});
  double turned = coreWay(ball, straight({0.5, 0.4, 0}, {}), bar, {{}, {}, turn, true});
  EXPECT_GT(turned, 0.4);
  EXPECT_LT(turned, 0.675);  // rad, of the ball's middle
}

// A way that is told to be free is free: looked at every part of it, whatever turns.
TEST(CoreWay, AFreeWayMeetsNothing) {
  Random random(3);
  auto any = [&](double size) {
    return Vec3{random.between(-size, size), random.between(-size, size), random.between(-size, size)};
  };
  int free = 0, stopped = 0, turning = 0;
  for (int trial = 0; trial < 1000; trial++) {
    ShapeData moving = boxShape({0.1, 0.05, 0.03}), still = boxShape({0.1, 0.05, 0.03});
    moving.middle = trial % 3 == 0 ? any(0.05) : Vec3{};
    Sweep way{{any(0.2), quatFromRotationVector(any(1))}, any(0.3), any(1), trial % 2 == 0};
    Sweep of{{any(0.2), quatFromRotationVector(any(1))}, any(0.3), any(1), trial % 5 < 3};
    Shape core;
    core.type = ShapeType::sphere;
    auto room = [&](double share) {
      Transform at = inverse(of.at(share)) * way.at(share);
      return shapeDistance(still.geometry, core, {transformPoint(at, moving.middle), {}}).distance;
    };
    if (room(0) < 0.01) continue;  // pressed in: its contacts part them
    double share = coreWay(moving, way, still, of), least = 1e9;
    turning += of.turns;
    for (int i = 0; i <= 100; i++) least = std::min(least, room(share * i / 100));
    EXPECT_GT(least, 0) << trial;
    free += share == 1;
    stopped += share < 1;
  }
  EXPECT_GT(free, 300);
  EXPECT_GT(stopped, 50);
  EXPECT_GT(turning, 300);
}

}  // namespace
}  // namespace brickfall
