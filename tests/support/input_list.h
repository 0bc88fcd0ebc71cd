// A list of calls to a world, as a recorded game or a network peer has it: the same list played into a fresh world must
// give the same bits in every step. Bodies are named by the order in which the list makes them.
#pragma once
#include <cstdint>
#include <vector>

#include "brickfall/world.h"
#include "support/lab_scenes.h"

namespace brickfall::test {

enum class InputKind : std::uint8_t {
  create,
  destroy,
  force,
  forceAtPoint,
  torque,
  impulse,
  impulseAtPoint,
  angularImpulse,
  transform,
  linearVelocity,
  angularVelocity,
  type,
  gravityScale,
  damping,
  gravity,
  wake,
  step,
  count
};

struct Input {
  InputKind kind = InputKind::step;
  int body = -1;        // in order of creation, from 0
  BodyDef def;          // create
  Vec3 first, second;   // force and point; position; velocity
  Quat rotation;        // transform
  double a = 0, b = 0;  // dt; scale; damping
  int number = 1;       // substeps; type
};

class InputList {
 public:
  int create(const BodyDef& def);  // gives the body's number in the list
  void call(InputKind kind, int body, Vec3 first = {}, Vec3 second = {});
  void transform(int body, Vec3 position, Quat rotation);
  void set(InputKind kind, int body, double a, double b = 0);
  void type(int body, BodyType type);
  void step(double dt, int substeps = 1);

  const std::vector<Input>& inputs() const { return inputs_; }
  int created() const { return created_; }

 private:
  std::vector<Input> inputs_;
  int created_ = 0;
};

struct Played {
  std::vector<std::uint64_t> hashes;  // after each step
  std::vector<BodyId> bodies;         // by number
  int refused = 0;                    // calls that answered with an error
};
Played play(const InputList& list, World& world);

// A ground, heaps of all kinds of bodies, and some hundred calls of every kind between the steps, from a seed.
InputList randomInputs(int seed, int steps);

inline int InputList::create(const BodyDef& def) {
  Input input;
  input.kind = InputKind::create;
  input.def = def;
  inputs_.push_back(input);
  return created_++;
}

inline void InputList::call(InputKind kind, int body, Vec3 first, Vec3 second) {
  Input input;
  input.kind = kind;
  input.body = body;
  input.first = first;
  input.second = second;
  inputs_.push_back(input);
}

inline void InputList::transform(int body, Vec3 position, Quat rotation) {
  call(InputKind::transform, body, position);
  inputs_.back().rotation = rotation;
}

inline void InputList::set(InputKind kind, int body, double a, double b) {
  call(kind, body);
  inputs_.back().a = a;
  inputs_.back().b = b;
}

inline void InputList::type(int body, BodyType type) {
  call(InputKind::type, body);
  inputs_.back().number = int(type);
}

inline void InputList::step(double dt, int substeps) {
  set(InputKind::step, -1, dt);
  inputs_.back().number = substeps;
}

namespace detail {

inline Status give(const Input& in, World& world, Played& played) {
  BodyId body = in.body >= 0 ? played.bodies[std::size_t(in.body)] : BodyId{};
  switch (in.kind) {
    case InputKind::create: {
      Result<BodyId> made = world.createBody(in.def);
      played.bodies.push_back(made ? *made : BodyId{});
      return made ? Status() : Status(made.error());
    }
    case InputKind::destroy:
      return world.destroyBody(body);
    case InputKind::force:
      return world.applyForce(body, in.first);
    case InputKind::forceAtPoint:
      return world.applyForceAtPoint(body, in.first, in.second);
    case InputKind::torque:
      return world.applyTorque(body, in.first);
    case InputKind::impulse:
      return world.applyImpulse(body, in.first);
    case InputKind::impulseAtPoint:
      return world.applyImpulseAtPoint(body, in.first, in.second);
    case InputKind::angularImpulse:
      return world.applyAngularImpulse(body, in.first);
    case InputKind::transform:
      return world.setTransform(body, in.first, in.rotation);
    case InputKind::linearVelocity:
      return world.setLinearVelocity(body, in.first);
    case InputKind::angularVelocity:
      return world.setAngularVelocity(body, in.first);
    case InputKind::type:
      return world.setType(body, BodyType(in.number));
    case InputKind::gravityScale:
      return world.setGravityScale(body, in.a);
    case InputKind::damping:
      return world.setDamping(body, in.a, in.b);
    case InputKind::gravity:
      return world.setGravity(in.first);
    case InputKind::wake:
      return world.wake(body);
    case InputKind::step: {
      Result<StepReport> report = world.step(in.a, in.number);
      played.hashes.push_back(world.stateHash());
      return report ? Status() : Status(report.error());
    }
    case InputKind::count:
      break;
  }
  return Error{ErrorCode::invalidArgument, "no such call"};
}

inline BodyDef randomBody(lab::LabRandom& random, int number) {
  BodyDef d;
  d.shapes.resize(1);
  ShapeDef& s = d.shapes[0];
  s.type = ShapeType(number % 4);
  s.halfExtents = {0.1, 0.1 + 0.05 * random.unit(), 0.15};
  s.radius = 0.1;
  s.halfHeight = 0.12;
  s.vertices = {{.15, 0, 0}, {-.15, 0, 0}, {0, .15, 0}, {0, -.15, 0}, {0, 0, .15}, {0, 0, -.15}};
  s.material.restitution = number % 3 == 0 ? 0.4 : 0;
  d.position = {1.2 * random.unit(), 0.2 + 2 * random.unit(), 1.2 * random.unit()};
  d.rotation = {random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5, 1};
  d.linearVelocity = {random.unit() - 0.5, 0, random.unit() - 0.5};
  d.dragArea = number % 5 == 0 ? 0.01 : 0;
  return d;
}

inline void randomCall(InputList& list, lab::LabRandom& random) {
  auto some = [&](double size) {
    return Vec3{random.unit() - 0.5, random.unit() - 0.5, random.unit() - 0.5} * (2 * size);
  };
  auto kind = InputKind(int(random.unit() * double(InputKind::step)));
  int body = 1 + int(random.unit() * (list.created() - 1));  // not the ground
  Vec3 point{1.2 * random.unit(), random.unit(), 1.2 * random.unit()};
  switch (kind) {
    case InputKind::create:
      list.create(randomBody(random, list.created()));
      break;
    case InputKind::force:
    case InputKind::forceAtPoint:
      list.call(kind, body, some(200), point);
      break;
    case InputKind::impulse:
    case InputKind::impulseAtPoint:
      list.call(kind, body, some(10), point);
      break;
    case InputKind::transform:
      list.transform(body, point + Vec3{0, 0.5, 0}, {random.unit(), random.unit(), random.unit(), 1});
      break;
    case InputKind::type:
      list.type(body, BodyType(int(random.unit() * 3)));
      break;
    case InputKind::gravityScale:
      list.set(kind, body, 0.5 + random.unit());
      break;
    case InputKind::damping: {
      const double linear = random.unit(), angular = random.unit();  // arguments have no order of their own
      list.set(kind, body, linear, angular);
      break;
    }
    case InputKind::gravity:
      list.call(kind, -1, {random.unit() - 0.5, -9.81, 0});
      break;
    default:
      list.call(kind, body, some(2));
  }
}

}  // namespace detail

inline Played play(const InputList& list, World& world) {
  Played played;
  for (const Input& input : list.inputs())
    if (!detail::give(input, world, played)) played.refused++;
  return played;
}

inline InputList randomInputs(int seed, int steps) {
  InputList list;
  lab::LabRandom random(seed);
  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shapes.resize(1);
  ground.shapes[0].type = ShapeType::plane;
  list.create(ground);
  for (int i = 0; i < 20; i++) list.create(detail::randomBody(random, i));
  for (int i = 0; i < steps; i++) {
    for (int n = int(4 * random.unit()); n > 0; n--) detail::randomCall(list, random);
    list.step(i % 10 == 7 ? 1.0 / 90 : 1.0 / 60, i % 4 == 0 ? 2 : 1);
  }
  return list;
}

}  // namespace brickfall::test
