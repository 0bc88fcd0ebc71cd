#include "support/newton_law.h"

#include <algorithm>
#include <cmath>

namespace brickfall::oracle {

namespace {

const Motion& motionOf(const Problem& problem, const std::vector<Motion>& x, int body) {
  std::size_t i = std::size_t(body), n = problem.bodies.size();
  return i < n ? x[i] : problem.partners[i - n];
}

}  // namespace

PointForce pointForce(const Problem& problem, const ProblemPoint& p, const std::vector<Motion>& x) {
  const Motion &a = motionOf(problem, x, p.a), &b = motionOf(problem, x, p.b);
  Vec3 moved = (b.d - a.d) + cross(b.th, p.armB) - cross(a.th, p.armA);
  double along = dot(p.n, moved);
  PointForce f;
  f.trialN = p.trialN - p.k * along;
  f.n = std::max(0.0, f.trialN);
  f.trialT = p.trialT - (moved - p.n * along) * p.k;
  double size = length(f.trialT);
  f.slides = size > p.limit;
  f.t = f.slides ? f.trialT * (p.limit / size) : f.trialT;
  return f;
}

std::vector<PointForce> pointForces(const Problem& problem, const std::vector<Motion>& x) {
  std::vector<PointForce> out;
  out.reserve(problem.points.size());
  for (const ProblemPoint& p : problem.points) out.push_back(pointForce(problem, p, x));
  return out;
}

Mat3 pointStiffness(const ProblemPoint& p, const PointForce& f) {
  Mat3 out{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};
  auto add = [&](Vec3 along, double k) {
    for (int i = 0; i < 3; i++) out.row[i] += along * (along[i] * k);
  };
  if (f.loaded()) add(p.n, p.k);
  if (!f.slides) {
    add(p.t1, p.k);
    add(p.t2, p.k);
  } else if (p.limit > 0) {
    double size = length(f.trialT);
    add(cross(p.n, f.trialT * (1 / size)), p.k * p.limit / size);  // only across the slip
  }
  return out;
}

std::vector<Load> residuals(const Problem& problem, const std::vector<Motion>& x) {
  std::vector<Load> out(problem.bodies.size());
  double perDt2 = 1 / (problem.dt * problem.dt);
  for (std::size_t i = 0; i < out.size(); i++) {
    const ProblemBody& b = problem.bodies[i];
    out[i].force = (b.dFree - x[i].d) * (b.mass * perDt2);
    out[i].torque = b.inertia * (b.thFree - x[i].th) * perDt2;
  }
  for (const ProblemPoint& p : problem.points) {
    PointForce f = pointForce(problem, p, x);
    Vec3 onB = p.n * f.n + f.t;
    if (std::size_t(p.a) < out.size()) {
      out[std::size_t(p.a)].force -= onB;
      out[std::size_t(p.a)].torque -= cross(p.armA, onB);
    }
    if (std::size_t(p.b) < out.size()) {
      out[std::size_t(p.b)].force += onB;
      out[std::size_t(p.b)].torque += cross(p.armB, onB);
    }
  }
  return out;
}

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
