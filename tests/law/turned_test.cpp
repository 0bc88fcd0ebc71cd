// Row 19: cylinders and cones: rolling, standing, columns of drums.
#include "law/lab.h"
#include "law/law.h"
#include "law/random_world.h"

namespace brickfall::law {
namespace {

constexpr double kTurnedSteps[] = {1.0 / 60, 1.0 / 120, 1.0 / 240};

// Lying across the slope, at x = 0.
BodyDef lying(const ShapeDef& shape) {
  BodyDef d = bodyOf(shape, {0, shape.radius, 0.13});
  d.rotation = turn({1, 0, 0}, 90);
  return d;
}

TEST(Law, Row19aCylinderRollsDownWithTwoThirds) {
  for (const bool box : {false, true})
    for (double degrees : {5.0, 20.0})
      for (double dt : kTurnedSteps) {
        Lab lab(LabSetup{.dt = dt}, degrees, kG, 0);
        lab.add(box ? bodyOf(boxOf({30, 0.5, 30}), {0, -0.5, 0}, BodyType::fixed)
                    : bodyOf(planeOf(), {}, BodyType::fixed));
        BodyId drum = lab.add(lying(cylinderOf(0.2, 0.4)));
        lab.run(0.5);
        const double before = lab.state(drum).linearVelocity.x;
        lab.run(1.5);
        const double wanted = 2.0 / 3 * kG * std::sin(degrees * kPi / 180);
        reached({text(degrees, 0) + (box ? " degrees on a box" : " degrees on a plane") + ": acceleration", dt,
                 (lab.state(drum).linearVelocity.x - before) / 1.5, wanted, 1e-3 * wanted, "m/s2"});
      }
}

TEST(Law, Row19aCylinderRollsOnWithoutJitter) {
  for (double dt : kTurnedSteps) {
    Lab lab(LabSetup{.dt = dt}, 0, kG, 0);
    lab.addGround(0.6);
    BodyDef d = lying(cylinderOf(0.2, 0.4));
    d.linearVelocity = {2, 0, 0}, d.angularVelocity = {0, 0, -10};
    BodyId drum = lab.add(d);
    double off = 0, hop = 0;
    for (int n = 0; n < std::lround(5 / dt) && lab.step(); n++) {
      BodyState s = lab.state(drum);
      off = std::max(off, length(s.linearVelocity - d.linearVelocity));
      hop = std::max(hop, std::fabs(s.position.y - 0.2));
    }
    atMost("rolling at 2 m/s for 5 s: velocity off by", dt, off, 1e-4, "m/s");
    atMost("rolling at 2 m/s for 5 s: height off by", dt, hop * 1e6, 10, "um");
  }
}

// Part of the motion energy and of the way round that a cone keeps which rolls on its side round the tip that it has, or would
// have if it were longer; and how deep it sinks in, in radii of its base.
struct ConeRound {
  double energy = 0, way = 0, depth = 0;
};
ConeRound coneRound(double radius, double opening, double cut, double gravity, double dt) {
  WorldDef def;
  def.gravity = {0, -gravity, 0};
  def.enableSleep = false;
  World world = makeWorld(def);
  const BodyId ground = add(world, bodyOf(planeOf(1), {}, BodyType::fixed));
  const double angle = std::atan(opening), length = radius / opening,
               round = 0.2 * std::sqrt(opening * gravity / radius);
  ShapeDef shape = coneOf(radius, cut * radius, 0.5 * (1 - cut) * length);
  shape.material.friction = 1;
  BodyDef d = bodyOf(shape, Vec3{std::cos(angle), std::sin(angle), 0} * (0.5 * (1 + cut) * length));
  d.rotation = quatFromAxisAngle({0, 0, 1}, kPi / 2 + angle);
  const BodyId cone = add(world, d);
  const Vec3 spin{-round / opening, 0, 0};
  EXPECT_TRUE(world.setAngularVelocity(cone, spin).ok());
  EXPECT_TRUE(world.setLinearVelocity(cone, cross(spin, world.state(cone)->centreOfMass)).ok());
  const double start = world.energy().kinetic, time = 12 * std::sqrt(radius / gravity);
  const int steps = int(std::lround(time / dt));
  ConeRound out;
  double at = 0;
  for (int n = 0; n < steps && world.step(dt).ok(); n++) {
    const Vec3 c = world.state(cone)->centreOfMass;
    const double now = std::atan2(-c.z, c.x);
    out.way += std::remainder(now - at, 2 * kPi) / (round * steps * dt);
    at = now;
    out.depth = std::max(out.depth, *world.penetration(world.shapes(cone)[0], world.shapes(ground)[0]) / radius);
  }
  out.energy = world.energy().kinetic / start;
  return out;
}

TEST(Law, Row19aConesRollRound) {
  struct Place {
    double radius, gravity;
  };
  for (const Place& place : {Place{0.01, kG}, Place{0.1, 1.6}, Place{0.1, kG}, Place{2, kG}, Place{2, 80}})
    for (double dt : kTurnedSteps) {
      double energy = 0, way = 0, depth = 0;
      for (double opening : {0.2, 0.33, 0.7})
        for (double cut : {0.0, 0.5}) {
          const ConeRound found = coneRound(place.radius, opening, cut, place.gravity, dt);
          energy = std::max(energy, std::fabs(found.energy - 1)), way = std::max(way, std::fabs(found.way - 1));
          depth = std::max(depth, found.depth);
        }
      const std::string name =
          "six cones of " + text(place.radius, 2) + " m at " + text(place.gravity, 1) + " m/s2 that roll round: ";
      atMost(name + "energy off", dt, 100 * energy, 0.5, "%");
      atMost(name + "way off", dt, 100 * way, 0.1, "%");
      atMost(name + "depth", dt, 100 * depth, 0.05, "% of the radius");
    }
}

// A coin that rolls upright, leans and falls over has no more energy than it began with.
TEST(Law, Row19bCoinGainsNothing) {
  for (double lean : {0.1, 0.3})
    for (double dt : kTurnedSteps) {
      Lab lab(LabSetup{.dt = dt}, 0, kG, 0);
      lab.addGround(1);
      BodyDef d = bodyOf(cylinderOf(0.2, 0.02, 1000, 1), {0, 0.2 * std::cos(lean) + 0.02 * std::sin(lean), 0});
      d.rotation = quatFromAxisAngle({1, 0, 0}, lean) * turn({1, 0, 0}, 90);
      d.linearVelocity = {2, 0, 0}, d.angularVelocity = {0, 0, -10};
      lab.add(d);
      auto energy = [&] { return lab.world.energy().kinetic + lab.world.energy().potential; };
      const double start = energy();
      double most = start;
      for (int n = 0; n < std::lround(8 / dt) && lab.step(); n++) most = std::max(most, energy());
      atMost("coin leaning by " + text(lean, 1) + " rad: energy gained", dt, most / start - 1, 1e-3,
             "of that of the start");
    }
}

// J, of that at the start: the most that a coin gains which rolls round on its rim, its centre at one place, at the speed
// at which a thin one would do so for ever.
double gainedRollingRound(double radius, double tilt, double friction, double dt) {
  Lab lab(LabSetup{.dt = dt}, 0, kG, 0);
  lab.addGround(friction);
  const double half = 0.08 * radius, angle = tilt * kPi / 180, round = std::sqrt(4 * kG / (radius * std::sin(angle)));
  BodyDef d =
      bodyOf(cylinderOf(radius, half, 7800, friction), {0, radius * std::sin(angle) + half * std::cos(angle), 0});
  d.rotation = turn({0, 0, 1}, tilt);
  d.angularVelocity = Vec3{std::cos(angle), std::sin(angle), 0} * (round * std::sin(angle));
  lab.add(d);
  auto energy = [&] { return lab.world.energy().kinetic + lab.world.energy().potential; };
  const double start = energy();
  double most = start;
  for (int n = 0; n < std::lround(0.5 / dt) && lab.step(); n++) most = std::max(most, energy());
  return most / start - 1;
}

TEST(Law, Row19bCoinsThatRollRoundGainNothing) {
  for (double radius : {0.0375, 0.2})
    for (double dt : {1 / 30.0, 1 / 60.0, 1 / 120.0, 1 / 240.0, 1 / 500.0, 1 / 1000.0, 1 / 2000.0}) {
      double most = 0;
      for (double tilt : {10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0})
        for (double friction : {0.5, 1.0}) most = std::max(most, gainedRollingRound(radius, tilt, friction, dt));
      atMost("coins of " + text(1e3 * radius, 1) + " mm that roll round: energy gained", dt, 100 * most, 0.2,
             "% of that of the start");
    }
}

// A drum on a slope falls over where its centre comes over the rim, whichever points of the rim it stands on.
TEST(Law, Row19cDrumStandsUpToItsTiltLimit) {
  const double radius = 0.3, half = 0.5;
  for (double yaw : {0.0, 5.6, 20.0})
    for (double dt : kTurnedSteps)
      for (double share : {0.99, 1.01}) {
        Lab lab(LabSetup{.dt = dt}, std::atan(share * radius / half) * 180 / kPi);
        lab.addGround(2);
        BodyDef d = bodyOf(cylinderOf(radius, half, 1000, 2), {0, half, 0});
        d.rotation = turn({0, 1, 0}, yaw);
        BodyId drum = lab.add(d);
        lab.run(4);
        const bool stands = rotate(lab.state(drum).rotation, Vec3{0, 1, 0}).y > 0.95;
        reached({"drum turned by " + text(yaw, 1) + " degrees at " + text(share, 2) + " of its limit stands (1 = yes)",
                 dt, stands ? 1.0 : 0.0, share < 1 ? 1.0 : 0.0, 0, ""});
      }
}

TEST(Law, Row19dColumnOfDrums) {
  const double radius = 0.3, half = 0.15, limit = radius / (9 * half);
  for (double dt : kTurnedSteps)
    for (double share : {0.95, 1.02}) {
      Lab lab(LabSetup{.dt = dt}, std::atan(share * limit) * 180 / kPi);
      lab.addGround(0.6);
      BodyId top;
      for (int i = 0; i < 9; i++) {
        BodyDef d = bodyOf(cylinderOf(radius, half, 2400), {0, half + 2 * half * i, 0});
        d.rotation = turn({0, 1, 0}, 37.0 * i);
        top = lab.add(d);
      }
      lab.run(share < 1 ? 3 : 4);
      const double moved = length(lab.state(top).position - Vec3{0, 17 * half, 0});
      if (share < 1)
        atMost("column of 9 drums at 0.95 of its limit: top moved in 3 s", dt, moved * 1e3, 0.1, "mm");
      else
        reached({"column of 9 drums at 1.02 of its limit falls (1 = yes)", dt, moved > 0.2 ? 1.0 : 0.0, 1, 0, ""});
    }
}

// Row 18u in worlds of which half of the bodies are cylinders and cones.
TEST(LawAnywhere, Row19eTurnedBodiesMakeNothing) {
  int through = 0, deep = 0;
  double gain = 0;
  for (int k = 0; k < kRandomKinds; k++)
    for (int i = 0; i < 15; i++) {
      RandomWorld random = drawWorld(RandomKind(k), i, true);
      const RandomOutcome found = runWorld(random);
      EXPECT_TRUE(found.finite) << random.text;
      gain = std::max(gain, found.gain);
      through += found.through > 0, deep += found.deep > 1;
      if (RandomKind(k) != RandomKind::space) continue;
      EXPECT_LE(found.linear, 1e-9) << random.text;
      EXPECT_LE(found.angular, 1e-9) << random.text;
    }
  atMost("90 worlds: most energy gained / that of the start", 0, gain, 1e-3, "");
  atMost("90 worlds in which a body goes through", 0, through, 1, "");
  atMost("90 worlds left with an overlap over 5 mm and 5 % of the size", 0, deep, 1, "");
}

}  // namespace
}  // namespace brickfall::law
