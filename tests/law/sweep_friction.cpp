// Rows 1, 2, 4, 5: friction.
#include "law/draw.h"
#include "law/law.h"
#include "law/sweeps.h"

namespace brickfall::law {

namespace {

// A flat body on a slope, which is either a tilted plane or box, or a level one under tilted gravity.
struct Slope {
  double friction, degrees;
  Lab lab;
  BodyId body;
  Vec3 start, down;
  std::string text;

  Slope(Draw& draw, const LabSetup& setup, double mu, double angle)
      : friction(mu), degrees(angle), lab(setup, 0), text(setup.text()) {
    bool tiltGravity = draw.oneIn(2), box = draw.oneIn(2);
    FlatBody flat = flatBody(draw, draw.scale(.01, 10), mu);
    if (tiltGravity) lab.tiltGravity(angle);
    Quat slope = tiltGravity ? Quat{} : turn({0, 0, 1}, -angle);
    BodyDef ground = bodyOf(planeOf(mu), {}, BodyType::fixed);
    if (box) ground = bodyOf(boxOf({150, 1, 150}, 1000, mu), rotate(slope, Vec3{0, -1, 0}), BodyType::fixed);
    ground.rotation = slope;
    lab.add(ground);
    double yaw = draw.between(0, 360);
    flat.def.rotation = slope * turn({0, 1, 0}, yaw);
    flat.def.position = rotate(slope, Vec3{0, flat.halfHeight, 0});
    body = lab.add(flat.def);
    start = lab.state(body).centreOfMass;
    down = rotate(slope, Vec3{1, 0, 0});
    text += ", " + flat.name + label(" turned %.0f deg", yaw) + label(", mu %.3f", mu) +
            (tiltGravity ? ", gravity tilted"
             : box       ? ", box tilted"
                         : ", plane tilted");
  }
  double acceleration() const {
    double a = degrees * kPi / 180;
    return kG * (std::sin(a) - friction * std::cos(a));
  }
  Vec3 moved() const { return lab.state(body).centreOfMass - start; }
};

double frictionAngle(double mu) { return std::atan(mu) * 180 / kPi; }

}  // namespace

void sweepSticking(int cases) {
  Sweep creep("any block 0.2 degrees below: creep in 5 s", 0.1, "mm"),
      angle("any block 0.2 degrees above: error of the angle", 0.2, "degrees");
  for (int i = 0; i < cases; i++) {
    Draw draw(i);
    LabSetup setup = draw.setup();
    double mu = draw.between(.1, 1.2);
    Slope below(draw, setup, mu, frictionAngle(mu) - 0.2);
    below.lab.run(1);
    Vec3 settled = below.moved();
    below.lab.run(5);
    creep.add(setup.part(), length(below.moved() - settled) * 1e3, below.text);
    Slope above(draw, setup, mu, frictionAngle(mu) + 0.2);
    above.lab.run(2);
    double a = above.acceleration(), found = dot(above.moved(), above.down) / 2, rad = above.degrees * kPi / 180;
    angle.add(setup.part(), (a - found) / (kG * (std::cos(rad) + mu * std::sin(rad))) * 180 / kPi, above.text);
  }
}

void sweepSliding(int cases) {
  Sweep sweep("any block, 2 to 15 degrees above: acceleration", 1, "%");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 1000);
    LabSetup setup = draw.setup();
    double mu = draw.between(.1, 1.2);
    Slope s(draw, setup, mu, std::min(80.0, frictionAngle(mu) + draw.between(2, 15)));
    s.lab.run(0.5);
    double before = dot(s.lab.state(s.body).linearVelocity, s.down);
    s.lab.run(1);
    double found = dot(s.lab.state(s.body).linearVelocity, s.down) - before;
    sweep.add(setup.part(), (found / s.acceleration() - 1) * 100, s.text);
  }
}

void sweepStopping(int cases) {
  Sweep way("any block: way", 1, "%"), time("any block: time, off by more than one step", 1, "%"),
      turned("any block: turned about the vertical", 0.01, "rad");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 5000);
    LabSetup setup = draw.setup();
    double mu = draw.between(.1, 1.2), speed = draw.between(1, 10), yaw = draw.between(0, 360);
    FlatBody flat = flatBody(draw, draw.scale(.05, 10), mu, .2);
    Lab lab(setup);
    lab.addGround(mu);
    flat.def.position.y = flat.halfHeight;
    flat.def.rotation = turn({0, 1, 0}, yaw);
    flat.def.linearVelocity = {speed, 0, 0};
    BodyId body = lab.add(flat.def);
    double start = lab.state(body).centreOfMass.x, wantTime = speed / (mu * kG), wantWay = speed * wantTime / 2;
    double stopped = -1;
    while (lab.world.time() < wantTime + 1 && lab.step())
      if (stopped < 0 && length(lab.state(body).linearVelocity) < 1e-3 * speed) stopped = lab.world.time();
    std::string which = setup.text() + ", " + flat.name + label(", mu %.3f", mu) + label(", %.2f m/s", speed);
    double steps = wantTime / setup.part();  // a block that stops within few steps stops at the end of one
    way.add(setup.part(), ((lab.state(body).centreOfMass.x - start) / wantWay - 1) * 100, which, 200 / (steps * steps));
    time.add(setup.part(), std::max(0.0, std::fabs(stopped - wantTime) - setup.dt) / wantTime * 100, which);
    turned.add(setup.part(), rotationVector(conjugate(flat.def.rotation) * lab.state(body).rotation).y, which);
  }
}

void sweepRolling(int cases) {
  Sweep speed("any ball or capsule: speed of rolling", 1, "%"),
      time("any ball or capsule: time, off by more than one step", 1, "%");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 9000);
    LabSetup setup = draw.setup();
    double mu = draw.between(.1, 1), r = draw.scale(.01, 3), v = draw.between(.5, 6) * std::sqrt(r / .1);
    double w = draw.oneIn(3) ? draw.between(-1, .8) * v / r : 0, density = draw.scale(100, 8000);
    bool capsule = draw.oneIn(3);
    Lab lab(setup);
    lab.addGround(mu);
    BodyDef d = bodyOf(capsule ? capsuleOf(r, r * draw.between(.5, 3), density) : sphereOf(r, density), {0, r, 0});
    d.shapes[0].material.friction = mu;
    if (capsule) d.rotation = turn({1, 0, 0}, 90);
    d.linearVelocity = {v, 0, 0};
    d.angularVelocity = {0, 0, -w};
    BodyId body = lab.add(d);
    MassProperties mass = *lab.world.massProperties(body);
    double k2 = mass.inertia.row[1].y / (mass.mass * r * r);  // about the axis that it rolls about
    double slip = v - r * w, want = slip / (mu * kG * (1 + 1 / k2)), rolling = v - mu * kG * want, found = -1;
    while (lab.world.time() < want + 1 && lab.step()) {
      BodyState s = lab.state(body);
      if (found < 0 && s.linearVelocity.x + s.angularVelocity.z * r <= 1e-3 * slip) found = lab.world.time();
    }
    std::string which = setup.text() + (capsule ? ", capsule" : ", ball") + label(" of %.3f m", r) +
                        label(", mu %.3f", mu) + label(", %.2f m/s", v) + label(", %.1f rad/s", w);
    speed.add(setup.part(), (lab.state(body).linearVelocity.x / rolling - 1) * 100, which);
    time.add(setup.part(), std::max(0.0, std::fabs(found - want) - setup.dt) / want * 100, which);
  }
}

}  // namespace brickfall::law
