// A tie between two bodies, whatever its kind: a link.
#pragma once
#include <cstdint>

#include "base/archive.h"
#include "base/ascending.h"
#include "base/findings.h"
#include "base/mix.h"
#include "dynamics/body_set.h"

namespace brickfall {

class ShapeSet;

enum class LinkKind : std::uint8_t { contact, joint, mortar, count };
//! not of the method: a count
constexpr std::size_t kLinkKinds = std::size_t(LinkKind::count);

struct Link {
  BodyIndex bodyA = kNoIndex, bodyB = kNoIndex;
  LinkKind kind = LinkKind::contact;
  std::uint32_t index = kNoIndex;  // in the set of its kind

  bool names(BodyIndex body) const { return bodyA == body || bodyB == body; }
};

}  // namespace brickfall
