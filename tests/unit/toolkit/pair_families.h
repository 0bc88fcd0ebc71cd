// Random pairs of boxes of every kind that gives trouble, by family.
#pragma once
#include <cmath>

#include "brickfall/geometry/obb_motion.h"
#include "slow_boxes.h"
#include "support/random_geometry.h"

namespace brickfall::test {

enum class Family {
  generic,          // nothing in common
  aligned,          // axes parallel or permuted, in a turned frame
  sharedNormal,     // one pair of face normals parallel
  sharedEdge,       // edge lying on a face: one pair of cosines zero
  nearParallel,     // frames 1e-1 .. 1e-15 rad apart
  oneNearParallel,  // one pair of axes 1e-1 .. 1e-15 rad apart
  crossedEdges,     // the same, and those edges meet: only their own row can part them
  sizeRatio,        // up to 1e6
  thin,             // plates and needles, down to 1e-4 of the length
  farAway,          // 1e4 sizes from the origin
  nested,           // one in the other, some concentric
  count
};
inline const char* nameOf(Family family) {
  const char* names[] = {"generic",      "aligned",   "sharedNormal", "sharedEdge", "nearParallel", "oneNearParallel",
                         "crossedEdges", "sizeRatio", "thin",         "farAway",    "nested"};
  return names[int(family)];
}

struct FamilyPair {
  ObbMotion motion;
  double angle = 0;  // of what is nearly parallel, rad
};

namespace family_detail {

inline Vec3 randomHalf(Random& random) {
  return {random.between(0.2, 1.5), random.between(0.2, 1.5), random.between(0.2, 1.5)};
}
inline double powerOfTen(Random& random, double low, double high) { return std::pow(10, random.between(low, high)); }
inline Mat3 rows(Quat q) { return transpose(toMatrix(q)); }

// Axes permuted and turned over, still right-handed.
inline Mat3 shuffled(const Mat3& axes, Random& random) {
  int first = int(random.below(3)), step = random.below(2) ? 1 : 2;
  Vec3 u = axes.row[first] * (random.below(2) ? 1.0 : -1.0),
       v = axes.row[(first + step) % 3] * (random.below(2) ? 1.0 : -1.0);
  return {{u, v, cross(u, v)}};
}
inline Mat3 turned(const Mat3& axes, Vec3 rotation) {
  Quat q = quatFromRotationVector(rotation);
  return {{rotate(q, axes.row[0]), rotate(q, axes.row[1]), rotate(q, axes.row[2])}};
}

// The middle of an edge along axis k, outermost along `out`, from the centre.
inline Vec3 outerEdge(const Obb& box, int k, Vec3 out) {
  Vec3 point;
  for (int i = 0; i < 3; i++) {
    if (i != k) point += box.axes.row[i] * (dot(out, box.axes.row[i]) < 0 ? -box.halfExtents[i] : box.halfExtents[i]);
  }
  return point;
}

}  // namespace family_detail

// Distances vary so that about as many pairs overlap as are apart; the velocity points roughly at the other box.
inline FamilyPair randomPair(Random& random, Family family) {
  using namespace family_detail;
  FamilyPair out;
  ObbMotion& m = out.motion;
  m.a.halfExtents = randomHalf(random), m.b.halfExtents = randomHalf(random);
  m.a.axes = rows(randomRotation(random)), m.b.axes = rows(randomRotation(random));
  switch (family) {
    case Family::aligned:
      m.b.axes = shuffled(m.a.axes, random);
      break;
    case Family::sharedNormal:
      m.b.axes = shuffled(turned(m.a.axes, m.a.axes.row[random.below(3)] * random.between(0.1, 1.4)), random);
      break;
    case Family::sharedEdge: {
      // Turned about a face normal of A, then about an edge: one axis of B stays in A's face.
      int k = int(random.below(3));
      Mat3 axes = turned(m.a.axes, m.a.axes.row[k] * random.between(0.1, 1.4));
      m.b.axes = shuffled(turned(axes, axes.row[(k + 1) % 3] * random.between(0.1, 1.4)), random);
      break;
    }
    case Family::nearParallel:
      out.angle = powerOfTen(random, -15, -1);
      m.b.axes = shuffled(turned(m.a.axes, randomDirection(random) * out.angle), random);
      break;
    case Family::oneNearParallel: {
      out.angle = powerOfTen(random, -15, -1);
      Mat3 axes = turned(m.a.axes, m.a.axes.row[random.below(3)] * random.between(0.1, 1.4));
      m.b.axes = shuffled(turned(axes, randomDirection(random) * out.angle), random);
      break;
    }
    case Family::sizeRatio: {
      double ratio = powerOfTen(random, -6, 6);
      (ratio < 1 ? m.b : m.a).halfExtents *= ratio < 1 ? ratio : 1 / ratio;
      break;
    }
    case Family::thin:
      for (Obb* box : {&m.a, &m.b}) {
        for (int k = 0; k < 2; k++) {
          if (random.below(2)) box->halfExtents[int(random.below(3))] *= powerOfTen(random, -4, -1);
        }
      }
      break;
    case Family::nested:
      m.b.halfExtents *= random.between(0.05, 0.3);
      break;
    default:
      break;
  }
  double reach = length(m.a.halfExtents) + length(m.b.halfExtents);
  m.b.centre = randomDirection(random) * (reach * random.between(0.2, 1.2));
  if (family == Family::sizeRatio || family == Family::thin) {
    // Near the surface of the larger box, where something can happen.
    Obb& larger = length(m.a.halfExtents) > length(m.b.halfExtents) ? m.a : m.b;
    double small = std::fmin(length(m.a.halfExtents), length(m.b.halfExtents));
    Vec3 local = scaled(randomVector(random, 1), larger.halfExtents);
    int k = int(random.below(3));
    local[k] = larger.halfExtents[k] * (random.below(2) ? 1 : -1);
    m.b.centre = transposeTimes(larger.axes, local) * (&larger == &m.a ? 1.0 : -1.0) +
                 randomDirection(random) * (small * random.between(0.2, 2.5));
  }
  if (family == Family::nested) m.b.centre = randomVector(random, 0.2) * double(random.below(2));
  Vec3 aim = randomVector(random, reach) - m.b.centre;
  m.velocityB = aim * random.between(0.3, 3);
  m.a.centre = randomVector(random, family == Family::farAway ? 1e4 * reach : reach);
  if (family == Family::crossedEdges) {
    int k = int(random.below(3));
    Vec3 across = normalized(cross(m.a.axes.row[k], randomDirection(random)));
    out.angle = powerOfTen(random, -10, -1);
    // Turned about its own edge, then about the direction in which the edges meet.
    m.b.axes = turned(turned(m.a.axes, m.a.axes.row[k] * random.between(0.1, 1.4)), across * out.angle);
    double gap = powerOfTen(random, -10, -2) * reach * (random.below(2) ? 1 : -1);
    m.b.centre = outerEdge(m.a, k, across) - outerEdge(m.b, k, -across) + across * gap;
    m.velocityB = across * -3.0 * std::fabs(gap) + randomVector(random, std::fabs(gap));
  }
  m.b.centre += m.a.centre;
  return out;
}

// Moves B along the line of the centres to where the boxes just touch, by the slow method, and from there by `offset` m.
inline void bringTogether(ObbMotion& m, double offset) {
  Vec3 direction = normalized(m.b.centre - m.a.centre);
  if (lengthSquared(direction) == 0) return;
  const SlowBox a(m.a);
  double touching = 0, apart = 1.01 * (length(m.a.halfExtents) + length(m.b.halfExtents));
  for (int k = 0; k < 60; k++) {
    double middle = 0.5 * (touching + apart);
    m.b.centre = m.a.centre + direction * middle;
    (slowOverlap(a, SlowBox(m.b)) ? touching : apart) = middle;
  }
  m.b.centre = m.a.centre + direction * (touching + offset);
}

}  // namespace brickfall::test
