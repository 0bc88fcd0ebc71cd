#include "support/newton_law.h"

#include <algorithm>
#include <cmath>

namespace brickfall::oracle {

namespace {

template <class T> MotionOf<T> motionOf(const Problem& problem, const std::vector<MotionOf<T>>& x, int body) {
  std::size_t i = std::size_t(body), n = problem.bodies.size();
  if (i < n) return x[i];
  return {as<T>(problem.partners[i - n].d), as<T>(problem.partners[i - n].th)};
}

}  // namespace

template <class T>
PointForceOf<T> pointForce(const Problem& problem, const ProblemPoint& p, const std::vector<MotionOf<T>>& x) {
  const MotionOf<T> a = motionOf(problem, x, p.a), b = motionOf(problem, x, p.b);
  const Vec3T<T> n = as<T>(p.n);
  Vec3T<T> moved = (b.d - a.d) + cross(b.th, as<T>(p.armB)) - cross(a.th, as<T>(p.armA));
  T along = dot(n, moved), k = p.k;
  PointForceOf<T> f;
  f.trialN = p.trialN - k * along;
  f.n = std::max(T(0), f.trialN);
  f.trialT = as<T>(p.trialT) - (moved - n * along) * k;
  T size = length(f.trialT);
  f.slides = size > p.limit;
  f.t = f.slides ? f.trialT * (p.limit / size) : f.trialT;
  return f;
}

template PointForce pointForce(const Problem&, const ProblemPoint&, const std::vector<Motion>&);
template PointForceOf<long double> pointForce(const Problem&, const ProblemPoint&, const std::vector<FineMotion>&);

std::vector<PointForce> pointForces(const Problem& problem, const std::vector<Motion>& x) {
  std::vector<PointForce> out;
  out.reserve(problem.points.size());
  for (const ProblemPoint& p : problem.points) out.push_back(pointForce(problem, p, x));
  return out;
}

template <class T> Mat3 pointStiffness(const ProblemPoint& p, const PointForceOf<T>& f) {
  Mat3 out{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  auto add = [&](Vec3 along, double k) {
    for (int i = 0; i < 3; i++) out.row[i] += along * (along[i] * k);
  };
  if (f.loaded()) add(p.n, p.k);
  if (!f.slides) {
    add(p.t1, p.k);
    add(p.t2, p.k);
  } else if (p.limit > 0) {
    const Vec3 trial = as<double>(f.trialT);
    double size = length(trial);
    add(cross(p.n, trial * (1 / size)), p.k * p.limit / size);  // only across the slip
  }
  return out;
}

template Mat3 pointStiffness(const ProblemPoint&, const PointForce&);
template Mat3 pointStiffness(const ProblemPoint&, const PointForceOf<long double>&);

template <class T> std::vector<Load> residuals(const Problem& problem, const std::vector<MotionOf<T>>& x) {
  std::vector<Vec3T<T>> force(problem.bodies.size()), torque(problem.bodies.size());
  const T dt = problem.dt, perDt2 = 1 / (dt * dt);
  for (std::size_t i = 0; i < force.size(); i++) {
    const ProblemBody& b = problem.bodies[i];
    force[i] = (as<T>(b.dFree) - x[i].d) * (b.mass * perDt2);
    torque[i] = as<T>(b.inertia) * (as<T>(b.thFree) - x[i].th) * perDt2;
  }
  for (const ProblemPoint& p : problem.points) {
    PointForceOf<T> f = pointForce(problem, p, x);
    Vec3T<T> onB = as<T>(p.n) * f.n + f.t;
    if (std::size_t(p.a) < force.size()) {
      force[std::size_t(p.a)] -= onB;
      torque[std::size_t(p.a)] -= cross(as<T>(p.armA), onB);
    }
    if (std::size_t(p.b) < force.size()) {
      force[std::size_t(p.b)] += onB;
      torque[std::size_t(p.b)] += cross(as<T>(p.armB), onB);
    }
  }
  std::vector<Load> out;
  out.reserve(force.size());
  for (std::size_t i = 0; i < force.size(); i++) out.push_back({as<double>(force[i]), as<double>(torque[i])});
  return out;
}

template std::vector<Load> residuals(const Problem&, const std::vector<Motion>&);
template std::vector<Load> residuals(const Problem&, const std::vector<FineMotion>&);

double stepEnergy(const Problem& problem, const std::vector<Motion>& x) {
  double sum = 0, perDt2 = 1 / (problem.dt * problem.dt);
  for (std::size_t i = 0; i < problem.bodies.size(); i++) {
    const ProblemBody& b = problem.bodies[i];
    Vec3 e = b.dFree - x[i].d, t = b.thFree - x[i].th;
    sum += 0.5 * perDt2 * (b.mass * dot(e, e) + dot(t, b.inertia * t));
  }
  for (const ProblemPoint& p : problem.points) {
    PointForce f = pointForce(problem, p, x);
    double size = length(f.trialT);
    sum += f.n * f.n / (2 * p.k);
    sum += f.slides ? (p.limit * size - 0.5 * p.limit * p.limit) / p.k : size * size / (2 * p.k);
  }
  return sum;
}

Imbalance imbalanceOf(const Problem& problem, const std::vector<Load>& residual) {
  Imbalance out;
  double squares = 0, energy = 0;
  for (std::size_t i = 0; i < residual.size(); i++) {
    const ProblemBody& b = problem.bodies[i];
    double weight = b.mass * kWeightUnit, force = length(residual[i].force) / weight;
    out.force = std::max(out.force, force);
    out.torque = std::max(out.torque, length(residual[i].torque) / (weight * b.inner));
    squares += force * force;
    energy +=
        dot(residual[i].force, residual[i].force) / b.mass + dot(residual[i].torque, b.invInertia * residual[i].torque);
  }
  out.rmsForce = std::sqrt(squares / double(residual.size()));
  out.mean = std::sqrt(energy / problem.mass()) / kWeightUnit;
  return out;
}

Imbalance imbalanceAt(const Problem& problem, const std::vector<Motion>& x) {
  return imbalanceOf(problem, residuals(problem, x));
}

Deviation deviationOf(const Problem& problem, const std::vector<Motion>& x, const std::vector<Motion>& y) {
  Deviation out;
  double sum = 0;
  for (std::size_t i = 0; i < problem.bodies.size(); i++) {
    const ProblemBody& b = problem.bodies[i];
    Vec3 d = x[i].d - y[i].d, th = x[i].th - y[i].th;
    sum += b.mass * dot(d, d) + dot(th, b.inertia * th);
    out.largest = std::max(out.largest, length(d) + length(th) * b.outer);
  }
  out.mean = std::sqrt(sum / problem.mass()) / (kWeightUnit * problem.dt * problem.dt);
  return out;
}

}  // namespace brickfall::oracle
