// One Newton step of a rigid cluster on the contacts of its boundary: the only place where anything is solved.
//
//   residual  g = sum over bodies (M (dFree - d) / dt^2; its torque)  +  sum over boundary points (F; r x F)
//   matrix    H = cluster mass and inertia / dt^2  +  sum over boundary contacts of their stiffness, moved to the centre
//   step      x = H^-1 g, all bodies of the cluster move rigidly by x
#include <algorithm>

#include "solver/contact_kernel.h"
#include "solver/island.h"
#include "solver/symmetric6.h"

namespace brickfall {

namespace {

// Adds a contact's stiffness, seen at arm r from the cluster's centre. With u = d - [r] th, w = th:
//   dd: A,  th d: [r] A + B^T,  th th: [r] A [r]^T + [r] B + ([r] B)^T + C
void addStiffness(Symmetric6& H, const kernel::Stiffness& k, Vec3f r) {
  // [r] A: column j is r x (column j of A); A is symmetric, so its columns are its rows.
  Mat3f rAt;  // transpose of [r] A, by rows
  for (int j = 0; j < 3; j++) rAt.row[j] = cross(r, k.A.row[j]);
  Mat3f rA = transpose(rAt);
  Mat3f Bt = transpose(k.B);
  Mat3f rBt;  // transpose of [r] B
  for (int j = 0; j < 3; j++) rBt.row[j] = cross(r, Bt.row[j]);
  for (int i = 0; i < 3; i++)
    for (int j = 0; j <= i; j++) H.at(i, j) += k.A.row[i][j];
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) H.at(3 + i, j) += rA.row[i][j] + Bt.row[i][j];
  for (int i = 0; i < 3; i++) {
    Vec3f rAr = cross(r, rA.row[i]);
    for (int j = 0; j <= i; j++) H.at(3 + i, 3 + j) += rAr[j] + rBt.row[j][i] + rBt.row[i][j] + k.C.row[i][j];
  }
}

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

}  // namespace

Wrench inertiaResidual(const SolveMass& m, const SolveMotion& motion) {
  Vec3f e = m.dFree - motion.d, t = m.thFree - motion.th;
  return {e * m.mass,
          {m.inertia[0] * t.x + m.inertia[1] * t.y + m.inertia[3] * t.z,
           m.inertia[1] * t.x + m.inertia[2] * t.y + m.inertia[4] * t.z,
           m.inertia[3] * t.x + m.inertia[4] * t.y + m.inertia[5] * t.z}};
}

bool clusterResidual(const Island& island, const Level& level, const Cluster& cluster, Wrench& residual,
                     Symmetric6* matrix, double& visits) {
  bool single = cluster.bodyEnd - cluster.bodyBegin == 1;
  Vec3f force, torque;
  for (std::uint32_t k = cluster.bodyBegin; k < cluster.bodyEnd; k++) {
    std::uint32_t body = level.bodies[k];
    Wrench inertia = inertiaResidual(island.masses[body], island.motion[body]);
    force += inertia.force;
    torque += inertia.torque;
    if (!single) torque += cross(island.masses[body].position - cluster.centre, inertia.force);
  }
  bool nonlinear = false;
  const SolveMotion* motion = island.motion.data();
  visits += 4.0 * (cluster.sideEnd - cluster.sideBegin);
  for (std::uint32_t k = cluster.sideBegin; k < cluster.sideEnd; k++) {
    const ContactRecord& r = island.records[level.sides[k] / 2];
    bool weAreB = level.sides[k] % 2 == 1;
    Vec3f t2 = cross(r.n, r.t1);
    kernel::PointForces f =
        kernel::pointForces(r, kernel::pointMotion(r, kernel::relativeMotion(r, motion, t2)));
    Wrench w = kernel::wrench(r, f, t2);
    Vec3f arm = weAreB ? r.armB : r.armA;
    if (!single) arm += island.masses[weAreB ? r.bodyB : r.bodyA].position - cluster.centre;
    Vec3f moment = cross(arm, w.force) + w.torque;
    if (weAreB) {
      force += w.force;
      torque += moment;
    } else {
      force -= w.force;
      torque -= moment;
    }
    nonlinear = nonlinear || kernel::needsLineSearch(r, f);
    if (matrix) addStiffness(*matrix, kernel::stiffness(r, f, t2, kNearContact), arm);
  }
  residual = {force, torque};
  if (matrix) addInertia(*matrix, cluster);
  return nonlinear;
}

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
  for (int k = 0; k < kLineSearchSteps; k++) {
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
    float width = high - low;
    float next = low + width * slopeLow / (slopeLow - slopeHigh);
    if (k >= 1) next = std::min(std::max(next, low + 0.2f * width), high - 0.2f * width);
    moveCluster(island, level, cluster, step, next - t);
    t = next;
  }
}

}  // namespace brickfall
