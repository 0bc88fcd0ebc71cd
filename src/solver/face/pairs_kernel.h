// Faces read two at a time: for pairs.cpp and pairs_avx2.cpp, which differ in their lanes.
#pragma once
#include <cstddef>

#include "solver/boundary.h"
#include "solver/face/kernel.h"
#include "solver/face/pairs.h"
#include "solver/step_context.h"

namespace brickfall::kernel {

//! not of the method: sides by which a record is asked for before its turn
inline constexpr std::uint32_t kAhead = 4;

BRICKFALL_LANES void fetch(const FaceRecord& r) {
  const char* line = reinterpret_cast<const char*>(&r);
  __builtin_prefetch(line);
  __builtin_prefetch(line + 64);
  __builtin_prefetch(line + 128);
}

// Without a branch: which end is ours changes from row to row.
static_assert(offsetof(FaceRecord, armB) == offsetof(FaceRecord, armA) + sizeof(Vec3f));
BRICKFALL_LANES V armOf(const FaceRecord& r, std::uint32_t end) {
  V arm;
  std::memcpy(&arm, reinterpret_cast<const char*>(&r.armA) + end * sizeof(Vec3f), sizeof arm);
  return V(M(arm) & M{-1, -1, -1, 0});
}

template <class L, bool withMatrix>
BRICKFALL_LANES void sumPair(const Boundary& b, const FaceRecord* records, SidePair<L> sides, BoundarySums& sums,
                             MatrixSums* matrix) {
  auto recordAt = [&](std::uint32_t side) -> const FaceRecord& { return records[side / 2 - b.firstRow]; };
  RecordPair<L> r{recordAt(b.sides[sides.first]), recordAt(b.sides[sides.second])};
  Frame<L> f = frame(r);
  PointForces<L> forces = pointForces(r, pointMotion(r, f, b.motion));
  WideWrench<L> w = wrench(r, f, forces);
  L arm = sides.halves([&](std::uint32_t side) {
    const FaceRecord& one = recordAt(side);
    V own = armOf(one, side & 1);
    if (b.single) return own;
    return own + (wide::load3Padded(b.masses[(side & 1) ? one.bodyB : one.bodyA].position) - b.centre);
  });
  sides.add(w.force, w.torque, arm, sums);
  if constexpr (withMatrix)
    matrix->add(stiffness(r, f, forces, b.exact ? Resist::exactly : Resist::nearly), arm, sides.both());
}

template <class L, bool withMatrix> void sumFaces(const Boundary& b, const FaceRecord* records, BoundarySums& out) {
  BoundarySums sums = out;
  for (std::uint32_t i = 0; i < b.count; i += 2) {
    if (i + kAhead + 1 < b.count) {
      fetch(records[b.sides[i + kAhead] / 2 - b.firstRow]);
      fetch(records[b.sides[i + kAhead + 1] / 2 - b.firstRow]);
    }
    sumPair<L, withMatrix>(b, records, {b, i, i + 1 < b.count ? i + 1 : i}, sums, out.matrix);
  }
  out = sums;
}

template <class L>
void readFaces(const FaceRecord* records, std::size_t count, const SolveMotion* motion, Reading* out) {
  for (std::size_t i = 0; i < count; i += 2) {
    const std::size_t j = i + 1 < count ? i + 1 : i;
    RecordPair<L> r{records[i], records[j]};
    Frame<L> f = frame(r);
    WideWrench<L> w = wrench(r, f, pointForces(r, pointMotion(r, f, motion)));
    out[j] = {highOf(w.force), highOf(w.torque)};
    out[i] = {lowOf(w.force), lowOf(w.torque)};
  }
}

template <class L>
void readStiffFaces(const FaceRecord* records, const std::uint32_t* faces, std::size_t count, const SolveMotion* motion,
                    Resist how, StiffReaction* out) {
  for (std::size_t i = 0; i < count; i += 2) {
    const std::size_t j = i + 1 < count ? i + 1 : i;
    RecordPair<L> r{records[faces[i]], records[faces[j]]};
    Frame<L> f = frame(r);
    PointForces<L> forces = pointForces(r, pointMotion(r, f, motion));
    WideWrench<L> w = wrench(r, f, forces);
    StiffnessOf<L> s = stiffness(r, f, forces, how);
    auto write = [&](StiffReaction& to, auto half) {
      to.force = half(w.force);
      to.torque = half(w.torque);
      to.armA = half(f.armA);
      to.armB = half(f.armB);
      for (int k = 0; k < 3; k++) {
        to.stiffness.A[k] = half(s.A[k]);
        to.stiffness.B[k] = half(s.B[k]);
        to.stiffness.C[k] = half(s.C[k]);
      }
    };
    write(out[j], [](L v) { return highOf(v); });
    write(out[i], [](L v) { return lowOf(v); });
  }
}

template <class L> PairFunctions pairFunctions() {
  return {sumFaces<L, false>, sumFaces<L, true>, readFaces<L>, readStiffFaces<L>};
}

}  // namespace brickfall::kernel
