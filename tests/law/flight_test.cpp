// Rows 6, 8, 17: rebounds, free rotation, drag.
#include "law/lab.h"
#include "law/law.h"
#include "law/reference.h"

namespace brickfall::law {
namespace {

struct Bounce {
  std::vector<double> apexes;  // m
  double end = 0, sideways = 0;
  ValidationSeries height;
};
Bounce bounce(bool sphere, double e, double dt) {
  Lab lab(LabSetup{.dt = dt});
  lab.addGround(0.6, e);
  ShapeDef shape = sphere ? sphereOf(0.25) : boxOf({0.25, 0.25, 0.25});
  shape.material.restitution = e;
  BodyId body = lab.add(bodyOf(shape, {0, 1.25, 0}));
  Bounce b;
  Trace trace((sphere ? "ball, e " : "box, e ") + text(e, 1));
  double before = 0, highest = -1;
  while (lab.world.time() < 5 && lab.step()) {
    BodyState s = lab.state(body);
    double v = s.linearVelocity.y, y = s.position.y - 0.25, apex = y + v * v / (2 * kG);
    trace.add(lab.world.time(), y);
    if (before < 0 && v > 0.3) {
      if (highest > 0) b.apexes.push_back(highest);
      highest = 0;
    }
    if (highest >= 0 && v > 0) highest = std::max(highest, apex);
    if (apex > 1e-6) b.end = lab.world.time();
    b.sideways = std::max(b.sideways, std::hypot(s.position.x, s.position.z));
    before = v;
  }
  if (highest > 0) b.apexes.push_back(highest);
  b.height = trace.series();
  return b;
}

double exactHeight(double t, double e) {
  double fall = std::sqrt(2 / kG), v = e * kG * fall;
  if (t < fall) return 1 - kG * t * t / 2;
  t -= fall;
  while (v > 1e-3 && t > 2 * v / kG) {
    t -= 2 * v / kG;
    v *= e;
  }
  return v > 1e-3 ? v * t - kG * t * t / 2 : 0;
}

TEST(Law, Row6BouncesToHeightsOfTheRestitutionSquared) {
  ValidationCurve curve{"6", "Dropped from 1 m, dt 1/60 s", "time, s", "height, m", {}, {}, ""};
  for (double e : {0.3, 0.5, 0.8})
    for (bool sphere : {true, false})
      for (double dt : kSteps) {
        std::string name = (sphere ? "ball, e " : "box, e ") + text(e, 1);
        Bounce b = bounce(sphere, e, dt);
        ASSERT_GE(b.apexes.size(), e > 0.6 ? 2u : 1u) << name;
        reached({name + ": first bounce", dt, b.apexes[0], e * e, 0.02 * e * e, "m"});
        if (e > 0.6) reached({name + ": second bounce", dt, b.apexes[1], std::pow(e, 4), 0.02 * std::pow(e, 4), "m"});
        double total = std::sqrt(2 / kG) * (1 + e) / (1 - e);
        reached({name + ": total time", dt, b.end, total, 0.02 * total, "s", 1.5 * dt / (1 - e)});
        atMost(name + ": sideways", dt, b.sideways * 1e3, 1, "mm");
        if (sphere && e > 0.4 && dt == kSteps[1]) {
          curve.found.push_back(b.height);
          curve.exact.push_back(exactCurve(
              "e " + text(e, 1), 0, 5, [&](double t) { return exactHeight(t, e); }, 500));
        }
      }
  record(curve);
}

TEST(Law, Row8DzhanibekovFlips) {
  ValidationCurve curve{"8",       "Box 0.3 x 0.2 x 0.1 m, spin (0.1, 10, 0) rad/s, dt 1/60 s",
                        "time, s", "spin about the middle axis, rad/s",
                        {},        {},
                        ""};
  for (double dt : kSteps) {
    Lab lab(LabSetup{.dt = dt}, 0, 0);
    BodyDef d = bodyOf(boxOf({0.15, 0.1, 0.05}, 1 / 0.006), {});
    d.angularVelocity = {0.1, 10, 0};
    BodyId box = lab.add(d);
    Vec3 momentum = lab.world.angularMomentum();
    double energy = lab.world.energy().kinetic, drift = 0, energyDrift = 0, before = 10;
    std::vector<double> flips;
    Trace trace("Brickfall");
    while (lab.world.time() < 60 - dt / 2 && lab.step()) {
      drift = std::max(drift, length(lab.world.angularMomentum() - momentum) / length(momentum));
      energyDrift = std::max(energyDrift, std::fabs(lab.world.energy().kinetic - energy) / energy);
      BodyState s = lab.state(box);
      double spin = dot(s.angularVelocity, rotate(s.rotation, Vec3{0, 1, 0}));
      if ((before > 0) != (spin > 0))
        flips.push_back(lab.world.time() - dt * std::fabs(spin) / (std::fabs(spin) + std::fabs(before)));
      before = spin;
      if (lab.world.time() < 10) trace.add(lab.world.time(), spin);
    }
    ASSERT_GE(flips.size(), 20u);
    reached({"half period", dt, (flips[20] - flips[0]) / 20, 2.4345, 0.01 * 2.4345, "s"});
    atMost("angular momentum drift in 60 s", dt, drift * 100, 1, "%");
    atMost("energy drift in 60 s", dt, energyDrift * 100, 1, "%");
    if (dt == kSteps[1]) {
      curve.found = {trace.series()};
      FreeTop top({}, lab.world.massProperties(box)->inertia, {0.1, 10, 0});
      Trace exact("Runge-Kutta, 0.1 ms", 1.0 / 60);
      for (int i = 0; i < 100000; i++) {
        exact.add(i * 1e-4, dot(top.spin(top.rotation), rotate(top.rotation, Vec3{0, 1, 0})));
        top.advance(1e-4);
      }
      curve.exact = {exact.series()};
    }
  }
  record(curve);
}

TEST(Law, Row17TerminalVelocity) {
  ValidationCurve curve{
      "17", "Ball of 0.2 m and 2.5 kg, CdA 0.5 m2, thrown up at 10 m/s", "time, s", "velocity, m/s", {}, {}, ""};
  double dragArea = 0.5, mass = 600 * 4.0 / 3 * kPi * 1e-3, c = 0.5 * 1.204 * dragArea / mass;
  for (double dt : kSteps) {
    Lab lab(LabSetup{.dt = dt});
    BodyDef d = bodyOf(sphereOf(0.1, 600), {0, 1e4, 0});
    d.dragArea = dragArea;
    d.linearVelocity = {0, 10, 0};
    BodyId ball = lab.add(d);
    Trace trace("dt 1/" + text(1 / dt, 0) + " s");
    FallInAir exact({0, 10, 0}, c);
    double worst = 0, worstPlace = 0;
    while (lab.world.time() < 30 && lab.step()) {
      for (int i = 0; i < 40; i++) exact.advance(dt / 40);
      BodyState s = lab.state(ball);
      worst = std::max(worst, std::fabs(s.linearVelocity.y - exact.velocity.y));
      if (lab.world.time() < 3) worstPlace = std::max(worstPlace, std::fabs(s.position.y - 1e4 - exact.position.y));
      if (lab.world.time() < 4) trace.add(lab.world.time(), s.linearVelocity.y);
    }
    double expected = std::sqrt(kG / c);
    reached({"terminal velocity", dt, -lab.state(ball).linearVelocity.y, expected, 1e-3 * expected, "m/s"});
    atMost("velocity on the way, off by", dt, worst, 0.02, "m/s");
    atMost("place in the first 3 s, off by", dt, worstPlace, 0.2, "m");
    if (dt == kSteps[0] || dt == kSteps[3]) curve.found.push_back(trace.series());
  }
  FallInAir exact({0, 10, 0}, c);
  Trace trace("v' = -g - c |v| v");
  for (int i = 0; i <= 400; i++, exact.advance(0.01)) trace.add(i * 0.01, exact.velocity.y);
  curve.exact = {trace.series()};
  record(curve);
}

}  // namespace
}  // namespace brickfall::law
