// Rows 9, 10, 13, 15, 15a, 15b: overhangs, columns, walls.
#include "law/draw.h"
#include "law/law.h"
#include "law/sweeps.h"

namespace brickfall::law {

namespace {

struct Stack {
  Lab lab;
  std::vector<BodyId> bodies;
  std::vector<Vec3> start;
  explicit Stack(const LabSetup& setup, double gravity = kG) : lab(setup, 0, gravity) {}
  void add(const BodyDef& d) {
    bodies.push_back(lab.add(d));
    start.push_back(lab.state(bodies.back()).position);
  }
  double moved() const {
    double most = 0;
    for (std::size_t i = 0; i < bodies.size(); i++)
      most = std::max(most, length(lab.state(bodies[i]).position - start[i]));
    return most;
  }
  std::vector<Vec3> places() const {
    std::vector<Vec3> out;
    for (BodyId b : bodies) out.push_back(lab.state(b).position);
    return out;
  }
};

// A wall of any bond and any size of brick.
struct AnyWall : Stack {
  int courses, bricks;
  double scale;
  std::string text;
  AnyWall(Draw& draw, const LabSetup& setup, double bottom)
      : Stack(setup), courses(4 + draw.below(8)), bricks(3 + draw.below(6)), scale(draw.scale(.05, 40)) {
    lab::Options o;
    o.bondShift = draw.oneIn(2) ? 1.0 / 3 : 0.5;
    o.headers = draw.oneIn(4);
    // In half bond a toothed end would leave the last brick of the top course exactly at its balance.
    o.wholeBricks = draw.oneIn(3) && o.bondShift < 0.5;
    lab.addGround(.6);
    for (const lab::Brick& b : lab::wall(courses, bricks, 0, o))
      add(bodyOf(boxOf(b.half * scale, 1900), b.centre * scale + Vec3{0, bottom, 0}));
    text = setup.text() + label(", bricks of %.3f m", lab::kBrickLength * scale) + label(", %g courses", courses) +
           label(", bond %.2f", o.bondShift) + (o.headers ? ", headers" : "") + (o.wholeBricks ? ", toothed" : "");
  }
  double elasticSag() const {  // docs/step.md: g h^2 / (4 stiffness) summed over the courses
    double h = lab.setup().part();
    return kG * h * h / 4000 * courses * (courses + 1) / 2;
  }
};

}  // namespace

void sweepOverhangs(int cases) {
  Sweep stands("99 % of it stands 10 s: moved / L", 0.02, ""), falls("101 % of it falls: share that did not", 0, "");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 60000);
    LabSetup setup = draw.setup();
    int n = 2 + draw.below(19);
    bool harmonic = draw.oneIn(2), below = draw.oneIn(2), hull = draw.oneIn(4);
    double length = draw.scale(.05, 5), height = length * draw.between(.15, .4), share = below ? .99 : 1.01;
    Stack s(setup);
    // A corbel on the ground would touch it when it tips: both stand on a table.
    s.lab.add(bodyOf(boxOf({5 * length, length, 5 * length}, 1000, 1), {-5 * length, -length, 0}, BodyType::fixed));
    double right = harmonic ? 0 : -length / 4, density = draw.scale(100, 8000);
    Vec3 half{length / 2, height / 2, length * draw.between(.1, .35)};
    for (int k = 0; k < n; k++) {
      if (harmonic || k > 0) right += share * length / (harmonic ? 2 * (n - k) : n);
      ShapeDef shape = boxOf(half, density, 1);
      if (hull) shape.type = ShapeType::hull;
      for (int c = 0; hull && c < 8; c++)
        shape.vertices.push_back({c & 1 ? half.x : -half.x, c & 2 ? half.y : -half.y, c & 4 ? half.z : -half.z});
      s.add(bodyOf(shape, {right - length / 2, height * (k + .5), 0}));
    }
    double moved = 0;
    while (s.lab.world.time() < 10 && moved < .02 * length && s.lab.step()) moved = s.moved();
    std::string which = setup.text() + (harmonic ? ", harmonic" : ", corbel") + label(" of %g", n) +
                        label(", L %.3f m", length) + label(", height %.2f L", height / length) +
                        (hull ? ", hulls" : "");
    // Joints are elastic: where their sag, carried up the tower, is more than the margin of 1 %, it may fall.
    double h = setup.part(), lean = kG * h * h * n / 1000 / length * n * height, margin = 0.01 * length / (2 * n);
    if (below)
      stands.add(h, moved / length, which, lean > margin / 4 ? 1 : 0);
    else
      falls.add(h, moved < .02 * length, which);
  }
}

void sweepColumns(int cases) {
  Sweep bottom("any column: force on the ground", 1, "%"), joints("any column: force in any joint", 1, "%");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 70000);
    LabSetup setup = draw.setup();
    bool mixed = draw.oneIn(3);
    int n = 1 + draw.below(mixed ? 12 : 40);
    double size = draw.scale(mixed ? .05 : .01, 10), top = 0;
    Stack s(setup);
    BodyId ground = s.lab.addGround(.6);
    std::vector<double> weight, force(std::size_t(n), 0);
    for (int k = 0; k < n; k++) {
      double wide = size * (mixed ? draw.between(.8, 1.2) : 1), hy = size / 4 * (mixed ? draw.between(.5, 1.5) : 1);
      double density = mixed ? draw.scale(500, 4000) : 1900;
      BodyDef d =
          bodyOf(draw.oneIn(3) ? drumOf(wide * .45, hy, density, .6) : boxOf({wide / 2, hy, wide * .4}, density), {});
      d.position.y = top + hy;
      if (mixed) d.rotation = turn({0, 1, 0}, draw.between(0, 360));
      s.add(d);
      top += 2 * hy;
      weight.push_back(s.lab.state(s.bodies.back()).mass * kG);
    }
    s.lab.run(2);
    Vec3 up = s.lab.direction({0, 1, 0});
    s.lab.world.forEachContact([&](const ContactView& c) {
      Vec3 sum;
      for (int k = 0; k < c.pointCount; k++) sum += c.normalWorld * c.points[k].normalForce + c.points[k].frictionForce;
      std::size_t upper = 0;  // the joint is named after the body on it
      for (std::size_t b = 0; b < s.bodies.size(); b++)
        if (s.bodies[b] == c.bodyA || s.bodies[b] == c.bodyB) upper = b;
      force[upper] += std::fabs(dot(sum, up));
    });
    EXPECT_TRUE(s.lab.world.isValid(ground));
    double carried = 0, worst = 0, last = 0;
    for (int k = n - 1; k >= 0; k--) {
      carried += weight[std::size_t(k)];
      last = (force[std::size_t(k)] / carried - 1) * 100;
      if (std::fabs(last) > std::fabs(worst)) worst = last;
    }
    std::string which =
        setup.text() + label(", %g bricks", n) + label(" of %.3f m", size) + (mixed ? ", all different" : "");
    bottom.add(setup.part(), last, which);
    joints.add(setup.part(), worst, which);
  }
}

void sweepHeavyTops(int cases) {
  Sweep sweep("any column under 10 to 1000 times its density: overlap", 5, "mm");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 80000);
    LabSetup setup = draw.setup();
    int n = 1 + draw.below(12);
    double size = draw.scale(.05, 5), ratio = draw.scale(10, 1000);
    Stack s(setup);
    s.lab.addGround(.6);
    for (int k = 0; k <= n; k++)
      s.add(bodyOf(boxOf({size / 2, size / 2, size / 2}, k < n ? 1000 : 1000 * ratio), {0, size * (k + .5), 0}));
    s.lab.run(6);
    double worst = 0;
    World& w = s.lab.world;
    for (std::size_t k = 0; k + 1 < s.bodies.size(); k++)
      worst = std::max(worst, *w.penetration(w.shapes(s.bodies[k])[0], w.shapes(s.bodies[k + 1])[0]));
    sweep.add(setup.part(), worst * 1e3,
              setup.text() + label(", %g cubes", n) + label(" of %.3f m", size) + label(", %.0f-fold on top", ratio));
  }
}

void sweepWalls(int cases) {
  Sweep moved("any wall: moved in 6 s, beyond the elastic sag", 0.5, "mm"), creep("any wall: creep in 3 s", 0.01, "mm");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 110000);
    LabSetup setup = draw.setup();
    AnyWall wall(draw, setup, 0);
    wall.lab.run(3);
    std::vector<Vec3> before = wall.places();
    wall.lab.run(3);
    std::vector<Vec3> after = wall.places();
    double crept = 0;
    for (std::size_t k = 0; k < before.size(); k++) crept = std::max(crept, length(after[k] - before[k]));
    moved.add(setup.part(), (wall.moved() - wall.elasticSag()) * 1e3, wall.text);
    creep.add(setup.part(), crept * 1e3, wall.text);
  }
}

void sweepFalls(int cases) {
  Sweep fall("any wall in free fall for 0.5 s: way", 0.1, "%"), spread("any wall in free fall: spread", 0.1, "mm");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 120000);
    LabSetup setup = draw.setup();
    AnyWall wall(draw, setup, 5);
    wall.lab.run(0.5);
    double t = wall.lab.world.time(), low = 1e9, high = 0;
    for (std::size_t k = 0; k < wall.bodies.size(); k++) {
      double fell = wall.start[k].y - wall.lab.state(wall.bodies[k]).position.y;
      low = std::min(low, fell);
      high = std::max(high, fell);
    }
    fall.add(setup.part(), (low / (kG * t * t / 2) - 1) * 100, wall.text);
    spread.add(setup.part(), (high - low) * 1e3, wall.text);
  }
}

void sweepLandings(int cases) {
  Sweep rise("any wall dropped flat: rise of energy / energy of the fall", 1e-6, ""),
      parted("any wall dropped flat: parted by, after 4 s", 5, "mm");
  for (int i = 0; i < cases; i++) {
    Draw draw(i + 130000);
    LabSetup setup = draw.setup();
    double height = draw.scale(.05, .5);
    AnyWall wall(draw, setup, height);
    auto energy = [&] {
      Energy e = wall.lab.world.energy();
      return e.kinetic + e.potential;
    };
    double start = energy(), fall = 0, most = start, low = 1e9, high = -1e9;
    for (BodyId b : wall.bodies) fall += wall.lab.state(b).mass * kG * height;
    while (wall.lab.world.time() < 4 && wall.lab.step()) most = std::max(most, energy());
    for (std::size_t k = 0; k < wall.bodies.size(); k++) {
      Vec3 d = wall.lab.state(wall.bodies[k]).position - wall.start[k];
      low = std::min(low, d.y);
      high = std::max({high, d.y, std::hypot(d.x, d.z) - height});
    }
    std::string which = wall.text + label(", from %.2f m", height);
    rise.add(setup.part(), std::max(0.0, most - start) / fall, which);
    parted.add(setup.part(), (high - low) * 1e3, which, 1e9);
  }
}

}  // namespace brickfall::law
