#include "math/free_turn.h"

#include <algorithm>
#include <cmath>

#include "math/small_angle.h"
#include "math/symmetric_eigen.h"
#include "math/wide_double.h"

namespace brickfall {

namespace {

//! rad | too small: cost | too large: energy of a spinning brick drifts
constexpr double kTurnPerSubstep = 0.1;  // rad: energy error of a substep ~ its fourth power
//! - | too small: bodies that spin by hundreds of radians in a step point elsewhere | too large: cost of such bodies
constexpr double kMostSubsteps = 4096;  // a longer turn ends short: on its way, where its energy is the same
constexpr double kSuzukiShare = 0.41449077179437571194;  // 1 / (4 - 4^(1/3))
constexpr double kSuzuki[] = {kSuzukiShare, kSuzukiShare, 1 - 4 * kSuzukiShare, kSuzukiShare, kSuzukiShare};

}  // namespace

PrincipalInertia principalInertia(const Mat3& inertia) {
  SymmetricEigen e = symmetricEigen(inertia);
  return {e.axes, {1 / e.values.x, 1 / e.values.y, 1 / e.values.z}};
}

namespace {

// In principal axes; its length is kept by every part of a turn.
Vec3 principalMomentum(Quat rotation, Vec3 angularMomentum, const PrincipalInertia& inertia) {
  return inertia.axes * rotate(conjugate(rotation), angularMomentum);
}
double turnIn(Vec3 momentum, const PrincipalInertia& inertia, double dt) {
  return length(scaled(inertia.inverse, momentum)) * dt;
}
int substepsFor(Vec3 momentum, const PrincipalInertia& inertia, double dt) {
  return int(std::min(kMostSubsteps, std::floor(turnIn(momentum, inertia, dt) / kTurnPerSubstep) + 1));
}
// `turned`: since the start, in principal axes.
Quat afterTurn(Quat rotation, Quat turned, const PrincipalInertia& inertia) {
  Vec3 axis = transposeTimes(inertia.axes, Vec3{turned.x, turned.y, turned.z});
  return normalized(rotation * Quat{axis.x, axis.y, axis.z, turned.w});
}

double timeOf(double share, double dt, int substeps) { return share * dt / substeps; }
// One substep, as a sequence of turns about one axis each: turn(axis, time), timeFor(share of the substep).
template <class TimeFor, class Turn> void splitTurn(TimeFor&& timeFor, Turn&& turn) {
  for (double share : kSuzuki) {
    const auto h = timeFor(share), half = h * decltype(timeFor(share))(0.5);
    turn(0, half);
    turn(1, half);
    turn(2, h);
    turn(1, half);
    turn(0, half);
  }
}

}  // namespace

Quat turnFreely(Quat rotation, Vec3 angularMomentum, const PrincipalInertia& inertia, double dt) {
  Vec3 momentum = principalMomentum(rotation, angularMomentum, inertia);
  int substeps = substepsFor(momentum, inertia, dt);
  const double most = kMostSubsteps * kTurnPerSubstep, whole = turnIn(momentum, inertia, dt);
  if (whole > most) dt *= most / whole;
  Quat turned;
  auto turn = [&](int axis, double t) {
    Vec3 w;
    w[axis] = inertia.inverse[axis] * momentum[axis] * t;
    Quat q = quatFromRotationVector(w);
    momentum = rotate(conjugate(q), momentum);
    turned = turned * q;
  };
  for (int s = 0; s < substeps; s++) splitTurn([&](double share) { return timeOf(share, dt, substeps); }, turn);
  return afterTurn(rotation, turned, inertia);
}

namespace {

using wide::D;

//! not of the method: lanes and single bodies give the same bits
constexpr double kSeriesAngle = 1e-4;  // rad, as in quatFromRotationVector
//! not of the method: likewise
constexpr double kLeastSpin = 1e-60;  // rad in a step, kg m2/s: above, no product vanishes among the smallest numbers
//! - | too small: fast spinning bodies are turned alone: cost | too large: three lanes wait for one
constexpr int kMostLaneSubsteps = 64;  // of a body that is turned beside others; no infinite spin is among them

// A substep for each lane, of its own length; of none is no turn at all.
// What turns about one axis alone leaves out all that quatFromRotationVector, rotate() and the product
// of quaternions multiply by zero; every other operation is theirs, in their order. Half of an angle is far under what sinCos()
// would take quarter turns off.
struct TurningLanes {
  D inverse[3], momentum[3];
  D turned[4] = {D(0), D(0), D(0), D(1)};
  bool bySeries = true;  // all angles are under kSeriesAngle

  void turn(int i, D time) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    D w = inverse[i] * momentum[i] * time, angle = wide::abs(w), square = angle * angle;
    D s = D(0.5) - square / D(48), c = D(1) - square / D(8);
    if (!bySeries) {
      D half = D(0.5) * angle, far = D(kSeriesAngle);
      s = wide::selectLess(angle, far, s, sineSmall(half) / angle);
      c = wide::selectLess(angle, far, c, cosineSmall(half));
    }
    D p = w * s, unit = D(1) / wide::sqrt(p * p + c * c), r = c * unit;
    p = p * unit;
    D tj = p * momentum[k] * D(2), tk = -(p * momentum[j]) * D(2);
    momentum[j] = momentum[j] + tj * r + p * tk;
    momentum[k] = momentum[k] + tk * r - p * tj;
    D a = turned[i], b = turned[j], d = turned[k], e = turned[3];
    turned[i] = e * p + a * r;
    turned[j] = b * r + d * p;
    turned[k] = d * r - b * p;
    turned[3] = e * r - a * p;
  }
};

// Its substeps are few, and no zero but such as arise on the way is among its numbers: their signs would tell.
bool fitsLane(Vec3 momentum, const PrincipalInertia& inertia, double dt, int substeps) {
  Vec3 spin = abs(scaled(inertia.inverse, momentum)) * dt, size = abs(momentum);
  bool seen = spin.x > kLeastSpin && spin.y > kLeastSpin && spin.z > kLeastSpin && size.x > kLeastSpin &&
              size.y > kLeastSpin && size.z > kLeastSpin;
  return seen && substeps <= kMostLaneSubsteps;
}

}  // namespace

void turnFreely(FreeTurn* turns, int count, double dt) {
  TurningLanes lanes;
  int laneOf[kTurnsAtOnce], substeps[kTurnsAtOnce] = {}, used = 0, most = 0;
  for (int n = 0; n < count; n++) {
    FreeTurn& t = turns[n];
    Vec3 momentum = principalMomentum(t.rotation, t.angularMomentum, t.inertia);
    const int its = substepsFor(momentum, t.inertia, dt);
    laneOf[n] = fitsLane(momentum, t.inertia, dt, its) ? used++ : -1;
    if (laneOf[n] < 0) {
      t.rotation = turnFreely(t.rotation, t.angularMomentum, t.inertia, dt);
      continue;
    }
    const Vec3& inverse = t.inertia.inverse;
    double largest = std::max({inverse.x, inverse.y, inverse.z}) * length(momentum) * dt;
    lanes.bySeries = lanes.bySeries && largest < kSeriesAngle;
    most = std::max(most, substeps[laneOf[n]] = its);
    for (int lane = laneOf[n]; lane < (used == 1 ? kTurnsAtOnce : used); lane++)  // the first one fills what stays free
      for (int i = 0; i < 3; i++) {
        lanes.inverse[i].set(lane, inverse[i]);
        lanes.momentum[i].set(lane, momentum[i]);
      }
  }
  if (used == 0) return;
  for (int s = 0; s < most; s++) {
    auto times = [&](double share) {
      D h(0);
      for (int lane = 0; lane < used; lane++)
        if (s < substeps[lane]) h.set(lane, timeOf(share, dt, substeps[lane]));
      return h;
    };
    splitTurn(times, [&](int axis, D time) { lanes.turn(axis, time); });
  }
  for (int n = 0; n < count; n++) {
    if (laneOf[n] < 0) continue;
    const int lane = laneOf[n];
    auto at = [&](int i) { return lanes.turned[i][lane]; };
    turns[n].rotation = afterTurn(turns[n].rotation, {at(0), at(1), at(2), at(3)}, turns[n].inertia);
  }
}

}  // namespace brickfall
