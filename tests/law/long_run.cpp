// The laws at full length: minutes and an hour of simulated time, many seeds, small steps. `make validate`.
#include "law/law.h"
#include "law/sweeps.h"

namespace brickfall::law {
namespace {

TEST(LongAnywhere, Row1Sticking) { sweepSticking(200); }
TEST(LongAnywhere, Row2Sliding) { sweepSliding(200); }
TEST(LongAnywhere, Row3Tilting) { sweepTilting(100); }
TEST(LongAnywhere, Row4Stopping) { sweepStopping(200); }
TEST(LongAnywhere, Row5Rolling) { sweepRolling(300); }
TEST(LongAnywhere, Row6Bouncing) { sweepBouncing(400); }
TEST(LongAnywhere, Row7Rocking) { sweepRocking(200); }
TEST(LongAnywhere, Row8Tumbling) { sweepTumbling(100); }
TEST(LongAnywhere, Row9Overhangs) { sweepOverhangs(200); }
TEST(LongAnywhere, Row10Columns) { sweepColumns(200); }
TEST(LongAnywhere, Row11Crashes) { sweepCrashes(200); }
TEST(LongAnywhere, Row13Walls) { sweepWalls(100); }
TEST(LongAnywhere, Row15HeavyTops) { sweepHeavyTops(200); }
TEST(LongAnywhere, Row15aFalls) { sweepFalls(60); }
TEST(LongAnywhere, Row15aToppling) { sweepToppling(200); }
TEST(LongAnywhere, Row15bLandings) { sweepLandings(60); }
TEST(LongAnywhere, Row17Drag) { sweepDrag(200); }
TEST(LongAnywhere, Row18uNothingFromNothing) { sweepRandomWorlds(16700); }  // 100,200 worlds
TEST(LongAnywhere, Row30tLinkagesGainNothing) { sweepRandomLinkages(1000); }
TEST(LongAnywhere, Row31aCouplets) { sweepCouplets(18); }
TEST(LongAnywhere, Row31bWrenches) { sweepWrenches(18); }
TEST(LongAnywhere, Row31cTriplets) { sweepTriplets(18); }
TEST(LongAnywhere, Row31dOpenings) { sweepOpenings(18); }
TEST(LongAnywhere, Row31eBreakOuts) { sweepBreakOuts(18); }
TEST(LongAnywhere, Row31mPiers) { sweepPiers(18); }
TEST(LongAnywhere, Row31nPushedWalls) { sweepPushedWalls(18); }
TEST(LongAnywhere, Row31vShearWalls) { sweepShearWalls(18); }
TEST(LongAnywhere, Row31yHeldShearWalls) { sweepHeldShearWalls(6); }
TEST(LongAnywhere, Row31yBoulders) { sweepBoulders(6); }
TEST(LongAnywhere, Row31yPanels) { sweepPanels(6); }

TEST(LongRun, Row13TenMinutes) {
  ValidationCurve curve{"13",      "Wall of 10 courses x 10, ten minutes: how far its bricks are below their place",
                        "time, s", "sag, mm",
                        {},        {},
                        ""};
  for (double dt : kSteps) {
    lab::Scene s = lab::make("w10");
    Trace worst("dt 1/" + text(1 / dt, 0) + " s", 1);
    lab::Measured m = lab::run(s, 600, dt, [&](int step, const StepReport& report) {
      if (step % std::lround(1 / dt) != 0) return;
      double sag = 0;
      for (std::size_t i = 0; i < s.boxes.size(); i++)
        sag = std::max(sag, s.start[i].y - s.world.state(s.boxes[i])->position.y);
      worst.add(report.time, sag * 1e3);
    });
    atMost("10 min: moved", dt, m.largestMove * 1e3, 0.5, "mm");
    atMost("10 min: creep from 10 s to the end", dt, m.creep * 1e3, 0.01, "mm");
    if (dt <= 1.0 / 60 && dt >= 1.0 / 120) {
      curve.found.push_back(worst.series());
      double elastic = kG * dt * dt / 4000 * 55 * 1e3;
      curve.exact.push_back(exactCurve(
          "elastic, dt 1/" + text(1 / dt, 0) + " s", 0, 600, [&](double) { return elastic; }, 10));
    }
  }
  record(curve);
}

// Nothing happens, so nothing may happen: the same bits of every pose and velocity from the first second to the last.
TEST(LongRun, Row13AnHourToTheLastBit) {
  for (bool sleep : {false, true})
    for (const char* name : {"w10", "w40"}) {
      lab::Options o;
      o.sleep = sleep;
      lab::Scene s = lab::make(name, o);
      for (int i = 0; i < 60; i++) ASSERT_TRUE(s.world.step(kDt).ok());
      std::uint64_t start = s.world.stateHash();
      double changed = -1;
      for (int i = 60; i < 3600 * 60 && changed < 0; i++) {
        ASSERT_TRUE(s.world.step(kDt).ok());
        if (s.world.stateHash() != start) changed = s.world.time();
      }
      std::string what = std::string(name == std::string("w10") ? "10 x 10" : "40 x 25") +
                         (sleep ? ", sleep on" : ", sleep off") + ": an hour, same bits after 1 s (1 = yes)";
      reached({what, kDt, changed < 0 ? 1.0 : 0.0, 1, 0, ""});
      EXPECT_LT(changed, 0) << name << " changed at " << changed << " s";
    }
}

TEST(LongRun, Row14OneMinute) {
  ValidationCurve curve{
      "14", "Wall of 40 courses x 25: how far its bricks are below their place", "time, s", "sag, mm", {}, {}, ""};
  for (double dt : {1.0 / 60, 1.0 / 120}) {
    lab::Scene s = lab::make("w40");
    Trace worst("dt 1/" + text(1 / dt, 0) + " s", 0.05);
    lab::Measured m = lab::run(s, 60, dt, [&](int step, const StepReport& report) {
      if (step % std::lround(0.05 / dt) != 0) return;
      double sag = 0;
      for (std::size_t i = 0; i < s.boxes.size(); i++)
        sag = std::max(sag, s.start[i].y - s.world.state(s.boxes[i])->position.y);
      worst.add(report.time, sag * 1e3);
    });
    atMost("60 s: sag", dt, m.sag * 1e3, 2, "mm");
    atMost("60 s: creep from 10 s to the end", dt, m.creep * 1e3, 0.1, "mm");
    curve.found.push_back(worst.series());
    double elastic = kG * dt * dt / 4000 * 820 * 1e3;
    curve.exact.push_back(exactCurve(
        "elastic, dt 1/" + text(1 / dt, 0) + " s", 0, 60, [&](double) { return elastic; }, 10));
  }
  record(curve);
}

TEST(LongRun, Row14HundredCoursesStand) {
  lab::Scene s = lab::make("w100");
  lab::Measured m = lab::run(s, 10, kDt);
  atMost("100 courses, 10 s: sag", kDt, m.sag * 1e3, 10, "mm");
  atMost("100 courses, 10 s: out of plane", kDt, m.outOfPlane * 1e3, 5, "mm");
}

TEST(LongRun, Row14FortyCoursesOutOfTrueTenSeeds) {
  Sweep sag("gaps to 0.05 or 0.1 mm, 20 walls: sag beyond the sum of gaps", 1.2, "mm"),
      plane("gaps to 0.05 or 0.1 mm, 20 walls: out of plane", 2, "mm");
  for (double gap : {0.05e-3, 0.1e-3})
    for (int seed = 1; seed <= 10; seed++) {
      lab::Options o;
      o.gap = gap;
      o.seed = seed;
      lab::Scene s = lab::make("w40", o);
      lab::Measured m = lab::run(s, 5, kDt);
      std::string which = "gaps to " + text(gap * 1e3, 2) + " mm, seed " + text(seed, 0);
      sag.add(kDt, (m.sag - 40 * gap) * 1e3, which);
      plane.add(kDt, m.outOfPlane * 1e3, which);
    }
}

TEST(LongRun, HolesAtSmallStepsAndTheRestStandsTenSeconds) {
  for (auto [name, most] : {std::pair{"hole5", 15}, std::pair{"hole10", 60}})
    for (double dt : {1.0 / 60, 1.0 / 240}) {
      lab::Scene s = lab::make(name);
      lab::Measured m = lab::run(s, 10, dt);
      atMost(std::string(name) + ", 10 s: bricks moved over 50 mm", dt, m.moved50, most, "");
      atMost(std::string(name) + ", 10 s: energy rise", dt, m.energyRise, 1e-6, "J");
    }
}

TEST(LongRun, WallHitComesToRest) {
  lab::Scene s = lab::make("wall_hit");
  lab::Measured m = lab::run(s, 10, kDt);
  atMost("wall_hit: energy rise / start", kDt, m.energyRise / m.energyStart, 1e-3, "");
  double depth = 0;
  int pairs = 0;
  s.world.forEachContact([&](const ContactView& c) {
    Result<double> d = s.world.penetration(c.shapeA, c.shapeB);
    if (d && *d > 0) {
      depth += *d;
      pairs++;
    }
  });
  atMost("wall_hit: mean overlap in the rubble", kDt, depth / std::max(1, pairs) * 1e3, 2, "mm");
  EXPECT_GE(m.lowest, 0);
}

TEST(LongRun, HitsToEightyMetresASecond) {
  for (const char* name : {"hit", "hitv40", "hitv80"})
    for (double e : {0.0, 0.3}) {
      lab::Options o;
      o.restitution = e;
      lab::Scene s = lab::make(name, o);
      lab::Measured m = lab::run(s, 5, kDt);
      atMost(std::string(name) + ", e " + text(e, 1) + ": energy rise / start", kDt, m.energyRise / m.energyStart, 1e-3,
             "");
      EXPECT_GE(m.lowest, 0) << name;
      EXPECT_TRUE(m.finite);
    }
}

// A net of boards on ball joints, hung up flat by its rim, falls into its curve. (One of 70 x 70 boards has 9940 joints
// and takes some 8 s a step.)
TEST(LongRun, ANetHangsByItsRim) {
  constexpr int kSide = 20;
  constexpr double kPitch = 0.1;
  World world = makeWorld();
  const BodyId frame = add(world, bodyOf(boxOf({0.1, 0.1, 0.1}), {0, 50, 0}, BodyType::fixed));
  std::vector<BodyId> boards;
  std::vector<JointId> joints;
  for (int i = 0; i < kSide * kSide; i++)
    boards.push_back(add(world, bodyOf(boxOf({0.04, 0.01, 0.04}), {kPitch * (i / kSide), 2, kPitch * (i % kSide)})));
  const auto at = [&](int row, int column) {
    const bool inside = row >= 0 && row < kSide && column >= 0 && column < kSide;
    return inside ? boards[std::size_t(row * kSide + column)] : frame;
  };
  const auto tie = [&](BodyId a, BodyId b, double row, double column) {
    joints.push_back(*world.createJoint({.bodyA = a, .bodyB = b, .anchor = {kPitch * row, 2, kPitch * column}}));
  };
  for (int i = -1; i < kSide; i++)
    for (int k = 0; k < kSide; k++) {
      tie(at(i, k), at(i + 1, k), i + 0.5, k);
      tie(at(k, i), at(k, i + 1), k, i + 0.5);
    }
  double gap = 0, gained = 0, last = world.energy().kinetic + world.energy().potential;
  for (int i = 0; i < 60; i++) {
    ASSERT_TRUE(world.step(kDt).ok());
    for (JointId joint : joints) gap = std::max(gap, world.state(joint)->error);
    const double now = world.energy().kinetic + world.energy().potential;
    gained = std::max(gained, now - last);
    last = now;
  }
  atMost("net of 20 x 20 boards, 840 joints: joints gape", kDt, gap, 1e-3, "m");
  atMost("net of 20 x 20 boards, 840 joints: energy gained in a step", kDt, gained, 1e-3, "J", 20);
}

}  // namespace
}  // namespace brickfall::law
