// Separating axes of two hulls. Faces: each plane against the other hull's deepest corner. Edges: only pairs that
// make a face of the Minkowski difference, which are those whose arcs on the Gauss sphere cross (D. Gregorius, "The
// Separating Axis Test between Convex Polyhedra", GDC 2013). Such an axis supports both hulls at these edges, so its
// separation is the distance of the edges along it, without a look at the other corners.
#include "narrowphase/hull_view.h"

namespace brickfall {
namespace {

// Sine (squared) of the smallest angle at which two edges still have a useful common normal.
constexpr double kParallel2 = 1e-8;
constexpr double kClearlyDifferent = 0.5;

// Whether scaled / sqrt(length2) may be over `best`, without the root. Anything positive may: it could separate.
bool mayBeat(double scaled, double length2, double best) {
  return scaled > 0 || (best < 0 && scaled * scaled <= best * best * length2);
}

// Edges (their even half edge) that can carry an axis better than `toBeat`. Along an axis n of separation s the other
// hull's centroid lies at least s + its inner radius above the edge, so if that is positive, it is above one of the
// edge's two faces: any n between their normals is a sum of the two with positive weights. Leaves out the far side of
// both hulls, three pairs of four or more.
int facingEdges(const HullView& hull, const HullView& other, double toBeat, std::uint16_t* out) {
  int count = 0;
  bool all = toBeat + other.innerRadius < 0;
  for (int e = 0; e < hull.edgeCount; e += 2) {
    Vec3 towards = other.centroid - hull.vertices[hull.edges[e].origin];
    int faces = int(dot(hull.planes[hull.edges[e].face].normal, towards) > 0) |
                int(dot(hull.planes[hull.edges[e + 1].face].normal, towards) > 0);
    out[count] = std::uint16_t(e);
    count += int(all) | faces;  // as likely as not: no branch
  }
  return count;
}

}  // namespace

FaceQuery queryFaces(const HullView& hull, const HullView& other, double margin, const ContactTolerances& tolerances,
                     bool& touchAlongLine) {
  FaceQuery best;
  constexpr int kRemembered = 4;
  FaceQuery out[kRemembered];  // faces that the other hull does not reach over
  int outCount = 0;
  for (int f = 0; f < hull.faceCount; f++) {
    const HullPlane& plane = hull.planes[f];
    int vertex = supportVertex(other, -plane.normal);
    double separation = dot(plane.normal, other.vertices[vertex]) - plane.offset;
    if (!(separation <= margin)) return {separation, f, vertex};
    if (separation > best.separation + tolerances.face) best = {separation, f, vertex};
    if (separation > -tolerances.slack) {
      for (int k = 0; k < outCount; k++) {
        bool just = separation <= tolerances.slack || out[k].separation <= tolerances.slack;
        if (just && dot(hull.planes[out[k].face].normal, plane.normal) < kClearlyDifferent) touchAlongLine = true;
      }
      if (outCount < kRemembered) out[outCount++] = {separation, f, vertex};
    }
  }
  return best;
}

EdgeQuery queryEdges(const HullView& a, const HullView& b, double margin, double toBeat) {
  EdgeQuery best;
  best.separation = toBeat;
  std::uint16_t facingB[kMaxHullEdges], facingA[kMaxHullEdges], crosses[kMaxHullEdges];
  int countA = facingEdges(a, b, toBeat, facingB), countB = facingEdges(b, a, toBeat, facingA);
  double side[kMaxHullFaces];  // of each face normal of b, seen along the edge of a
  for (int i = 0; i < countA; i++) {
    int ea = facingB[i];
    Vec3 pa = a.vertices[a.edges[ea].origin], da = a.vertices[a.edges[ea + 1].origin] - pa;
    Vec3 n1 = a.planes[a.edges[ea].face].normal, n2 = a.planes[a.edges[ea + 1].face].normal;
    for (int f = 0; f < b.faceCount; f++) side[f] = dot(b.planes[f].normal, da);
    // The arc of b, turned inside out, against the circle of a's arc, and the other way round. da and db stand in for the
    // cross products of the arcs' ends.
    int crossing = 0;
    for (int k = 0; k < countB; k++) {
      int eb = facingA[k];
      crosses[crossing] = std::uint16_t(eb);
      crossing += side[b.edges[eb].face] * side[b.edges[eb + 1].face] < 0;
    }
    for (int k = 0; k < crossing; k++) {
      int eb = crosses[k], f1 = b.edges[eb].face, f2 = b.edges[eb + 1].face;
      Vec3 pb = b.vertices[b.edges[eb].origin], db = b.vertices[b.edges[eb + 1].origin] - pb;
      if (dot(n1, db) * dot(n2, db) >= 0) continue;
      Vec3 axis = cross(da, db);
      double outA = dot(axis, n1 + n2), outB = -dot(axis, b.planes[f1].normal + b.planes[f2].normal);
      if (outA * outB <= 0) continue;  // the circles cross, the arcs do not
      if (outA < 0) axis = -axis;
      double scaled = dot(axis, pb - pa), length2 = lengthSquared(axis);
      if (!mayBeat(scaled, length2, best.separation)) continue;
      if (length2 < kParallel2 * lengthSquared(da) * lengthSquared(db)) continue;
      double inverseLength = 1 / std::sqrt(length2), separation = scaled * inverseLength;
      if (separation > margin) return {separation, ea, eb, axis * inverseLength};
      if (separation > best.separation) best = {separation, ea, eb, axis * inverseLength};
    }
  }
  return best;
}

}  // namespace brickfall
