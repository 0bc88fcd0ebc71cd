#include "support/synthetic_take.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>

namespace brickfall::test {
namespace {

constexpr Vec3 kHalf{0.12, 0.0355, 0.0575};  // a standard brick, m
constexpr double kDt = 1.0 / 60;

struct Mover {
  Vec3 position, velocity, spin;
  Quat rotation;
  Vec3 half = kHalf;
  double startTime = 0;  // s; it does not move before
  bool resting = true;
  int bounces = 0;
};

// Random numbers of the same bits everywhere (the standard's distributions are not).
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return low + (high - low) * double(engine_() >> 11) * 0x1p-53; }
  Vec3 cube(double size) {
    double x = in(-size, size), y = in(-size, size), z = in(-size, size);
    return {x, y, z};
  }

 private:
  std::mt19937_64 engine_;
};

double lowest(const Mover& m) {
  Mat3 r = toMatrix(m.rotation);
  return m.position.y - std::fabs(r.row[1].x) * m.half.x - std::fabs(r.row[1].y) * m.half.y -
         std::fabs(r.row[1].z) * m.half.z;
}

// Turns the body flat: its axis that is most upright becomes exactly upright.
void layDown(Mover& m) {
  Mat3 r = toMatrix(m.rotation);
  int axis = 0;
  for (int k = 1; k < 3; k++) axis = std::fabs(r.row[1][k]) > std::fabs(r.row[1][axis]) ? k : axis;
  Vec3 now = r.column(axis) * (r.row[1][axis] < 0 ? -1.0 : 1.0);
  Vec3 turn = cross(now, Vec3{0, 1, 0});
  double sine = length(turn);
  if (sine > 1e-9)
    m.rotation = normalized(quatFromAxisAngle(turn * (1 / sine), std::asin(std::min(1.0, sine))) * m.rotation);
  m.position.y -= lowest(m);
  m.velocity = m.spin = {};
  m.resting = true;
}

// Returns the impulse of a bounce, 0 = none.
double move(Mover& m, bool everResting, Dice& dice) {
  m.velocity += Vec3{0, -9.81, 0} * kDt;
  if (!everResting && dice.in(0, 1) < 0.5) {  // pushed by neighbours all the time
    m.velocity += dice.cube(0.4);
    m.spin += dice.cube(1.5);
  }
  m.position += m.velocity * kDt;
  m.rotation = normalized(quatFromRotationVector(m.spin * kDt) * m.rotation);
  double depth = -lowest(m);
  if (!(depth > 0)) return 0;
  m.position.y += depth;
  if (m.velocity.y >= 0) return 0;
  double impulse = 3.4 * 1.4 * -m.velocity.y;
  m.bounces++;
  double keep = everResting ? 0.35 : 0.8;
  m.velocity = {m.velocity.x * 0.6, -m.velocity.y * keep, m.velocity.z * 0.6};
  m.spin = m.spin * 0.5 + dice.cube(everResting ? 3.0 / m.bounces : 6.0);
  if (!everResting) m.velocity += Vec3{dice.in(-1, 1), dice.in(1, 3), dice.in(-1, 1)};
  if (everResting && (m.bounces > 7 || length(m.velocity) < 0.35)) layDown(m);
  return impulse;
}

TakeBody brickBody(const std::string& name, std::uint32_t colour) {
  TakeBody body;
  body.name = name;
  body.role = BodyRole::brick;
  body.colour = colour;
  body.mass = 3.4;
  body.material = "brick";
  ShapeDef box;
  box.halfExtents = kHalf;
  body.shapes = {box};
  return body;
}

void addOtherShapes(std::vector<TakeBody>& bodies, std::vector<Mover>& movers) {
  TakeBody capsule = brickBody("capsule", 0x4F7F8F), hull = brickBody("hull", 0x8F7F4F),
           pair = brickBody("pair", 0x6F8F4F);
  capsule.role = hull.role = pair.role = BodyRole::body;
  capsule.shapes[0].type = ShapeType::capsule;
  capsule.shapes[0].radius = 0.05;
  capsule.shapes[0].halfHeight = 0.1;
  hull.shapes[0].type = ShapeType::hull;
  hull.shapes[0].vertices = {{-0.1, -0.1, -0.1}, {0.1, -0.1, -0.1}, {0.1, -0.1, 0.1}, {-0.1, -0.1, 0.1}, {0, 0.1, 0}};
  pair.shapes.push_back(pair.shapes[0]);
  pair.shapes[0].local.position = {0, 0, -0.06};
  pair.shapes[1].type = ShapeType::sphere;
  pair.shapes[1].radius = 0.06;
  pair.shapes[1].local.position = {0, 0.02, 0.08};
  pair.shapeMaterials = {"brick", "steel"};
  pair.shapeColours = {0x6F8F4F, 0x222426};
  double x = -0.4;
  for (TakeBody* body : {&capsule, &hull, &pair}) {
    bodies.push_back(*body);
    Mover m;
    m.half = {0.1, body == &capsule ? 0.15 : 0.1, 0.1};
    m.position = {x, m.half.y, 0.6};
    movers.push_back(m);
    x += 0.4;
  }
}

// The first brick goes; three pieces of it come, of which the second goes again.
void breakBrick(SyntheticTake& out, std::vector<Mover>& movers, std::size_t frame, Dice& dice) {
  const Mover whole = movers[2];
  out.lives[2].end = frame;
  for (int piece = 0; piece < 3; piece++) {
    Mover m = whole;
    m.half.x = whole.half.x / 3;
    m.position += rotate(whole.rotation, Vec3{(piece - 1) * 2 * m.half.x, 0, 0});
    m.velocity = dice.cube(1) + Vec3{0, 1.5, 0};
    m.spin = dice.cube(5);
    m.resting = false;
    movers.push_back(m);
    TakeBody body = brickBody("piece " + std::to_string(piece), 0xC5643A);
    body.role = BodyRole::body;
    body.mass /= 3;
    body.shapes[0].halfExtents = m.half;
    out.bodies.push_back(std::move(body));
    out.lives.push_back({frame, piece == 1 ? frame + 70 : SIZE_MAX});
  }
}

void addMortar(SyntheticTake& out, const SyntheticOptions& options) {
  const std::uint32_t bricks = std::uint32_t(options.courses * options.bricksPerCourse);
  for (std::uint32_t k = 0; k + 1 < bricks; k++)
    out.mortar.push_back({k + 2, k + 3, {kHalf.x, 0, 0}, {0, kHalf.y, 0}, {0, 0, kHalf.z}});
  for (std::size_t f = 0; f < out.frames.size(); f++) {
    TakeFrame& frame = out.frames[f];
    const bool broken = int(f) >= options.hitFrame;
    for (std::size_t k = 0; k < out.mortar.size(); k++) {
      if (out.mortarEnd(k) <= f) continue;
      frame.mortar.push_back({0.01f * float((k + f / 16) % 90), float(k % 5) / 10});
      if (k == 2 && broken) frame.mortar.back() = {0, 1};
    }
    if (int(f) != options.hitFrame || out.mortar.size() < 4) continue;
    TakeBreak one{2, frame.time - 0.5, frame.time, MortarMode::shear, 0.25f, 0.75f, {1, 2, -3}, {}};
    one.takers = {{3, 5, 6, 10, 20}, {TakeLoadTaker::kContacts, 4, 0, 0, 7}};
    frame.breaks.push_back(one);
  }
}

}  // namespace

std::size_t SyntheticTake::mortarEnd(std::size_t joint) const {
  return std::min(lives[mortar[joint].bodyA].end, lives[mortar[joint].bodyB].end);
}

TakeChange SyntheticTake::change(std::size_t frame) const {
  TakeChange out;
  for (std::size_t k = 0; k < bodies.size(); k++) {
    const TakeLife life = k < lives.size() ? lives[k] : TakeLife{0, SIZE_MAX};
    if (life.birth == frame) out.births.push_back(bodies[k]);
    if (life.end == frame) out.ends.push_back(std::uint32_t(k));
  }
  if (frame == 0) out.mortar = mortar;
  for (std::size_t k = 0; k < mortar.size(); k++)
    if (mortarEnd(k) == frame) out.mortarEnds.push_back(std::uint32_t(k));
  return out;
}

SyntheticTake makeSyntheticTake(const SyntheticOptions& options) {
  SyntheticTake out;
  Dice dice(options.seed);
  out.header.scene = "synthetic";
  out.header.title = "A wall that only pretends <to fall> & \"lie\"";
  out.header.engineVersion = "test";
  out.header.seed = options.seed;
  TakeBody ground;
  ground.name = "ground";
  ground.role = BodyRole::ground;
  ground.colour = 0x8A8A80;
  ground.shapes.resize(1);
  ground.shapes[0].type = ShapeType::plane;
  TakeBody ball = brickBody("ball", 0x30343A);
  ball.role = BodyRole::ball;
  ball.mass = 16.8;
  ball.shapes[0].type = ShapeType::sphere;
  ball.shapes[0].radius = 0.08;
  out.bodies = {ground, ball};
  double width = options.bricksPerCourse * 2 * kHalf.x, height = options.courses * 2 * kHalf.y;
  double speed = 12, hitTime = options.hitFrame * kDt;
  std::vector<Mover> movers(2);
  movers[1].half = {0.08, 0.08, 0.08};
  movers[1].position = {0, height * 0.5, speed * hitTime + kHalf.z + 0.08};
  movers[1].velocity = {0, 0, -speed};
  movers[1].resting = false;
  for (int row = 0; row < options.courses; row++) {
    for (int k = 0; k < options.bricksPerCourse; k++) {
      Mover m;
      m.position = {(k + (row % 2 ? 0.5 : 0.0)) * 2 * kHalf.x - width / 2, (2 * row + 1) * kHalf.y, 0};
      double far = std::hypot(m.position.x, m.position.y - height / 2);
      m.startTime = hitTime + far * 0.25;
      double push = 6 / (1 + 2 * far);
      m.velocity = Vec3{m.position.x, 0.4, -1.2} * push + dice.cube(push * 0.3);
      m.spin = dice.cube(3 * push);
      movers.push_back(m);
      out.bodies.push_back(brickBody("brick " + std::to_string(movers.size() - 3), 0xB5543A));
    }
  }
  if (options.otherShapes) addOtherShapes(out.bodies, movers);
  out.header.cameras = {{"front", {1.2, height * 0.9 + 0.5, 3.2}, {0, height * 0.4, 0}, 45},
                        {"side", {-3.5, 1.0, 0.8}, {0, height * 0.3, 0}, 40}};
  out.header.cameras[1].path = {{0, {-3.5, 1.0, 0.8}, {0, height * 0.3, 0}, 40}, {2.5, {-2, 1.2, 2}, {0, 0, 0}, 35}};

  out.lives.assign(movers.size(), {0, SIZE_MAX});
  for (int f = 0; f < options.frames; f++) {
    TakeFrame frame;
    frame.time = f * kDt;
    if (options.breaking && f == options.hitFrame) breakBrick(out, movers, std::size_t(f), dice);
    for (std::size_t k = 0; k < movers.size(); k++) {
      if (!out.lives[k].holds(std::size_t(f))) continue;
      Mover& m = movers[k];
      double impulse = 0;
      bool brick = k >= 2 && (out.bodies[k].role == BodyRole::brick || out.lives[k].birth > 0);
      if (k == 1 && f > 0 && f < options.hitFrame) m.position += m.velocity * kDt;  // straight, to meet the wall
      if (k == 1 && f == options.hitFrame) {
        m.velocity = m.velocity * 0.4;
        frame.events.push_back({TakeEventType::hit, 1, 2, m.position, 80});  // of a brick that may break by it
      }
      if (brick && m.resting && m.bounces == 0 && frame.time >= m.startTime) m.resting = false;
      if (!m.resting && f > 0 && (brick || f >= options.hitFrame)) impulse = move(m, options.everResting, dice);
      if (impulse > 2) frame.events.push_back({TakeEventType::hit, std::uint32_t(k), 0, m.position, float(impulse)});
      TakePose pose;
      pose.position = m.position;
      pose.rotation = m.rotation;
      pose.speed = m.resting ? 0.0f : float(length(m.velocity));
      pose.contactForce = m.resting ? (k == 0 ? 0.0f : 33.0f) : float(impulse / kDt);
      frame.poses.push_back(pose);
    }
    out.frames.push_back(std::move(frame));
  }
  if (options.mortared) addMortar(out, options);
  return out;
}

std::string writeTake(const SyntheticTake& take, const std::string& path, const std::string& summary) {
  Result<TakeWriter> writer = TakeWriter::create(path, take.header);
  if (!writer) return writer.error().message;
  for (std::size_t f = 0; f < take.frames.size(); f++) {
    if (Status written = writer->write(take.frames[f], take.change(f)); !written) return written.error().message;
  }
  Status finished = writer->finish(summary);
  return finished ? std::string() : finished.error().message;
}

}  // namespace brickfall::test
