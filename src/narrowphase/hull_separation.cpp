// Separating axes of two hulls. Faces: each plane against the other hull's deepest corner. Edges: only pairs that make a
// face of the Minkowski difference, which are those whose arcs on the Gauss sphere cross (D. Gregorius, "The Separating
// Axis Test between Convex Polyhedra", GDC 2013). Such an axis supports both hulls at these edges, so its separation is the
// distance of the edges along it, without a look at the other corners.
#include "narrowphase/hull_view.h"

namespace brickfall {
namespace {

// Sine (squared) of the smallest angle at which two edges still have a useful common normal.
constexpr double kParallel2 = 1e-8;
constexpr double kClearlyDifferent = 0.5;

}  // namespace

FaceQuery queryFaces(const HullView& hull, const HullView& other, double margin, const ContactTolerances& tolerances,
                     bool& touchAlongLine) {
  FaceQuery best;
  constexpr int kRemembered = 4;
  int touching[kRemembered], touchingCount = 0;
  for (int f = 0; f < hull.faceCount; f++) {
    const HullPlane& plane = hull.planes[f];
    int vertex = supportVertex(other, -plane.normal);
    double separation = dot(plane.normal, other.vertices[vertex]) - plane.offset;
    if (!(separation <= margin)) return {separation, f, vertex};
    if (separation > best.separation + tolerances.face) best = {separation, f, vertex};
    if (separation > -tolerances.slack) {
      for (int k = 0; k < touchingCount; k++)
        if (dot(hull.planes[touching[k]].normal, plane.normal) < kClearlyDifferent) touchAlongLine = true;
      if (touchingCount < kRemembered) touching[touchingCount++] = f;
    }
  }
  return best;
}

EdgeQuery queryEdges(const HullView& a, const HullView& b, double margin, double toBeat) {
  EdgeQuery best;
  best.separation = toBeat;
  for (int ea = 0; ea < a.edgeCount; ea += 2) {
    Vec3 pa = a.vertices[a.edges[ea].origin], da = a.vertices[a.edges[ea + 1].origin] - pa;
    Vec3 n1 = a.planes[a.edges[ea].face].normal, n2 = a.planes[a.edges[ea + 1].face].normal;
    double da2 = lengthSquared(da);
    for (int eb = 0; eb < b.edgeCount; eb += 2) {
      // The arc of b, turned inside out, is m1 m2; da and db stand in for the cross products of the arcs' ends.
      Vec3 m1 = -b.planes[b.edges[eb].face].normal, m2 = -b.planes[b.edges[eb + 1].face].normal;
      double side1 = dot(m1, da), side2 = dot(m2, da);
      if (side1 * side2 >= 0) continue;
      Vec3 pb = b.vertices[b.edges[eb].origin], db = b.vertices[b.edges[eb + 1].origin] - pb;
      double side3 = dot(n1, db), side4 = dot(n2, db);
      if (side3 * side4 >= 0) continue;
      Vec3 axis = cross(da, db);
      double length2 = lengthSquared(axis);
      if (length2 < kParallel2 * da2 * lengthSquared(db)) continue;
      axis *= 1 / std::sqrt(length2);
      double outA = dot(axis, n1 + n2), outB = dot(axis, m1 + m2);
      if (outA * outB <= 0) continue;  // the arcs' circles cross, the arcs do not
      if (outA < 0) axis = -axis;
      double separation = dot(axis, pb - pa);
      if (separation > margin) return {separation, ea, eb, axis};
      if (separation > best.separation) best = {separation, ea, eb, axis};
    }
  }
  return best;
}

}  // namespace brickfall
