// Which point of an old manifold hands its memory to a point of the new one.
#pragma once
#include <cstdint>

#include "dynamics/contact.h"

namespace brickfall {

//! inner radii | too small: a sliding or rocking contact forgets its force: bodies sink for a step
//! | too large: a point takes over the force of another one
constexpr double kMatchShare = 0.6;  // of the thinner shape: an old point this near may hand its memory to a new one
//! radii | too small: torn joints close slowly; points that stick creep where the polygon of a contact is cut anew
//! | too large: a body that rolls on short faces stands on a corner that it has left, and sinks in at the next;
//! what an obstacle held back from its joint is flung after the rest
constexpr double kSamePlace = 0.03;  // of the thinner shape: a point this near is the same one, whatever its feature;
                                     // an anchor further away is placed anew. A joint's error further than so much of
                                     // the larger body's radius, or rad, counts as no further
// Cosines between two normals.
//! - | too small: a contact takes over the force that it had on another face
//! | too large: a rocking brick forgets its force: it sinks for a step
constexpr double kSameFace = 0.9;  // still the same face: forces go on
//! - | too small: anchors are dragged round by a turn | too large: anchors are placed anew while they stick: creep
constexpr double kKeptFace = 0.999;  // anchors go on, too

class PointMatcher {
 public:
  // `fresh`, `now`: the new contact with the features of its points, its frame and anchors. `reach`, m: kMatchShare of the thinner
  // shape's inner radius. Of all pairs of an old and a new point the nearest come first, as seen from the body on which they are
  // nearer: where something slides, a corner keeps its place on one body and leaves it on the other. The same feature counts as twice
  // as near.
  PointMatcher(const Contact& old, const ContactGeometry& geometry, const Contact& fresh, const ContactGeometry& now,
               double reach);

  // The old point that new point i goes on with. -1: none, or another face, whose forces say nothing.
  int from(int i) const { return from_[i]; }
  // If it sticks it may keep its anchors: the face is the same, nothing rolls on it, and both are one place of the body. A corner
  // that only is the nearest one would leave its own without support.
  bool keepsAnchors(int i) const { return keeps_ >> i & 1; }
  const TangentTurn& turn() const { return turn_; }

 private:
  TangentTurn turn_;
  int from_[4] = {-1, -1, -1, -1};
  std::uint32_t keeps_ = 0;  // bit per new point
};

}  // namespace brickfall
