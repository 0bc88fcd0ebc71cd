// Overlap depth. For cores inflated by radii: the depth of the cores (or minus their distance) plus the radii. Cores by
// separating axes: the depth is the least overlap over the face normals of both and the crossed edges, which are the
// face normals of their Minkowski difference.
#include "geometry/core.h"
#include "geometry/mesh_shape.h"
#include "geometry/polytope.h"
#include "geometry/queries.h"
#include "geometry/touch_axis.h"

namespace brickfall {

namespace {

// Squared sine between two edges below which their cross product says nothing; the face normals cover that case.
constexpr double kParallelSquared = 1e-12;

double least(double a, double b) { return a < b ? a : b; }

// The fifteen axes of two boxes: the rows of Gottschalk's test, divided by the length of the axis. Returns the overlap, or
// something not positive if an axis separates.
double boxBoxOverlap(Vec3 a, Vec3 b, const Transform& bInA) {
  Mat3 c = toMatrix(bInA.rotation);  // c.row[i][j] = A_i . B_j
  Mat3 size{{abs(c.row[0]), abs(c.row[1]), abs(c.row[2])}};
  Vec3 d = bInA.position, dInB = transposeTimes(c, d);
  double overlap = 1e300;
  for (int i = 0; i < 3; i++) overlap = least(overlap, a[i] + dot(size.row[i], b) - std::fabs(d[i]));
  for (int j = 0; j < 3; j++) overlap = least(overlap, b[j] + dot(size.column(j), a) - std::fabs(dInB[j]));
  if (!(overlap > 0)) return overlap;
  for (int i = 0; i < 3; i++) {
    int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; j++) {
      int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      double squared = c.row[i1][j] * c.row[i1][j] + c.row[i2][j] * c.row[i2][j];  // of A_i x B_j
      if (!(squared > kParallelSquared)) continue;
      double reach =
          a[i1] * size.row[i2][j] + a[i2] * size.row[i1][j] + b[j1] * size.row[i][j2] + b[j2] * size.row[i][j1];
      double apart = std::fabs(c.row[i1][j] * d[i2] - c.row[i2][j] * d[i1]);
      overlap = least(overlap, (reach - apart) / std::sqrt(squared));
    }
  }
  return overlap;
}

double faceOverlap(const Polytope& a, const Polytope& b) {
  double overlap = 1e300;
  for (int f = 0; f < a.faceCount; f++) {
    double lowest = 1e300;
    for (int v = 0; v < b.vertexCount; v++) lowest = least(lowest, dot(a.planes[f].normal, b.vertices[v]));
    overlap = least(overlap, a.planes[f].offset - lowest);
    if (!(overlap > 0)) break;
  }
  return overlap;
}

// Two edges make a face of the Minkowski difference if their arcs on the Gauss map cross, that of b mirrored. The normal
// of the left face crossed with that of the right one runs along the edge, so the edges stand in for the arcs' planes.
bool arcsCross(const PolytopeEdge& a, Vec3 alongA, const PolytopeEdge& b, Vec3 alongB) {
  double cba = -dot(b.leftNormal, alongA), dba = -dot(b.rightNormal, alongA);
  double adc = dot(a.leftNormal, alongB), bdc = dot(a.rightNormal, alongB);
  return cba * dba < 0 && adc * bdc < 0 && cba * bdc > 0;
}

// Overlap along the axis across both edges, turned to point out of a.
double edgeOverlap(Vec3 onA, Vec3 alongA, Vec3 centreOfA, Vec3 onB, Vec3 alongB) {
  Vec3 axis = cross(alongA, alongB);
  double squared = lengthSquared(axis);
  if (!(squared > kParallelSquared * lengthSquared(alongA) * lengthSquared(alongB))) return 1e300;
  double outwards = dot(axis, onA - centreOfA) < 0 ? -1 : 1;
  return outwards * dot(axis, onA - onB) / std::sqrt(squared);
}

double polytopeOverlap(const Polytope& a, const Polytope& b) {
  double overlap = faceOverlap(a, b);
  if (overlap > 0) overlap = least(overlap, faceOverlap(b, a));
  for (int i = 0; i < a.edgeCount && overlap > 0; i++) {
    const PolytopeEdge& edgeA = a.edges[i];
    Vec3 alongA = edgeA.end - edgeA.start;
    for (int j = 0; j < b.edgeCount; j++) {
      const PolytopeEdge& edgeB = b.edges[j];
      Vec3 alongB = edgeB.end - edgeB.start;
      if (!arcsCross(edgeA, alongA, edgeB, alongB)) continue;
      overlap = least(overlap, edgeOverlap(edgeA.start, alongA, a.centre, edgeB.start, alongB));
    }
  }
  return overlap;
}

// A segment has no faces, and its Gauss map is the circle across it.
double segmentOverlap(const Polytope& a, Vec3 start, Vec3 end) {
  double overlap = 1e300;
  for (int f = 0; f < a.faceCount; f++) {
    const HullPlane& plane = a.planes[f];
    overlap = least(overlap, plane.offset - least(dot(plane.normal, start), dot(plane.normal, end)));
  }
  Vec3 along = end - start;
  for (int i = 0; i < a.edgeCount && overlap > 0; i++) {
    const PolytopeEdge& edge = a.edges[i];
    if (!(dot(edge.leftNormal, along) * dot(edge.rightNormal, along) < 0)) continue;
    overlap = least(overlap, edgeOverlap(edge.start, edge.end - edge.start, a.centre, start, along));
  }
  return overlap;
}

double pointOverlap(const Shape& shape, Vec3 point) {
  double overlap = 1e300;
  if (shape.type == ShapeType::box) {
    for (int k = 0; k < 3; k++) overlap = least(overlap, shape.halfExtents[k] - std::fabs(point[k]));
  } else {
    for (const HullPlane& plane : shape.hull->planes) overlap = least(overlap, plane.offset - dot(plane.normal, point));
  }
  return overlap;
}

bool isPolytope(const Shape& shape) { return shape.type == ShapeType::box || shape.type == ShapeType::hull; }

// Depth of the cores, negative when they are apart.
double coreOverlap(const Shape& a, const Shape& b, const Transform& bInA) {
  if (a.type == ShapeType::box && b.type == ShapeType::box) return boxBoxOverlap(a.halfExtents, b.halfExtents, bInA);
  if (isPolytope(a) && isPolytope(b)) return polytopeOverlap(Polytope(a, {}), Polytope(b, bInA));
  Shape coreA = a, coreB = b;
  if (!isPolytope(a)) coreA.radius = 0;
  if (!isPolytope(b)) coreB.radius = 0;
  double distance = shapeDistance(coreA, coreB, bInA).distance;
  if (distance > 0 || !isPolytope(a)) return -distance;
  if (b.type == ShapeType::sphere) return pointOverlap(a, bInA.position);
  Vec3 tip{0, b.halfHeight, 0};
  return segmentOverlap(Polytope(a, {}), transformPoint(bInA, -tip), transformPoint(bInA, tip));
}

double planeOverlap(const Shape& b, const Transform& bInPlane) {
  if (b.type == ShapeType::plane) return 0;
  Vec3 down = transposeTimes(toMatrix(bInPlane.rotation), Vec3{0, -1, 0});
  return coreRadius(b) - transformPoint(bInPlane, coreSupport(b, down)).y;
}

}  // namespace

double penetrationDepth(const Shape& a, const Shape& b, const Transform& bInA) {
  if (hasMesh(a, b))
    return a.type == ShapeType::mesh ? meshPenetration(a, b, bInA) : meshPenetration(b, a, inverse(bInA));
  double depth = 0;
  const bool turned = isFrustum(a.type) || isFrustum(b.type);
  if (turned && a.type != ShapeType::plane && b.type != ShapeType::plane) {
    if (auto axis = findTouchAxis(a, b, bInA, 0)) depth = -axis->separation;
  } else if (a.type == ShapeType::plane) {
    depth = planeOverlap(b, bInA);
  } else if (b.type == ShapeType::plane) {
    depth = planeOverlap(a, inverse(bInA));
  } else if (isPolytope(b) && !isPolytope(a)) {
    depth = coreOverlap(b, a, inverse(bInA)) + coreRadius(a);
  } else {
    depth = coreOverlap(a, b, bInA) + coreRadius(a) + coreRadius(b);
  }
  return depth > 0 ? depth : 0;
}

}  // namespace brickfall
