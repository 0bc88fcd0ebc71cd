#include "shot.h"

#include <algorithm>
#include <cmath>

#include "support/random_geometry.h"
#include "support/world_helpers.h"

namespace brickfall::oracle {

using namespace test;

namespace {

const Vec3 kBrick{0.1075, 0.0325, 0.05125};

// A box that the missile must not pass, and where the missile's centre was outside of it last, in its frame.
struct Obstacle {
  BodyId body;
  Transform local;
  Vec3 half;
  ShapeId shape;
  Vec3 lastOutside;
  Transform before;  // where its body was a step ago
  bool inside = false;
};

struct Scene {
  World world;
  std::vector<Obstacle> obstacles;
  BodyId missile;
  ShapeId missileShape;
  double flight = 0;  // m to the target
};

Transform poseOf(const World& world, BodyId body) {
  BodyState s = *world.state(body);
  return {s.position, s.rotation};
}

Vec3 inFrame(const Obstacle& o, const Transform& pose, Vec3 point) {
  return transformPoint(inverse(pose * o.local), point);
}

bool isInside(Vec3 p, Vec3 half) {
  return std::fabs(p.x) < half.x && std::fabs(p.y) < half.y && std::fabs(p.z) < half.z;
}

// The way from one outside place to another leads from face to opposite face, through the middle.
bool passes(Vec3 from, Vec3 to, Vec3 half) {
  for (int k = 0; k < 3; k++) {
    bool opposite = from[k] * to[k] < 0 && std::fabs(from[k]) >= half[k] && std::fabs(to[k]) >= half[k];
    if (!opposite) continue;
    Vec3 middle = from + (to - from) * (from[k] / (from[k] - to[k]));
    middle[k] = 0;
    if (isInside(middle, half)) return true;
  }
  return false;
}

// One step: from place to place, straight in the world. In the frame of an obstacle that turns, the missile's way is an
// arc (a brick hit at its corner makes half a turn in a step: what is still in front of it is then on the other side of
// its frame, and went round it, not through), so it is followed in parts of 0.05 rad. True if it leads through.
bool follow(Obstacle& o, const Transform& after, Vec3 axis, double angle, Vec3 from, Vec3 to) {
  int parts = 1 + int(angle / 0.05);
  bool through = false;
  for (int part = 1; part <= parts; part++) {
    double share = double(part) / parts;
    Transform pose{o.before.position + (after.position - o.before.position) * share,
                   normalized(quatFromRotationVector(axis * (angle * share)) * o.before.rotation)};
    if (part == parts) pose = after;
    Vec3 now = inFrame(o, pose, from + (to - from) * share);
    o.inside = isInside(now, o.half);
    if (o.inside) continue;
    through = through || passes(o.lastOutside, now, o.half);
    o.lastOutside = now;
  }
  o.before = after;
  return through;
}

// Its turn is told from the shorter one the other way by `spin` (rad in the step), but not from one with a whole turn more: what
// leads through by one of them and past by the other has not gone through.
bool follow(Obstacle& o, const Transform& after, Vec3 spin, Vec3 from, Vec3 to) {
  Quat turn = after.rotation * conjugate(o.before.rotation);
  double sine = length(Vec3{turn.x, turn.y, turn.z}), angle = 2 * std::atan2(sine, std::fabs(turn.w));
  Vec3 axis = sine > 0 ? Vec3{turn.x, turn.y, turn.z} * ((turn.w < 0 ? -1 : 1) / sine) : Vec3{};
  if (angle > 1 && dot(axis, spin) < 0) axis = -axis, angle = 2 * kPi - angle;
  Obstacle start = o;
  bool through = follow(o, after, axis, angle, from, to);
  for (double more = angle + 2 * kPi; through && more < length(spin) + kPi; more += 2 * kPi) {
    Obstacle again = start;
    through = follow(again, after, axis, more, from, to);
  }
  return through;
}

void addObstacle(Scene& scene, BodyId body, Vec3 half, const Transform& local, std::size_t index) {
  scene.obstacles.push_back({body, local, half, scene.world.shapes(body)[index], {}, {}});
}

BodyDef plateDef(Vec3 half, const Transform& pose, BodyType type, double density) {
  BodyDef def = bodyOf(boxOf(half, density), pose.position, type);
  def.rotation = pose.rotation;
  return def;
}

// The target's middle plane is that of the pose's x and y; z is the way through.
void build(Scene& scene, const Shot& shot, const Transform& pose, Random& random) {
  Vec3 half{random.between(0.3, 1), random.between(0.3, 1), shot.thickness / 2};
  double density = random.between(500, 3000);
  switch (shot.target) {
    case Target::plate:
    case Target::loosePlate: {
      BodyType type = shot.target == Target::plate ? BodyType::fixed : BodyType::dynamic;
      addObstacle(scene, add(scene.world, plateDef(half, pose, type, density)), half, {}, 0);
      break;
    }
    case Target::thrownPlate:  // at the missile
    case Target::movingPlate: {
      BodyType type = shot.target == Target::thrownPlate ? BodyType::dynamic : BodyType::kinematic;
      BodyDef def = plateDef(half, pose, type, density);
      def.linearVelocity = rotate(pose.rotation, Vec3{0, 0, random.between(-5, 20)});
      addObstacle(scene, add(scene.world, def), half, {}, 0);
      break;
    }
    case Target::twoPlates: {  // at right angles, meeting along an edge
      addObstacle(scene, add(scene.world, plateDef(half, pose, BodyType::fixed, density)), half, {}, 0);
      Vec3 other{half.z, half.y, half.x};
      Transform side{{half.x - half.z, 0, half.z + half.x}, {}};
      addObstacle(scene, add(scene.world, plateDef(other, pose * side, BodyType::fixed, density)), other, {}, 0);
      break;
    }
    case Target::fixedWall: {
      BodyDef def;
      def.type = BodyType::fixed;
      def.position = pose.position, def.rotation = pose.rotation;
      for (int course = 0; course < 6; course++)
        for (int i = 0; i < 4; i++) {
          ShapeDef brick = boxOf(kBrick);
          brick.local.position = {2 * kBrick.x * (i - 1.75 + 0.5 * (course % 2)), 2 * kBrick.y * (course - 2.5), 0};
          def.shapes.push_back(brick);
        }
      BodyId wall = add(scene.world, def);
      for (std::size_t k = 0; k < def.shapes.size(); k++) addObstacle(scene, wall, kBrick, def.shapes[k].local, k);
      break;
    }
    case Target::brickWall:
      add(scene.world, bodyOf(planeOf(), {0, -6 * kBrick.y, 0}, BodyType::fixed));
      for (int course = 0; course < 6; course++)
        for (int i = 0; i < 4; i++) {
          Vec3 place{2 * kBrick.x * (i - 1.75 + 0.5 * (course % 2)), 2 * kBrick.y * (course - 2.5), 0};
          addObstacle(scene, add(scene.world, bodyOf(boxOf(kBrick, 1900), place)), kBrick, {}, 0);
        }
      break;
  }
}

ShapeDef missileShape(const Shot& shot, Random& random) {
  double density = std::pow(10.0, random.between(2.5, 3.9));
  double size = std::pow(10.0, random.between(-2.3, -1));  // 5 .. 100 mm
  auto any = [&] { return size * random.between(0.3, 1); };
  ShapeDef out = sphereOf(size, density);
  if (shot.missile == Missile::brick) out = boxOf({size, any(), any()}, density);
  if (shot.missile == Missile::capsule) out = capsuleOf(0.5 * any(), size, density);
  if (shot.missile == Missile::hull) {
    out = hullOf(size, density);
    Vec3 axes{size, any(), any()};
    out.vertices = randomPoints(random, 12, axes, true);
  }
  if (random.below(3) == 0) out.material.restitution = random.between(0.1, 1);
  return out;
}

double reachOf(const ShapeDef& s) {
  if (s.type == ShapeType::box) return length(s.halfExtents);
  if (s.type == ShapeType::hull) return 0.1;
  return s.type == ShapeType::capsule ? s.radius + s.halfHeight : s.radius;
}
double innerOf(const ShapeDef& s) {
  if (s.type == ShapeType::box) return std::min({s.halfExtents.x, s.halfExtents.y, s.halfExtents.z});
  if (s.type == ShapeType::hull) return 0.2 * length(s.vertices[0]);
  return s.radius;
}

// Where on the target, and from which side, in the frame of its middle plane.
void aimAt(const Shot& shot, Vec3 half, Random& random, Vec3& place, Vec3& direction) {
  double around = random.between(0, 2 * kPi), slope = 0;
  place = {random.between(-0.9, 0.9) * half.x, random.between(-0.9, 0.9) * half.y, half.z};
  if (shot.aim == Aim::oblique) slope = random.between(0.2, 1.2);
  if (shot.aim == Aim::grazing) slope = random.between(1.3, 1.56);
  direction = {std::sin(slope) * std::cos(around), std::sin(slope) * std::sin(around), -std::cos(slope)};
  if (shot.aim == Aim::edgeOn) {  // along the plate, at its rim
    direction = normalized(Vec3{-1, random.between(-0.5, 0.5), random.between(-0.1, 0.1)});
    place = {half.x, place.y, random.between(-1, 1) * half.z};
  }
  if (shot.aim == Aim::corner) {
    place = {half.x * random.between(0.97, 1), half.y * random.between(0.97, 1), half.z};
    direction = normalized(Vec3{random.between(-1, 0.3), random.between(-1, 0.3), -1});
  }
}

Scene makeScene(const Shot& shot, Flight& flight) {
  Random random(shot.seed * 2654435761u + 17);
  WorldDef def;
  def.solver.maxHitParts = 1;  // fly() makes parts of its own
  if (shot.target != Target::brickWall) def.gravity = {0, random.below(2) ? -9.81 : 0.0, 0};
  Scene scene{makeWorld(def), {}, {}, {}};
  bool level = shot.target == Target::brickWall;
  Transform pose = level ? Transform{} : randomPose(random, random.below(8) ? 1 : 10000);
  build(scene, shot, pose, random);
  bool wall = shot.target == Target::fixedWall || shot.target == Target::brickWall;
  Vec3 half = wall ? Vec3{3 * kBrick.x, 5 * kBrick.y, kBrick.z} : scene.obstacles[0].half;

  ShapeDef shape = missileShape(shot, random);
  Vec3 place, direction;
  aimAt(shot, half, random, place, direction);
  if (level && direction.y > 0.2) direction.y = -direction.y;
  scene.flight = reachOf(shape) * 1.5 + random.between(0.05, 1.5);
  BodyDef missile = bodyOf(shape, transformPoint(pose, place - direction * scene.flight));
  if (level && missile.position.y < -5 * kBrick.y) missile.position.y = 0;
  missile.rotation = randomRotation(random);
  missile.linearVelocity = rotate(pose.rotation, direction) * shot.speed;
  missile.angularVelocity = randomDirection(random) * shot.spin;
  scene.missile = add(scene.world, missile);
  scene.missileShape = scene.world.shapes(scene.missile)[0];
  flight.missileSize = innerOf(shape);
  flight.obstacleSize = std::min({scene.obstacles[0].half.x, scene.obstacles[0].half.y, scene.obstacles[0].half.z});
  return scene;
}

// Of the coming step, with as many as a world takes by itself; this one is left as it is.
int partsOf(const World& world, double dt) {
  World copy = std::move(World::create({})).value();
  if (!copy.restore(world.snapshot()).ok()) return 1;
  WorldDef def = copy.definition();
  def.solver.maxHitParts = SolverSettings{}.maxHitParts;
  if (!copy.setDefinition(def).ok()) return 1;
  Result<StepReport> report = copy.step(dt);
  return report.ok() ? report->parts : 1;
}

}  // namespace

const char* nameOf(Target target) {
  constexpr const char* kNames[kTargets] = {"fixed plate", "two plates",   "fixed wall",    "moving plate",
                                            "loose plate", "thrown plate", "wall of bricks"};
  return kNames[int(target)];
}
const char* nameOf(Missile missile) {
  constexpr const char* kNames[kMissiles] = {"ball", "brick", "capsule", "hull"};
  return kNames[int(missile)];
}
const char* nameOf(Aim aim) {
  constexpr const char* kNames[kAims] = {"straight", "oblique", "grazing", "edge-on", "corner"};
  return kNames[int(aim)];
}

Shot randomShot(std::uint64_t seed) {
  Random random(seed * 7919 + 3);
  Shot shot;
  shot.target = Target(random.below(kTargets));
  shot.missile = Missile(random.below(kMissiles));
  shot.aim = Aim(random.below(kAims));
  shot.thickness = std::pow(10.0, random.between(std::log10(0.005), -1));
  shot.speed = std::pow(10.0, random.between(0, std::log10(200)));
  if (random.below(3)) shot.spin = std::pow(10.0, random.between(0, 3));
  shot.dt = 1.0 / (30 << random.below(4));
  shot.seed = seed;
  return shot;
}

std::string describe(const Shot& s) {
  char out[200];
  std::snprintf(out, sizeof out, "shot %llu: %s at %s, %s, %.3g m/s, spin %.3g, %.3g mm, dt 1/%.0f",
                static_cast<unsigned long long>(s.seed), nameOf(s.missile), nameOf(s.target), nameOf(s.aim), s.speed,
                s.spin, s.thickness * 1e3, 1 / s.dt);
  return out;
}

Flight fly(const Shot& shot) {
  Flight out;
  Scene scene = makeScene(shot, out);
  World& world = scene.world;
  auto centre = [&] { return world.state(scene.missile)->centreOfMass; };
  for (Obstacle& o : scene.obstacles) {
    o.before = poseOf(world, o.body);
    o.lastOutside = inFrame(o, o.before, centre());
    if (world.penetration(scene.missileShape, o.shape).value() > 0) return out;
  }
  out.fired = true;
  int steps = int(1.3 * scene.flight / shot.speed / shot.dt) + 15;
  auto move = [&](double dt) {
    Vec3 centreBefore = centre();
    if (!world.step(dt).ok()) return;
    for (const ContactEvent& touch : world.events().begin)
      out.hit = out.hit || touch.bodyA == scene.missile || touch.bodyB == scene.missile;
    for (Obstacle& o : scene.obstacles)
      if (follow(o, poseOf(world, o.body), world.state(o.body)->angularVelocity * dt, centreBefore, centre()))
        out.through = true;
  };
  // Ways are straight in a part of a step only: what would be made in several is done one by one.
  auto step = [&] {
    out.steps++;
    const int parts = partsOf(world, shot.dt);
    for (int part = 0; part < parts; part++) move(shot.dt / parts);
  };
  auto inside = [&] {
    return std::any_of(scene.obstacles.begin(), scene.obstacles.end(), [](const Obstacle& o) { return o.inside; });
  };
  for (int n = 0; n < steps; n++) step();
  out.wedged = inside();
  for (int n = 0; n < int(0.5 / shot.dt) && inside(); n++) step();
  out.within = inside();
  out.wedged = out.wedged && !out.within;
  for (const Obstacle& o : scene.obstacles) {
    Result<double> depth = world.penetration(scene.missileShape, o.shape);
    if (depth.ok()) out.overlap = std::max(out.overlap, *depth);
  }
  return out;
}

}  // namespace brickfall::oracle
