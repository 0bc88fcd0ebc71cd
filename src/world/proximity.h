// Which shapes of a world are near each other: their bounds, and the broad phase that the bounds lie in. The candidate
// pairs that it finds belong to the contacts (dynamics/ties.h).
#pragma once
#include <memory>
#include <vector>

#include "brickfall/broad_phase.h"
#include "broadphase/broad_phase.h"
#include "dynamics/contact_set.h"
#include "narrowphase/mesh_collide.h"
#include "world/passed_pairs.h"
#include "world/registry.h"

namespace brickfall {

//! inner radii | too small: debris overlaps before it meets: hits on large bricks move fewer; bounds are made anew
//! | too large: more pairs and points that carry nothing; bodies that a hit throws end in what they meet
constexpr double kRoom = 0.3;  // around a shape: its margin at most; kept bounds are this much larger than they need
                               // be; a body that ends further from the way of its velocity may end in something

// The surroundings of a shape.
struct Surroundings {
  ProxyIndex proxy = kNoProxy;  // none: its body takes no part
  bool mesh = false;            // a triangle mesh
  Aabb swept;                   // m: bounds over the coming step at the present velocity, grown by the contact margin
};

class Proximity {
 public:
  // Makes it empty, for a world with these settings.
  void open(BroadPhaseMethod method, double contactMargin);

  std::unique_ptr<BroadPhase> broadPhase;  // never null in a world
  double contactMargin = 0;                // m, for bodies that do not move
  std::vector<Surroundings> around;        // by shape
  Vec3 fall;                               // m/s: what gravity adds to velocities in the coming step
  // Scratch, kept for its memory.
  BroadPhase::Pairs foundPairs;
  std::vector<CandidatePair> newPairs;
  std::vector<CandidatePair> newParts;  // of pairs with a mesh
  std::vector<PassedPair> passed;
  std::vector<Course> courses;          // by body (passed_pairs.h)
  std::vector<Sinking> sinking;         // likewise
  std::vector<BoundsUpdate> following;  // bounds of which the broad phase is to be told
  MeshScratch meshScratch;

  // m: how early contacts of a shape are made.
  double marginOf(const ShapeData& shape) const;
  // Bounds that anything must meet to be able to touch the shape in the coming step.
  void updateSwept(const Registry& registry, ShapeIndex shape, double dt);
  void enter(const Registry& registry, BodyIndex body);  // all its shapes, where they are
  void enter(const Registry& registry, ShapeIndex shape, const Aabb& swept);
  void leave(const Registry& registry, BodyIndex body);
  void follow(const Registry& registry, ShapeIndex shape);    // adds the swept bounds to `following`, before the step
  void keepBounds(const Registry& registry, BodyIndex body);  // where it is, after the step
  const Aabb& kept(ShapeIndex shape) const { return broadPhase->kept(around[shape].proxy); }

  void keepRoom(std::size_t shapes, std::size_t pairs, std::size_t touching);

  void checkStructure(Findings& f, const Registry& registry) const;
  void checkBounds(Findings& f, const Registry& registry) const;  // of shapes that have entered
};

}  // namespace brickfall
