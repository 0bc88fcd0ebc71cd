// Rows 1, 2, 4, 5: blocks and balls with friction.
#include "law/lab.h"
#include "law/law.h"

namespace brickfall::law {
namespace {

// A box on an inclined plane: either a fixed box is tilted, or gravity is and the ground stays level.
struct Incline {
  Lab lab;
  BodyId box;
  Vec3 start, down;  // unit, along the slope

  Incline(double degrees, double friction, bool tiltGravity, double dt, double yawDegrees = 0)
      : lab(LabSetup{.dt = dt}, tiltGravity ? degrees : 0) {
    Quat slope = turn({0, 0, 1}, tiltGravity ? 0 : -degrees);  // down along +x
    BodyDef plane = bodyOf(boxOf({30, 0.5, 30}, 1000, friction), rotate(slope, Vec3{0, -0.5, 0}), BodyType::fixed);
    plane.rotation = slope;
    lab.add(plane);
    BodyDef d = bodyOf(boxOf({0.25, 0.1, 0.25}, 1000, friction), rotate(slope, Vec3{0, 0.1, 0}));
    d.rotation = slope * turn({0, 1, 0}, yawDegrees);
    box = lab.add(d);
    start = d.position;
    down = rotate(slope, Vec3{1, 0, 0});
  }
  Vec3 moved() const { return lab.state(box).position - start; }
  double slid() const { return dot(moved(), down); }
};

// The angle at which it begins to slide, from how far it slides just above it.
double angleOfSliding(double friction, bool tiltGravity, double dt) {
  double degrees = std::atan(friction) * 180 / kPi + 0.2, a = degrees * kPi / 180;
  Incline above(degrees, friction, tiltGravity, dt);
  above.lab.run(2);
  double missing = kG * (std::sin(a) - friction * std::cos(a)) - above.slid() / 2;
  return std::atan(friction) * 180 / kPi + missing / (kG * (std::cos(a) + friction * std::sin(a))) * 180 / kPi;
}

TEST(Law, Row1BlockOnAnInclineSticksUpToTheAngleOfFriction) {
  for (double friction : {0.5, 0.6, 0.75})
    for (bool tiltGravity : {false, true})
      for (double dt : kSteps) {
        std::string name = "mu " + text(friction, 2) + (tiltGravity ? ", gravity tilted" : ", plane tilted");
        double limit = std::atan(friction) * 180 / kPi;
        reached({name + ": angle of sliding", dt, angleOfSliding(friction, tiltGravity, dt), limit, 0.2, "degrees"});
        Incline below(limit - 0.2, friction, tiltGravity, dt);
        below.lab.run(1);
        Vec3 settled = below.moved();
        below.lab.run(5);
        atMost(name + ": creep in 5 s, 0.2 degrees below", dt, length(below.moved() - settled) * 1e3, 0.1, "mm");
      }
}

TEST(Law, Row1HoldsWhicheverWayTheBlockIsTurned) {
  for (double yaw : {0.0, 17.0, 37.0, 45.0}) {
    double limit = std::atan(0.6) * 180 / kPi;
    Incline below(limit - 0.2, 0.6, false, kDt, yaw), above(limit + 0.2, 0.6, false, kDt, yaw);
    below.lab.run(5);
    above.lab.run(2);
    atMost("turned by " + text(yaw, 0) + " degrees: moved in 5 s", kDt, length(below.moved()) * 1e3, 0.1, "mm");
    EXPECT_GT(above.slid(), 0.01);
  }
}

TEST(Law, Row2AccelerationDownAnIncline) {
  double expected = kG * (std::sin(kPi / 6) - 0.5 * std::cos(kPi / 6));
  ValidationCurve curve{"2", "Sliding down 30 degrees, mu 0.5: way", "time, s", "way, m", {}, {}, ""};
  for (bool tiltGravity : {false, true})
    for (double dt : kSteps) {
      Incline i(30, 0.5, tiltGravity, dt);
      Trace trace("dt 1/" + text(1 / dt, 0) + " s", 0.02);
      double before = 0;
      for (int n = 0; n < std::lround(2 / dt) && i.lab.step(); n++) {
        trace.add(i.lab.world.time(), i.slid());
        if (n == std::lround(0.5 / dt) - 1) before = dot(i.lab.state(i.box).linearVelocity, i.down);
      }
      double a = (dot(i.lab.state(i.box).linearVelocity, i.down) - before) / 1.5;
      reached({tiltGravity ? "gravity tilted: acceleration" : "plane tilted: acceleration", dt, a, expected,
               0.01 * expected, "m/s2"});
      if (!tiltGravity && dt != kSteps[2]) curve.found.push_back(trace.series());
    }
  curve.exact = {exactCurve("a t2 / 2", 0, 2, [&](double t) { return expected * t * t / 2; })};
  record(curve);
}

TEST(Law, Row4SlidesToRest) {
  double way = 25 / (2 * 0.4 * kG), time = 5 / (0.4 * kG);
  ValidationCurve curve{"4", "Sliding to rest, 5 m/s, mu 0.4: way", "time, s", "way, m", {}, {}, ""};
  for (double dt : kSteps) {
    Lab lab(LabSetup{.dt = dt});
    lab.addGround(0.4);
    BodyDef d = bodyOf(boxOf({0.25, 0.1, 0.25}, 1000, 0.4), {0, 0.1, 0});
    d.linearVelocity = {5, 0, 0};
    BodyId box = lab.add(d);
    Trace trace("dt 1/" + text(1 / dt, 0) + " s", 0.01);
    double stopped = -1;
    while (lab.world.time() < 1.6 && lab.step()) {
      BodyState s = lab.state(box);
      trace.add(lab.world.time(), s.position.x);
      if (stopped < 0 && length(s.linearVelocity) < 1e-2) stopped = lab.world.time();
    }
    reached({"way", dt, lab.state(box).position.x, way, 0.01 * way, "m"});
    reached({"time", dt, stopped, time, 0.01 * time + dt, "s"});
    if (dt != kSteps[2]) curve.found.push_back(trace.series());
  }
  curve.exact = {exactCurve("v0 t - mu g t2 / 2", 0, 1.6, [&](double t) {
    double s = std::min(t, time);
    return 5 * s - 0.4 * kG * s * s / 2;
  })};
  record(curve);
}

TEST(Law, Row5SlidingBallBeginsToRoll) {
  double mu = 0.2, v0 = 2, r = 0.1, time = 2.0 / 7 * v0 / (mu * kG);
  ValidationCurve curve{"5", "Ball from sliding to rolling, 2 m/s, mu 0.2, dt 1/60 s", "time, s", "m/s", {}, {}, ""};
  for (double dt : kSteps) {
    Lab lab(LabSetup{.dt = dt});
    lab.addGround(mu);
    BodyDef d = bodyOf(sphereOf(r, 1000, mu), {0, r, 0});
    d.linearVelocity = {v0, 0, 0};
    BodyId ball = lab.add(d);
    double rolls = -1, way = 0;
    Trace speed("speed"), rim("spin x radius");
    while (lab.world.time() < 0.6 && lab.step()) {
      BodyState s = lab.state(ball);
      speed.add(lab.world.time(), s.linearVelocity.x);
      rim.add(lab.world.time(), -s.angularVelocity.z * r);
      if (rolls < 0 && s.linearVelocity.x <= -s.angularVelocity.z * r * 1.001) {
        rolls = lab.world.time();
        way = s.position.x;
      }
    }
    reached({"speed of rolling", dt, lab.state(ball).linearVelocity.x, 5.0 / 7 * v0, 0.01 * v0, "m/s"});
    reached({"time", dt, rolls, time, 0.01 * time + dt, "s"});
    reached({"way when it first rolls", dt, way, 0.49928, 0.01 * 0.49928 + 1.43 * dt, "m"});
    if (dt == kSteps[1]) curve.found = {speed.series(), rim.series()};
  }
  curve.exact = {exactCurve("speed", 0, 0.6, [&](double t) { return v0 - mu * kG * std::min(t, time); }),
                 exactCurve("spin x radius", 0, 0.6, [&](double t) { return 2.5 * mu * kG * std::min(t, time); })};
  record(curve);
}

TEST(Law, Row5FastBallRollsOnUndisturbed) {
  Lab lab(LabSetup{});
  lab.addGround(0.6);
  BodyDef d = bodyOf(sphereOf(0.05), {0, 0.05, 0});
  d.linearVelocity = {8, 0, 0};
  d.angularVelocity = {0, 0, -160};  // 2.7 rad a step
  BodyId ball = lab.add(d);
  lab.run(2);
  reached({"ball rolling at 2.7 rad a step: speed after 2 s", kDt, lab.state(ball).linearVelocity.x, 8, 0.08, "m/s"});
}

}  // namespace
}  // namespace brickfall::law
