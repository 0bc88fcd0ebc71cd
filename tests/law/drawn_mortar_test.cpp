// Walls in mortar drawn at random, hit by steel balls.
#include "law/draw.h"
#include "law/glued.h"

namespace brickfall::law {
namespace {

// The middle of a joint's face in the frame of a body.
Vec3 placeOn(const World& world, BodyId body, Vec3 at) {
  const BodyState s = *world.state(body);
  return rotate(conjugate(s.rotation), at - s.position);
}
Vec3 placeNow(const World& world, BodyId body, Vec3 place) {
  const BodyState s = *world.state(body);
  return s.position + rotate(s.rotation, place);
}

struct HitWall : Glued {
  explicit HitWall(int number) {
    Draw draw(number + 3100000);
    dt = draw.oneIn(2) ? 1.0 / 60 : 1.0 / 120;
    if (draw.oneIn(2)) {
      for (double* of : {&strength.tension, &strength.cohesion, &strength.tensionEnergy, &strength.shearEnergy})
        *of *= 0.2;
    }
    const int courses = 2 + draw.below(6), bricks = 2 + draw.below(6);
    brick({0.5 * bricks * kBrickSize.x, -0.5, 0}, BodyType::fixed, {10, 1, 10});
    wall(courses, bricks);
    glue(1, std::size_t(bricks) + 2);
    for (MortarId joint : joints) {
      const MortarState m = *world.state(joint);
      onA.push_back(placeOn(world, m.bodyA, m.centre));
      onB.push_back(placeOn(world, m.bodyB, m.centre));
    }
    const double radius = draw.between(0.05, 0.2), speed = draw.scale(1, 40);
    BodyDef ball = bodyOf(sphereOf(radius, 7800),
                          {kBrickSize.x * draw.between(0, bricks), radius + kBrickSize.y * courses * draw.unit(),
                           0.5 * kBrickSize.z + radius + speed * dt * draw.between(0.05, 3)});
    ball.linearVelocity = normalized(Vec3{draw.between(-0.4, 0.4), draw.between(-0.3, 0.3), -1}) * speed;
    add(world, ball);
  }
  // m: between the faces of a joint that holds, the largest.
  double torn() {
    double most = 0;
    for (std::size_t k = 0; k < joints.size(); k++) {
      const MortarState m = *world.state(joints[k]);
      if (m.broken) continue;
      cracked += m.damage > 0;
      most = std::max(most, length(placeNow(world, m.bodyA, onA[k]) - placeNow(world, m.bodyB, onB[k])));
    }
    return most;
  }
  // m: of two bodies in each other, the largest overlap.
  double deepest() const {
    double most = 0;
    world.forEachContact([&](const ContactView& c) {
      if (Result<double> depth = world.penetration(c.shapeA, c.shapeB)) most = std::max(most, *depth);
    });
    return most;
  }

  double dt = 0;  // s
  int cracked = 0;
  std::vector<Vec3> onA, onB;
};

// Whatever a hit does to a joint within one step: a joint that holds afterwards has its faces on each other, and bodies
// whose joint broke are no deeper in each other than others that are hit.
TEST(Law, Row31wWhatHoldsIsNotTorn) {
  double torn = 0;
  int broken = 0, cracked = 0, deepWalls = 0;
  for (int seed = 0; seed < 60; seed++) {
    HitWall w(seed);
    double wallDeep = 0;
    for (int i = 0; i < 24; i++) {
      w.step(w.dt);
      torn = std::max(torn, w.torn());
      wallDeep = std::max(wallDeep, w.deepest());
    }
    deepWalls += wallDeep > 0.02;
    broken += w.broken;
    cracked += w.cracked;
  }
  EXPECT_GT(broken, 500);
  EXPECT_GT(cracked, 500);
  atMost("of joints that hold in 60 walls that are hit, faces are apart by", 0, 1000 * torn, 5, "mm");
  atMost("walls in which anything is 20 mm deep in anything, of 60", 0, deepWalls, 2, "");
}

// A blow on the edge of a brick in mortar far stronger than it: the brick turns no faster than its wall, and all of the
// blow is for its mortar to bear at once.
TEST(Law, Row31xABrickInStrongMortarDoesNotSpin) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
    Glued g;
    for (double* of : {&g.strength.tension, &g.strength.cohesion, &g.strength.tensionEnergy, &g.strength.shearEnergy})
      *of *= 20;
    g.brick({0.5, -0.5, 0}, BodyType::fixed, {10, 1, 10});
    g.wall(8, 5);
    g.glue(1, 7);
    BodyDef ball = bodyOf(sphereOf(0.029, 7800), {3.5 * kBrickSize.x, 0.51, 0.12});
    ball.linearVelocity = {0, 0, -12};
    add(g.world, ball);
    double spin = 0;
    for (int i = 0; i < int(std::lround(0.1 / dt)); i++) {
      g.step(dt);
      for (std::size_t k = 1; k < g.bodies.size(); k++)
        spin = std::max(spin, length(g.world.state(g.bodies[k])->angularVelocity));
    }
    EXPECT_EQ(g.broken, 0);
    atMost("fastest spin of a brick in strong mortar, struck at its edge", dt, spin, 2, "rad/s");
  }
}

// Two bricks that mortar holds tumble, and land: their turn grows or ends within a step, or the last check lets them go.
// None of it parts the faces.
TEST(Law, Row31zAPairThatLandsIsNotTorn) {
  for (double strong : {1.0, 20.0})
    for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120}) {
      double apart = 0;
      for (int k = 0; k < 12; k++) {
        Glued g;
        for (double* of :
             {&g.strength.tension, &g.strength.cohesion, &g.strength.tensionEnergy, &g.strength.shearEnergy})
          *of *= strong;
        const double spin = 12, half = 0.5 * kBrickSize.x;  // rad/s, m
        g.brick({0, -0.5, 0}, BodyType::fixed, {10, 1, 10});
        for (double side : {-1.0, 1.0}) {
          const BodyId body = g.brick({side * half, 0.5 + 0.02 * k, 0});
          ASSERT_TRUE(g.world.setAngularVelocity(body, {0, 0, spin}).ok());
          ASSERT_TRUE(g.world.setLinearVelocity(body, {1, side * spin * half, 0}).ok());
        }
        g.gluePair(1, 2);
        for (int i = 0; i < int(std::lround(0.5 / dt)) && g.broken == 0; i++) {
          g.step(dt);
          if (g.broken == 0)
            apart = std::max(apart, length(placeNow(g.world, g.bodies[1], {half, 0, 0}) -
                                           placeNow(g.world, g.bodies[2], {-half, 0, 0})));
        }
      }
      atMost(label("a pair in %.0f x cement that lands: faces apart by", strong), dt, 1000 * apart, dt > 0.02 ? 2 : 0.4,
             "mm");
    }
}

}  // namespace
}  // namespace brickfall::law
