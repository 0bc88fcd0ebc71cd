// What every manifold must satisfy, random poses, and slow reference methods that share no code with the engine's.
#pragma once
#include <string>
#include <vector>

#include "geometry/hull.h"
#include "geometry/shape.h"
#include "narrowphase/collide.h"
#include "support/random_geometry.h"

namespace brickfall::test {

Shape boxShape(Vec3 halfExtents);
Shape sphereShape(double radius);
Shape capsuleShape(double radius, double halfHeight);
Shape hullShape(const Hull& hull);
Shape planeShape();

Vec3 randomHalfExtents(Random& random);
Hull randomHull(Random& random, int points);

// The corners of a box or hull at a pose.
std::vector<Vec3> cornersOf(const Shape& shape, const Transform& pose);
// Directions of faces and of edges at a pose (box or hull).
std::vector<Vec3> faceNormalsOf(const Shape& shape, const Transform& pose);
std::vector<Vec3> edgeDirectionsOf(const Shape& shape, const Transform& pose);

// Largest separation over all face normals and all cross products of edges, by projecting every corner: > 0 apart, <
// 0 the depth. With the axis, from a to b.
struct Separation {
  double value = -1e30;
  Vec3 axis;
  bool edge = false;
};
Separation slowSeparation(const Shape& a, const Shape& b, const Transform& bInA);

// Distance of a point from a box or hull, by another way than the contact functions go.
double distanceByGjk(const Shape& shape, Vec3 point);

// Empty, or what is wrong: unit normal, points along it, separations up to the margin, each point within `tolerance`
// of the shape that it is said to be on, all points coplanar on one of the two.
std::string faultOf(const Manifold& m, const Shape& a, const Shape& b, const Transform& bInA, double margin,
                    double tolerance);
double deepest(const Manifold& m);

// Manifold of (b, a) brought into the frame of a, for comparison with that of (a, b).
Manifold swapped(const Shape& a, const Shape& b, const Transform& bInA, double margin);

}  // namespace brickfall::test
