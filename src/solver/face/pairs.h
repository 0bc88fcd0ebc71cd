// Faces read two at a time, in whatever lanes the machine has: the same bits in all.
#pragma once
#include <cstddef>

#include "solver/boundary.h"
#include "solver/face/record.h"

namespace brickfall {

// Reads the action of a boundary's faces at present into Boundary::trial, and adds it to `sums` in the order of the
// sides.
void sumFaces(const Boundary& boundary, const FaceRecord* records, BoundarySums& sums);
// Reads the action of `count` faces, each by itself.
void readFaces(const FaceRecord* records, std::size_t count, const SolveMotion* motion, Reading* out);
// Reads the action of the faces named, each by itself, and how it resists a Newton step.
void readStiffFaces(const FaceRecord* records, const std::uint32_t* faces, std::size_t count, const SolveMotion* motion,
                    Resist how, StiffReaction* out);

// These functions in lanes of one kind: those above choose one of these sets.
struct PairFunctions {
  void (*sum)(const Boundary&, const FaceRecord*, BoundarySums&) = nullptr;
  void (*sumWithMatrix)(const Boundary&, const FaceRecord*, BoundarySums&) = nullptr;
  void (*read)(const FaceRecord*, std::size_t, const SolveMotion*, Reading*) = nullptr;
  void (*readStiff)(const FaceRecord*, const std::uint32_t*, std::size_t, const SolveMotion*, Resist,
                    StiffReaction*) = nullptr;
};
PairFunctions pairsInHalves();
PairFunctions pairsInEight();  // for machines with AVX2; none where the compiler cannot

}  // namespace brickfall
