// Rows 9, 10, 15, 15a, 15b: a wall can be made to stand by glue; these find out.
#include "law/lab.h"
#include "law/law.h"

namespace brickfall::law {
namespace {

// n blocks of 0.4 x 0.1 m at the edge of a table, block i from the top shifted by share L / (2 i) over the next.
double overhangMoves(int n, double share, double dt, double seconds) {
  Lab lab(LabSetup{.dt = dt});
  double length = 0.4, height = 0.1, right = 0;
  lab.add(bodyOf(boxOf({1, 0.5, 0.5}, 1000, 1), {-1, -0.5, 0}, BodyType::fixed));
  std::vector<BodyId> blocks;
  std::vector<Vec3> start;
  for (int k = 0; k < n; k++) {
    right += share * length / (2 * (n - k));
    start.push_back({right - length / 2, height * (k + 0.5), 0});
    blocks.push_back(lab.add(bodyOf(boxOf({length / 2, height / 2, 0.1}, 1000, 1), start.back())));
  }
  lab.run(seconds);
  double moved = 0;
  for (std::size_t i = 0; i < blocks.size(); i++)
    moved = std::max(moved, brickfall::length(lab.state(blocks[i]).position - start[i]));
  return moved;
}

TEST(Law, Row9HarmonicOverhang) {
  for (int n : {2, 4, 10, 16})
    for (double dt : kSteps) {
      double share = 0;
      for (int i = 1; i <= n; i++) share += 0.5 / i;
      std::string name = text(n, 0) + " blocks, " + text(share, 5) + " L";
      double stood = overhangMoves(n, 0.99, dt, 10), fell = overhangMoves(n, 1.01, dt, 4);
      reached({name + ": 99 % of it, moved in 10 s", dt, stood * 1e3, 0, 2, "mm"});
      EXPECT_GT(fell, 0.05) << n << " blocks at 101 % did not fall" << at(dt);
      reached({name + ": 101 % of it falls (1 = yes)", dt, fell > 0.05 ? 1.0 : 0.0, 1, 0, ""});
    }
}

TEST(Law, Row10ColumnPressesOnTheGroundWithItsWeight) {
  for (int n : {1, 5, 20, 50})
    for (double dt : kSteps) {
      Lab lab(LabSetup{.dt = dt});
      BodyId ground = lab.addGround(0.6);
      double weight = 0, force = 0;
      for (int i = 0; i < n; i++)
        weight +=
            lab.state(lab.add(bodyOf(boxOf({0.1075, 0.0325, 0.05125}, 1900), {0, 0.0325 + 0.065 * i, 0}))).mass * kG;
      lab.run(2);
      lab.world.forEachContact([&](const ContactView& c) {
        if (c.bodyA != ground && c.bodyB != ground) return;
        for (int k = 0; k < c.pointCount; k++) force += c.points[k].normalForce;
      });
      reached({text(n, 0) + " bricks: force on the ground", dt, force, weight, 0.01 * weight, "N"});
    }
}

TEST(Law, Row15ColumnUnderAThousandfoldWeight) {
  for (double dt : kSteps) {
    lab::Scene s = lab::make("col");
    run(s.world, 6, dt);
    double worst = 0;
    for (std::size_t i = 0; i + 1 < s.boxes.size(); i++)
      worst = std::max(worst, *s.world.penetration(s.world.shapes(s.boxes[i])[0], s.world.shapes(s.boxes[i + 1])[0]));
    atMost("overlap", dt, worst * 1e3, 5, "mm");
    for (std::size_t i = 0; i < s.boxes.size(); i++) EXPECT_LT(lab::boxMove(s, i), 0.01) << i;
  }
}

TEST(Law, Row15aWallInFreeFallIsNotHeld) {
  ValidationCurve curve{"15a", "Wall of row 13 in free fall, dt 1/60 s", "time, s", "fallen, m", {}, {}, ""};
  for (double dt : kSteps) {
    lab::Scene s = lab::make("fall");
    Trace highest("top brick", 0.02), lowest("bottom brick", 0.02);
    lab::Measured m = lab::run(s, 0.5, dt, [&](int, const StepReport& report) {
      lowest.add(report.time, s.start.front().y - s.world.state(s.boxes.front())->position.y);
      highest.add(report.time, s.start.back().y - s.world.state(s.boxes.back())->position.y);
    });
    reached({"wall in free fall: way", dt, m.fellMin, 1.22625, 1e-3 * 1.22625, "m"});
    atMost("wall in free fall: spread", dt, (m.fellMax - m.fellMin) * 1e3, 0.1, "mm");
    if (dt == kSteps[1]) curve.found = {lowest.series(), highest.series()};
  }
  curve.exact = {exactCurve("g t2 / 2", 0, 0.5, [](double t) { return kG * t * t / 2; })};
  record(curve);
}

TEST(Law, Row15aBallIntoAFloatingWallKeepsMomentum) {
  for (double e : {0.0, 0.5})
    for (double dt : kSteps) {
      lab::Options o;
      o.restitution = e;
      lab::Scene s = lab::make("hit0", o);
      double before = s.world.linearMomentum().z, energy = s.world.energy().kinetic;
      Vec3 spin = s.world.angularMomentum();
      run(s.world, 0.7, dt);
      std::string name = "ball into a floating wall, e " + text(e, 1);
      reached({name + ": momentum / before", dt, s.world.linearMomentum().z / before, 1, 1e-3, ""});
      atMost(name + ": drift of angular momentum", dt, length(s.world.angularMomentum() - spin) / length(spin), 1e-2,
             "");
      atMost(name + ": energy / before", dt, s.world.energy().kinetic / energy, 1.0001, "");
    }
}

TEST(Law, Row15aCorbelOf21mmStandsAnd22mmFalls) {
  ValidationCurve curve{
      "15a", "Corbels of ten bricks, dt 1/120 s: statics let 21.5 mm stand", "time, s", "largest motion, mm", {}, {},
      ""};
  for (double dt : kSteps) {
    lab::Scene stands = lab::make("cor21"), falls = lab::make("cor22");
    lab::Measured a = lab::run(stands, 10, dt), b = lab::run(falls, 4, dt);
    reached({"corbel of 21 mm: moved in 10 s", dt, a.largestMove * 1e3, 0, 1, "mm"});
    reached({"corbel of 22 mm falls (1 = yes)", dt, b.collapseTime > 0 ? 1.0 : 0.0, 1, 0, ""});
  }
  for (const char* name : {"cor21", "cor22", "cor23", "cor25"}) {
    lab::Scene s = lab::make(name);
    Trace trace(std::string(name + 3) + " mm", 0.01);
    lab::run(s, 1, 1.0 / 120, [&](int, const StepReport& report) {
      double moved = 0;
      for (std::size_t i = 0; i < s.boxes.size(); i++) moved = std::max(moved, lab::boxMove(s, i));
      if (moved < 0.25) trace.add(report.time, moved * 1e3);
    });
    curve.found.push_back(trace.series());
  }
  record(curve);
}

TEST(Law, Row15aBoxSlidesAsFarAsItMust) {
  double way = 9 / (2 * 0.6 * kG);
  for (double dt : kSteps) {
    lab::Scene s = lab::make("stop");
    lab::Measured m = lab::run(s, 2, dt);
    reached({"box sliding to rest from 3 m/s: way", dt, m.slid, way, 0.01 * way, "m"});
  }
}

TEST(Law, Row15bWallDroppedFlatLandsAndStands) {
  ValidationCurve curve{
      "15b", "Wall of row 13 dropped flat from 0.5 m, dt 1/60 s", "time, s", "energy above that at rest, J", {}, {},
      ""};
  for (double dt : kSteps) {
    lab::Scene s = lab::make("drop");
    Trace energy("kinetic + potential", 0.01);
    std::vector<double> values;
    lab::Measured m = lab::run(s, 4, dt, [&](int, const StepReport& report) {
      Energy e = s.world.energy();
      if (report.time < 1) energy.add(report.time, e.kinetic + e.potential);
      values.push_back(e.kinetic + e.potential);
    });
    atMost("bricks parted by", dt, std::max(m.fellMax - m.fellMin, m.outOfPlane) * 1e3, 5, "mm");
    // Overlap from the impact is let go within a second, which lifts the wall; kinetic energy is none by then.
    reached({"largest rise of energy in a step", dt, std::max(0.0, m.largestJump), 0, 1e-3, "J", 120 * dt + 1});
    atMost("energy above that at the start", dt, m.energyRise, 1e-3, "J");
    EXPECT_TRUE(m.finite);
    expectSound(s.world);
    if (dt == kSteps[1]) {
      ValidationSeries series = energy.series();
      for (double& y : series.y) y -= values.back();
      curve.found = {series};
      double top = m.energyStart - values.back(), landing = std::sqrt(2 * 0.5 / kG);
      curve.exact = {exactCurve("plastic", 0, 1, [&](double t) { return t < landing ? top : 0; })};
    }
  }
  record(curve);
}

// Where points change sides in every step, what keeps its place rests. (Otherwise none of these heaps ever does.)
TEST(Law, HeapsOfBoxesAndCapsulesComeToRest) {
  constexpr int kHeaps = 8;
  int resting = 0;
  for (int seed = 0; seed < kHeaps; seed++) {
    World world = awakeWorld();
    addGround(world);
    for (int side : {-1, 1}) {
      add(world, bodyOf(boxOf({0.05, 1, 0.4}), {side * 0.2, 1, 0}, BodyType::fixed));
      add(world, bodyOf(boxOf({0.4, 1, 0.05}), {0, 1, side * 0.2}, BodyType::fixed));
    }
    lab::LabRandom random(seed);
    auto part = [&] { return random.unit() - 0.5; };
    for (int i = 0; i < 8; i++) {
      const double k = 0.5 + 0.5 * random.unit();
      const ShapeDef shape = i % 2 ? capsuleOf(0.03 * k, 0.05 * k, 1900) : boxOf(Vec3{0.08, 0.0325, 0.05} * k, 1900);
      BodyDef body = bodyOf(shape, {0.1 * part(), 0.15 + 0.12 * i, 0.1 * part()});
      body.rotation = normalized(Quat{part(), part(), part(), part()});
      add(world, body);
    }
    StepReport last;
    for (int step = 0; step < 480; step++) last = stepSound(world, 1.0 / 120);
    resting += last.restingIslands == last.islands;
  }
  EXPECT_GE(resting, kHeaps / 2) << "of " << kHeaps;
}

}  // namespace
}  // namespace brickfall::law
