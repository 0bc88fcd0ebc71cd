// Hull against hull, and box against hull: separating axes, then the incident face cut against the sides of the
// reference face, or the crossing of two edges. Orders and biases as in box_box.cpp.
#include "narrowphase/clipping.h"
#include "narrowphase/features.h"
#include "narrowphase/hull_view.h"
#include "narrowphase/pairs.h"
#include "narrowphase/segment.h"

namespace brickfall {
namespace {

constexpr double kSameFace = 0.98;
constexpr int kMaxPolygon = 2 * kMaxHullVertices;

// A corner of the polygon being cut: where two lines meet. A line is a half edge of the incident face, or kSide + one
// of the reference face.
constexpr int kSide = 1 << 15;
struct ClipCorner {
  Vec3 p;
  int before, after;
};

int cutSide(const ClipCorner* from, int count, ClipCorner* to, int side, Vec3 outward, double offset, double slack) {
  int kept = 0;
  for (int i = 0; i < count && kept < kMaxPolygon - 1; i++) {
    const ClipCorner& c = from[i];
    const ClipCorner& next = from[i + 1 == count ? 0 : i + 1];
    double dc = dot(outward, c.p) - offset, dn = dot(outward, next.p) - offset;
    bool inside = dc <= slack, nextInside = dn <= slack;
    if (inside) to[kept++] = c;
    if (inside == nextInside) continue;
    double f = dc / (dc - dn);
    f = f < 0 ? 0 : f > 1 ? 1 : f;
    ClipCorner cut{c.p + (next.p - c.p) * f, c.after, kSide | side};
    if (!inside) cut.before = kSide | side, cut.after = c.after;
    to[kept++] = cut;
  }
  return kept;
}

std::uint32_t featureName(const HullView& ref, const HullView& inc, bool refIsA, const ClipCorner& corner) {
  bool first = corner.before & kSide, second = corner.after & kSide;
  int before = corner.before & ~kSide, after = corner.after & ~kSide;
  if (first && second) {
    int vertex = ref.edges[before].next == after ? ref.edges[after].origin : ref.edges[before].origin;
    return refIsA ? cornerOfA(vertex) : cornerOfB(vertex);
  }
  if (!first && !second) return refIsA ? cornerOfB(inc.edges[after].origin) : cornerOfA(inc.edges[after].origin);
  int edgeRef = (first ? before : after) / 2, edgeInc = (first ? after : before) / 2;
  return refIsA ? edgeCrossing(edgeRef, edgeInc) : edgeCrossing(edgeInc, edgeRef);
}

// Cuts the incident face (of those around the deepest corner the one most opposed) to the reference face's prism.
int clipFace(const HullView& ref, const HullView& inc, const FaceQuery& query, const ContactTolerances& tolerance,
             ClipCorner* polygon) {
  ClipCorner other[kMaxPolygon];
  ClipCorner* from = polygon;
  ClipCorner* to = other;
  Vec3 normal = ref.planes[query.face].normal;
  int face = faceAround(inc, query.vertex, -normal);
  int count = 0, previous = -1, e = inc.firstEdge[face];
  do {
    polygon[count++] = {inc.vertices[inc.edges[e].origin], previous, e};
    previous = e;
    e = inc.edges[e].next;
  } while (e != inc.firstEdge[face]);
  polygon[0].before = previous;

  e = ref.firstEdge[query.face];
  do {
    Vec3 a = ref.vertices[ref.edges[e].origin], b = ref.vertices[ref.edges[ref.edges[e].next].origin];
    Vec3 outward = normalized(cross(b - a, normal));
    count = cutSide(from, count, to, e, outward, dot(outward, a), tolerance.slack);
    ClipCorner* swap = from;
    from = to;
    to = swap;
    e = ref.edges[e].next;
  } while (e != ref.firstEdge[query.face] && count > 0);
  if (from != polygon)
    for (int i = 0; i < count; i++) polygon[i] = from[i];
  return count;
}

void addPoint(Manifold& out, bool refIsA, Vec3 onInc, Vec3 refNormal, double separation, std::uint32_t feature) {
  Vec3 onRef = onInc - refNormal * separation;
  out.points[out.count++] = {refIsA ? onRef : onInc, refIsA ? onInc : onRef, separation, feature};
}

void faceContact(const HullView& ref, const HullView& inc, bool refIsA, const FaceQuery& query, double margin,
                 const ContactTolerances& tolerance, Manifold& out) {
  ClipCorner polygon[kMaxPolygon];
  PatchPoint patch[kMaxPolygon];
  int corners = clipFace(ref, inc, query, tolerance, polygon), count = 0;
  const HullPlane& plane = ref.planes[query.face];
  // Any two directions in the plane of the face.
  int e = ref.firstEdge[query.face];
  Vec3 origin = ref.vertices[ref.edges[e].origin];
  Vec3 u = normalized(ref.vertices[ref.edges[ref.edges[e].next].origin] - origin), v = cross(plane.normal, u);
  for (int i = 0; i < corners; i++) {
    Vec3 p = polygon[i].p;
    double separation = dot(plane.normal, p) - plane.offset;
    if (separation > margin) continue;
    patch[count++] = {dot(u, p - origin), dot(v, p - origin), separation, featureName(ref, inc, refIsA, polygon[i])};
  }
  count = reducePatch(patch, count, tolerance);
  out.normal = refIsA ? plane.normal : -plane.normal;
  for (int i = 0; i < count; i++) {
    Vec3 onInc = origin + u * patch[i].u + v * patch[i].v + plane.normal * patch[i].separation;
    addPoint(out, refIsA, onInc, plane.normal, patch[i].separation, patch[i].feature);
  }
}

bool edgeContact(const HullView& a, const HullView& b, const EdgeQuery& query, Manifold& out) {
  Vec3 pa = a.vertices[a.edges[query.edgeA].origin], da = a.vertices[a.edges[query.edgeA + 1].origin] - pa;
  Vec3 pb = b.vertices[b.edges[query.edgeB].origin], db = b.vertices[b.edges[query.edgeB + 1].origin] - pb;
  SegmentPair nearest = nearestOfSegments(pa, da, pb, db);
  // At an end of an edge they are not crossing: another axis is the one of least overlap.
  if (nearest.s <= 0 || nearest.s >= 1 || nearest.t <= 0 || nearest.t >= 1) return false;
  out.normal = query.normal;
  out.count = 1;
  out.points[0] = {nearest.p, nearest.p + query.normal * query.separation, query.separation,
                   edgeCrossing(query.edgeA / 2, query.edgeB / 2)};
  return true;
}

// The deepest corner below a face alone, wherever that is: the last resort, so that no overlap goes unseen.
void cornerContact(const HullView& ref, const HullView& inc, bool refIsA, const FaceQuery& query, Manifold& out) {
  Vec3 normal = ref.planes[query.face].normal;
  out.normal = refIsA ? normal : -normal;
  addPoint(out, refIsA, inc.vertices[query.vertex], normal, query.separation,
           refIsA ? cornerOfB(query.vertex) : cornerOfA(query.vertex));
}

}  // namespace

void collideHullHull(const Shape& shapeA, const Shape& shapeB, const Transform& bInA, double margin, Manifold& out) {
  HullStorage storageA, storageB;
  HullView a = viewOf(shapeA, storageA), b = viewOf(shapeB, bInA, storageB);
  ContactTolerances tolerance = contactTolerances(a.innerRadius < b.innerRadius ? a.innerRadius : b.innerRadius);

  bool touchAlongLine = false;
  FaceQuery faceA = queryFaces(a, b, margin, tolerance, touchAlongLine);
  if (!(faceA.separation <= margin)) return;
  FaceQuery faceB = queryFaces(b, a, margin, tolerance, touchAlongLine);
  if (!(faceB.separation <= margin) || touchAlongLine) return;
  bool sameFace = dot(a.planes[faceA.face].normal, b.planes[faceB.face].normal) < -kSameFace;
  bool refIsA = faceB.separation <= faceA.separation + (sameFace ? tolerance.otherFace : tolerance.face);
  double face = refIsA ? faceA.separation : faceB.separation;

  EdgeQuery edge = queryEdges(a, b, margin, face + tolerance.edge);
  if (edge.edgeA >= 0 && edge.separation > margin) return;
  if (edge.edgeA >= 0 && edgeContact(a, b, edge, out)) return;
  const FaceQuery& best = refIsA ? faceA : faceB;
  const FaceQuery& other = refIsA ? faceB : faceA;
  const HullView& ref = refIsA ? a : b;
  const HullView& inc = refIsA ? b : a;
  faceContact(ref, inc, refIsA, best, margin, tolerance, out);
  if (out.count > 0 || face >= 0) return;
  // Nothing over the reference face, though the face axes overlap. Either the hulls are apart (corner beside corner, which
  // only an edge axis sees), or another axis was better, but not by its bias: try the others.
  edge = queryEdges(a, b, margin, -1e30);
  if (edge.separation > 0) return;
  if (other.separation > face - tolerance.edge) faceContact(inc, ref, !refIsA, other, margin, tolerance, out);
  if (out.count > 0 || (edge.edgeA >= 0 && edgeContact(a, b, edge, out))) return;
  cornerContact(ref, inc, refIsA, best, out);
}

}  // namespace brickfall
