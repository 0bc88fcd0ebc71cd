// The scenes by which the solver is judged: standing walls, honest falls, hits. Built in code, the same for tests and for
// the program that measures them (bench/walls). Names and parameters follow the reference program that the method was
// developed with, so that the two can be compared outcome by outcome.
#pragma once
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "brickfall/brickfall.h"

namespace brickfall::lab {

struct Options {
  double dt = 1.0 / 60;
  double gap = 0;  // m: random gaps under every brick, 0 .. gap, and like shifts
  int seed = 0;
  double restitution = 0;
  double yawDegrees = 0;     // walls turned about the vertical
  double bondShift = 0.5;    // of every second course; 0.5 closes the ends with half bats
  bool wholeBricks = false;  // no half bats: toothed ends
  double headJoint = 0;      // m
  bool headers = false;      // bricks across the wall
  bool shuffle = false;      // bodies created in random order
  bool sleep = false;
  int threads = 1;
  BroadPhaseMethod broadPhase = BroadPhaseMethod::tree;
  SolverSettings solver;
};

struct Brick {
  Vec3 centre, half;
  Quat rotation;
};

struct Scene {
  std::string name;
  double seconds = 10;
  World world;
  BodyId ground;
  std::vector<BodyId> boxes;   // in order of creation
  std::vector<Vec3> start;     // of the boxes
  std::vector<BodyId> others;  // spheres
};

// xorshift64 with 24 bits: the reference program's generator.
class LabRandom {
 public:
  explicit LabRandom(int seed) : state_(88172645463325252ull + std::uint64_t(seed) * 977) {
    for (int i = 0; i < 10; i++) unit();
  }
  double unit() {
    state_ ^= state_ << 13;
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return double(state_ >> 40) / double(1 << 24);
  }

 private:
  std::uint64_t state_;
};

constexpr double kBrickLength = 0.215, kBrickHeight = 0.065, kBrickWidth = 0.1025, kDensity = 1900, kFriction = 0.6;

// A wall along x, foot at y = bottom, middle plane z = 0.
inline std::vector<Brick> wall(int courses, int bricks, double bottom, const Options& o) {
  std::vector<Brick> out;
  double L = o.headers ? kBrickWidth : kBrickLength, W = o.headers ? kBrickLength : kBrickWidth, H = kBrickHeight;
  double pitch = L + o.headJoint;
  for (int row = 0; row < courses; row++) {
    double y = bottom + H * (row + 0.5);
    auto add = [&](double from, double length) {
      out.push_back({{from + length / 2, y, 0}, {length / 2, H / 2, W / 2}, {}});
    };
    if (row % 2 == 0) {
      for (int i = 0; i < bricks; i++) add(pitch * i, L);
    } else if (o.wholeBricks) {
      for (int i = 0; i < bricks; i++) add(pitch * (i + o.bondShift), L);
    } else {
      double bat = L * o.bondShift;
      add(0, bat - o.headJoint * (1 - o.bondShift));
      for (int i = 0; i < bricks - 1; i++) add(pitch * (i + o.bondShift), L);
      double from = pitch * (bricks - 1 + o.bondShift);
      add(from, pitch * bricks - o.headJoint - from);
    }
  }
  return out;
}

// Every brick gets a random gap of 0..gap below it and small random shifts and turns.
inline void disturb(std::vector<Brick>& bricks, double gap, int seed) {
  LabRandom random(seed);
  int row = -1;
  double rowHeight = -1;
  for (Brick& b : bricks) {
    double y = b.centre.y;
    if (y > rowHeight + 1e-3) {
      row++;
      rowHeight = y;
    }
    b.centre.y += (row + 1) * gap - gap * random.unit();
    b.centre.x += gap * (random.unit() - 0.5);
    b.centre.z -= gap * (random.unit() - 0.5);
    b.rotation = normalized(Quat{0, (random.unit() - 0.5) * gap * 5, 0, 1});
  }
}

inline ShapeDef boxShape(Vec3 half, double density, double friction, double restitution) {
  ShapeDef s;
  s.halfExtents = half;
  s.material.density = density;
  s.material.friction = friction;
  s.material.restitution = restitution;
  return s;
}

class Builder {
 public:
  Builder(std::string name, const Options& o) : options_(o) { scene_.name = std::move(name); }
  WorldDef def;
  double groundHeight = 0, groundFriction = kFriction;

  void open() {
    def.enableSleep = options_.sleep;
    def.threads = options_.threads;
    def.broadPhase = options_.broadPhase;
    def.solver = options_.solver;
    scene_.world = std::move(World::create(def)).value();
    BodyDef ground;
    ground.type = BodyType::fixed;
    ShapeDef plane;
    plane.type = ShapeType::plane;
    plane.material.friction = groundFriction;
    plane.material.restitution = options_.restitution;
    ground.shapes = {plane};
    ground.position.y = groundHeight;
    scene_.ground = scene_.world.createBody(ground).value();
  }
  BodyId box(Vec3 half, Vec3 position, double density, double friction = kFriction, Quat rotation = {},
             Vec3 velocity = {}, Vec3 spin = {}) {
    BodyDef d;
    d.shapes = {boxShape(half, density, friction, options_.restitution)};
    d.position = position;
    d.rotation = rotation;
    d.linearVelocity = velocity;
    d.angularVelocity = spin;
    BodyId id = scene_.world.createBody(d).value();
    scene_.boxes.push_back(id);
    scene_.start.push_back(position);
    return id;
  }
  BodyId sphere(double radius, double density, Vec3 position, Vec3 velocity) {
    BodyDef d;
    ShapeDef s = boxShape({}, density, kFriction, options_.restitution);
    s.type = ShapeType::sphere;
    s.radius = radius;
    d.shapes = {s};
    d.position = position;
    d.linearVelocity = velocity;
    BodyId id = scene_.world.createBody(d).value();
    scene_.others.push_back(id);
    return id;
  }
  void addWall(int courses, int bricks, double bottom = 0) {
    std::vector<Brick> all = wall(courses, bricks, bottom, options_);
    if (options_.gap > 0) disturb(all, options_.gap, options_.seed);
    if (options_.shuffle) {
      LabRandom random(options_.seed + 1000);
      for (std::size_t i = all.size(); i > 1; i--) std::swap(all[i - 1], all[std::size_t(random.unit() * double(i))]);
    }
    Quat yaw = quatFromAxisAngle({0, 1, 0}, options_.yawDegrees * 3.14159265358979323846 / 180);
    for (const Brick& b : all) box(b.half, rotate(yaw, b.centre), kDensity, kFriction, yaw * b.rotation);
  }
  Scene take(double seconds) {
    scene_.seconds = seconds;
    return std::move(scene_);
  }

 private:
  Options options_;
  Scene scene_{"", 0, std::move(World::create(WorldDef{})).value(), {}, {}, {}, {}};
};

inline bool startsWith(const std::string& text, const char* prefix) { return text.rfind(prefix, 0) == 0; }

// Walls and piles that stand: w10 w40 w100 pyr col.
inline std::optional<Scene> standing(const std::string& name, const Options& o) {
  Builder b(name, o);
  if (name == "w10") {
    b.open();
    b.addWall(10, 10);
    return b.take(60);
  }
  if (name == "w40") {
    b.open();
    b.addWall(40, 25);
    return b.take(20);
  }
  if (name == "w100") {
    b.open();
    b.addWall(100, 20);
    return b.take(10);
  }
  if (name == "pyr") {
    b.open();
    for (int row = 0; row < 40; row++)
      for (int i = 0; i < 40 - row; i++) b.box({.25, .25, .25}, {0.5 * (i + 0.5 * row), 0.25 + 0.5 * row, 0}, kDensity);
    return b.take(20);
  }
  if (name == "col") {
    b.open();
    for (int row = 0; row < 10; row++) b.box({.5, .5, .5}, {0, 0.5 + row, 0}, 1000);
    b.box({.5, .5, .5}, {0, 10.5, 0}, 1e6);
    return b.take(20);
  }
  return std::nullopt;
}

// Walls that are hit, or fall: ball hit hitvN wall_hit holeN hit0 fall drop.
inline std::optional<Scene> hit(const std::string& name, const Options& o) {
  Builder b(name, o);
  double middle40 = 25 * kBrickLength / 2;
  auto number = [&](std::size_t from) { return std::atof(name.c_str() + from); };
  if (name == "ball") {
    b.open();
    b.addWall(40, 25);
    b.sphere(0.05, 400, {middle40 + 0.1, 1.3, 0.25}, {0, 0, -3});
    return b.take(8);
  }
  if (name == "hit" || startsWith(name, "hitv")) {
    b.open();
    b.addWall(40, 25);
    b.sphere(0.5, 7800, {middle40, 1.3, name == "hit" ? 1.0 : 1.5}, {0, 0, name == "hit" ? -20 : -number(4)});
    return b.take(name == "hit" ? 10 : 5);
  }
  if (startsWith(name, "hole")) {
    b.open();
    b.addWall(40, 25);
    b.sphere(0.08, 7800, {middle40, 1.3, 0.3}, {0, 0, -number(4)});
    return b.take(3);
  }
  if (name == "wall_hit") {
    b.open();
    b.addWall(20, 50);
    b.sphere(0.5, 7800, {50 * kBrickLength / 2, 20 * kBrickHeight / 2, 3}, {0, 0, -20});
    return b.take(10);
  }
  if (name == "hit0") {
    b.def.gravity = {};
    b.groundHeight = -100;
    b.open();
    b.addWall(10, 10);
    b.sphere(0.2, 7800, {10 * kBrickLength / 2, 0.4, 0.4}, {0, 0, -10});
    return b.take(1);
  }
  if (name == "fall" || name == "drop") {
    b.open();
    b.addWall(10, 10, name == "fall" ? 5 : 0.5);
    return b.take(name == "fall" ? 0.5 : 5);
  }
  return std::nullopt;
}

// A few bodies: stop incN corN topple bounce bouncing tumble row.
inline std::optional<Scene> few(const std::string& name, const Options& o) {
  Builder b(name, o);
  auto number = [&](std::size_t from) { return std::atof(name.c_str() + from); };
  if (name == "stop") {
    b.open();
    b.box({.25, .1, .25}, {0, 0.1, 0}, 1000, kFriction, {}, {3, 0, 0});
    return b.take(3);
  }
  if (startsWith(name, "inc")) {  // the ground stays level, gravity is tilted
    double angle = number(3) * 3.14159265358979323846 / 180;
    b.def.gravity = {9.81 * std::sin(angle), -9.81 * std::cos(angle), 0};
    b.open();
    b.box({.25, .25, .25}, {0, 0.25, 0}, 1000);
    return b.take(5);
  }
  if (startsWith(name, "cor")) {
    b.open();
    double shift = number(3) * 1e-3;
    for (int row = 0; row < 10; row++)
      b.box({kBrickLength / 2, kBrickHeight / 2, kBrickWidth / 2}, {row * shift, kBrickHeight * (row + 0.5), 0},
            kDensity);
    return b.take(5);
  }
  if (name == "topple") {
    double angle = 0.2, hx = 0.1, hy = 0.5;
    b.groundFriction = 0.9;
    b.open();
    Vec3 centre{-hx * std::cos(angle) + hy * std::sin(angle), hx * std::sin(angle) + hy * std::cos(angle), 0};
    b.box({hx, hy, 0.1}, centre, 1000, 0.9, normalized(Quat{0, 0, -std::sin(angle / 2), std::cos(angle / 2)}));
    return b.take(2);
  }
  if (name == "bounce" || name == "tumble") {
    b.open();
    bool tumble = name == "tumble";
    b.box({.25, .25, .25}, {0, 1.25, 0}, 1000, kFriction, tumble ? normalized(Quat{0.2, 0.05, -0.1, 1}) : Quat{}, {},
          tumble ? Vec3{3, 2, -1} : Vec3{});
    return b.take(5);
  }
  if (name == "bouncing") {
    b.open();
    b.sphere(0.25, 1000, {0, 1.25, 0}, {});
    return b.take(5);
  }
  if (name == "row") {
    b.def.gravity = {};
    b.groundHeight = -100;
    b.open();
    b.sphere(0.05, 7800, {0, 0, 0.2}, {0, 0, -3});
    for (int i = 0; i < 4; i++) b.sphere(0.05, 7800, {0, 0, -0.1 * i}, {});
    return b.take(0.3);
  }
  return std::nullopt;
}

// Ends the program on an unknown name.
inline Scene make(const std::string& name, const Options& o = {}) {
  for (auto family : {standing, hit, few})
    if (std::optional<Scene> scene = family(name, o)) return std::move(*scene);
  std::abort();
}

}  // namespace brickfall::lab
