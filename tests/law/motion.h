// Scenes in which large islands move: walls with bricks left out or hit by a ball, sleds, heaps. Built alike for the tests and
// for `make validate`, which runs more of them.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <vector>

#include "law/law.h"

namespace brickfall::law {

// Each case is held at each step by `make validate` (BRICKFALL_WHOLE_SCENES, as in tests/ledger), the long ones by
// `make test` at the first and the last, or the first.
constexpr double kMotionSteps[] = {1.0 / 60, 1.0 / 120, 1.0 / 240};
inline bool atFullLength() { return std::getenv("BRICKFALL_WHOLE_SCENES") != nullptr; }
inline std::vector<double> stepsOfLongCase(std::vector<double> inShort = {kMotionSteps[0], kMotionSteps[2]}) {
  return atFullLength() ? std::vector<double>(std::begin(kMotionSteps), std::end(kMotionSteps)) : inShort;
}

struct WallOf {
  int courses = 10, bricks = 10;
  double friction = 0.65, groundFriction = 0.65, restitution = 0, groundRestitution = 0;
  double headJoint = 0.010;  // m
  int hole = 0;              // lengths: bricks of the lowest course wholly inside so much about the middle are left out
};

struct BuiltWall {
  World world = makeWorld();
  std::vector<BodyId> bricks;
  std::vector<Vec3> start;
  std::vector<BodyId> unsupported;  // of the second course, above the hole
  double middle = 0;                // m, of its length
};

// Running bond of whole bricks in the plane z = 0, its foot at y = 0 on a box.
inline BuiltWall buildWall(const WallOf& w) {
  BuiltWall out;
  WorldDef def;
  def.enableSleep = false;
  def.hitEventSpeed = def.hitEventImpulse = 0;  // every impact is told, also one that is over before its step is
  out.world = makeWorld(def);
  ShapeDef slab = boxOf({20, 0.5, 5}, 1000, w.groundFriction);
  slab.material.restitution = w.groundRestitution;
  add(out.world, bodyOf(slab, {0, -0.5, 0}, BodyType::fixed));
  const Vec3 half{0.1075, 0.0325, 0.05125};
  double pitch = 2 * half.x + w.headJoint, hole = w.hole * pitch / 2;
  out.middle = pitch * w.bricks / 2;
  double left = out.middle, right = out.middle;  // m, the hole's ends
  for (int course = 0; course < w.courses; course++)
    for (int i = 0; i < w.bricks; i++) {
      Vec3 at{half.x + pitch * (i + (course % 2 ? 0.5 : 0.0)), half.y * (2 * course + 1), 0};
      bool inside = std::fabs(at.x - out.middle) + half.x <= hole + 1e-9;
      if (course == 0 && inside) {
        left = std::min(left, at.x - half.x - w.headJoint);
        right = std::max(right, at.x + half.x + w.headJoint);
        continue;
      }
      ShapeDef shape = boxOf(half, 1900, w.friction);
      shape.material.restitution = w.restitution;
      BodyId body = add(out.world, bodyOf(shape, at));
      out.bricks.push_back(body);
      out.start.push_back(at);
      if (course == 1 && at.x - half.x > left && at.x + half.x < right) out.unsupported.push_back(body);
    }
  return out;
}

inline BodyId shoot(BuiltWall& wall, double radius, double density, Vec3 from, Vec3 velocity, double restitution = 0) {
  BodyDef ball = bodyOf(sphereOf(radius, density), from);
  ball.shapes[0].material.restitution = restitution;
  ball.linearVelocity = velocity;
  return add(wall.world, ball);
}

inline int movedOver(const BuiltWall& wall, double distance) {
  int moved = 0;
  for (std::size_t i = 0; i < wall.bricks.size(); i++)
    moved += length(wall.world.state(wall.bricks[i])->position - wall.start[i]) > distance;
  return moved;
}

// Bodies that nothing pressed on in a step and the one before it: what they accelerate with against g. One that an obstacle held
// in the step falls only for as long as it moves: by less than g, but along it.
struct Untouched {
  double worst = 0, sum = 0;  // of |a - g| / g; of a / g along g
  double thrown = 0;          // worst of |a - s g| / g for the s from 0 to 1 that is nearest
  long seen = 0, held = 0;    // by more than 0.05 g
  double mean() const { return seen > 0 ? sum / double(seen) : 0; }
  void look(const World& world, const std::vector<BodyId>& bodies, double gravity = kG) {
    std::set<BodyId> pressed;
    world.forEachContact([&](const ContactView& c) {
      bool loaded = false;
      for (int i = 0; i < c.pointCount; i++) loaded = loaded || c.points[i].normalForce > 0;
      if (!loaded) return;
      pressed.insert(c.bodyA);
      pressed.insert(c.bodyB);
    });
    for (const HitEvent& hit : world.events().hits) {
      pressed.insert(hit.bodyA);
      pressed.insert(hit.bodyB);
    }
    for (const auto& [body, a] : fell_) {
      if (pressed.count(body) > 0) continue;  // it may have met that at the end of the last step
      worst = std::max(worst, length(a - Vec3{0, -gravity, 0}) / gravity);
      thrown = std::max(thrown, length(a - Vec3{0, std::clamp(a.y, -gravity, 0.0), 0}) / gravity);
      held += length(a - Vec3{0, -gravity, 0}) > 0.05 * gravity;
      sum += -a.y / gravity;
      seen++;
    }
    fell_.clear();
    for (BodyId body : bodies)
      if (!first_ && pressed.count(body) + before_.count(body) == 0)
        fell_.push_back({body, world.state(body)->linearAcceleration});
    before_ = pressed;
    first_ = false;
  }

 private:
  std::set<BodyId> before_;
  std::vector<std::pair<BodyId, Vec3>> fell_;  // in the last step
  bool first_ = true;
};

}  // namespace brickfall::law
