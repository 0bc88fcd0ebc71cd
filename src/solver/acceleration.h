// Goes on from the last cycles: among all motions that their changes add up to, it takes the one of least energy.
//
// Motions that many bodies must make together (a wall that sways, a heap that settles) come along by a little in each
// cycle, in much the same way. So the island is moved by
//
//   P = sum of x_j s_j,   x such that   s_i . (residual - sum of x_j y_j) = 0   for all i,
//
// with s_j the change of the motion in one of the last cycles, and y_j by how much the residual fell. The newest change
// is then made whole by P, so that the next ones stand across it. (Nonlinear Krylov acceleration: Carlson and Miller,
// SIAM J. Sci. Comput. 19, 1998; for minima, De Sterck, SIAM J. Sci. Comput. 34, 2012.)
#pragma once
#include <array>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "solver/row_forces.h"

namespace brickfall {

class Acceleration {
 public:
  explicit Acceleration(Island& island) : island_(island) {}

  // Moves the island by P and reads its forces there. Nothing happens before the first change, or if P is no way down.
  // If P ends too far beyond its minimum, even when it has been made shorter, the island is put back as it was.
  void apply(RowForces& forces);
  // A cycle between begin and end is a change. (Friction limits are renewed outside of it.)
  void begin();
  void end();
  // The same of a cycle that changed nothing but these bodies.
  void end(const std::pmr::vector<std::uint32_t>& changed);
  // Motions or residuals were changed outside of cycles.
  void forget() { begun_ = false; }

 private:
  //! - | too small: slow settling is not seen through | too large: cost, for changes made elsewhere
  static constexpr int kChanges = 3;

  // The change of one body in one cycle.
  struct Change {
    SolveMotion way;
    Wrench fell;  // by how much the body's residual fell
  };
  using Shares = std::array<double, kChanges>;  // x, the newest first
  struct Curvature {
    double of[kChanges][kChanges] = {};  // s_i . y_j, j not newer than i
  };
  Change* change(int age);  // of all bodies; 0: the newest
  Change* nextChange();
  Change changeOf(std::size_t body) const;
  Curvature curvature();
  Shares slopes();  // s_i . residual
  double slopeAlong(const Shares& shares);
  template <class WayOf> void addWays(const Shares& shares, double part, WayOf wayOf);
  void moveBy(const Shares& shares, double part);
  void makeNewestWhole(const Shares& shares, double part);

  Island& island_;
  std::pmr::vector<SolveMotion> startMotion_{island_.memory};  // by body: where a cycle, or P, begins
  std::pmr::vector<Wrench> startResidual_{island_.memory};     // by body
  std::pmr::vector<Change> changes_{island_.memory};           // kChanges lists by body, used in turn
  int count_ = 0, made_ = 0;
  bool begun_ = false;  // what the next cycle begins with is known
};

}  // namespace brickfall
