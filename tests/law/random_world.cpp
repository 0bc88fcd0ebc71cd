#include "law/random_world.h"

#include <algorithm>
#include <cmath>

#include "brickfall/geometry/mesh_tree.h"

namespace brickfall::law {

namespace {

constexpr double kThinnest = 2e-4;  // m, half of a plate
constexpr double kStepsBefore = 4;  // bodies are thrown so that they arrive after so many steps at most

// A rod, a drum, a coin or a cone, cut off or not.
BodyDef turnedBody(Draw& draw, double size, const Material& material) {
  const double slim = std::max(kThinnest, size * draw.scale(.1, 1));
  ShapeDef s;
  switch (draw.below(4)) {
    case 0:
      s = cylinderOf(slim, size, material.density);
      break;
    case 1:
      s = cylinderOf(size, std::max(kThinnest, size * draw.scale(.03, .3)), material.density);
      break;
    case 2:
      s = coneOf(slim, 0, size * draw.between(.5, 1), material.density);
      break;
    default:
      s = coneOf(size, slim, size * draw.between(.2, 1), material.density);
  }
  s.material = material;
  return bodyOf(s, {});
}

// A body of any shape, of about `size` m (half its extent).
BodyDef anyBody(Draw& draw, double size, const Material& material) {
  auto shaped = [&](ShapeDef s) {
    s.material = material;
    return s;
  };
  auto box = [&](Vec3 half) {
    return shaped(boxOf({std::max(half.x, kThinnest), std::max(half.y, kThinnest), std::max(half.z, kThinnest)}));
  };
  switch (draw.below(6)) {
    case 0:
      return bodyOf(shaped(sphereOf(size, material.density)), {});
    case 1:
      return bodyOf(box({size, size * draw.scale(.1, 1), size * draw.scale(.3, 1)}), {});
    case 2:
      return bodyOf(shaped(capsuleOf(size / 2, size * draw.between(.2, 1), material.density)), {});
    case 3:
      return bodyOf(shaped(hullOf(size, material.density)), {});
    case 4:  // a thin plate
      return bodyOf(box({size, size * draw.scale(.02, .1), size * draw.between(.5, 1)}), {});
    default:
      BodyDef d = bodyOf(box({size / 2, size * .3, size * .3}), {});
      d.shapes.push_back(draw.oneIn(2) ? shaped(sphereOf(size * .4, material.density))
                                       : box({size * .2, size * .6, size * .2}));
      d.shapes[1].local.position = {size * .6, 0, 0};
      return d;
  }
}

double innerOf(const BodyDef& d) {
  double least = 1e30;
  for (const ShapeDef& s : d.shapes) {
    Aabb box = bounds(s, {});
    Vec3 half = (box.upper - box.lower) * 0.5;
    least = std::min({least, half.x, half.y, half.z});
  }
  return least;
}

std::shared_ptr<const MeshTree> hills(double size) {
  constexpr std::uint32_t kCells = 8;
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t i = 0; i <= kCells; i++)
    for (std::uint32_t k = 0; k <= kCells; k++) {
      const double x = 2.0 * i / kCells - 1, z = 2.0 * k / kCells - 1;
      vertices.push_back(Vec3{x * 40, std::sin(7 * x) * std::sin(5 * z), z * 40} * size);
    }
  auto at = [](std::uint32_t i, std::uint32_t k) { return i * (kCells + 1) + k; };
  for (std::uint32_t i = 0; i < kCells; i++)
    for (std::uint32_t k = 0; k < kCells; k++)
      for (std::uint32_t v : {at(i, k), at(i, k + 1), at(i + 1, k), at(i + 1, k), at(i, k + 1), at(i + 1, k + 1)})
        indices.push_back(v);
  return std::make_shared<const MeshTree>(MeshTree::build(TriangleMesh::create(vertices, indices).value()));
}

// What is thrown at, its upper side at y = 0, and what it says of itself.
BodyDef targetOf(RandomKind kind, Draw& draw, double size, const Material& material, RandomWorld& out) {
  BodyDef d = bodyOf(planeOf(), {}, BodyType::fixed);
  if (kind == RandomKind::terrain) {
    d.shapes[0] = {};
    d.shapes[0].type = ShapeType::mesh;
    d.shapes[0].mesh = hills(size);
    out.halfExtents = Vec3{40, 1, 40} * size;
    out.hilly = true;
  } else if (kind != RandomKind::ground) {
    double thin = kind == RandomKind::wall ? draw.between(1, 3) * size : std::max(1e-3, size * draw.scale(.02, .5));
    out.halfExtents = {size * draw.between(10, 60), thin, size * draw.between(10, 60)};
    d.shapes[0] = boxOf(out.halfExtents);
    d.position.y = -thin;
  }
  if (kind == RandomKind::belt) {
    d.type = BodyType::kinematic;
    out.drive = draw.direction() * draw.scale(.1, 20);
    d.linearVelocity = out.drive;
  }
  d.shapes[0].material = material;
  return d;
}

bool overlaps(const World& world, BodyId body, const std::vector<BodyId>& others) {
  for (BodyId other : others)
    for (ShapeId a : world.shapes(body))
      for (ShapeId b : world.shapes(other))
        if (Result<double> depth = world.penetration(a, b); depth && *depth > 0) return true;
  return false;
}

}  // namespace

const char* nameOf(RandomKind kind) {
  constexpr const char* kNames[kRandomKinds] = {"space", "plate", "wall", "ground", "belt", "terrain"};
  return kNames[int(kind)];
}

RandomWorld drawWorld(RandomKind kind, int seed, bool turned) {
  Draw draw(seed * kRandomKinds + int(kind) + 7000000);
  WorldDef def;
  def.enableSleep = false;
  const bool space = kind == RandomKind::space;
  const double gravity = space || (kind != RandomKind::ground && draw.oneIn(2)) ? 0
                         : draw.oneIn(2)                                        ? kG
                                                                                : draw.scale(.1, 100);
  def.gravity = {0, -gravity, 0};
  RandomWorld out{{makeWorld(def), {}, 1 / draw.scale(20, 2000), 1, 0, {}}, {}, {}, {}, {}, false};
  if (draw.oneIn(3)) out.substeps = 1 + draw.below(8);
  out.steps = int(std::clamp(0.4 / out.dt, 20.0, 120.0));
  Material material;
  material.restitution = draw.oneIn(3) ? 0 : draw.oneIn(4) ? 1 : draw.unit();
  material.friction = draw.oneIn(4) ? 0 : draw.between(0, 2);
  const double largest = draw.scale(1e-3, 30), speed = draw.scale(.1, 1000);
  if (!space) out.target = add(out.world, targetOf(kind, draw, largest, material, out));
  const int count = space ? 2 + draw.below(5) : 1 + draw.below(draw.oneIn(2) ? 1 : 6);
  for (int i = 0; i < count; i++) {
    const double size =
        i == 0 || draw.oneIn(2) ? largest * draw.between(.5, 1) : std::max(1e-3, largest * draw.scale(1e-3, 1));
    material.density = draw.scale(50, 12000);
    BodyDef d = turned && draw.oneIn(2) ? turnedBody(draw, size, material) : anyBody(draw, size, material);
    Vec3 from = draw.direction();
    if (!space) from.y = std::fabs(from.y) + .2, from = normalized(from);
    const double own = speed * draw.between(.5, 1), way = own * out.dt * draw.between(0, kStepsBefore);
    const double spread = space ? 2.2 : 1.2;
    d.position =
        from * (2 * size + way) + draw.direction() * (space ? 0 : largest * 4) + from * (spread * i * largest * 2);
    if (!space) d.position.y = std::max(d.position.y, (kind == RandomKind::terrain ? 3.0 * largest : 0) + 2.1 * size);
    const double degrees = draw.between(0, 180);
    d.rotation = turn(draw.direction(), degrees);
    d.linearVelocity = from * -own + out.drive;
    d.angularVelocity = draw.direction() * (draw.oneIn(3) ? 0 : draw.scale(.1, 400));
    out.sizes.push_back(innerOf(d));
    const BodyId body = add(out.world, d);
    // No two are drawn in each other: it comes from further away.
    for (; overlaps(out.world, body, out.bodies); d.position += from * size)
      EXPECT_TRUE(out.world.setTransform(body, d.position + from * size, d.rotation).ok());
    out.bodies.push_back(body);
  }
  out.text = std::string(turned ? "turned bodies, " : "") + nameOf(kind) + label(" %g", seed) +
             label(": dt 1/%.4g s", 1 / out.dt) + label(" / %g", out.substeps) + label(", %g bodies", count) +
             label(" to %.3g m", largest) + label(", %.3g m/s", speed) + label(", g %.3g", gravity) +
             label(", e %.2f", material.restitution) + label(", mu %.2f", material.friction);
  return out;
}

namespace {

// J: kinetic and potential, in the frame of what is driven.
double energyOf(const RandomWorld& r) {
  double sum = r.world.energy().kinetic + r.world.energy().potential;
  Vec3 p = r.world.linearMomentum();
  double mass = 0;
  for (BodyId body : r.bodies) mass += r.world.state(body)->mass;
  return sum - dot(p, r.drive) +
         mass * (0.5 * lengthSquared(r.drive) + dot(r.world.gravity(), r.drive) * r.world.time());
}

// The centre went from above what is thrown at to below it, through its face: along the chord of the step, and where it
// comes from by its velocity at the end. What a hit throws over the edge goes round it, and so does what comes in under
// the rim of hills.
bool passes(const RandomWorld& r, Vec3 before, Vec3 now, Vec3 velocity, double time) {
  before -= r.drive * (time - r.dt), now -= r.drive * time, velocity -= r.drive;
  const double level = -r.halfExtents.y, crests = r.hilly ? r.halfExtents.y : level;
  if (!(before.y > level && now.y <= level)) return false;
  if (r.halfExtents == Vec3{}) return true;
  auto inside = [&](Vec3 at) { return std::fabs(at.x) < r.halfExtents.x && std::fabs(at.z) < r.halfExtents.z; };
  auto onChord = [&](double y) { return before + (now - before) * ((before.y - y) / (before.y - now.y)); };
  return inside(onChord(level)) && inside(before.y > crests ? onChord(crests) : before) &&
         (!(velocity.y < 0) || inside(now + velocity * ((level - now.y) / velocity.y)));
}

double deepest(const RandomWorld& r) {
  double worst = 0;
  r.world.forEachContact([&](const ContactView& c) {
    Result<double> depth = r.world.penetration(c.shapeA, c.shapeB);
    if (!depth || !(*depth > 0)) return;
    double size = 1e30;
    for (std::size_t i = 0; i < r.bodies.size(); i++)
      if (r.bodies[i] == c.bodyA || r.bodies[i] == c.bodyB) size = std::min(size, 2 * r.sizes[i]);
    worst = std::max(worst, *depth / std::max(5e-3, 0.05 * size));
  });
  return worst;
}

}  // namespace

RandomOutcome runWorld(RandomWorld& r) {
  RandomOutcome out;
  auto masses = [&](auto&& each) {
    for (BodyId body : r.bodies) each(*r.world.state(body));
  };
  double scale = energyOf(r), momentum = 0, angular = 0;
  masses([&](const BodyState& s) {
    scale += s.mass * dot(r.world.gravity(), s.centreOfMass);
    momentum = std::max(momentum, s.mass * length(s.linearVelocity));
    angular = std::max(angular, s.mass * length(s.linearVelocity) * (length(s.position) + 0));
  });
  const double start = energyOf(r);
  double highest = scale;
  const Vec3 p = r.world.linearMomentum(), l = r.world.angularMomentum();
  std::vector<Vec3> before;
  masses([&](const BodyState& s) { before.push_back(s.centreOfMass); });
  std::vector<char> through(r.bodies.size(), 0);
  double deepBefore = 0;
  for (int i = 0; i < r.steps; i++) {
    Result<StepReport> made = r.world.step(r.dt, r.substeps);
    if (!made.ok() || !made->quarantined.empty()) {
      out.finite = false;
      return out;
    }
    double fallen = 0;
    masses([&](const BodyState& s) { fallen += s.mass * dot(r.world.gravity(), s.centreOfMass); });
    const double kinetic = energyOf(r) + fallen;
    highest = std::max(highest, kinetic);
    out.gain = std::max(out.gain, (energyOf(r) - start) / highest);
    out.linear = std::max(out.linear, length(r.world.linearMomentum() - p) / momentum);
    out.angular = std::max(out.angular, length(r.world.angularMomentum() - l) / angular);
    for (std::size_t k = 0; k < r.bodies.size(); k++) {
      const BodyState now = *r.world.state(r.bodies[k]);
      if (r.target && passes(r, before[k], now.centreOfMass, now.linearVelocity, r.world.time())) through[k] = 1;
      before[k] = now.centreOfMass;
    }
    if (i == r.steps / 2) deepBefore = deepest(r);
  }
  out.deep = r.steps * r.dt >= 0.4 ? std::min(deepBefore, deepest(r)) : 0;
  out.through = int(std::count(through.begin(), through.end(), 1));
  return out;
}

void expectNothingFromNothing(RandomKind kind, int seed) {
  RandomWorld random = drawWorld(kind, seed);
  const RandomOutcome found = runWorld(random);
  EXPECT_LE(found.gain, 1e-3) << random.text;
  EXPECT_TRUE(found.finite) << random.text;
  EXPECT_EQ(found.through, 0) << random.text;
  EXPECT_LE(found.deep, 0.5) << random.text;
  if (kind != RandomKind::space) return;
  EXPECT_LE(found.linear, 1e-9) << random.text;
  EXPECT_LE(found.angular, 1e-9) << random.text;
}

}  // namespace brickfall::law
