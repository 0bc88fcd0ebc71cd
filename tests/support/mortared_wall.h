// A small wall in weak mortar on a plane, and a ball that goes through it: joints crack and break in the first steps.
#pragma once
#include <vector>

#include "brickfall/world.h"

namespace brickfall::test {

struct MortaredWall {
  World world;
  BodyId ground;
  std::vector<BodyId> bricks;
  std::vector<MortarId> joints;
};

inline BodyDef plainBody(ShapeType type, Vec3 halfExtents, Vec3 position) {
  BodyDef def;
  def.shapes.resize(1);
  def.shapes[0].type = type;
  def.shapes[0].halfExtents = halfExtents;
  def.position = position;
  return def;
}

inline MortaredWall mortaredWall(int courses, int across, double ballSpeed, const WorldDef& def = {}) {
  MortaredWall wall{std::move(World::create(def)).value(), {}, {}, {}};
  World& world = wall.world;
  const Vec3 half{0.1, 0.04, 0.05};
  BodyDef ground = plainBody(ShapeType::plane, half, {});
  ground.type = BodyType::fixed;
  wall.ground = *world.createBody(ground);
  for (int row = 0; row < courses; row++)
    for (int k = 0; k < across; k++) {
      const Vec3 place{(2 * k + row % 2) * half.x, (2 * row + 1) * half.y, 0};
      wall.bricks.push_back(*world.createBody(plainBody(ShapeType::box, half, place)));
    }
  const std::vector<BodyId> all = world.bodies();
  for (std::size_t i = 0; i < all.size(); i++)
    for (std::size_t k = i + 1; k < all.size(); k++) {
      MortarDef mortar;
      mortar.bodyA = all[i];
      mortar.bodyB = all[k];
      mortar.outline = *world.sharedFace(all[i], all[k]);
      if (mortar.outline.empty()) continue;
      const double share = 0.1 + 0.01 * double((7 * i + 3 * k) % 10);  // not two alike
      mortar.strength.tension *= share;
      mortar.strength.cohesion *= share;
      mortar.strength.tensionEnergy *= share;
      mortar.strength.shearEnergy *= share;
      wall.joints.push_back(*world.createMortar(mortar));
    }
  BodyDef ball = plainBody(ShapeType::sphere, half, {across * half.x, courses * half.y, 0.3});
  ball.shapes[0].radius = 0.06;
  ball.shapes[0].material.density = 7850;
  ball.linearVelocity = {0.5, 0, -ballSpeed};
  (void)world.createBody(ball).value();
  return wall;
}

}  // namespace brickfall::test
