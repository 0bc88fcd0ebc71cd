// A list of calls to a world, as a recorded game or a network peer has it: the same list played into a fresh world must
// give the same bits in every step. Bodies are named by the order in which the list makes them.
#pragma once
#include <cstdint>
#include <vector>

#include "brickfall/world.h"

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

}  // namespace brickfall::test
