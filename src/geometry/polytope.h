// A box or hull, placed, with all that separating axes ask for; on the stack.
#pragma once
#include "brickfall/shapes.h"
#include "geometry/hull.h"
#include "geometry/shape.h"

namespace brickfall {

struct PolytopeEdge {
  Vec3 start, end;
  Vec3 leftNormal, rightNormal;  // of the faces beside it, seen from outside
};

struct Polytope {
  static constexpr int kMaxFaces = 2 * kMaxHullVertices - 4, kMaxEdges = 3 * kMaxHullVertices - 6;  // by Euler

  Vec3 vertices[kMaxHullVertices];
  HullPlane planes[kMaxFaces];
  PolytopeEdge edges[kMaxEdges];
  int vertexCount = 0, faceCount = 0, edgeCount = 0;
  Vec3 centre;  // a point inside

  Polytope(const Shape& shape, const Transform& pose);

 private:
  void fillBox(Vec3 half, const Mat3& turn, Vec3 position);
  void fillHull(const Hull& hull, const Mat3& turn, Vec3 position);
};

}  // namespace brickfall
