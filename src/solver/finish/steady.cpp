#include "solver/finish/steady.h"

#include <cmath>

namespace brickfall {

namespace {

//! g h | too small: slides and rolls lose half a step of way
//! | too large: bodies that land or leave get a correction that is not theirs
constexpr double kSteadyShare = 0.2;  // of g dt: a smaller change of a normal velocity counts as none

}  // namespace

double changeAtPoint(const ContactRecord& row, int i, const VelocityChange& a, const VelocityChange& b) {
  Vec3 n = toDouble(row.n), t1 = toDouble(row.t1);
  Vec3 off = t1 * double(row.s1[i]) + cross(n, t1) * double(row.s2[i]);
  return dot(n, b.move + cross(b.turn, toDouble(row.armB) + off) - a.move - cross(a.turn, toDouble(row.armA) + off));
}

bool isSteady(const ContactRecord& row, const ContactStart& start, int i, const VelocityChange& a,
              const VelocityChange& b, double dt, double expected) {
  const double most = kSteadyShare * start.scale.gravity * dt;
  return std::fabs(changeAtPoint(row, i, a, b) - expected) <= most && std::fabs(start.approach[i]) <= most;
}

}  // namespace brickfall
