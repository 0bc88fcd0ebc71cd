// Rows 6, 8, 11, 17: rebounds, free rotation, collisions in empty space, drag.
#include "law/draw.h"
#include "law/law.h"
#include "law/reference.h"
#include "law/sweeps.h"

namespace brickfall::law {

namespace {

BodyDef fallingBody(Draw& draw, double size, double restitution, std::string* name) {
  double density = draw.scale(100, 8000);
  BodyDef d;
  switch (draw.below(4)) {
    case 0:
      d = bodyOf(sphereOf(size, density), {});
      *name = "ball";
      break;
    case 1:
      d = bodyOf(boxOf({size * draw.between(.5, 1.5), size, size * draw.between(.5, 1.5)}, density), {});
      *name = "box";
      break;
    case 2:
      d = bodyOf(drumOf(size * 1.2, size, density, .6), {});
      *name = "drum";
      break;
    default:
      d = bodyOf(capsuleOf(size, size * draw.between(.5, 2), density), {});
      d.rotation = turn({1, 0, 0}, 90);
      *name = "lying capsule";
  }
  *name += label(" of %.3f m", size);
  d.shapes[0].material.restitution = restitution;
  return d;
}

struct Bounces {
  std::vector<double> apexes;  // m
  double end = 0;  // s, last time that it could rise to a millionth of its start, and moved by as much of its speed
  double sideways = 0;  // m
};
Bounces watchBounces(Lab& lab, BodyId body, double rest, double height, double seconds) {
  Bounces b;
  double before = 0, highest = -1;
  while (lab.world.time() < seconds && lab.step()) {
    BodyState s = lab.state(body);
    double v = s.linearVelocity.y, apex = s.position.y - rest + v * v / (2 * kG);
    if (before < 0 && v > 0) {
      if (highest > 0) b.apexes.push_back(highest);
      highest = 0;
    }
    if (highest >= 0 && v > 0) highest = std::max(highest, apex);
    if (apex > 1e-6 * height && std::fabs(v) > 1e-6 * std::sqrt(2 * kG * height)) b.end = lab.world.time();
    b.sideways = std::max(b.sideways, std::hypot(s.position.x, s.position.z));
    before = v;
  }
  if (highest > 0) b.apexes.push_back(highest);
  return b;
}

}  // namespace

void sweepBouncing(int cases) {
  Sweep heights("any body: height, for each bounce faster than 1 m/s", 1, "%"), total("any body: total time", 1, "%"),
      sideways("any body: sideways / height", 1e-3, "");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 20000);
    LabSetup setup = draw.setup();
    double e = draw.oneIn(4) ? 1 : draw.between(.1, .95), size = draw.scale(.02, 5), height = draw.scale(.3, 10);
    std::string name;
    BodyDef d = fallingBody(draw, size, e, &name);
    d.position.y = size + height;
    Lab lab(setup);
    lab.addGround(.6, e);
    double want = std::sqrt(2 * height / kG) * (1 + e) / (1 - e), seconds = e < 1 ? std::min(20.0, want + 1) : 8;
    Bounces b = watchBounces(lab, lab.add(d), size, height, seconds);
    double worst = 0, apex = height, time = std::sqrt(2 * height / kG);
    for (std::size_t n = 0; n < 40; n++) {
      double impact = std::sqrt(2 * kG * apex);
      apex *= e * e;
      time += 2 * impact * e / kG;
      bool seen = 2 * impact * e / kG > 3 * setup.dt;  // long enough in the air to be read off
      if (impact < 1.05 || time > seconds - 0.1 || !seen) break;
      double error = ((n < b.apexes.size() ? b.apexes[n] : 0) / apex - 1) / double(n + 1);
      if (std::fabs(error) > std::fabs(worst)) worst = error;
    }
    std::string which = setup.text() + ", " + name + label(", e %.3f", e) + label(", from %.2f m", height);
    heights.add(setup.part(), worst * 100, which, 3);
    if (e < .9 && want < 19)
      total.add(setup.part(), (b.end / want - 1) * 100, which, (2.5 * setup.part() / (1 - e) + setup.dt) / want * 100);
    sideways.add(setup.part(), b.sideways / height, which);
  }
}

void sweepTumbling(int cases) {
  Sweep angle("any body, any frame: orientation after 10 s, off per turn made", 1e-4, "turns"),
      energy("any body, any frame: energy after 10 s", 0.01, "%"),
      momentum("any body, any frame: angular momentum after 10 s", 1e-7, "%");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 50000);
    LabSetup setup = draw.setup();
    double size = draw.scale(.02, 10), w = draw.between(2, 20);
    Vec3 h = Vec3{draw.between(.3, 1), draw.between(.3, 1), draw.between(.3, 1)} * size;
    BodyDef d = bodyOf(boxOf(h, draw.scale(100, 8000)), {});
    int kind = draw.below(3);
    if (kind == 1) d.shapes[0].local = {draw.direction() * size, turn(draw.direction(), draw.between(0, 180))};
    if (kind == 2) {
      d.shapes.push_back(boxOf({h.x / 2, h.y * .3, h.z}, 1500));
      d.shapes[1].local = {{h.x, h.y * .3, 0}, turn({1, 2, 3}, draw.between(0, 90))};
    }
    d.angularVelocity = draw.direction() * w;
    d.linearVelocity = {1, 2, 3};
    Lab lab(setup, 0, 0);
    BodyId body = lab.add(d);
    BodyState start = *lab.world.state(body);
    Mat3 inertia = lab.world.massProperties(body)->inertia;
    FreeTop top(start.rotation, inertia, start.angularVelocity);
    for (int k = 0; k < 50000; k++) top.advance(2e-4);
    lab.run(10);
    BodyState end = *lab.world.state(body);
    Vec3 l = rotate(end.rotation, inertia * rotate(conjugate(end.rotation), end.angularVelocity));
    double e0 = dot(top.momentum(), start.angularVelocity), e1 = dot(l, end.angularVelocity);
    std::string which = setup.text() + label(", %.3f m", size) + label(", %.1f rad/s", w) +
                        (kind == 0   ? ", box"
                         : kind == 1 ? ", box turned in its body"
                                     : ", two boxes");
    double off = length(rotationVector(normalized(conjugate(top.rotation) * end.rotation)));
    angle.add(setup.part(), off / (10 * w), which);
    energy.add(setup.part(), (e1 / e0 - 1) * 100, which);
    momentum.add(setup.part(), length(l - top.momentum()) / length(l) * 100, which);
  }
}

void sweepCrashes(int cases) {
  Sweep linear("2 to 13 bodies thrown at each other: linear momentum", 1e-6, ""),
      angular("2 to 13 bodies thrown at each other: angular momentum", 1e-5, ""),
      energy("2 to 13 bodies thrown at each other: rise of energy in a step, rebounds left out", 1e-3, ""),
      above("2 to 13 bodies thrown at each other: energy above the start", 1e-6, "");
  int turned = 0;
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 90000);
    LabSetup setup = draw.setup();
    setup.origin = {};
    double speed = draw.scale(.1, 100), e = std::array{0.0, 0.5, 1.0, draw.unit()}[std::size_t(draw.below(4))];
    Lab lab(setup, 0, 0);
    lab.world.trace({.ledger = true});
    double largest = 0;
    int count = 2 + draw.below(12);
    for (int k = 0; k < count; k++) {
      double z = draw.scale(.05, .3), density = draw.scale(100, 8000);
      ShapeDef shapes[] = {boxOf({z, z * draw.between(.3, 1), z * draw.between(.3, 1)}, density), sphereOf(z, density),
                           capsuleOf(z / 2, z, density), hullOf(z, density)};
      ShapeDef shape = shapes[draw.below(4)];
      shape.material.restitution = e;
      shape.material.friction = draw.unit();
      Vec3 from = draw.direction();
      BodyDef d = bodyOf(shape, from * draw.between(1, 2));
      d.linearVelocity = from * -speed;
      d.angularVelocity = draw.direction() * speed;
      largest = std::max(largest, lab.world.state(lab.add(d))->mass * speed);
    }
    Vec3 p = lab.world.linearMomentum(), l = lab.world.angularMomentum();
    double start = lab.world.energy().kinetic, before = start, dp = 0, dl = 0, rise = 0, most = 0;
    while (lab.world.time() < std::min(20.0, 4 / speed) && lab.step()) {
      dp = std::max(dp, length(lab.world.linearMomentum() - p) / largest);
      dl = std::max(dl, length(lab.world.angularMomentum() - l) / largest);
      double now = lab.world.energy().kinetic;
      // In islands of many bodies, and of what flies beyond its own size in a step, an impact gives back in the next step what
      // it took in this one.
      const StepLedger& ledger = *lab.report.ledger;
      double back = std::max(0.0, ledger.rebound.energy) + std::max(0.0, ledger.impacts.energy);
      rise = std::max(rise, (now - before - back) / start);
      most = std::max(most, now / start - 1);
      before = now;
    }
    std::string which = setup.text() + label(", %g bodies", count) + label(", %.3g m/s", speed) + label(", e %.2f", e);
    linear.add(setup.part(), dp, which);
    // Known to be off where bodies that were stopped before they met could not be moved on without going through others: the
    // centre of mass is then not where its momentum says. Above 1e-5 in 12 of 1000 such crashes, above 0.002 in one, 0.0037. Energy
    // rises where a crash draws bodies that spin together (arms are frozen in a step): above 0.001 in one of 1000, 0.0013.
    angular.add(setup.part(), dl, which, 0.01);
    turned += dl > 0.002;
    energy.add(setup.part(), rise, which, 0.005);
    above.add(setup.part(), most, which);
  }
  EXPECT_LE(turned, std::max(1, cases / 200))
      << "of " << cases << " crashes with angular momentum off by more than 0.002";
}

void sweepDrag(int cases) {
  Sweep velocity("any ball thrown: velocity", 0.1, "%"), place("any ball thrown: place / way", 0.1, "%"),
      terminal("any ball: terminal velocity", 0.1, "%");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 100000);
    LabSetup setup = draw.setup();
    double r = draw.scale(.02, 1), density = draw.scale(20, 3000);
    BodyDef d = bodyOf(sphereOf(r, density), {});
    d.dragArea = draw.between(.3, 1.2) * kPi * r * r;
    d.linearVelocity = {draw.between(-30, 30), draw.between(-30, 30), 0};
    Lab lab(setup);
    BodyId ball = lab.add(d);
    double c = 0.5 * 1.204 * d.dragArea / lab.state(ball).mass;
    double seconds = double(std::lround(draw.between(.5, 5) / setup.dt)) * setup.dt;
    FallInAir want(d.linearVelocity, c);
    double way = 0;
    for (int k = 0; k < 4000; k++) {
      want.advance(seconds / 4000);
      way += length(want.velocity) * seconds / 4000;
    }
    lab.run(seconds);
    BodyState s = lab.state(ball);
    std::string which = setup.text() + label(", radius %.3f m", r) + label(", %.0f kg/m3", density) +
                        label(", %.1f m/s", length(d.linearVelocity)) + label(", %.2f s", seconds);
    velocity.add(setup.part(), length(s.linearVelocity - want.velocity) / length(want.velocity) * 100, which);
    place.add(setup.part(), length(s.position - want.position) / way * 100, which, 0.5);
    double fall = std::sqrt(kG / c);
    lab.run(8 * fall / kG);
    terminal.add(setup.part(), (-lab.state(ball).linearVelocity.y / fall - 1) * 100, which);
  }
}

}  // namespace brickfall::law
