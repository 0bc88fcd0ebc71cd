// Hull against hull, and box against hull: separating axes, then the incident face cut against the sides of the
// reference face, or the crossing of two edges. Orders and biases as in box_box.cpp.
#include "narrowphase/clipping.h"
#include "narrowphase/edge_stretch.h"
#include "narrowphase/features.h"
#include "narrowphase/hull_view.h"
#include "narrowphase/pairs.h"
#include "narrowphase/segment.h"

namespace brickfall {
namespace {

constexpr double kSameFace = 0.98;
constexpr int kMaxPolygon = 2 * kMaxHullVertices;

// How near points must be, what counts as equal, and which points carried force so far.
struct Search {
  double margin;
  ContactTolerances tolerance;
  const LoadedPoints& loaded;
};

// A corner of the polygon being cut: where two lines meet. A line is a half edge of the incident face, or kSide + one
// of the reference face.
constexpr int kSide = 1 << 15;
struct ClipCorner {
  double x, y, z;  // not a Vec3, which would be cleared: there are many of these on the stack and few are used
  int before, after;

  Vec3 p() const { return {x, y, z}; }
};

// A side of the reference face. A corner up to `slack` beyond it is not cut off.
struct Side {
  Vec3 outward;
  double offset, slack;
  int edge;
};

// Where two sides meet at a sharp angle, a point that is beyond each by no more than the slack is beyond their corner by up to
// slack / sin(angle / 2). Shards have faces of a degree or two: a hundred times the slack. It may be `same` at most.
void limitSlack(Side& one, Side& next, const ContactTolerances& tolerance) {
  double sine2 = 0.5 * (1 + dot(one.outward, next.outward));  // of half the angle
  double same2 = tolerance.same * tolerance.same;
  if (same2 * sine2 >= tolerance.slack * tolerance.slack) return;
  double most = sine2 > 0 ? tolerance.same * std::sqrt(sine2) : 0;
  one.slack = one.slack < most ? one.slack : most;
  next.slack = next.slack < most ? next.slack : most;
}

Side sideOf(const HullView& hull, int edge, const ContactTolerances& tolerance) {
  const HullEdge& e = hull.edges[edge];
  Vec3 a = hull.vertices[e.origin], b = hull.vertices[hull.edges[e.next].origin];
  Vec3 outward = normalized(cross(b - a, hull.planes[e.face].normal));
  return {outward, dot(outward, a), tolerance.slack, edge};
}

int cutSide(const ClipCorner* from, int count, ClipCorner* to, const Side& side) {
  int kept = 0;
  for (int i = 0; i < count && kept < kMaxPolygon - 1; i++) {
    const ClipCorner& c = from[i];
    const ClipCorner& next = from[i + 1 == count ? 0 : i + 1];
    double dc = dot(side.outward, c.p()) - side.offset, dn = dot(side.outward, next.p()) - side.offset;
    bool inside = dc <= side.slack, nextInside = dn <= side.slack;
    if (inside) to[kept++] = c;
    if (inside == nextInside) continue;
    double f = dc / (dc - dn);
    f = f < 0 ? 0 : f > 1 ? 1 : f;
    Vec3 p = c.p() + (next.p() - c.p()) * f;
    ClipCorner cut{p.x, p.y, p.z, c.after, kSide | side.edge};
    if (!inside) cut.before = kSide | side.edge, cut.after = c.after;
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

// Cuts a face of `inc` to the prism over a face of `ref`.
int clipFace(const HullView& ref, int refFace, const HullView& inc, int incFace, const ContactTolerances& tolerance,
             ClipCorner* polygon) {
  ClipCorner other[kMaxPolygon];
  ClipCorner* from = polygon;
  ClipCorner* to = other;
  int count = 0, previous = -1, e = inc.firstEdge[incFace];
  do {
    Vec3 p = inc.vertices[inc.edges[e].origin];
    polygon[count++] = {p.x, p.y, p.z, previous, e};
    previous = e;
    e = inc.edges[e].next;
  } while (e != inc.firstEdge[incFace]);
  polygon[0].before = previous;

  int first = ref.firstEdge[refFace], last = first;
  while (ref.edges[last].next != first) last = ref.edges[last].next;
  Side before = sideOf(ref, last, tolerance), side = sideOf(ref, first, tolerance);
  limitSlack(before, side, tolerance);
  for (bool more = true; more && count > 0;) {
    Side next = sideOf(ref, ref.edges[side.edge].next, tolerance);
    limitSlack(side, next, tolerance);
    count = cutSide(from, count, to, side);
    ClipCorner* swap = from;
    from = to;
    to = swap;
    more = side.edge != last;
    side = next;
  }
  if (from != polygon)
    for (int i = 0; i < count; i++) polygon[i] = from[i];
  return count;
}

void addPoint(Manifold& out, bool refIsA, Vec3 onInc, Vec3 refNormal, double separation, std::uint32_t feature) {
  Vec3 onRef = onInc - refNormal * separation;
  out.points[out.count++] = {refIsA ? onRef : onInc, refIsA ? onInc : onRef, separation, feature};
}

// Points of one face of `inc` over the reference face; their least separation, or kNone.
constexpr double kNone = 1e30;
double faceOverFace(const HullView& ref, const HullView& inc, bool refIsA, int refFace, int incFace,
                    const Search& search, Manifold& out) {
  ClipCorner polygon[kMaxPolygon];
  PatchPoint patch[kMaxPolygon];
  int corners = clipFace(ref, refFace, inc, incFace, search.tolerance, polygon), count = 0;
  const HullPlane& plane = ref.planes[refFace];
  // Any two directions in the plane of the face.
  int e = ref.firstEdge[refFace];
  Vec3 origin = ref.vertices[ref.edges[e].origin];
  Vec3 u = normalized(ref.vertices[ref.edges[ref.edges[e].next].origin] - origin), v = cross(plane.normal, u);
  double least = kNone;
  for (int i = 0; i < corners; i++) {
    Vec3 p = polygon[i].p();
    double separation = dot(plane.normal, p) - plane.offset;
    if (separation > search.margin) continue;
    if (separation < least) least = separation;
    patch[count++] = {dot(u, p - origin), dot(v, p - origin), separation, featureName(ref, inc, refIsA, polygon[i])};
  }
  const ReducedPatch reduced = reducePatch(patch, count, search.tolerance, search.loaded);
  out.normal = refIsA ? plane.normal : -plane.normal;
  out.count = 0;
  out.partial = reduced.partial;
  for (int i = 0; i < reduced.count; i++) {
    Vec3 onInc = origin + u * patch[i].u + v * patch[i].v + plane.normal * patch[i].separation;
    addPoint(out, refIsA, onInc, plane.normal, patch[i].separation, patch[i].feature);
  }
  return least;
}

double lowestCorner(const HullView& hull, int face, const HullPlane& plane) {
  double lowest = kNone;
  int e = hull.firstEdge[face];
  do {
    double height = dot(plane.normal, hull.vertices[hull.edges[e].origin]) - plane.offset;
    if (height < lowest) lowest = height;
    e = hull.edges[e].next;
  } while (e != hull.firstEdge[face]);
  return lowest;
}

// The incident face is, of those around the deepest corner, the one most opposed. Where that corner is not over the
// reference face, another face may be what touches: a blade that lies across with its edge looks at it most with the face
// at its tip. Then the one that reaches deepest over the reference face is taken. Returns the least separation, or kNone.
double faceContact(const HullView& ref, const HullView& inc, bool refIsA, const FaceQuery& query, const Search& search,
                   Manifold& out) {
  const HullPlane& plane = ref.planes[query.face];
  int first = faceAround(inc, query.vertex, -plane.normal);
  double deepest = faceOverFace(ref, inc, refIsA, query.face, first, search, out);
  const double slack = search.tolerance.slack;
  if (deepest <= query.separation + slack) return deepest;
  for (int f = 0; f < inc.faceCount; f++) {
    if (f == first || dot(inc.planes[f].normal, plane.normal) >= 0) continue;
    double reach = lowestCorner(inc, f, plane);
    if (reach > search.margin || reach >= deepest - slack) continue;
    Manifold trial;
    double least = faceOverFace(ref, inc, refIsA, query.face, f, search, trial);
    if (least < deepest - slack) deepest = least, out = trial;
  }
  return deepest;
}

// Both ways along the edge `e` of one hull from the crossing at `from` (its share of the edge), over the faces of the
// other that meet in its edge `f`, where `at` is the crossing.
void addStretches(const HullView& hull, int e, const HullView& other, int f, double from, Vec3 at, bool edgeOfB,
                  const Search& search, Manifold& out) {
  const int ends[2] = {hull.edges[e].origin, hull.edges[e + 1].origin};
  const Vec3 along = hull.vertices[ends[1]] - hull.vertices[ends[0]];
  const double length = brickfall::length(along);
  for (const bool ahead : {false, true}) {
    const Vec3 direction = along * ((ahead ? 1 : -1) / length);
    const int one = other.edges[f].face, two = other.edges[f + 1].face;
    const int face = dot(other.planes[one].normal, direction) > dot(other.planes[two].normal, direction) ? one : two;
    const Vec3 normal = other.planes[face].normal;
    const double up = dot(out.normal, normal);
    if (up == 0) continue;
    const Vec3 onFace = direction - out.normal * (dot(direction, normal) / up);  // seen along the contact's normal
    double toSide = 1e30;
    int side = -1, h = other.firstEdge[face];
    do {
      const Side s = sideOf(other, h, search.tolerance);
      const double approach = dot(s.outward, onFace), room = s.offset - dot(s.outward, at);
      if (h / 2 != f / 2 && approach > 0 && room < toSide * approach) toSide = room / approach, side = h / 2;
      h = other.edges[h].next;
    } while (h != other.firstEdge[face]);
    if (side < 0) continue;
    addStretch({direction, ahead ? (1 - from) * length : from * length, normal, toSide,
                edgeOfB ? cornerOfB(ends[ahead]) : cornerOfA(ends[ahead]),
                edgeOfB ? edgeCrossing(side, e / 2) : edgeCrossing(e / 2, side)},
               edgeOfB, search.margin, search.tolerance.same, out);
  }
}

// The nearest points of two edges. Not if they lie further than `beside` from each other across the axis: the edges do not
// cross, and another axis is the one of least overlap.
bool edgeContact(const HullView& a, const HullView& b, const EdgeQuery& query, double beside, const Search& search,
                 Manifold& out) {
  Vec3 pa = a.vertices[a.edges[query.edgeA].origin], da = a.vertices[a.edges[query.edgeA + 1].origin] - pa;
  Vec3 pb = b.vertices[b.edges[query.edgeB].origin], db = b.vertices[b.edges[query.edgeB + 1].origin] - pb;
  SegmentPair nearest = nearestOfSegments(pa, da, pb, db);
  bool atEnd = nearest.s <= 0 || nearest.s >= 1 || nearest.t <= 0 || nearest.t >= 1;
  Vec3 onB = nearest.p + query.normal * query.separation;
  if (atEnd && !(lengthSquared(nearest.q - onB) < beside * beside)) return false;
  out.normal = query.normal;
  out.count = 1;
  out.partial = false;
  out.points[0] = {nearest.p, onB, query.separation, edgeCrossing(query.edgeA / 2, query.edgeB / 2)};
  if (atEnd) return true;
  addStretches(a, query.edgeA, b, query.edgeB, nearest.s, onB, false, search, out);
  addStretches(b, query.edgeB, a, query.edgeA, nearest.t, nearest.p, true, search, out);
  return true;
}

// The deepest corner below a face alone, wherever that is: the last resort, so that no overlap goes unseen.
void cornerContact(const HullView& ref, const HullView& inc, bool refIsA, const FaceQuery& query, Manifold& out) {
  Vec3 normal = ref.planes[query.face].normal;
  out.normal = refIsA ? normal : -normal;
  addPoint(out, refIsA, inc.vertices[query.vertex], normal, query.separation,
           refIsA ? cornerOfB(query.vertex) : cornerOfA(query.vertex));
}

// All axes nearly as good as the best face, until one shows the overlap.
class OtherAxes {
 public:
  OtherAxes(const HullView& a, const HullView& b, const Search& search, double face, Manifold& out, double deepest)
      : a_(a),
        b_(b),
        search_(search),
        enough_(face + search.tolerance.edge),
        nearlyAsGood_(face - search.tolerance.edge),
        out_(out),
        deepest_(deepest) {}

  bool tryFace(bool refIsA, const FaceQuery& query) {
    if (!(query.separation > nearlyAsGood_)) return false;
    Manifold trial;
    double least = faceContact(refIsA ? a_ : b_, refIsA ? b_ : a_, refIsA, query, search_, trial);
    if (least < deepest_ - search_.tolerance.slack) deepest_ = least, out_ = trial;
    return deepest_ <= enough_;
  }
  bool tryFaces(bool refIsA) {
    const HullView &ref = refIsA ? a_ : b_, &inc = refIsA ? b_ : a_;
    for (int f = 0; f < ref.faceCount; f++) {
      const HullPlane& plane = ref.planes[f];
      int vertex = supportVertex(inc, -plane.normal);
      if (tryFace(refIsA, {dot(plane.normal, inc.vertices[vertex]) - plane.offset, f, vertex})) return true;
    }
    return false;
  }
  bool tryEdges(const EdgeQuery& query) {
    bool better =
        query.edgeA >= 0 && query.separation > nearlyAsGood_ && query.separation < deepest_ - search_.tolerance.slack;
    if (better && edgeContact(a_, b_, query, 0, search_, out_)) deepest_ = query.separation;
    return deepest_ <= enough_;
  }

 private:
  const HullView &a_, &b_;
  const Search& search_;
  double enough_, nearlyAsGood_;
  Manifold& out_;
  double deepest_;
};

}  // namespace

void collideHullHull(const Shape& shapeA, const Shape& shapeB, const Transform& bInA, double margin,
                     const LoadedPoints& loaded, Manifold& out) {
  HullStorage storageA, storageB;
  HullView a = viewOf(shapeA, storageA), b = viewOf(shapeB, bInA, storageB);
  ContactTolerances tolerance = contactTolerances(a.innerRadius < b.innerRadius ? a.innerRadius : b.innerRadius);
  const Search search{margin, tolerance, loaded};

  bool touchAlongLine = false;
  FaceQuery faceA = queryFaces(a, b, margin, tolerance, touchAlongLine);
  if (!(faceA.separation <= margin)) return;
  FaceQuery faceB = queryFaces(b, a, margin, tolerance, touchAlongLine);
  if (!(faceB.separation <= margin) || touchAlongLine) return;
  bool sameFace = dot(a.planes[faceA.face].normal, b.planes[faceB.face].normal) < -kSameFace;
  bool refIsA = faceB.separation <= faceA.separation + (sameFace ? tolerance.otherFace : tolerance.face);
  double face = refIsA ? faceA.separation : faceB.separation;

  // Of faces that overlap a little, an edge axis that parts the hulls is looked for even if it is not better by its bias.
  double better = face + tolerance.edge;
  EdgeQuery edge = queryEdges(a, b, margin, face < 0 && better > 0 ? 0 : better);
  if (edge.edgeA >= 0 && edge.separation > margin) return;
  if (edge.edgeA >= 0 && edge.separation > better && edgeContact(a, b, edge, 0, search, out)) return;
  const FaceQuery& best = refIsA ? faceA : faceB;
  const FaceQuery& other = refIsA ? faceB : faceA;
  const HullView& ref = refIsA ? a : b;
  const HullView& inc = refIsA ? b : a;
  double deepest = faceContact(ref, inc, refIsA, best, search, out);
  if (face >= 0) return;
  if (edge.edgeA >= 0 && edge.separation > 0) {
    // Apart, corner beside corner or corner beside edge. What is below a face and over it may be outside all the same, where
    // the hull is narrower below: then the corners alone may touch.
    if (deepest >= -tolerance.slack) return;
    out.count = 0;
    edgeContact(a, b, edge, tolerance.same, search, out);
    return;
  }
  if (deepest <= better) return;
  // What lies over the reference face is not as deep as it says, or nothing lies there: another axis was better, but not by
  // its bias. Try all that are nearly as good.
  if (edge.edgeA < 0) edge = queryEdges(a, b, margin, -1e30);
  OtherAxes others(a, b, search, face, out, deepest);
  if (others.tryFace(!refIsA, other) || others.tryEdges(edge) || others.tryFaces(refIsA) || others.tryFaces(!refIsA))
    return;
  if (out.count == 0) cornerContact(ref, inc, refIsA, best, out);
}

}  // namespace brickfall
