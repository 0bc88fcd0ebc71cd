// Faces as rows: what the solve reads of every kind of tie whose rows are faces. The life of a face (what it remembers,
// what it becomes at the start of a step, what is kept at its end) is its kind's own (contact/rows.h).
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/face/kernel.h"
#include "solver/face/pairs.h"

namespace brickfall {

struct FaceRows {
  explicit FaceRows(std::pmr::memory_resource* memory) : records(memory) {}
  std::pmr::vector<FaceRecord> records;  // by row
  bool rolls = false;                    // any of them resists rolling in this step

  // The direction from A to B along which the face presses.
  Vec3 normal(std::size_t k) const { return toDouble(records[k].n); }
  // Reads `count` rows from k on.
  void read(std::size_t k, std::size_t count, const SolveMotion* motion, Reading* out) const {
    readFaces(records.data() + k, count, motion, out);
  }
  // visit(ends, force): of rows that resist rolling, the most with which they do, N.
  template <class Visit> void eachResistance(Visit&& visit) const {
    if (!rolls) return;
    for (std::size_t k = 0; k < records.size(); k++)
      if (records[k].rolls) visit(RowEnds{records[k].bodyA, records[k].bodyB}, records[k].limit[3]);
  }
  // J: the most that the face's law gives in a step, by whatever way: that of a spring which is released halfway.
  double mostWork(std::size_t k) const {
    const FaceRecord& r = records[k];
    double sum = 0;
    for (int i = 0; i < 4; i++) {
      if (!(r.k[i] > 0)) continue;
      const double n = r.leastN[i] < 0 ? r.trialN[i] : std::max(0.0f, r.trialN[i]);
      sum += (n * n + double(r.trial1[i]) * r.trial1[i] + double(r.trial2[i]) * r.trial2[i]) / (4 * double(r.k[i]));
    }
    return sum;
  }
  // Sums the rows of this kind on a cluster's boundary.
  void sumBoundary(const Boundary& boundary, BoundarySums& sums) const { sumFaces(boundary, records.data(), sums); }
  Reaction react(std::size_t k, const SolveMotion* motion) const {
    const FaceRecord& r = records[k];
    auto frame = kernel::frame(r);
    auto w = kernel::wrench(r, frame, kernel::pointForces(r, kernel::pointMotion(r, frame, motion)));
    return {w.force, w.torque, frame.armA, frame.armB};
  }
  // Reads the `count` rows named.
  void readStiff(const std::uint32_t* rows, std::size_t count, const SolveMotion* motion, Resist how,
                 StiffReaction* out) const {
    readStiffFaces(records.data(), rows, count, motion, how, out);
  }
  StiffReaction reactStiff(std::size_t k, const SolveMotion* motion, Resist how) const {
    const FaceRecord& r = records[k];
    auto frame = kernel::frame(r);
    auto f = kernel::pointForces(r, kernel::pointMotion(r, frame, motion));
    auto w = kernel::wrench(r, frame, f);
    return {{w.force, w.torque, frame.armA, frame.armB}, kernel::stiffness(r, frame, f, how)};
  }
  // The stiffness of this reaction, for a matrix in doubles.
  void writeStiffness(std::size_t, const SolveMotion*, const StiffReaction& x, BodyBlock& K) const {
    write(x.stiffness, K);
  }
};

}  // namespace brickfall
