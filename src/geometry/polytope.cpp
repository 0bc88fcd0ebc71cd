#include "geometry/polytope.h"

namespace brickfall {

Polytope::Polytope(const Shape& shape, const Transform& pose) {
  Mat3 turn = toMatrix(pose.rotation);
  if (shape.type == ShapeType::box) {
    fillBox(shape.halfExtents, turn, pose.position);
  } else {
    fillHull(*shape.hull, turn, pose.position);
  }
}

void Polytope::fillBox(Vec3 half, const Mat3& turn, Vec3 position) {
  centre = position;
  for (int k = 0; k < 8; k++) {
    Vec3 corner{k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z};
    vertices[vertexCount++] = turn * corner + position;
  }
  for (int axis = 0; axis < 3; axis++) {
    Vec3 normal = turn.column(axis);
    double middle = dot(normal, position);
    planes[faceCount++] = {normal, half[axis] + middle};
    planes[faceCount++] = {-normal, half[axis] - middle};
  }
  for (int axis = 0; axis < 3; axis++) {  // four edges along it, on the sides s and t of the two others
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int side = 0; side < 4; side++) {
      double s = side & 1 ? 1 : -1, t = side & 2 ? 1 : -1;
      Vec3 from;
      from[u] = s * half[u], from[v] = t * half[v], from[axis] = -half[axis];
      Vec3 to = from;
      to[axis] = half[axis];
      // The cross product of left and right normal runs along the edge: u x v is the axis, so for s t > 0 u is left.
      Vec3 normalU = turn.column(u) * s, normalV = turn.column(v) * t;
      edges[edgeCount++] = {turn * from + position, turn * to + position, s * t > 0 ? normalU : normalV,
                            s * t > 0 ? normalV : normalU};
    }
  }
}

void Polytope::fillHull(const Hull& hull, const Mat3& turn, Vec3 position) {
  centre = turn * hull.centroid + position;
  for (Vec3 v : hull.vertices) vertices[vertexCount++] = turn * v + position;
  for (const HullPlane& plane : hull.planes) {
    Vec3 normal = turn * plane.normal;
    planes[faceCount++] = {normal, plane.offset + dot(normal, position)};
  }
  for (std::size_t e = 0; e < hull.edges.size(); e += 2) {
    const HullEdge &edge = hull.edges[e], &twin = hull.edges[e + 1];
    edges[edgeCount++] = {vertices[edge.origin], vertices[twin.origin], planes[edge.face].normal,
                          planes[twin.face].normal};
  }
}

}  // namespace brickfall
