// Newton's equations of some bodies of an island together: 6 unknowns a body, in doubles, by a Cholesky factor in an
// envelope that is narrow where neighbours have near places. For the direct solve and for what joints tie.
#pragma once
#include <memory_resource>
#include <utility>
#include <vector>

#include "solver/body_matrix.h"
#include "solver/numbering.h"
#include "solver/rounding.h"

namespace brickfall {

struct BodyNewton {
  explicit BodyNewton(Island& of) : island(of) {}

  Island& island;
  std::pmr::vector<std::uint32_t> bodies{island.memory};  // in the order in which sums take them
  std::pmr::vector<std::uint32_t> place{island.memory};   // of a body of the island in the matrix; kNoPlace: it stays
  BlockEnvelope matrix{island.memory};
  std::pmr::vector<double> step{island.memory};        // by place
  std::pmr::vector<SolveMotion> from{island.memory};   // as `bodies`: where the step begins
  std::pmr::vector<Rounding> rounding{island.memory};  // by body of the island; empty without firm ties

  bool has(std::uint32_t body) const { return body < place.size() && place[body] != kNoPlace; }
  void enter(std::uint32_t body) {
    place[body] = std::uint32_t(bodies.size());
    bodies.push_back(body);
  }
  // After all bodies have entered.
  void findPlaces();
  double& entry(std::uint32_t body, int k) { return step[6 * place[body] + std::size_t(k)]; }
  double entry(std::uint32_t body, int k) const { return step[6 * place[body] + std::size_t(k)]; }

  // The matrix: first the bodies, then each row on them, then what is locked, and the factor: false if there is none.
  void beginMatrix();
  template <class Kind> void add(const Kind& kind, std::size_t k, const StiffReaction& x) {
    BodyBlock K;
    kind.writeStiffness(k, island.motion.data(), x, K);
    addRow(kind.ends(k), x, K);
    if constexpr (Kind::kFirm)
      if (!rounding.empty()) addRounding(rounding, kind.ends(k), x, island.motion.data());
  }
  // The stiffness of a row, at the arms of its reaction.
  void addRow(RowEnds ends, const Reaction& x, const BodyBlock& K) {
    auto endOf = [this](std::uint32_t body, wide::V arm) {
      return MatrixEnd{has(body) ? place[body] : kNoPlace, toDouble(wide::store3(arm))};
    };
    addTie(matrix, K, endOf(ends.a, x.armA), endOf(ends.b, x.armB));
  }
  bool factor();

  // The residuals as right side, then the step. Nothing goes where it is locked.
  void takeResiduals();
  void solve();
  // How fast the energy falls along the step. The slope itself falls along the step, and is zero at the minimum.
  double slope() const;
  void begin();                  // a way along the step, from the present motion
  void moveBodies(double part);  // to a part of it
};

}  // namespace brickfall
