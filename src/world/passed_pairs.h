// Pairs of shapes that pass each other in the coming step, if what both touch before that lets them go on straight.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "dynamics/body_set.h"
#include "dynamics/contact_set.h"

namespace brickfall {

struct PassedPair {
  std::uint32_t pair = 0;  // in ContactSet::pairs
  double time = 0;         // s, when they are past
};

// s, by body: until when its contacts turn a body that passes something aside by no more than a millimetre. Of others anything.
void findStraight(const BodySet& bodies, const ContactSet& contacts, std::span<const PassedPair> passed,
                  std::vector<double>& until);

}  // namespace brickfall
