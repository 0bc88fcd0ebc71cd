// Rows 3, 7 and the toppling block of 15a.
#include "law/lab.h"
#include "law/law.h"
#include "law/reference.h"

namespace brickfall::law {
namespace {

// A block 0.25 m or 0.2 m wide and 1 m high, tilted about its lower edge.
struct TiltedBlock {
  Lab lab;
  BodyId block;
  TiltedBlock(double dt, double width, double tilt) : lab(LabSetup{.dt = dt}) {
    lab.addGround(2);
    BodyDef d = bodyOf(boxOf({width / 2, 0.5, width / 2}, 1000, 2), {});
    d.rotation = turn({0, 0, 1}, -tilt * 180 / kPi);
    d.position = -rotate(d.rotation, Vec3{width / 2, -0.5, 0});
    block = lab.add(d);
  }
  double tilt() const { return -rotationVector(lab.state(block).rotation).z; }
};

TEST(Law, Row3SlowlyTiltedBlockTopples) {
  // It needs its time to fall: exact is the angle at which a rigid block on the tilting plane has turned 0.1 rad.
  double rate = 0.1 * kPi / 180, alpha = std::atan(0.25), p2 = 3 * kG / (2 * std::hypot(1, 0.25));
  double exact = 0, tilt = 0, spin = 0;
  for (double t = 0; tilt < 0.1; t += 1e-4) {
    exact = alpha - 0.02 + rate * t;
    spin = tilt > 0 || exact > alpha ? spin + p2 * std::sin(tilt + exact - alpha) * 1e-4 : 0;
    tilt += spin * 1e-4;
  }
  for (double dt : kSteps) {
    TiltedBlock b(dt, 0.25, 0);
    double angle = alpha - 0.02;
    b.lab.tiltGravity(angle * 180 / kPi);
    b.lab.run(0.5);
    while (b.tilt() < 0.1 && angle < 0.3 && b.lab.step()) {
      angle += rate * dt;
      b.lab.tiltGravity(angle * 180 / kPi);
    }
    // How far past its balance the rigid block is by then is taken off.
    reached({"topples at", dt, (angle - exact + alpha) * 180 / kPi, alpha * 180 / kPi, 0.1, "degrees"});
  }
}

// Gravity turned at once past the balance of 14.036 degrees: the block has to go over, however near it is.
TEST(Law, Row3BlockPastItsBalanceGoesOver) {
  for (double dt : kSteps)
    for (double degrees : {14.1, 14.3, 14.6, 15.0, 16.0}) {
      TiltedBlock b(dt, 0.25, 0);
      b.lab.run(0.5);
      b.lab.tiltGravity(degrees);
      b.lab.run(4);
      EXPECT_GT(b.tilt(), 1) << degrees << " degrees, dt " << dt;
    }
}

TEST(Law, Row3BlockShortOfItsBalanceStays) {
  for (double dt : kSteps)
    for (double degrees : {12.0, 13.5, 13.9}) {
      TiltedBlock b(dt, 0.25, 0);
      b.lab.run(0.5);
      b.lab.tiltGravity(degrees);
      b.lab.run(4);
      EXPECT_LT(std::fabs(b.tilt()), 2e-3) << degrees << " degrees, dt " << dt;
    }
}

TEST(Law, Row7HousnerBlockRocks) {
  double start = 0.5 * std::atan(0.25);
  ValidationCurve curve{
      "7", "Rocking block 0.25 x 1 m from half its critical angle", "time, s", "tilt, degrees", {}, {}, ""};
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 1920}) {
    TiltedBlock b(dt, 0.25, start);
    Trace trace("dt 1/" + text(1 / dt, 0) + " s", 1.0 / 120);
    double upright = -1, before = start, peak = 0;
    while (b.lab.world.time() < 2 && b.lab.step()) {
      double tilt = b.tilt();
      if (upright < 0 && tilt <= 1e-4)
        upright = b.lab.world.time() - dt * (1e-4 - tilt) / std::max(1e-9, before - tilt);
      if (upright >= 0 && b.lab.world.time() < 0.9) peak = std::max(peak, -tilt);
      before = tilt;
      trace.add(b.lab.world.time(), tilt * 180 / kPi);
    }
    reached({"quarter period", dt, upright, 0.34917, 0.02 * 0.34917, "s", 0.02 * 0.34917 + 0.5 * dt});
    RockingBlock exact(1, 0.25, start);
    double exactPeak = 0;
    while (exact.time < 0.9) {
      exact.advance(1e-5);
      exactPeak = std::max(exactPeak, -exact.tilt);
    }
    double scale = 180 / kPi;
    reached({"largest tilt after the first impact", dt, peak * scale, exactPeak * scale, 0.02 * exactPeak * scale,
             "degrees", exactPeak * scale});
    if (dt < 0.017 && dt != 1.0 / 120) curve.found.push_back(trace.series());
  }
  RockingBlock exact(1, 0.25, start);
  Trace trace("Housner", 1.0 / 240);
  for (; exact.time < 2; exact.advance(1e-4)) trace.add(exact.time, exact.tilt * 180 / kPi);
  curve.exact = {trace.series()};
  record(curve);
}

TEST(Law, Row15aTiltedBlockFallsInItsTime) {
  ValidationCurve curve{"15a", "Block 0.2 x 0.2 x 1 m let go tilted 0.2 rad", "time, s", "tilt, degrees", {}, {}, ""};
  for (double dt : kSteps) {
    TiltedBlock b(dt, 0.2, 0.2);
    Trace trace("dt 1/" + text(1 / dt, 0) + " s", 1.0 / 120);
    double found = -1, before = 0.2;
    while (b.lab.world.time() < 2 && b.tilt() < 1.4 && b.lab.step()) {
      double tilt = b.tilt();
      trace.add(b.lab.world.time(), tilt * 180 / kPi);
      if (found < 0 && tilt >= kPi / 3) found = b.lab.world.time() - dt * (tilt - kPi / 3) / (tilt - before);
      before = tilt;
    }
    reached({"block tilted 0.2 rad: 60 degrees after", dt, found, 1.711, 0.01 * 1.711, "s"});
    if (dt != kSteps[2]) curve.found.push_back(trace.series());
  }
  RockingBlock exact(1, 0.2, 0.2);
  Trace trace("rigid block", 1.0 / 120);
  for (; exact.tilt < 1.4; exact.advance(1e-4)) trace.add(exact.time, exact.tilt * 180 / kPi);
  curve.exact = {trace.series()};
  record(curve);
}

}  // namespace
}  // namespace brickfall::law
