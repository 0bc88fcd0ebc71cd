#include "solver/body_newton.h"

#include <algorithm>

#include "solver/locks.h"

namespace brickfall {

void BodyNewton::findPlaces() {
  Adjacency neighbours(island.memory);
  neighbours.fill(std::uint32_t(bodies.size()), [this](auto visit) {
    std::as_const(island.rows).each([&](const auto& kind, std::size_t k) {
      const RowEnds ends = kind.ends(k);
      if (has(ends.a) && has(ends.b)) visit(place[ends.a], place[ends.b]);
    });
  });
  const std::pmr::vector<std::uint32_t> places = nearPlaces(neighbours);
  matrix.shape(lowestPlaces(neighbours, places));
  for (std::size_t i = 0; i < bodies.size(); i++) place[bodies[i]] = places[i];
  step.resize(6 * bodies.size());
  if (island.facts.firm) rounding.resize(place.size());
}

void BodyNewton::beginMatrix() {
  matrix.clear();
  std::fill(rounding.begin(), rounding.end(), Rounding());
  for (std::uint32_t body : bodies) addBody(matrix, place[body], island.masses[body]);
}

bool BodyNewton::factor() {
  if (anyLocks(island))
    for (std::uint32_t body : bodies) matrix.stiffen(place[body], island.locks[body], kLockedStiffness);
  return matrix.factor();
}

void BodyNewton::takeResiduals() {
  for (std::uint32_t body : bodies)
    for (int k = 0; k < 3; k++) {
      entry(body, k) = double(island.residual[body].force[k]);
      entry(body, k + 3) = double(island.residual[body].torque[k]);
    }
}

void BodyNewton::solve() {
  matrix.solve(step.data());
  if (!anyLocks(island)) return;
  for (std::uint32_t body : bodies)
    for (int k = 0; k < 6; k++)
      if (island.locks[body] >> k & 1) entry(body, k) = 0;
}

double BodyNewton::slope() const {
  double sum = 0;
  for (std::uint32_t body : bodies)
    for (int k = 0; k < 3; k++)
      sum += double(island.residual[body].force[k]) * entry(body, k) +
             double(island.residual[body].torque[k]) * entry(body, k + 3);
  return sum;
}

void BodyNewton::begin() {
  from.clear();
  for (std::uint32_t body : bodies) from.push_back(island.motion[body]);
}

void BodyNewton::moveBodies(double part) {
  for (std::size_t i = 0; i < bodies.size(); i++) {
    SolveMotion& m = island.motion[bodies[i]];
    for (int k = 0; k < 3; k++) {
      m.d[k] = float(double(from[i].d[k]) + part * entry(bodies[i], k));
      m.th[k] = float(double(from[i].th[k]) + part * entry(bodies[i], k + 3));
    }
  }
}

}  // namespace brickfall
