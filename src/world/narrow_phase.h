// From candidate pairs to contacts: the manifold of two shapes that are near. It is kept while the shapes hardly move
// against each other, else made anew with the memory of its points.
#pragma once
#include "world/proximity.h"

namespace brickfall {

class NarrowPhase {
 public:
  NarrowPhase(const Registry& registry, double dt, Proximity& proximity, ContactSet& contacts)
      : bodies_(registry.bodies), shapes_(registry.shapes), dt_(dt), proximity_(proximity), contacts_(contacts) {}

  // Brings all pairs that are not asleep up to date.
  void run();
  // Renews a contact in the middle of a step, after its bodies moved: its points where they are now. Shapes that have
  // parted keep their old points.
  void renew(ContactIndex contact);
  // Likewise after a body flew far: old points are out of reach.
  void follow(ContactIndex contact);
  // Contacts of a pair that the broad phase has not found yet: pairs with their contacts, to be inserted.
  void meet(CandidatePair pair, std::vector<CandidatePair>& out);

  int reused() const { return reused_; }  // manifolds
  int computed() const { return computed_; }

 private:
  // How two bodies are placed, and how they approach each other.
  struct Approach {
    bool near = false;   // they may touch in the coming step
    Transform relative;  // B's centre frame in A's
    Vec3 velocity;       // m/s, of B against A
  };

  // Whether a manifold is taken where the shapes are now, or where they will meet in the step.
  enum class Look { asNow, ahead };

  // For pairs of which one body has moved.
  bool updatePair(CandidatePair& pair, Look look);  // false: the pair is forgotten
  void collidePair(const CandidatePair& pair, const Approach& approach, Look look, Manifold& m);
  void lookAheadOf(const CandidatePair& pair, const Approach& approach, Manifold& m);
  // A pair that passes only if both go straight, and whose bodies do not, gets the points that are nearest now.
  void restorePassed();
  // All parts of a shape and a mesh. As many of the first ones as the returned count are kept.
  int updateParts(CandidatePair* parts, int count);
  void findParts(const CandidatePair* parts, int count, const Approach& approach, MeshManifolds& found);
  int takeParts(CandidatePair* parts, int count, const MeshManifolds& found, const Transform& relative);
  bool isStill(const CandidatePair& pair) const;
  bool haveParted(const CandidatePair& pair) const;
  Approach approachOf(const CandidatePair& pair) const;
  double reachOf(const CandidatePair& pair, const Approach& approach) const;  // m
  double marginOf(const CandidatePair& pair) const;                           // m
  bool meetsMesh(const CandidatePair& pair) const;
  bool mayReuse(const CandidatePair& pair, const Approach& approach) const;
  void makeContact(CandidatePair& pair, const Manifold& m, const Transform& relative);

  const BodySet& bodies_;
  const ShapeSet& shapes_;
  double dt_;
  Proximity& proximity_;
  ContactSet& contacts_;
  int reused_ = 0, computed_ = 0;
};

// Sets gaps and drifts from the anchors, in double, and the points' places about their middle. `relative`: the centre
// frame of B in that of A.
void measurePoints(Contact& c, ContactGeometry& g, const Transform& relative);

}  // namespace brickfall
