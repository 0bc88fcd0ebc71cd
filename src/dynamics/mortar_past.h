// How a mortar joint opened, and what the ties beside it bore then. Nothing that moves a body reads it.
#pragma once
#include <cstdint>
#include <limits>

#include "dynamics/mortar.h"

namespace brickfall {

// A tie of one of a joint's bodies: mortar, or the contacts of two bodies.
struct TieLoad {
  MortarIndex mortar = kNoIndex;  // kNoIndex: contacts
  BodyIndex bodyA = kNoIndex, bodyB = kNoIndex;
  float before = 0, after = 0;  // N
  bool names(BodyIndex body) const { return bodyA == body || bodyB == body; }
  bool isSame(const TieLoad& other) const {
    return mortar == other.mortar && bodyA == other.bodyA && bodyB == other.bodyB;
  }
};

//! of the ties beside a joint | too small: who takes the load is not seen | too large: memory
constexpr std::uint32_t kTieLoads = 12;  // a brick in a wall has six beside each of its joints

struct OpeningMemory {
  MortarIndex mortar = kNoIndex;
  std::uint32_t count = 0;                                     // of loads
  double crackTime = 0, openTime = 0, grewTime = 0;            // s: first, of this opening, last
  double breakTime = std::numeric_limits<double>::infinity();  // s
  double damage = 0;                                           // as it was told last
  Vec3T<float> force;                                          // N, from A on B, before it opened
  TieLoad loads[kTieLoads];
};

}  // namespace brickfall
