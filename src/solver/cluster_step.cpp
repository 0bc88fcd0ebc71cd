// One Newton step of a rigid cluster on the rows of its boundary.
//
//   residual  g = sum over bodies (M (dFree - d) / dt^2; its torque)  +  sum over boundary points (F; r x F)
//   matrix    H = cluster mass and inertia / dt^2  +  sum over boundary rows of their stiffness, moved to the centre
//   step      x = H^-1 g, all bodies of the cluster move rigidly by x
#include "solver/cluster_step.h"

#include <algorithm>

namespace brickfall {

namespace {

using wide::V;

// The Newton matrix as sums over rows, by lines of three in four lanes. With a row's stiffness [A B; B^T C] seen at
// arm r from the cluster's centre (u = d - [r] th, w = th):
//   dd: A,   th d: [r] A + B^T,   th th: [r] A [r]^T + [r] B + ([r] B)^T + C.
// The transposed parts are summed untransposed and turned over once at the end.
struct MatrixSums {
  V dd[3] = {}, thd[3] = {}, B[3] = {}, thth[3] = {}, rB[3] = {};

  // [r] M by rows
  static void crossRows(V r, const V* m, V* out) {
    V x = wide::spread<0>(r), y = wide::spread<1>(r), z = wide::spread<2>(r);
    out[0] = y * m[2] - z * m[1];
    out[1] = z * m[0] - x * m[2];
    out[2] = x * m[1] - y * m[0];
  }

  void add(const Stiffness& k, V r) {
    V rA[3], rBk[3];
    crossRows(r, k.A, rA);
    crossRows(r, k.B, rBk);
    for (int i = 0; i < 3; i++) {
      dd[i] += k.A[i];
      thd[i] += rA[i];
      B[i] += k.B[i];
      thth[i] += wide::cross3(r, rA[i]) + k.C[i];
      rB[i] += rBk[i];
    }
  }

  void write(Symmetric6& H) const {
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) H.at(i, j) = dd[i][j];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) H.at(3 + i, j) = thd[i][j] + B[j][i];
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++) H.at(3 + i, 3 + j) = thth[i][j] + (rB[i][j] + rB[j][i]);
  }
};

void addInertia(Symmetric6& H, const Cluster& c) {
  for (int i = 0; i < 3; i++) H.at(i, i) += c.mass;
  H.at(3, 3) += c.inertia[0];
  H.at(4, 3) += c.inertia[1];
  H.at(4, 4) += c.inertia[2];
  H.at(5, 3) += c.inertia[3];
  H.at(5, 4) += c.inertia[4];
  H.at(5, 5) += c.inertia[5];
}

void moveCluster(Island& island, const Level& level, const Cluster& cluster, const Wrench& step, float scale) {
  Vec3f move = step.force * scale, turn = step.torque * scale;
  if (cluster.bodyEnd - cluster.bodyBegin == 1) {
    SolveMotion& m = island.motion[level.bodies[cluster.bodyBegin]];
    m.d += move;
    m.th += turn;
    return;
  }
  for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
    std::uint32_t body = level.bodies[k];
    SolveMotion& m = island.motion[body];
    m.d += move + cross(turn, island.masses[body].position - cluster.centre);
    m.th += turn;
  }
}

float power(const Wrench& a, const Wrench& b) { return dot(a.force, b.force) + dot(a.torque, b.torque); }

template <bool withMatrix>
bool sumBoundary(const Island& island, const Level& level, const Cluster& cluster, V& force, V& torque,
                 MatrixSums& sums) {
  bool single = cluster.bodyEnd - cluster.bodyBegin == 1;
  const SolveMotion* motion = island.motion.data();
  const SolveMass* masses = island.masses.data();
  const bool exact = island.plan.exactSteps;
  V centre = wide::load3(cluster.centre);
  wide::M nonlinear{};
  for (std::uint32_t k = cluster.sideBegin; k < cluster.sideEnd; k++) {
    std::uint32_t side = level.sides[k];
    // Rows lie in the order of their pairs, clusters jump about in it.
    if (k + 2 < cluster.sideEnd)
      island.rows.at(level.sides[k + 2] / 2, [](const auto& kind, std::uint32_t row) { kind.prefetch(row); });
    island.rows.at(side / 2, [&](const auto& kind, std::uint32_t row) {
      wide::M weAreB = wide::M{} - std::int32_t(side & 1);
      StiffReaction x = kind.template reactStiff<withMatrix>(row, motion, exact);
      V arm = wide::select(weAreB, x.armB, x.armA);
      if (!single) {
        RowEnds ends = kind.ends(row);
        arm += wide::load3(masses[(side & 1) ? ends.b : ends.a].position) - centre;
      }
      V sign = wide::select(weAreB, wide::set(1), wide::set(-1));
      force += sign * x.force;
      torque += sign * (wide::cross3(arm, x.force) + x.torque);
      nonlinear |= x.nonlinear;
      if constexpr (withMatrix) sums.add(x.stiffness, arm);
    });
  }
  return wide::any(nonlinear);
}

}  // namespace

bool clusterResidual(const Island& island, const Level& level, const Cluster& cluster, Wrench& residual,
                     Symmetric6* matrix, double& visits) {
  bool single = cluster.bodyEnd - cluster.bodyBegin == 1;
  Vec3f inertiaForce, inertiaTorque;
  for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
    std::uint32_t body = level.bodies[k];
    Wrench inertia = inertiaResidual(island.masses[body], island.motion[body]);
    inertiaForce += inertia.force;
    inertiaTorque += inertia.torque;
    if (!single) inertiaTorque += cross(island.masses[body].position - cluster.centre, inertia.force);
  }
  visits += 4.0 * (cluster.sideEnd - cluster.sideBegin);
  V force = wide::load3(inertiaForce), torque = wide::load3(inertiaTorque);
  MatrixSums sums;
  bool nonlinear = matrix ? sumBoundary<true>(island, level, cluster, force, torque, sums)
                          : sumBoundary<false>(island, level, cluster, force, torque, sums);
  residual = {wide::store3(force), wide::store3(torque)};
  if (matrix) {
    sums.write(*matrix);
    addInertia(*matrix, cluster);
  }
  return nonlinear;
}

// Open points nearer than kNearContact are in the matrix, so that no step runs through them and no line search is needed
// for them; but what turns away from them, or towards one that is still far, then gets a step that can be a hundred times
// too short and seems to hang in the air. Small islands, which are cheap, therefore leave them out and search instead.
//
// The slope (residual . step) is positive while the step still lowers the energy. Where friction slides, the full step
// may be too short or too long: bracketed secant search (Illinois rule) for the zero of the slope.
void clusterStep(Island& island, const Level& level, const Cluster& cluster, double& visits) {
  Symmetric6 matrix;
  Wrench residual;
  bool nonlinear = clusterResidual(island, level, cluster, residual, &matrix, visits);
  if (!matrix.factor()) return;
  Wrench step = matrix.solve(residual);
  moveCluster(island, level, cluster, step, 1);
  if (!nonlinear) return;

  float slopeAtStart = power(residual, step);
  float t = 1, low = 0, slopeLow = slopeAtStart, high = -1, slopeHigh = 0;  // high < 0: no upper end found yet
  int searchSteps = island.plan.exactSteps ? kLineSearchStepsExact : kLineSearchSteps;
  for (int k = 0; k < searchSteps; k++) {
    clusterResidual(island, level, cluster, residual, nullptr, visits);
    float slope = power(residual, step);
    if (slope >= 0) {
      bool goodEnough = slope < 0.3f * slopeAtStart || (slope < 0.6f * slopeAtStart && k >= 2);
      if (high < 0 || goodEnough) break;
      low = t;
      slopeLow = slope;
      slopeHigh *= 0.5f;  // otherwise one end of the bracket may never move
    } else {
      if (slope > -0.1f * slopeAtStart) break;
      high = t;
      slopeHigh = slope;
    }
    float fall = slopeLow - slopeHigh;
    if (!(fall > 0)) break;  // both have underflowed: forces that a float hardly knows are balanced
    float width = high - low;
    float next = low + width * slopeLow / fall;
    if (k >= 1) next = std::min(std::max(next, low + 0.2f * width), high - 0.2f * width);
    moveCluster(island, level, cluster, step, next - t);
    t = next;
  }
}

}  // namespace brickfall
