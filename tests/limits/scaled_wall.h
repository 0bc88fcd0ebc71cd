// A wall of ten courses of bricks of any size, anywhere, and how far it went.
#pragma once
#include "support/world_helpers.h"

namespace brickfall::test {

struct ScaledWall {
  World world;
  double size;  // m, length of a brick; height 0.3, width 0.48 of it, as a clay brick
  std::vector<BodyId> bricks;
  std::vector<Vec3> start;
  Vec3 middle;  // of the wall

  // The ground is a box below the wall, so that it is where the wall is.
  ScaledWall(double brickLength, Vec3 at, const WorldDef& def, double yawDegrees = 0)
      : world(makeWorld(def)), size(brickLength) {
    Vec3 half{0.5 * size, 0.15 * size, 0.24 * size};
    Quat yaw = turn({0, 1, 0}, yawDegrees);
    ShapeDef ground = boxOf({40 * size, size, 40 * size}, 1900);
    BodyDef floor = bodyOf(ground, at - Vec3{0, size, 0}, BodyType::fixed);
    add(world, floor);
    // Half bats close every second course: an end brick that juts out by half would be at its very balance.
    for (int row = 0; row < 10; row++)
      for (int i = 0; i < 6 + row % 2; i++) {
        bool bat = row % 2 == 1 && (i == 0 || i == 6);
        double x = bat ? (i == 0 ? -2.75 : 2.75) : i - 2.5 - 0.5 * (row % 2);
        Vec3 own{bat ? half.x / 2 : half.x, half.y, half.z};
        BodyDef d = bodyOf(boxOf(own, 1900), at + rotate(yaw, {x * size, half.y * (2 * row + 1), 0}));
        d.rotation = yaw;
        bricks.push_back(add(world, d));
        start.push_back(d.position);
      }
    middle = at + rotate(yaw, {0, half.y * 9, 0});
  }
  // Largest way of a brick, in brick lengths.
  double moved() const {
    double most = 0;
    for (std::size_t i = 0; i < bricks.size(); i++)
      most = std::max(most, length(world.state(bricks[i])->position - start[i]));
    return most / size;
  }
  int movedBricks(double lengths) const {
    int count = 0;
    for (std::size_t i = 0; i < bricks.size(); i++)
      count += length(world.state(bricks[i])->position - start[i]) > lengths * size;
    return count;
  }
  // A steel ball at half height, across the wall; in brick lengths its radius and how far aside of the middle.
  void shoot(double speed, double radius = 0.25, double aside = 0) {
    BodyDef d = bodyOf(sphereOf(radius * size, 7800), middle + Vec3{aside * size, 0, 2 * size});
    d.linearVelocity = {0, 0, -speed};
    add(world, d);
  }
  void runFor(double seconds, double dt) {
    for (int n = int(std::lround(seconds / dt)); n > 0; n--) {
      Result<StepReport> report = world.step(dt);
      ASSERT_TRUE(report.ok());
      ASSERT_TRUE(report->quarantined.empty());
    }
  }
};

}  // namespace brickfall::test
