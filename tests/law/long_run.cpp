// The laws at full length: minutes of simulated time, many seeds, small steps. `make validate`.
#include "law/law.h"

namespace brickfall::law {
namespace {

TEST(LongRun, Row13TenMinutes) {
  lab::Scene s = lab::make("w10");
  lab::Measured m = lab::run(s, 600, 1.0 / 60);
  atMost("moved", m.largestMove * 1e3, 0.5, "mm");
  atMost("creep", m.creep * 1e3, 0.01, "mm");
}

TEST(LongRun, Row14OneMinute) {
  lab::Scene s = lab::make("w40");
  lab::Measured m = lab::run(s, 60, 1.0 / 60);
  atMost("sag", m.sag * 1e3, 2, "mm");
  atMost("creep from 10 s to the end", m.creep * 1e3, 0.1, "mm");
}

TEST(LongRun, HundredCoursesStand) {
  lab::Scene s = lab::make("w100");
  lab::Measured m = lab::run(s, 10, 1.0 / 60);
  atMost("sag", m.sag * 1e3, 10, "mm");
  atMost("out of plane", m.outOfPlane * 1e3, 5, "mm");
}

TEST(LongRun, FortyCoursesOutOfTrueTenSeeds) {
  for (double gap : {0.05e-3, 0.1e-3})
    for (int seed = 1; seed <= 10; seed++) {
      lab::Options o;
      o.gap = gap;
      o.seed = seed;
      lab::Scene s = lab::make("w40", o);
      lab::Measured m = lab::run(s, 5, 1.0 / 60);
      std::string name = "gap " + std::to_string(gap * 1e3).substr(0, 4) + " mm, seed " + std::to_string(seed);
      atMost(name + ": sag", m.sag * 1e3, 40 * gap * 1e3 + 1.2, "mm");
      atMost(name + ": out of plane", m.outOfPlane * 1e3, 2, "mm");
    }
}

TEST(LongRun, Row13SmallSteps) {
  for (double dt : {1.0 / 120, 1.0 / 240, 1.0 / 480}) {
    lab::Scene s = lab::make("w10");
    lab::Measured m = lab::run(s, 60, dt);
    atMost("moved" + at(dt), m.largestMove * 1e3, 0.5, "mm");
  }
}

TEST(LongRun, HolesAtSmallStepsAndTheRestStandsTenSeconds) {
  for (auto [name, most] : {std::pair{"hole5", 15}, std::pair{"hole10", 60}})
    for (double dt : {1.0 / 60, 1.0 / 240}) {
      lab::Scene s = lab::make(name);
      lab::Measured m = lab::run(s, 10, dt);
      atMost(std::string(name) + at(dt) + ": bricks moved over 50 mm", m.moved50, most, "");
      atMost(std::string(name) + at(dt) + ": energy rise", m.energyRise, 1e-6, "J");
    }
}

TEST(LongRun, WallHitComesToRest) {
  lab::Scene s = lab::make("wall_hit");
  lab::Measured m = lab::run(s, 10, 1.0 / 60);
  atMost("energy rise / start", m.energyRise / m.energyStart, 1e-3, "");
  double depth = 0;
  int pairs = 0;
  s.world.forEachContact([&](const ContactView& c) {
    Result<double> d = s.world.penetration(c.shapeA, c.shapeB);
    if (d && *d > 0) {
      depth += *d;
      pairs++;
    }
  });
  atMost("mean overlap in the rubble", depth / std::max(1, pairs) * 1e3, 2, "mm");
  EXPECT_GE(m.lowest, 0);
}

TEST(LongRun, HitsToEightyMetresASecond) {
  for (const char* name : {"hit", "hitv40", "hitv80"})
    for (double e : {0.0, 0.3}) {
      lab::Options o;
      o.restitution = e;
      lab::Scene s = lab::make(name, o);
      lab::Measured m = lab::run(s, 5, 1.0 / 60);
      atMost(std::string(name) + ": energy rise / start", m.energyRise / m.energyStart, 1e-3, "");
      EXPECT_GE(m.lowest, 0) << name;
      EXPECT_TRUE(m.finite);
    }
}

}  // namespace
}  // namespace brickfall::law
