// Row 31: mortar against closed forms, at every step, turned by 37 degrees, bodies made in any order.
#include "law/draw.h"
#include "law/glued.h"
#include "law/lab.h"
#include "law/sweeps.h"

namespace brickfall::law {

namespace {

constexpr double kThin = 0.1025;                                   // m
constexpr double kThinModulus = kBrickSize.x * kThin * kThin / 6;  // m3, of a bed about its length
constexpr double kMasonry = 19e3;                                  // N/m3
constexpr Vec3 kLaidBrick{0.225, 0.075, kThin};                    // m: with its share of the joints

double percentOff(double found, double expected) { return (found / expected - 1) * 100; }

// N: the pull that tears a brick of this size off a fixed one, its weight with it.
double pullOff(Glued& g, Vec3 size, double dt) {
  g.brick({0, 1, 0}, BodyType::fixed, size);
  g.brick({0, 1 - size.y, 0}, BodyType::dynamic, size);
  g.glue();
  double force = 0;
  while (g.broken == 0 && force < 1e5) {
    force += 2000 * dt;
    g.push(1, {0, -force, 0});
    g.step(dt);
  }
  return force + g.weight(1);
}

// N: EN 1052-3. The middle one of three bricks is pushed down while the outer ones, held, are pressed together.
double tripletForce(const GluedSetup& setup, double pressure) {
  Glued g(setup);
  const Vec3 size{0.065, kThin, kBrickSize.x};
  g.brick({-size.x, 1, 0}, BodyType::fixed, size);
  g.brick({0, 1, 0}, BodyType::dynamic, size);
  g.brick({size.x, 1, 0}, BodyType::dynamic, size);
  g.glue();
  const double weight = g.weight(1);
  double force = 0;
  while (g.broken == 0 && force < 2e5) {
    force += 10000 * setup.dt;
    g.push(2, {-pressure * kBed, weight, 0});
    // In the plane of its joint: nothing bends it.
    g.pushAt(2, {0, 0.5 * (force + weight), 0}, {0.5 * size.x, 1, 0});
    g.push(1, {0, -force, 0});
    g.step(setup.dt);
  }
  return force + weight;
}

// J: taken by a bed between a fixed brick and a heavy one that is driven, along the bed or off it.
double drivenWork(const GluedSetup& setup, double speed, bool shears) {
  Glued g(setup, emptySpace());
  g.brick({0, 0, 0}, BodyType::fixed);
  Glued::Box driven{{0, kBrickSize.y, 0}, kBrickSize, BodyType::dynamic, 1e7};
  driven.locks.turnX = driven.locks.turnY = driven.locks.turnZ = true;
  g.box(driven);
  g.glue();
  for (int i = 0; i < 8 + int(0.02 / (speed * setup.dt)) && g.broken == 0; i++) {
    EXPECT_TRUE(g.world.setLinearVelocity(g.bodies[1], g.turn * (shears ? Vec3{speed, 0, 0} : Vec3{0, speed, 0})).ok());
    g.step(setup.dt);
  }
  EXPECT_EQ(g.broken, 1);
  return g.work();
}

// A wall of whole bricks and half bats, four across, with nothing at its sides.
struct LeanWall : Glued {
  LeanWall(const GluedSetup& setup, double height) : Glued(setup) {
    const int courses = int(std::lround(height / kLaidBrick.y));
    for (int course = 0; course < courses; course++) {
      const double y = (course + 0.5) * kLaidBrick.y, half = 0.5 * kLaidBrick.x;
      for (int i = 0; i < 4 + course % 2; i++) {
        const bool bat = course % 2 != 0 && (i == 0 || i == 4);
        const double x = course % 2 == 0 ? (i + 0.5) * kLaidBrick.x
                         : i == 0        ? 0.5 * half
                         : i == 4        ? 7.5 * half
                                         : i * kLaidBrick.x;
        brick({x, y, 0}, BodyType::dynamic, bat ? Vec3{half, kLaidBrick.y, kThin} : kLaidBrick, kMasonry / kG);
      }
    }
    bricks = boxes.size();
  }
  void foot(double depth) { brick({2 * kLaidBrick.x, -0.05, 0}, BodyType::fixed, {4 * kLaidBrick.x, 0.1, depth}); }
  // Without friction, on both sides of it.
  void rails(double y) {
    for (double side : {-1.0, 1.0})
      box({{2 * kLaidBrick.x, y, side * (0.5 * kThin + 0.05)},
           {4 * kLaidBrick.x, 0.004, 0.1},
           BodyType::fixed,
           1900,
           0});
  }
  void glueBricks() {
    make();
    for (std::size_t i = 0; i < bricks; i++)
      for (std::size_t j = i + 1; j < std::min(i + 7, bricks); j++) gluePair(i, j);
  }
  void blow(double pressure, double dt) {
    for (std::size_t i = 0; i < bricks; i++) push(i, {0, 0, pressure * boxes[i].size.x * boxes[i].size.y});
    step(dt);
  }
  // Pa: the pressure at which its first joint cracks.
  double crackPressure(double expected, double dt) {
    for (int i = 0; i < int(std::lround(0.2 / dt)); i++) step(dt);
    double pressure = 0;
    while (damage() == 0 && pressure < 2 * expected) blow(pressure += expected / 1.37 * dt, dt);
    return pressure;
  }
  std::size_t bricks = 0;
};

// A wall of 0.99 m x 1 m x 0.1 m between a fixed base and a beam that stays level and is free to rise: it cracks and
// rocks about two opposite corners. What its mortar bears while it opens adds to that as long as the crack is short: so
// its energy in tension is small, and its friction so large that nothing slides.
struct ShearWall : Glued {
  explicit ShearWall(const GluedSetup& setup) : Glued(setup) {
    brick({0.5 * kLength, -0.05, 0}, BodyType::fixed, {kLength, 0.1, kThick});
    for (int course = 0; course < kCourses; course++)
      for (int i = 0; i < 5; i++) {
        const bool bat = i == (course % 2 == 0 ? 4 : 0);
        const double from = (i - (course % 2 != 0 && i > 0 ? 0.5 : 0.0)) * kPitch, size = bat ? 0.5 * kPitch : kPitch;
        brick({from + 0.5 * size, (course + 0.5) * kCourse, 0}, BodyType::dynamic, {size, kCourse, kThick});
      }
    Box beam{{0.5 * kLength, kHeight + 0.05, 0}, {kLength, 0.1, kThick}};
    beam.locks = AxisLocks::noTurns();
    box(beam);
    strength.tensionEnergy *= 0.03;
    strength.friction = 1.3;
    glue();
  }
  void press(double pressure, double along, double dt) {
    const std::size_t beam = boxes.size() - 1;
    push(beam, {along, weight(beam) - pressure * kLength * kThick, 0});
    step(dt);
  }
  // N: on the beam, when it has gone by a twentieth of the wall's thickness.
  double bears(double pressure, double expected, double dt) {
    for (int i = 0; i < int(std::lround(0.2 / dt)); i++) press(pressure, 0, dt);
    double force = 0;
    while (move(boxes.size() - 1).x < 0.05 * kThick && force < 2 * expected) {
      force += (force < 0.8 * expected ? 2.5 : 0.1) * expected * dt;
      press(pressure, force, dt);
    }
    return force;
  }
  double wallWeight() const {
    double sum = 0;
    for (std::size_t i = 1; i + 1 < boxes.size(); i++) sum += weight(i);
    return sum;
  }
  static constexpr double kPitch = 0.22, kLength = 0.99, kThick = 0.1, kHeight = 1;  // m
  static constexpr int kCourses = 18;
  static constexpr double kCourse = kHeight / kCourses;
};

}  // namespace

void sweepShearWalls(int cases) {
  Sweep sweep("a wall sheared under a level beam: force off (N + W / 2) (L / H) (1 - nu) by", 5, "%");
  for (const GluedSetup& setup : gluedSetups(cases))
    for (double pressure : {0.3e6, 0.6e6}) {
      ShearWall wall(setup);
      const double load = pressure * wall.kLength * wall.kThick, toe = pressure / (0.85 * wall.strength.compression);
      const double expected = (load + 0.5 * wall.wallWeight()) * wall.kLength / wall.kHeight * (1 - toe);
      sweep.add(setup.dt, percentOff(wall.bears(pressure, expected, setup.dt), expected),
                setup.text() + label(", under %.1f MPa", pressure * 1e-6));
    }
}

void sweepCouplets(int cases) {
  Sweep pull("a couplet: pull that breaks it, off ft A by", 1, "%"),
      work("the energy that it takes, off A G by", 3, "%");
  for (const GluedSetup& setup : gluedSetups(cases))
    for (double length : {kBrickSize.x, kThin}) {
      Glued g(setup);
      const double area = length * kThin;
      pull.add(setup.dt, percentOff(pullOff(g, {length, 0.065, kThin}, setup.dt), g.strength.tension * area),
               setup.text() + label(", %.4f m long", length));
      work.add(setup.dt, percentOff(g.work(), g.strength.tensionEnergy * area), setup.text());
    }
}

void sweepWrenches(int cases) {
  Sweep sweep("a bond wrench: moment that cracks, off (ft + N / A) W by", 2, "%");
  for (const GluedSetup& setup : gluedSetups(cases))
    for (double load : {0.0, 500.0, 2000.0, 8000.0}) {
      Glued g(setup);
      g.brick({0, 1, 0}, BodyType::fixed);
      g.brick({0, 1 + kBrickSize.y, 0});
      g.glue();
      double moment = 0;
      while (g.damage() == 0 && moment < 1e3) {
        moment += 30 * setup.dt;
        g.push(1, {0, -load, 0});
        g.twist(1, {moment, 0, 0});
        g.step(setup.dt);
      }
      const double expected = (g.strength.tension + (load + g.weight(1)) / kBed) * kThinModulus;
      sweep.add(setup.dt, percentOff(moment, expected), setup.text() + label(", under %.0f N", load));
    }
}

void sweepTriplets(int cases) {
  Sweep sweep("a triplet: force that breaks it, off 2 A (c + sigma tan phi) by", 3, "%");
  const MortarStrength s;
  for (const GluedSetup& setup : gluedSetups(cases))
    for (double pressure : {0.2e6, 0.6e6, 1e6})
      sweep.add(setup.dt, percentOff(tripletForce(setup, pressure), 2 * kBed * (s.cohesion + s.friction * pressure)),
                setup.text() + label(", under %.1f MPa", pressure * 1e-6));
}

void sweepOpenings(int cases) {
  Sweep sweep("an opening at any speed: energy off A G by", 3, "%");
  const MortarStrength s;
  for (const GluedSetup& setup : gluedSetups(cases))
    for (double speed : {0.01, 0.1, 1.0, 10.0})
      for (bool shears : {false, true})
        sweep.add(setup.dt,
                  percentOff(drivenWork(setup, speed, shears), (shears ? s.shearEnergy : s.tensionEnergy) * kBed),
                  setup.text() + label(shears ? ", sheared at %.2f m/s" : ", pulled at %.2f m/s", speed));
}

void sweepBreakOuts(int cases) {
  Sweep sweep("a ball breaks a brick out: speed off the true one by", 8, "%");
  Draw draw(1);
  for (const GluedSetup& setup : gluedSetups(cases))
    for (auto [mass, speed] : {std::pair{16.7, 1.41}, {5.0, 3.16}, {1.0, 10.3}})
      for (double part : {draw.between(0, 1), draw.between(0, 1), draw.between(0.99, 1), 1.0})
        sweep.add(setup.dt, percentOff(speedThatBreaksOut(mass, speed, setup, part), speed),
                  setup.text() + label(", %.1f kg", mass) + label(", %.4f of a step away", part));
}

void sweepPiers(int cases) {
  Sweep sweep("a pier of ten bricks: side load that cracks it, off (ft + N / A) W / h by", 3, "%");
  for (const GluedSetup& setup : gluedSetups(cases))
    for (double load : {0.0, 2000.0}) {
      Glued g(setup);
      g.brick({0, -0.5 * kBrickSize.y, 0}, BodyType::fixed);
      for (int i = 0; i < 10; i++) g.brick({0, (i + 0.5) * kBrickSize.y, 0});
      g.glue();
      const double height = 10 * kBrickSize.y, rests = 0.3;  // m, s
      const double expected = (g.strength.tension + (load + 10 * g.weight(1)) / kBed) * kThinModulus / height;
      double force = 0;
      auto go = [&] {
        g.push(10, {0, -load, 0});
        g.pushAt(10, {0, 0, force}, {0, height, 0});
        g.step(setup.dt);
      };
      for (int i = 0; i < int(std::lround(rests / setup.dt)); i++) go();
      while (g.damage() == 0 && force < 1e3) {
        force += 80 * setup.dt;
        go();
      }
      const std::string which = setup.text() + label(", under %.0f N", load);
      sweep.add(setup.dt, percentOff(force, expected), which);
      // Cracked, it only rocks, at a seventh of that: it falls.
      for (int i = 0; i < int(std::lround(1 / setup.dt)); i++) {
        force += 10 * setup.dt;
        go();
      }
      EXPECT_GT(g.broken, 0) << which;
      EXPECT_GT(g.moved(), 0.3) << which;
    }
}

void sweepPushedWalls(int cases) {
  Sweep oneWay("a wall held at foot and head: pressure that cracks it, off 4/3 (ft + gamma h/2) (t/h)^2 by", 5, "%");
  Sweep free("a free wall: pressure that cracks it, off 2 (ft + gamma h) W / h^2 by", 5, "%");
  Sweep rocks("a free wall on a dry bed, 5 % off gamma t^2 / h: stands or falls wrongly", 0, "");
  const double ft = MortarStrength().tension;
  for (const GluedSetup& setup : gluedSetups(cases)) {
    const double high = 2.475, low = 1.05;
    LeanWall held(setup, high);
    held.foot(0.004);  // no moment
    for (double y : {0.002, high - 0.002}) held.rails(y);
    held.glueBricks();
    const double bends = 4.0 / 3 * (ft + 0.5 * kMasonry * high) * (kThin / high) * (kThin / high);
    oneWay.add(setup.dt, percentOff(held.crackPressure(bends, setup.dt), bends), setup.text());
    LeanWall cantilever(setup, low);
    cantilever.foot(kThin);
    cantilever.glueBricks();
    for (std::size_t i = 0; i < 4; i++) cantilever.gluePair(cantilever.bricks, i);
    const double cracks = (ft + kMasonry * low) * kThin * kThin / (3 * low * low);
    free.add(setup.dt, percentOff(cantilever.crackPressure(cracks, setup.dt), cracks), setup.text());
    for (double share : {0.95, 1.05}) {
      LeanWall dry(setup, low);
      dry.foot(kThin);
      dry.glueBricks();
      const double most = share * kMasonry * kThin * kThin / low;
      for (int i = 0; i < int(std::lround(3 / setup.dt)); i++) dry.blow(std::min(most, most * i * setup.dt), setup.dt);
      rocks.add(setup.dt, (dry.moved() > 0.05) != (share > 1), setup.text() + label(", at %.2f of it", share));
    }
  }
}

}  // namespace brickfall::law
