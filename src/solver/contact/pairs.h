// Contacts read two at a time, in whatever lanes the machine has: the same bits in all.
#pragma once
#include <cstddef>

#include "solver/boundary.h"
#include "solver/contact/record.h"

namespace brickfall {

// Of a boundary's contacts.
void sumContacts(const Boundary& boundary, const ContactRecord* records, BoundarySums& sums);
// One after the other.
void readContacts(const ContactRecord* records, std::size_t count, const SolveMotion* motion, Reading* out);

// The same in lanes of one kind.
struct PairFunctions {
  void (*sum)(const Boundary&, const ContactRecord*, BoundarySums&) = nullptr;
  void (*sumWithMatrix)(const Boundary&, const ContactRecord*, BoundarySums&) = nullptr;
  void (*read)(const ContactRecord*, std::size_t, const SolveMotion*, Reading*) = nullptr;
};
PairFunctions pairsInHalves();
PairFunctions pairsInEight();  // for machines with AVX2; none where the compiler cannot

}  // namespace brickfall
