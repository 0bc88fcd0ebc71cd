#include "solver/acceleration.h"

#include <algorithm>

#include "solver/slope_search.h"

namespace brickfall {

namespace {

//! not of the method: bodies that are summed as floats before a double takes over
constexpr std::size_t kRun = 64;

using wide::V;

V forceOf(const Wrench& w) { return wide::load3(w.force); }
V torqueOf(const Wrench& w) { return wide::load3(w.torque); }
V wayOf(const SolveMotion& m) { return wide::load(&m.d.x); }
V turnOf(const SolveMotion& m) { return wide::load(&m.th.x); }
double total(V v) { return (double(v[0]) + double(v[2])) + (double(v[1]) + double(v[3])); }

// Sums over bodies: add(body, sums) a run as floats, then as doubles.
template <std::size_t n, class Add> std::array<double, n> sumOver(std::size_t bodies, Add add) {
  std::array<double, n> out{};
  for (std::size_t from = 0; from < bodies; from += kRun) {
    V run[n] = {};
    for (std::size_t k = from; k < std::min(bodies, from + kRun); k++) add(k, run);
    for (std::size_t i = 0; i < n; i++) out[i] += total(run[i]);
  }
  return out;
}

// The minimum along the changes, newest first. Changes that are like newer ones are left out. Of the matrix, only
// entries right of the diagonal are read.
template <std::size_t most>
std::array<double, most> minimum(int count, const double (&matrix)[most][most], const std::array<double, most>& slope) {
  double lower[most][most] = {}, pivot[most] = {}, right[most] = {};
  for (int j = 0; j < count; j++) {
    pivot[j] = matrix[j][j];
    right[j] = slope[std::size_t(j)];
    for (int k = 0; k < j; k++) {
      if (!(pivot[k] > 0)) continue;
      double s = matrix[k][j];
      for (int l = 0; l < k; l++) s -= lower[j][l] * lower[k][l] * pivot[l];
      lower[j][k] = s / pivot[k];
      pivot[j] -= lower[j][k] * s;
      right[j] -= lower[j][k] * right[k];
    }
    // A trifle of the change is across the newer ones: it is alike. Its curvature is that of a square.
    if (!(pivot[j] > kTrifle * kTrifle * matrix[j][j])) pivot[j] = 0;
  }
  std::array<double, most> out{};
  for (int j = count - 1; j >= 0; j--) {
    if (!(pivot[j] > 0)) continue;
    double x = right[j] / pivot[j];
    for (int i = j + 1; i < count; i++) x -= lower[i][j] * out[std::size_t(i)];
    out[std::size_t(j)] = x;
  }
  return out;
}

}  // namespace

Acceleration::Change* Acceleration::change(int age) {
  return changes_.data() + std::size_t((made_ - 1 - age) % kChanges) * island_.bodies.size();
}

void Acceleration::begin() {
  if (begun_) return;
  begun_ = true;
  startMotion_.assign(island_.motion.begin(), island_.motion.begin() + std::ptrdiff_t(island_.bodies.size()));
  startResidual_.assign(island_.residual.begin(), island_.residual.end());
}

Acceleration::Change* Acceleration::nextChange() {
  changes_.resize(kChanges * island_.bodies.size());
  made_++;
  count_ = std::min(count_ + 1, kChanges);
  return change(0);
}

Acceleration::Change Acceleration::changeOf(std::size_t body) const {
  const SolveMotion &now = island_.motion[body], &was = startMotion_[body];
  const Wrench &left = island_.residual[body], &had = startResidual_[body];
  Change out;
  out.way.d = now.d - was.d;
  out.way.th = now.th - was.th;
  out.fell.force = had.force - left.force;
  out.fell.torque = had.torque - left.torque;
  return out;
}

void Acceleration::end() {
  Change* out = nextChange();
  for (std::size_t i = 0; i < island_.bodies.size(); i++) out[i] = changeOf(i);
  begun_ = false;
}

void Acceleration::end(const std::pmr::vector<std::uint32_t>& changed) {
  Change* out = nextChange();
  std::fill(out, out + island_.bodies.size(), Change{});
  for (std::uint32_t i : changed) {
    out[i] = changeOf(i);
    startMotion_[i] = island_.motion[i];
    startResidual_[i] = island_.residual[i];
  }
}

Acceleration::Curvature Acceleration::curvature() {
  Curvature out;
  for (int i = 0; i < count_; i++) {
    const Change *ways = change(i), *older[kChanges] = {};
    for (int j = i; j < count_; j++) older[j] = change(j);
    auto sums = sumOver<kChanges>(island_.bodies.size(), [&](std::size_t k, V* run) {
      V way = wayOf(ways[k].way), turn = turnOf(ways[k].way);
      for (int j = i; j < count_; j++) run[j] += way * forceOf(older[j][k].fell) + turn * torqueOf(older[j][k].fell);
    });
    for (int j = i; j < count_; j++) out.of[i][j] = sums[std::size_t(j)];
  }
  return out;
}

Acceleration::Shares Acceleration::slopes() {
  const Change* ways[kChanges] = {};
  for (int i = 0; i < count_; i++) ways[i] = change(i);
  return sumOver<kChanges>(island_.bodies.size(), [&](std::size_t k, V* run) {
    V force = forceOf(island_.residual[k]), torque = torqueOf(island_.residual[k]);
    for (int i = 0; i < count_; i++) run[i] += wayOf(ways[i][k].way) * force + turnOf(ways[i][k].way) * torque;
  });
}

double Acceleration::slopeAlong(const Shares& shares) {
  Shares now = slopes();
  double sum = 0;
  for (int j = 0; j < count_; j++) sum += shares[std::size_t(j)] * now[std::size_t(j)];
  return sum;
}

template <class WayOf> void Acceleration::addWays(const Shares& shares, double part, WayOf wayOf) {
  for (int j = 0; j < count_; j++) {
    float share = float(shares[std::size_t(j)] * part);
    const Change* c = change(j);
    for (std::size_t k = 0; k < island_.bodies.size(); k++) {
      wayOf(k).d += c[k].way.d * share;
      wayOf(k).th += c[k].way.th * share;
    }
  }
}

void Acceleration::moveBy(const Shares& shares, double part) {
  addWays(shares, part, [&](std::size_t k) -> SolveMotion& { return island_.motion[k]; });
}

void Acceleration::makeNewestWhole(const Shares& shares, double part) {
  Change* whole = change(0);
  addWays(shares, part, [&](std::size_t k) -> SolveMotion& { return whole[k].way; });
  for (std::size_t k = 0; k < island_.bodies.size(); k++) {
    whole[k].fell.force += startResidual_[k].force - island_.residual[k].force;
    whole[k].fell.torque += startResidual_[k].torque - island_.residual[k].torque;
  }
}

void Acceleration::apply(RowForces& forces) {
  if (count_ == 0) return;
  Shares shares = minimum(count_, curvature().of, slopes());
  double start = slopeAlong(shares), part = 1;
  if (!(start > 0)) return;
  begin();
  begun_ = false;
  moveBy(shares, part);
  forces.readAgain();
  double slope = slopeAlong(shares);
  if (!(slope > -kFarFromMinimum * start)) {
    double shorter = start / (start - slope);
    moveBy(shares, shorter - part);
    part = shorter;
    forces.readAgain();
    if (!(slopeAlong(shares) > -kFarFromMinimum * start)) {  // also if it is not a number
      std::copy(startMotion_.begin(), startMotion_.end(), island_.motion.begin());
      forces.readAgain();
      return;
    }
  }
  makeNewestWhole(shares, part);
}

}  // namespace brickfall
