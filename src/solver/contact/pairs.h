// Contacts read two at a time, in whatever lanes the machine has: the same bits in all.
#pragma once
#include <cstddef>

#include "solver/boundary.h"
#include "solver/contact/record.h"

namespace brickfall {

// What a boundary's contacts do now, into Boundary::trial, and added to `sums` in the order of its sides.
void sumContacts(const Boundary& boundary, const ContactRecord* records, BoundarySums& sums);
// What `count` contacts do, each by itself.
void readContacts(const ContactRecord* records, std::size_t count, const SolveMotion* motion, Reading* out);

// These functions in lanes of one kind: what the two above choose from.
struct PairFunctions {
  void (*sum)(const Boundary&, const ContactRecord*, BoundarySums&) = nullptr;
  void (*sumWithMatrix)(const Boundary&, const ContactRecord*, BoundarySums&) = nullptr;
  void (*read)(const ContactRecord*, std::size_t, const SolveMotion*, Reading*) = nullptr;
};
PairFunctions pairsInHalves();
PairFunctions pairsInEight();  // for machines with AVX2; none where the compiler cannot

}  // namespace brickfall
