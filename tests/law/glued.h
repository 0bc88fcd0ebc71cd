// Boxes that mortar glues where they touch: on these the laws of mortar are measured.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "law/law.h"

namespace brickfall::law {

constexpr Vec3 kBrickSize{0.215, 0.065, 0.1025};  // m
constexpr double kBed = 0.215 * 0.1025;           // m2

// How a law of mortar is run: nothing of it may change what is found.
struct GluedSetup {
  double dt = kDt;
  double yaw = 0;     // rad
  unsigned seed = 0;  // of the order in which bodies are made; 0: that of the laws
  std::string text() const {
    return "1/" + std::to_string(std::lround(1 / dt)) + " s, turned by " + law::text(yaw * 180 / kPi, 0) +
           " degrees, seed " + std::to_string(seed);
  }
};

// Evenly out of all steps, turns and seeds.
inline std::vector<GluedSetup> gluedSetups(int cases) {
  std::vector<GluedSetup> all;
  for (unsigned seed : {0u, 1u, 2u})
    for (double degrees : {0.0, 37.0})
      for (double dt : {1.0 / 60, 1.0 / 120, 1.0 / 240}) all.push_back({dt, degrees * kPi / 180, seed});
  std::vector<GluedSetup> out;
  for (std::size_t i = 0; i < std::size_t(cases) && i < all.size(); i++) out.push_back(all[11 * i % all.size()]);
  return out;
}

// The boxes have their faces along the axes of a frame that may be turned about the vertical. Places, forces and ways
// are told in that frame.
struct Glued {
  struct Box {
    Vec3 centre, size;
    BodyType type = BodyType::dynamic;
    double density = 1900;
    double friction = 0.75;
    AxisLocks locks;
  };

  explicit Glued(const GluedSetup& setup = {}, World made = makeWorld()) : world(std::move(made)), seed(setup.seed) {
    turnBy(setup.yaw);
  }
  // Numbers boxes in the order of the calls. Bodies are made by `make`, or at once without a seed.
  BodyId brick(Vec3 centre, BodyType type = BodyType::dynamic, Vec3 size = kBrickSize, double density = 1900) {
    return box({centre, size, type, density});
  }
  BodyId box(const Box& made) {
    boxes.push_back(made);
    bodies.push_back(seed == 0 ? bodyFrom(made) : BodyId{});
    return bodies.back();
  }
  void make() {
    if (seed == 0) return;
    std::vector<std::size_t> order(boxes.size());
    for (std::size_t i = 0; i < order.size(); i++) order[i] = i;
    std::shuffle(order.begin(), order.end(), std::mt19937(seed));
    for (std::size_t i : order) bodies[i] = bodyFrom(boxes[i]);
  }
  // `reach`: how much later in the order a neighbour comes at most.
  void glue(std::size_t from = 0, std::size_t reach = std::size_t(-1)) {
    make();
    for (std::size_t i = from; i < bodies.size(); i++)
      for (std::size_t j = i + 1; j < bodies.size() && (i == 0 || j - i <= reach); j++) gluePair(i, j);
  }
  void gluePair(std::size_t i, std::size_t j) {
    const Vec3 apart = boxes[j].centre - boxes[i].centre, halfI = boxes[i].size * 0.5, halfJ = boxes[j].size * 0.5;
    for (int axis = 0; axis < 3; axis++) {
      const int p = (axis + 1) % 3, q = (axis + 2) % 3;
      if (std::fabs(std::fabs(apart[axis]) - (halfI + halfJ)[axis]) > 1e-6) continue;
      auto low = [&](int a) { return std::max((boxes[i].centre - halfI)[a], (boxes[j].centre - halfJ)[a]); };
      auto high = [&](int a) { return std::min((boxes[i].centre + halfI)[a], (boxes[j].centre + halfJ)[a]); };
      if (high(p) - low(p) < 0.01 || high(q) - low(q) < 0.01) continue;
      MortarDef def;
      def.bodyA = bodies[i];
      def.bodyB = bodies[j];
      def.strength = strength;
      for (auto [a, b] : {std::pair{low(p), low(q)}, {high(p), low(q)}, {high(p), high(q)}, {low(p), high(q)}}) {
        Vec3 corner;
        corner[axis] = boxes[i].centre[axis] + std::copysign(halfI[axis], apart[axis]);
        corner[p] = a;
        corner[q] = b;
        def.outline.push_back(turn * corner);
      }
      if (apart[axis] < 0) std::reverse(def.outline.begin(), def.outline.end());
      Result<MortarId> made = world.createMortar(def);
      ASSERT_TRUE(made.ok()) << made.error().message;
      joints.push_back(*made);
    }
  }
  void wall(int courses, int bricks) {
    for (int course = 0; course < courses; course++)
      for (int i = 0; i < bricks; i++)
        brick({(i + (course % 2 ? 0.5 : 0.0)) * kBrickSize.x, (course + 0.5) * kBrickSize.y, 0});
  }
  void step(double dt) {
    ASSERT_TRUE(world.step(dt).ok());
    for (const MortarEvent& e : world.events().mortar) broken += e.broken;
  }
  void push(std::size_t i, Vec3 force) { ASSERT_TRUE(world.applyForce(bodies[i], turn * force).ok()); }
  void pushAt(std::size_t i, Vec3 force, Vec3 place) {
    ASSERT_TRUE(world.applyForceAtPoint(bodies[i], turn * force, turn * place).ok());
  }
  void twist(std::size_t i, Vec3 torque) { ASSERT_TRUE(world.applyTorque(bodies[i], turn * torque).ok()); }
  double weight(std::size_t i) const { return world.state(bodies[i])->mass * kG; }
  double work() const {
    double sum = 0;
    for (MortarId joint : joints) sum += world.state(joint)->tensionWork + world.state(joint)->shearWork;
    return sum;
  }
  // Of the joint that has most.
  double damage() const {
    double most = 0;
    for (MortarId joint : joints) most = std::max(most, world.state(joint)->damage);
    return most;
  }
  Vec3 move(std::size_t i) const { return transpose(turn) * world.state(bodies[i])->position - boxes[i].centre; }
  // m: how far any brick is from where it was.
  double moved() const {
    double most = 0;
    for (std::size_t i = 0; i < bodies.size(); i++) most = std::max(most, length(move(i)));
    return most;
  }
  void turnBy(double yaw) {
    rotation = {0, std::sin(0.5 * yaw), 0, std::cos(0.5 * yaw)};
    turn = toMatrix(rotation);
  }

  World world;
  unsigned seed;
  std::vector<Box> boxes;
  std::vector<BodyId> bodies;
  std::vector<MortarId> joints;
  MortarStrength strength;
  Quat rotation;
  Mat3 turn;
  int broken = 0;

 private:
  BodyId bodyFrom(const Box& box) {
    BodyDef def = bodyOf(boxOf(box.size * 0.5, box.density, box.friction), turn * box.centre, box.type);
    def.rotation = rotation;
    def.locks = box.locks;
    return add(world, def);
  }
};

// Whether a ball of steel breaks a brick out that is glued to four fixed ones. It comes `part` of a step's way away, and meets
// the middle of the brick along its normal: what falls as it comes presses on the beds as well, the more the longer it flew.
inline bool breaksOut(double mass, double speed, const GluedSetup& setup, double part) {
  Glued g(setup);
  g.brick({0, 1, 0});
  for (Vec3 off :
       {Vec3{kBrickSize.x, 0, 0}, Vec3{-kBrickSize.x, 0, 0}, Vec3{0, kBrickSize.y, 0}, Vec3{0, -kBrickSize.y, 0}})
    g.brick(Vec3{0, 1, 0} + off, BodyType::fixed);
  g.make();
  for (std::size_t j = 1; j < 5; j++) g.gluePair(0, j);
  const double radius = std::cbrt(mass / (7800 * 4.0 / 3 * kPi));
  const double flies = part * setup.dt;  // s
  BodyDef ball = bodyOf(sphereOf(radius, 7800),
                        g.turn * Vec3{0, 1 - 0.5 * kG * flies * flies, 0.5 * kBrickSize.z + radius + speed * flies});
  ball.linearVelocity = g.turn * Vec3{0, kG * flies, -speed};
  add(g.world, ball);
  for (int i = 0; i < 6; i++) g.step(setup.dt);
  return g.broken == 4;
}
inline double speedThatBreaksOut(double mass, double expected, const GluedSetup& setup, double part) {
  double low = 0.5 * expected, high = 2 * expected;
  EXPECT_FALSE(breaksOut(mass, low, setup, part));
  EXPECT_TRUE(breaksOut(mass, high, setup, part));
  while (high > 1.01 * low) {
    const double middle = 0.5 * (low + high);
    (breaksOut(mass, middle, setup, part) ? high : low) = middle;
  }
  return high;
}

// What comes at the middle of a wall: a steel ball.
struct Shot {
  Vec3 velocity;          // m/s; the wall lies in z = 0
  double radius = 0.08;   // m
  MortarStrength mortar;  // of the wall
};

// What a ball breaks within .25 s, the mean over balls that come a millimetre and a part of a step beside each other.
struct Break {
  double joints = 0, energy = 0;  // J
};
inline Break meanBroken(int courses, int bricks, const Shot& shot, double dt, int balls) {
  Break mean;
  for (int ball = 0; ball < balls; ball++) {
    Glued g;
    g.strength = shot.mortar;
    g.brick({0.5 * bricks * kBrickSize.x, -0.5, 0}, BodyType::fixed, {10, 1, 10});
    g.wall(courses, bricks);
    g.glue(1, std::size_t(bricks) + 2);
    for (int i = 0; i < int(std::lround(0.3 / dt)); i++) g.step(dt);
    const double speed = -shot.velocity.z;
    BodyDef def = bodyOf(sphereOf(shot.radius, 7800), {0.5 * bricks * kBrickSize.x + 0.001 * ball,
                                                       0.5 * courses * kBrickSize.y + 0.001 * (5 * ball % 16),
                                                       0.07 + shot.radius + speed * dt * (ball + 0.5) / balls});
    def.linearVelocity = shot.velocity;
    add(g.world, def);
    for (int i = 0; i < int(std::lround((0.25 + 0.02 / speed) / dt)); i++) g.step(dt);
    mean.joints += double(g.broken) / balls;
    mean.energy += g.work() / balls;
  }
  return mean;
}

}  // namespace brickfall::law
