#include "support/newton_oracle.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

namespace brickfall::oracle {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Jacobian = Eigen::Matrix<double, 3, 6>;
using Sparse = Eigen::SparseMatrix<double>;

// Displacement of a body's point at `arm` from its (d, th): [1, -[arm]].
Jacobian jacobian(Vec3 arm) {
  Jacobian j;
  j << 1, 0, 0, 0, arm.z, -arm.y, 0, 1, 0, -arm.z, 0, arm.x, 0, 0, 1, arm.y, -arm.x, 0;
  return j;
}

Eigen::Matrix3d toEigen(const Mat3& m) {
  Eigen::Matrix3d out;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) out(i, j) = m.row[i][j];
  return out;
}

class Newton {
 public:
  Newton(const Problem& problem, const std::vector<Motion>& start) : problem_(problem) {
    for (const Motion& m : start) x_.push_back({as<long double>(m.d), as<long double>(m.th)});
  }

  std::vector<Motion> rounded() const {
    std::vector<Motion> out;
    for (const FineMotion& m : x_) out.push_back({as<double>(m.d), as<double>(m.th)});
    return out;
  }
  Imbalance left() const { return imbalanceOf(problem_, residuals(problem_, x_)); }

  // One step to the minimum along Newton's direction. False if rounding leaves nothing to gain.
  bool step() {
    Eigen::VectorXd direction = solve(residuals(problem_, x_));
    double slopeAtStart = slope(direction, 0);
    if (!(slopeAtStart > 0)) return false;
    double t = search(direction, slopeAtStart);
    move(direction, t);
    return t > 0;
  }

 private:
  // Pattern and order of elimination are found once: contacts of the step stay, whether loaded or not.
  Eigen::VectorXd solve(const std::vector<Load>& residual) {
    Sparse matrix = hessian();
    if (!analysed_) factor_.analyzePattern(matrix);
    analysed_ = true;
    factor_.factorize(matrix);
    Eigen::VectorXd right(6 * Eigen::Index(residual.size()));
    for (std::size_t i = 0; i < residual.size(); i++)
      for (int k = 0; k < 3; k++) {
        right[6 * Eigen::Index(i) + k] = residual[i].force[k];
        right[6 * Eigen::Index(i) + 3 + k] = residual[i].torque[k];
      }
    return factor_.solve(right);
  }

  Sparse hessian() const {
    std::vector<Eigen::Triplet<double>> entries;
    auto add = [&](int row, int column, const Matrix6& block) {
      for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
          if (6 * row + i >= 6 * column + j) entries.emplace_back(6 * row + i, 6 * column + j, block(i, j));
    };
    int count = int(problem_.bodies.size());
    double perDt2 = 1 / (problem_.dt * problem_.dt);
    for (int i = 0; i < count; i++) {
      const ProblemBody& b = problem_.bodies[std::size_t(i)];
      Matrix6 block = Matrix6::Zero();
      block.topLeftCorner<3, 3>() = Eigen::Matrix3d::Identity() * (b.mass * perDt2);
      block.bottomRightCorner<3, 3>() = toEigen(b.inertia) * perDt2;
      add(i, i, block);
    }
    for (const ProblemPoint& p : problem_.points) {
      Eigen::Matrix3d k = toEigen(pointStiffness(p, pointForce(problem_, p, x_)));
      Jacobian a = jacobian(p.armA), b = jacobian(p.armB);
      if (p.a < count) add(p.a, p.a, a.transpose() * k * a);
      if (p.b < count) add(p.b, p.b, b.transpose() * k * b);
      if (p.a < count && p.b < count) {
        if (p.a > p.b)
          add(p.a, p.b, -(a.transpose() * k * b));
        else
          add(p.b, p.a, -(b.transpose() * k * a));
      }
    }
    Sparse out(6 * count, 6 * count);
    out.setFromTriplets(entries.begin(), entries.end());
    return out;
  }

  std::vector<FineMotion> at(const Eigen::VectorXd& direction, double t) const {
    std::vector<FineMotion> y = x_;
    for (std::size_t i = 0; i < y.size(); i++)
      for (int k = 0; k < 3; k++) {
        y[i].d[k] += t * direction[6 * Eigen::Index(i) + k];
        y[i].th[k] += t * direction[6 * Eigen::Index(i) + 3 + k];
      }
    return y;
  }
  void move(const Eigen::VectorXd& direction, double t) { x_ = at(direction, t); }

  // How fast the energy falls along the direction: falls itself with t, and is zero at the minimum.
  double slope(const Eigen::VectorXd& direction, double t) const {
    std::vector<Load> r = residuals(problem_, at(direction, t));
    double sum = 0;
    for (std::size_t i = 0; i < r.size(); i++)
      for (int k = 0; k < 3; k++)
        sum += r[i].force[k] * direction[6 * Eigen::Index(i) + k] +
               r[i].torque[k] * direction[6 * Eigen::Index(i) + 3 + k];
    return sum;
  }

  // A bracket of the minimum, then the Illinois rule.
  double search(const Eigen::VectorXd& direction, double slopeAtStart) const {
    double enough = 1e-3 * slopeAtStart;
    double low = 0, high = 1, slopeLow = slopeAtStart, slopeHigh = slope(direction, 1);
    if (std::fabs(slopeHigh) <= 0.1 * slopeAtStart) return 1;
    while (slopeHigh > 0 && high < 1e6) {
      low = high;
      slopeLow = slopeHigh;
      high *= 2;
      slopeHigh = slope(direction, high);
    }
    double t = high;
    for (int k = 0; k < 80; k++) {
      t = low + (high - low) * slopeLow / (slopeLow - slopeHigh);
      if (k % 3 == 2) t = 0.5 * (low + high);
      double s = slope(direction, t);
      if (std::fabs(s) <= enough) break;
      if (s > 0) {
        low = t;
        slopeLow = s;
        slopeHigh *= 0.5;
      } else {
        high = t;
        slopeHigh = s;
        slopeLow *= 0.5;
      }
    }
    return t;
  }

  const Problem& problem_;
  std::vector<FineMotion> x_;
  Eigen::SimplicialLLT<Sparse, Eigen::Lower> factor_;
  bool analysed_ = false;
};

std::vector<Motion> freeMotion(const Problem& problem) {
  std::vector<Motion> out;
  for (const ProblemBody& b : problem.bodies) out.push_back({b.dFree, b.thFree});
  return out;
}

Solution solveFrom(const Problem& problem, const std::vector<Motion>& start, const NewtonSettings& settings) {
  Newton newton(problem, start);
  Solution out;
  for (;;) {
    out.motion = newton.rounded();
    out.left = newton.left();
    out.converged = out.left.worst() <= settings.tolerance;
    if (out.converged || out.iterations >= settings.iterations || !newton.step()) return out;
    out.iterations++;
  }
}

}  // namespace

Solution solveFrozen(const Problem& problem, const NewtonSettings& settings) {
  return solveFrom(problem, freeMotion(problem), settings);
}

Solution solveWithNewBounds(Problem& problem, const NewtonSettings& settings, int rounds) {
  Solution out;
  out.motion = freeMotion(problem);
  int iterations = 0;
  for (int round = 1;; round++) {
    out = solveFrom(problem, out.motion, settings);
    out.iterations = iterations += out.iterations;
    out.rounds = round;
    double changed = 0;  // in weights of the lighter body
    for (ProblemPoint& p : problem.points) {
      if (!p.carriedNothing) continue;
      double bound = p.friction * std::min(pointForce(problem, p, out.motion).n, p.newBound);
      double weight = 1e300;
      for (int body : {p.a, p.b})
        if (std::size_t(body) < problem.bodies.size())
          weight = std::min(weight, problem.bodies[std::size_t(body)].mass * 9.81);
      changed = std::max(changed, std::fabs(bound - p.limit) / weight);
      p.limit = bound;
    }
    if (changed <= 1e-9) return out;
    if (round == rounds) {
      out.converged = false;
      return out;
    }
  }
}

}  // namespace brickfall::oracle
