// Which point of an old manifold hands its memory to a point of the new one.
#pragma once
#include <cstdint>

#include "dynamics/contact.h"

namespace brickfall {

//! m | too small: a sliding or rocking contact forgets its force: bodies sink for a step
//! | too large: a point takes over the force of another one
constexpr double kMatchDistance = 0.02;  // m: an old point this near may hand its memory to a new one
// Cosines between two normals.
//! - | too small: a contact takes over the force that it had on another face
//! | too large: a rocking brick forgets its force: it sinks for a step
constexpr double kSameFace = 0.9;  // still the same face: forces go on
//! - | too small: anchors are dragged round by a turn | too large: anchors are placed anew while they stick: creep
constexpr double kKeptFace = 0.999;  // anchors go on, too

class PointMatcher {
 public:
  // `fresh`, `now`: the new contact, with its frame; its points are matched one after the other.
  PointMatcher(const Contact& old, const ContactGeometry& geometry, const Contact& fresh, const ContactGeometry& now);

  // The nearest unused old point; the same feature counts as twice as near. -1: none, or another face, whose forces say
  // nothing.
  int match(Vec3 anchorB, std::uint32_t feature);
  // A sticking point may keep its anchors: the face is the same, and nothing rolls on it.
  bool keepsAnchors() const { return normals_ > kKeptFace && !rolls_; }
  const TangentTurn& turn() const { return turn_; }

 private:
  const Contact& old_;
  const ContactGeometry& geometry_;
  double normals_;  // cosine of the angle between old and new normal
  TangentTurn turn_;
  bool rolls_;
  std::uint32_t used_ = 0;  // bit per old point
};

}  // namespace brickfall
