// What is twice as large, heavier or under more gravity looks the same, only slower or faster: with lengths x s, gravity x g and
// densities x d all times go x sqrt(s / g). Nothing of the method knows a metre. Where lengths and gravity change by powers of two and
// masses by powers of four (the direct solve takes roots of them), the picture is the same to the last bit.
#include <functional>

#include "law/law.h"

namespace brickfall::law {
namespace {

struct Likeness {
  double size = 1, gravity = 1, density = 1;
  double time() const { return std::sqrt(size / gravity); }
  double speed() const { return std::sqrt(size * gravity); }
  std::string text() const {
    return "lengths x " + law::text(size, 4) + ", gravity x " + law::text(gravity, 3) + ", densities x " +
           law::text(density, 2);
  }
};

// A scene in the units of the reference; it is built in those of `like`.
struct LikeScene {
  explicit LikeScene(const Likeness& as) : like(as) {
    WorldDef def;
    def.gravity = {0, -kG * like.gravity, 0};
    def.enableSleep = false;
    world = makeWorld(def);
    fixed({20, 0.5, 20}, {0, -0.5, 0});
  }
  ShapeDef made(ShapeDef shape) const {
    shape.halfExtents = shape.halfExtents * like.size;
    shape.radius *= like.size;
    shape.material.density *= like.density;
    shape.material.restitution = restitution;
    return shape;
  }
  void fixed(Vec3 half, Vec3 at) { add(world, bodyOf(made(boxOf(half, 1000, 0.65)), at * like.size, BodyType::fixed)); }
  void put(const ShapeDef& shape, Vec3 at, Vec3 velocity = {}, Quat turned = {}) {
    BodyDef d = bodyOf(made(shape), at * like.size);
    d.rotation = turned;
    d.linearVelocity = velocity * like.speed();
    bodies.push_back(add(world, d));
    start.push_back(at);
  }
  void brick(Vec3 at, Quat turned = {}) { put(boxOf(kHalf, 1900, 0.65), at, {}, turned); }
  void run(double seconds) {
    const double dt = kDt * like.time();
    for (int n = int(std::lround(seconds / kDt)); n > 0; n--) ASSERT_TRUE(world.step(dt).ok());
  }

  Vec3 place(std::size_t i) const { return world.state(bodies[i])->position * (1 / like.size); }
  int moved() const {
    int out = 0;
    for (std::size_t i = 0; i < bodies.size(); i++) out += length(place(i) - start[i]) > 0.05;
    return out;
  }
  // m, of the reference
  double deepest() const {
    double out = 0;
    world.forEachContact([&](const ContactView& c) {
      for (int i = 0; i < c.pointCount; i++) out = std::max(out, -c.points[i].separation / like.size);
    });
    return out;
  }

  static constexpr Vec3 kHalf{0.1075, 0.0325, 0.05125};
  Likeness like;
  double restitution = 0;
  World world = makeWorld();
  std::vector<BodyId> bodies;
  std::vector<Vec3> start;
};

LikeScene hitWall(const Likeness& like, double restitution = 0, double aside = 0) {
  const int courses = 12, across = 10;
  LikeScene s(like);
  s.restitution = restitution;
  for (int course = 0; course < courses; course++)
    for (int i = 0; i < across; i++)
      s.brick({0.225 * (i + (course % 2 ? 0.5 : 0.0) - 0.5 * across), 0.0325 * (2 * course + 1), 0});
  s.put(sphereOf(0.12, 7800), {0.03 + aside, 0.42, 0.4}, {0, 0, -12});
  return s;
}

LikeScene landingStack(const Likeness& like) {
  LikeScene s(like);
  for (int i = 0; i < 8; i++) s.brick({0.004 * i, 0.3 + 0.0325 * (2.06 * i + 1), 0.002 * (i % 3)}, turn({1, 0, 1}, 3));
  return s;
}

LikeScene heapInShaft(const Likeness& like) {
  const int layers = 8;
  LikeScene s(like);
  for (double side : {-1.0, 1.0}) {
    s.fixed({0.1, 2, 0.5}, {0.4 * side, 2, 0});
    s.fixed({0.5, 2, 0.1}, {0, 2, 0.4 * side});
  }
  for (int i = 0; i < 4 * layers; i++)
    s.brick({0.14 * (i % 2 ? 1 : -1), 0.1 + 0.16 * (i / 4), 0.12 * (i / 2 % 2 ? 1 : -1)},
            turn({1.0 + i % 3, 1.0 * (i % 5), 2}, 17 * i));
  return s;
}

struct Case {
  std::string name;
  double seconds;
  std::function<LikeScene(const Likeness&)> build;
};
std::vector<Case> cases() {
  return {{"a wall that a ball hits", 2, [](const Likeness& l) { return hitWall(l); }},
          {"a wall that a ball hits, e 0.2", 2, [](const Likeness& l) { return hitWall(l, 0.2); }},
          {"a stack that lands", 2, landingStack},
          {"a heap in a shaft", 2, [](const Likeness& l) { return heapInShaft(l); }}};
}

TEST(Law, Row18tPowersOfTwoChangeNoBit) {
  for (const Case& c : cases()) {
    LikeScene wanted = c.build({});
    wanted.run(c.seconds);
    for (Likeness like : {Likeness{1, 4, 1}, Likeness{1, 0.25, 1}, Likeness{1. / 16, 1, 4}, Likeness{4, 0.25, 1},
                          Likeness{4, 16, 0.25}}) {
      LikeScene found = c.build(like);
      found.run(c.seconds);
      double worst = 0;
      for (std::size_t i = 0; i < wanted.bodies.size(); i++)
        worst = std::max(worst, length(found.place(i) - wanted.place(i)));
      atMost(c.name + ", " + like.text() + ": difference", 0, worst, 0, "m");
    }
  }
}

// Factors that are no powers of two round otherwise, and what a hit moves depends on that: one shot in four brings half the wall
// down, at every size. What holds is the mean of some shots.
TEST(Law, Row18tAHitMovesAsManyAtAnySizeGravityAndDensity) {
  auto meanOf = [](const Likeness& like) {
    constexpr int kShots = 8;
    double sum = 0;
    for (int k = 0; k < kShots; k++) {
      LikeScene s = hitWall(like, 0.2, 1e-6 * k);
      s.run(1);
      sum += s.moved();
    }
    return sum / kShots;
  };
  const double wanted = meanOf({});
  for (Likeness like : {Likeness{0.2, 1, 1}, Likeness{1, 8, 1}, Likeness{12, 1, 0.06}, Likeness{1. / 16, 1. / 6, 10}})
    reached({"bricks moved, to those of the reference: " + like.text(), 0, meanOf(like) / wanted, 1, 0.4, ""});
}

// Of 160 blocks of 2.6 m some ended as deep in each other as 58 mm of a brick's scale.
TEST(Law, Row18tNothingSinksIntoEachOtherAtAnySize) {
  for (Likeness like :
       {Likeness{}, Likeness{0.2, 1, 1}, Likeness{1, 8, 1}, Likeness{12, 1, 0.06}, Likeness{12, 8, 10}}) {
    LikeScene s = heapInShaft(like);
    s.run(2);
    atMost("deepest overlap, " + like.text(), 0, s.deepest() * 1e3, 2, "mm");
  }
}

}  // namespace
}  // namespace brickfall::law
