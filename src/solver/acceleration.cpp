#include "solver/acceleration.h"

#include <algorithm>

namespace brickfall {

namespace {

//! - | too small: rounding is taken for a way of its own | too large: changes that are alike are lost
constexpr double kAlike = 1e-4;  // of a change's own curvature: what is left of it across the newer ones
//! - | too small: cost | too large: P may end far beyond its minimum
constexpr double kTooFar = 0.5;  // of the slope at its start
//! not of the method: bodies that are summed as floats before a double takes over
constexpr std::size_t kRun = 64;

using wide::V;

V forceOf(const Wrench& w) { return wide::load3(w.force); }
V torqueOf(const Wrench& w) { return wide::load3(w.torque); }
V wayOf(const SolveMotion& m) { return wide::load(&m.d.x); }
V turnOf(const SolveMotion& m) { return wide::load(&m.th.x); }
double total(V v) { return (double(v[0]) + double(v[2])) + (double(v[1]) + double(v[3])); }

// The minimum along the changes, newest first; those that are like newer ones are left out.
template <int most>
void sharesOf(int count, const double (&curvature)[most][most], const double* slope, double* shares) {
  double lower[most][most] = {}, pivot[most] = {}, right[most] = {};
  auto symmetric = [&](int i, int j) { return 0.5 * (curvature[i][j] + curvature[j][i]); };
  for (int j = 0; j < count; j++) {
    pivot[j] = symmetric(j, j);
    right[j] = slope[j];
    for (int k = 0; k < j; k++) {
      if (!(pivot[k] > 0)) continue;
      double s = symmetric(j, k);
      for (int l = 0; l < k; l++) s -= lower[j][l] * lower[k][l] * pivot[l];
      lower[j][k] = s / pivot[k];
      pivot[j] -= lower[j][k] * s;
      right[j] -= lower[j][k] * right[k];
    }
    if (!(pivot[j] > kAlike * symmetric(j, j))) pivot[j] = 0;
  }
  for (int j = count - 1; j >= 0; j--) {
    shares[j] = pivot[j] > 0 ? right[j] / pivot[j] : 0;
    for (int i = j + 1; i < count && pivot[j] > 0; i++) shares[j] -= lower[i][j] * shares[i];
  }
}

}  // namespace

const Acceleration::Change* Acceleration::change(int age) const {
  return changes_.data() + std::size_t((made_ - 1 - age) % kChanges) * island_.bodies.size();
}
Acceleration::Change* Acceleration::newest() { return const_cast<Change*>(change(0)); }

void Acceleration::begin() {
  startMotion_.assign(island_.motion.begin(), island_.motion.begin() + std::ptrdiff_t(island_.bodies.size()));
  startResidual_.assign(island_.residual.begin(), island_.residual.end());
}

void Acceleration::end() {
  std::size_t bodies = island_.bodies.size();
  changes_.resize(kChanges * bodies);
  made_++;
  count_ = std::min(count_ + 1, kChanges);
  Change* out = newest();
  for (std::size_t i = 0; i < bodies; i++) {
    const SolveMotion &now = island_.motion[i], &was = startMotion_[i];
    out[i].way.d = now.d - was.d;
    out[i].way.th = now.th - was.th;
    out[i].fell.d = startResidual_[i].force - island_.residual[i].force;
    out[i].fell.th = startResidual_[i].torque - island_.residual[i].torque;
  }
}

Acceleration::Products Acceleration::products() const {
  Products out;
  std::size_t bodies = island_.bodies.size();
  for (std::size_t from = 0; from < bodies; from += kRun) {
    V curvature[kChanges][kChanges] = {}, slope[kChanges] = {};
    for (std::size_t k = from; k < std::min(bodies, from + kRun); k++) {
      V force = forceOf(island_.residual[k]), torque = torqueOf(island_.residual[k]);
      for (int i = 0; i < count_; i++) {
        V way = wayOf(change(i)[k].way), turn = turnOf(change(i)[k].way);
        slope[i] += way * force + turn * torque;
        for (int j = 0; j < count_; j++)
          curvature[i][j] += way * wayOf(change(j)[k].fell) + turn * turnOf(change(j)[k].fell);
      }
    }
    for (int i = 0; i < count_; i++) {
      out.slope[i] += total(slope[i]);
      for (int j = 0; j < count_; j++) out.curvature[i][j] += total(curvature[i][j]);
    }
  }
  return out;
}

void Acceleration::moveBy(const double* shares, double part) {
  for (int j = 0; j < count_; j++) {
    float share = float(shares[j] * part);
    const Change* c = change(j);
    for (std::size_t k = 0; k < island_.bodies.size(); k++) {
      island_.motion[k].d += c[k].way.d * share;
      island_.motion[k].th += c[k].way.th * share;
    }
  }
}

double Acceleration::slopeAlong(const double* shares) const {
  Products now = products();
  double sum = 0;
  for (int j = 0; j < count_; j++) sum += shares[j] * now.slope[j];
  return sum;
}

void Acceleration::makeNewestWhole(const double* shares, double part) {
  Change* whole = newest();
  for (std::size_t k = 0; k < island_.bodies.size(); k++) {
    Vec3f way, turn;
    for (int j = 0; j < count_; j++) {
      float share = float(shares[j] * part);
      way += change(j)[k].way.d * share;
      turn += change(j)[k].way.th * share;
    }
    whole[k].way.d += way;
    whole[k].way.th += turn;
    whole[k].fell.d += startResidual_[k].force - island_.residual[k].force;
    whole[k].fell.th += startResidual_[k].torque - island_.residual[k].torque;
  }
}

void Acceleration::apply(RowForces& forces) {
  if (count_ == 0) return;
  Products now = products();
  double shares[kChanges] = {}, start = 0, part = 1;
  sharesOf(count_, now.curvature, now.slope, shares);
  for (int j = 0; j < count_; j++) start += shares[j] * now.slope[j];
  if (!(start > 0)) return;
  startResidual_.assign(island_.residual.begin(), island_.residual.end());
  moveBy(shares, part);
  forces.readAgain();
  double slope = slopeAlong(shares);
  if (!(slope > -kTooFar * start)) {
    double shorter = start / (start - slope);
    moveBy(shares, shorter - part);
    part = shorter;
    forces.readAgain();
    if (!(slopeAlong(shares) > -kTooFar * start)) {
      moveBy(shares, -part);
      forces.readAgain();
      return;
    }
  }
  makeNewestWhole(shares, part);
}

}  // namespace brickfall
