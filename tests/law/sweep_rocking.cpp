// Rows 3, 7 and the toppling block of 15a: blocks that turn about an edge.
#include "law/draw.h"
#include "law/law.h"
#include "law/reference.h"
#include "law/sweeps.h"

namespace brickfall::law {

namespace {

struct TiltedBlock {
  double height, width;
  Lab lab;
  BodyId block;
  TiltedBlock(const LabSetup& setup, double h, double w, double depth, double density, double tilt)
      : height(h), width(w), lab(setup) {
    lab.addGround(2);
    BodyDef d = bodyOf(boxOf({w / 2, h / 2, depth / 2}, density, 2), {});
    d.rotation = turn({0, 0, 1}, -tilt * 180 / kPi);
    d.position = -rotate(d.rotation, Vec3{w / 2, -h / 2, 0});
    block = lab.add(d);
  }
  double tilt() const { return -rotationVector(lab.state(block).rotation).z; }
};

// Time until the tilt passes `target`, between two steps, or -1.
double timeTo(TiltedBlock& b, double target, double seconds) {
  double before = b.tilt(), dt = b.lab.setup().dt;
  while (b.lab.world.time() < seconds && b.lab.step()) {
    double now = b.tilt();
    if ((now - target) * (before - target) <= 0) return b.lab.world.time() - dt * (now - target) / (now - before);
    before = now;
  }
  return -1;
}

double exactTimeTo(RockingBlock block, double target) {
  bool above = block.tilt > target;
  while ((block.tilt > target) == above && block.time < 20) block.advance(2e-5);
  return block.time;
}

}  // namespace

void sweepRocking(int cases) {
  Sweep sweep("any block: quarter period", 2, "%"), first("any block: first 95 % of the quarter period", 2, "%");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 30000);
    LabSetup setup = draw.setup();
    double h = draw.scale(.05, 8), w = h * draw.between(.15, .5), depth = w * draw.between(.5, 2);
    RockingBlock exact(h, w, std::atan(w / h) * draw.between(.2, .8));
    TiltedBlock block(setup, h, w, depth, draw.scale(100, 8000), exact.tilt);
    double start = exact.tilt, want = exactTimeTo(exact, 1e-4 * start);
    double found = timeTo(block, 1e-4 * start, 2 * want);
    std::string which = setup.text() + label(", %.3f m high", h) + label(", slenderness %.2f", h / w) +
                        label(", from %.2f of the critical angle", start / exact.alpha()) +
                        label(", %.4f s wanted", want);
    // Implicit steps are right to a part of a step: what is finer than some 20 steps a quarter period can be asked for.
    sweep.add(setup.part(), found < 0 ? 100 : (found / want - 1) * 100, which, 150 * setup.part() / want);
    TiltedBlock again(setup, h, w, depth, 1000, start);
    double nearly = exactTimeTo(exact, 0.1 * start), foundNearly = timeTo(again, 0.1 * start, 2 * want);
    first.add(setup.part(), foundNearly < 0 ? 100 : (foundNearly / nearly - 1) * 100, which,
              100 * setup.part() / nearly);
  }
}

void sweepToppling(int cases) {
  Sweep sweep("any block past its balance: time to 60 degrees", 1, "%");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 31000);
    LabSetup setup = draw.setup();
    double h = draw.scale(.05, 8), w = h * draw.between(.15, .5), depth = w * draw.between(.5, 2);
    RockingBlock exact(h, w, std::atan(w / h) * draw.between(1.01, 1.3));
    TiltedBlock block(setup, h, w, depth, draw.scale(100, 8000), exact.tilt);
    double want = exactTimeTo(exact, kPi / 3), found = timeTo(block, kPi / 3, 2 * want + 1);
    std::string which = setup.text() + label(", %.3f m high", h) + label(", slenderness %.2f", h / w) +
                        label(", from %.3f of the critical angle", exact.tilt / exact.alpha()) +
                        label(", %.4f s wanted", want);
    sweep.add(setup.part(), found < 0 ? 100 : (found / want - 1) * 100, which, 80 * setup.part() / want);
  }
}

// The plane tilts at 0.1 to 0.5 degrees a second, by itself (kinematic) or under turning gravity. What is exact for a
// block on it: the relative tilt obeys the same equation, with the plane's angle added.
void sweepTilting(int cases) {
  Sweep sweep("any block: angle at which it has turned 0.1 rad", 0.2, "degrees");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 40000);
    LabSetup setup = draw.setup();
    double h = draw.scale(.1, 8), w = h * draw.between(.1, .6), rate = draw.between(.1, .5) * kPi / 180;
    double alpha = std::atan(w / h), start = alpha - 1.5 * kPi / 180, p2 = 3 * kG / (2 * std::hypot(h, w));
    bool gravity = draw.oneIn(2);
    Lab lab(setup, gravity ? start * 180 / kPi : 0);
    Quat slope = gravity ? Quat{} : turn({0, 0, 1}, -start * 180 / kPi);
    BodyId plane = gravity ? lab.addGround(2) : BodyId{};
    if (!gravity) {
      BodyDef d = bodyOf(boxOf({10 * h, 1, 10 * h}, 1000, 2), rotate(slope, Vec3{0, -1, 0}), BodyType::kinematic);
      d.rotation = slope;
      plane = lab.add(d);
    }
    BodyDef d = bodyOf(boxOf({w / 2, h / 2, w / 2 * draw.between(.5, 2)}, 1000, 2), rotate(slope, Vec3{0, h / 2, 0}));
    d.rotation = slope;
    BodyId block = lab.add(d);
    double want = 0, tilt = 0, spin = 0;
    for (double t = 0; tilt < 0.1; t += 1e-4) {
      want = start + rate * t;
      double push = p2 * std::sin(tilt + want - alpha);
      spin = tilt > 0 || push > 0 ? spin + push * 1e-4 : 0;
      tilt += spin * 1e-4;
    }
    double found = 0;
    for (double angle = start; found == 0 && angle < want + 0.05 && lab.step();) {
      angle += rate * setup.dt;
      if (gravity) {
        lab.tiltGravity(angle * 180 / kPi);
      } else {
        Vec3 turning{0, 0, -rate};
        EXPECT_TRUE(
            lab.world.setLinearVelocity(plane, lab.direction(cross(turning, lab.state(plane).centreOfMass))).ok());
        EXPECT_TRUE(lab.world.setAngularVelocity(plane, lab.axial(turning)).ok());
      }
      Quat under = gravity ? Quat{} : lab.state(plane).rotation;
      if (length(rotationVector(conjugate(under) * lab.state(block).rotation)) > 0.1) found = angle;
    }
    sweep.add(setup.part(), (found - want) * 180 / kPi,
              setup.text() + label(", %.3f m high", h) + label(", slenderness %.2f", h / w) +
                  label(", %.2f degrees/s", rate * 180 / kPi) + (gravity ? ", gravity" : ", plane"));
  }
}

}  // namespace brickfall::law
