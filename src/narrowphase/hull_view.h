// A convex polytope as the contact functions read it: hulls as they are, boxes dressed up as hulls, either moved into
// the frame of the other shape. On the stack; nothing is allocated.
#pragma once
#include "geometry/hull.h"
#include "geometry/shape.h"
#include "narrowphase/clipping.h"

namespace brickfall {

constexpr int kMaxHullFaces = 2 * kMaxHullVertices - 4;
constexpr int kMaxHullEdges = 3 * kMaxHullVertices - 6;  // pairs of half edges

struct HullView {
  const Vec3* vertices = nullptr;
  const HullPlane* planes = nullptr;
  const std::uint16_t* firstEdge = nullptr;  // per face
  const HullEdge* edges = nullptr;
  int vertexCount = 0, faceCount = 0, edgeCount = 0;
  Vec3 centroid;
  double innerRadius = 0;  // distance of the centroid from the nearest face, m
};

// Room for the moved corners and planes.
struct HullStorage {
  Vec3 vertices[kMaxHullVertices];
  HullPlane planes[kMaxHullFaces];
};

// The view of a box or hull in its own frame; a box's corners are numbered by a bit per axis, as in features.h.
HullView viewOf(const Shape& shape, HullStorage& storage);
// The same at a pose.
HullView viewOf(const Shape& shape, const Transform& pose, HullStorage& storage);

// Furthest corner along a direction; of equals the first.
int supportVertex(const HullView& hull, Vec3 direction);
// Of the faces around a corner the one that looks along `direction` most.
int faceAround(const HullView& hull, int vertex, Vec3 direction);

// Separating axes (hull_separation.cpp).
struct FaceQuery {
  double separation = -1e30;
  int face = -1;
  int vertex = -1;  // of the other hull, deepest below the face
};
struct EdgeQuery {
  double separation = -1e30;
  int edgeA = -1, edgeB = -1;  // the even half edge
  Vec3 normal;                 // unit, from a to b
};

// Best face of `hull` against `other` (the first of equals). Stops as soon as one separates by more than `margin`.
// `touchAlongLine`: the other just touches the plane of one face (within slack) and does not reach over that of another
// that looks in a clearly different direction, so the contact has no width.
FaceQuery queryFaces(const HullView& hull, const HullView& other, double margin, const ContactTolerances& tolerances,
                     bool& touchAlongLine);
// Best axis across two edges that is better than `toBeat`; stops at one that separates by more than `margin`.
EdgeQuery queryEdges(const HullView& a, const HullView& b, double margin, double toBeat);

}  // namespace brickfall
