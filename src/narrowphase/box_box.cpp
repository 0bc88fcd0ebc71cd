// Box against box: fifteen separating axes (Gottschalk et al. 1996), then the contact points of the winner.
//
// Boxes are what walls are made of, so this is written for a resting wall first. There neighbours touch with gaps of
// rounding size, faces are parallel to rounding, and several axes are equally good. Hence the order and the biases:
// face axes before edge axes, faces of a before faces of b, the first of equals; a later one must be better by a
// clear amount (ContactTolerances), or the normal would change from step to step with nothing moving.
//
// Notation: boxes a and b with half extents a[i], b[j]; c[i][j] = A_i . B_j; q = |c|; t = centre of b in the frame of
// a, s = the same vector along the axes of b. Separations are in metres along unit axes, negative = overlap.
#include <utility>

#include "narrowphase/clipping.h"
#include "narrowphase/edge_stretch.h"
#include "narrowphase/features.h"
#include "narrowphase/pairs.h"

namespace brickfall {
namespace {

constexpr int kNext[3] = {1, 2, 0}, kLast[3] = {2, 0, 1};
// Edges that turn against each other by less than this (rad, squared) have no useful cross product; the face axes
// then see all.
constexpr double kParallel2 = 1e-8;
// Face axes that are parallel to this cosine compete for the same contact.
constexpr double kSameFace = 0.98;
//! half extents | too small: leaning edges slip on each other's faces | too large: a box that slides past an edge tilts early
constexpr double kRoundShare = 0.01;

struct BoxPair {
  double a[3], b[3];
  double c[3][3], q[3][3];
  double t[3], s[3];
  double smallest;  // of all half extents
  ContactTolerances tolerance;
  const LoadedPoints* loaded;
};

BoxPair makePair(const Shape& shapeA, const Shape& shapeB, const Transform& bInA, const LoadedPoints& loaded) {
  BoxPair p;
  p.loaded = &loaded;
  Mat3 r = toMatrix(bInA.rotation);
  Vec3 s = transposeTimes(r, bInA.position);
  p.smallest = 1e30;
  for (int i = 0; i < 3; i++) {
    p.a[i] = shapeA.halfExtents[i];
    p.b[i] = shapeB.halfExtents[i];
    p.t[i] = bInA.position[i];
    p.s[i] = s[i];
    p.smallest = p.a[i] < p.smallest ? p.a[i] : p.smallest;
    p.smallest = p.b[i] < p.smallest ? p.b[i] : p.smallest;
    for (int j = 0; j < 3; j++) {
      p.c[i][j] = r.row[i][j];
      p.q[i][j] = std::fabs(p.c[i][j]);
    }
  }
  p.tolerance = contactTolerances(p.smallest);
  return p;
}

struct FaceAxis {
  double separation = -1e30;
  int index = -1;  // 0..2 faces of a, 3..5 faces of b
};

// False if a face axis separates the two by more than the margin, or if they meet only along an edge: when the other
// box just touches the plane of one face and is beyond, or just touches, that of a second, the patch has no width (a
// brick and its diagonal neighbour). Such a line carries nothing, and which of the two normals it would get is
// decided by rounding; sideways would be harmful. `other`: the best of the other box.
bool testFaces(const BoxPair& p, double margin, FaceAxis& best, FaceAxis& other) {
  double sa[3], sb[3];
  int outA = 0, outB = 0;             // faces that the other box does not reach over
  bool justA = false, justB = false;  // ... and one of them by rounding only
  for (int i = 0; i < 3; i++) {
    sa[i] = std::fabs(p.t[i]) - p.a[i] - (p.b[0] * p.q[i][0] + p.b[1] * p.q[i][1] + p.b[2] * p.q[i][2]);
    sb[i] = std::fabs(p.s[i]) - p.b[i] - (p.a[0] * p.q[0][i] + p.a[1] * p.q[1][i] + p.a[2] * p.q[2][i]);
    if (!(sa[i] <= margin) || !(sb[i] <= margin)) return false;
    outA += sa[i] > -p.tolerance.slack;
    outB += sb[i] > -p.tolerance.slack;
    justA = justA || std::fabs(sa[i]) <= p.tolerance.slack;
    justB = justB || std::fabs(sb[i]) <= p.tolerance.slack;
  }
  if ((outA > 1 && justA) || (outB > 1 && justB)) return false;
  FaceAxis ofA, ofB;
  for (int i = 0; i < 3; i++) {
    if (sa[i] > ofA.separation + p.tolerance.face) ofA = {sa[i], i};
    if (sb[i] > ofB.separation + p.tolerance.face) ofB = {sb[i], 3 + i};
  }
  bool sameContact = p.q[ofA.index][ofB.index - 3] > kSameFace;
  bool takeB = ofB.separation > ofA.separation + (sameContact ? p.tolerance.otherFace : p.tolerance.face);
  best = takeB ? ofB : ofA;
  other = takeB ? ofA : ofB;
  return true;
}

struct EdgeAxis {
  double separation = -1e30;
  int edgeA = -1, edgeB = -1;
  double inverseLength = 0;  // of the cross product
};

// L = A_i x B_j: L.A_i1 = -c[i2][j], L.A_i2 = c[i1][j], L.B_j1 = c[i][j2], L.B_j2 = -c[i][j1], with (i, i1, i2) cyclic.
// False if one separates. An axis that cannot beat `best` costs no root: |L| <= 1, so dividing an overlap by it only
// makes the overlap larger.
bool testEdges(const BoxPair& p, double margin, double toBeat, EdgeAxis& best) {
  best.separation = toBeat;
  for (int i = 0; i < 3; i++) {
    int i1 = kNext[i], i2 = kLast[i];
    for (int j = 0; j < 3; j++) {
      int j1 = kNext[j], j2 = kLast[j];
      double distance = std::fabs(p.c[i1][j] * p.t[i2] - p.c[i2][j] * p.t[i1]);
      double extents = p.a[i1] * p.q[i2][j] + p.a[i2] * p.q[i1][j] + p.b[j1] * p.q[i][j2] + p.b[j2] * p.q[i][j1];
      double scaled = distance - extents;
      if (scaled <= best.separation && scaled <= 0) continue;
      double length2 = p.c[i1][j] * p.c[i1][j] + p.c[i2][j] * p.c[i2][j];
      if (length2 < kParallel2) continue;
      double inverseLength = 1 / std::sqrt(length2);
      double separation = scaled * inverseLength;
      if (separation > margin) return false;
      if (separation > best.separation) best = {separation, i, j, inverseLength};
    }
  }
  return true;
}

// An edge of a box, seen in the frame of a box: of that box or the other.
struct BoxEdgeView {
  int axis;            // of its box: its direction
  bool next, last;     // on the positive side of the next axis, and of the one after
  double at;           // m along it from its middle: where it crosses
  const double* half;  // half extents of its box

  int number() const { return boxEdge(axis, next, last); }
  int corner(bool positive) const {
    return (positive ? 1 << axis : 0) | (next ? 1 << kNext[axis] : 0) | (last ? 1 << kLast[axis] : 0);
  }
};

// Both ways along `edge` from the crossing, over the faces that meet in `other`. The axes of both boxes are those in the
// frame of a.
void addStretches(const BoxEdgeView& edge, const BoxEdgeView& other, const Vec3* axesOfEdge, const Vec3* axesOfOther,
                  bool edgeOfB, double margin, double same, Manifold& out) {
  Vec3 direction, normal;  // in the frame of the other's box
  for (int k = 0; k < 3; k++) {
    direction[k] = dot(axesOfEdge[edge.axis], axesOfOther[k]);
    normal[k] = dot(out.normal, axesOfOther[k]);
  }
  const int k1 = kNext[other.axis], k2 = kLast[other.axis];
  const double s1 = other.next ? 1 : -1, s2 = other.last ? 1 : -1;
  for (const double sign : {-1.0, 1.0}) {
    // The way leads inward from the plane of one face, so it lies over the other.
    const bool overFirst = sign * s1 * direction[k1] > sign * s2 * direction[k2];
    const int face = overFirst ? k1 : k2, inward = overFirst ? k2 : k1;
    const double up = overFirst ? s1 : s2, in = overFirst ? s2 : s1;
    if (normal[face] == 0) continue;
    const Vec3 onFace = (direction - normal * (direction[face] / normal[face])) * sign;  // seen along the normal
    const double across = in * onFace[inward], along = onFace[other.axis];
    const double toFar = across < 0 ? 2 * other.half[inward] / -across : 1e30;
    const double room = other.half[other.axis] - (along > 0 ? other.at : -other.at);
    const double toNear = along != 0 ? room / std::fabs(along) : 1e30;
    const bool far = toFar < toNear;  // leaves the face by the side opposite to `other`, else by one at its ends
    bool side[3] = {};                // signs of that side
    side[face] = up > 0;
    side[inward] = in < 0;
    side[other.axis] = along > 0;
    const int number =
        far ? boxEdge(other.axis, side[k1], side[k2]) : boxEdge(inward, side[kNext[inward]], side[kLast[inward]]);
    const int corner = edge.corner(sign > 0);
    addStretch({axesOfEdge[edge.axis] * sign, edge.half[edge.axis] - sign * edge.at, axesOfOther[face] * up,
                far ? toFar : toNear, edgeOfB ? cornerOfB(corner) : cornerOfA(corner),
                edgeOfB ? edgeCrossing(number, edge.number()) : edgeCrossing(edge.number(), number)},
               edgeOfB, margin, same, out);
  }
}

// The crossing of two edges. False if it lies outside one of them: then the axis is not the one of least overlap.
bool edgeContact(const BoxPair& p, const EdgeAxis& axis, double margin, Manifold& out) {
  int i = axis.edgeA, i1 = kNext[i], i2 = kLast[i];
  int j = axis.edgeB, j1 = kNext[j], j2 = kLast[j];
  double n1 = -p.c[i2][j] * axis.inverseLength, n2 = p.c[i1][j] * axis.inverseLength;
  if (n1 * p.t[i1] + n2 * p.t[i2] < 0) n1 = -n1, n2 = -n2;
  Vec3 n;
  n[i1] = n1;
  n[i2] = n2;
  Vec3 u[3];  // the axes of b
  for (int k = 0; k < 3; k++) u[k] = {p.c[0][k], p.c[1][k], p.c[2][k]};
  bool a1 = n1 > 0, a2 = n2 > 0, b1 = dot(u[j1], n) < 0, b2 = dot(u[j2], n) < 0;
  Vec3 onA;  // middle of the edge of a, then the point on it
  onA[i1] = a1 ? p.a[i1] : -p.a[i1];
  onA[i2] = a2 ? p.a[i2] : -p.a[i2];
  Vec3 middleB = Vec3{p.t[0], p.t[1], p.t[2]} + u[j1] * (b1 ? p.b[j1] : -p.b[j1]) + u[j2] * (b2 ? p.b[j2] : -p.b[j2]);
  // (Q - P) x B_j . L / |L|^2 and the same with A_i: no cancellation, however small the angle.
  Vec3 axisA;
  axisA[i] = 1;
  Vec3 crossed = cross(axisA, u[j]) * (axis.inverseLength * axis.inverseLength);
  Vec3 between = middleB - onA;
  double x = dot(cross(between, u[j]), crossed), y = dot(cross(between, axisA), crossed);
  if (std::fabs(x) > p.a[i] + p.tolerance.same || std::fabs(y) > p.b[j] + p.tolerance.same) return false;
  onA[i] = x;
  out.normal = n;
  out.count = 1;
  out.partial = false;
  out.points[0] = {onA, onA + n * axis.separation, axis.separation,
                   edgeCrossing(boxEdge(i, a1, a2), boxEdge(j, b1, b2))};
  Vec3 unit[3];
  for (int k = 0; k < 3; k++) unit[k][k] = 1;
  const BoxEdgeView ofA{i, a1, a2, x, p.a}, ofB{j, b1, b2, y, p.b};
  addStretches(ofA, ofB, unit, u, false, margin, p.tolerance.same, out);
  addStretches(ofB, ofA, u, unit, true, margin, p.tolerance.same, out);
  return true;
}

// Of two edges side by side, at `a` on A and `b` on B, one lies over the face beside the other: the point on that edge, and
// that on the face, along `n`.
ManifoldPoint edgeOverFace(Vec3 a, Vec3 b, Vec3 n, Vec3 faceOfA, Vec3 faceOfB, std::uint32_t name) {
  const Vec3 between = b - a;
  const bool overB = dot(between, faceOfB - faceOfA) > 0;
  const Vec3 face = overB ? faceOfB : faceOfA;
  const double separation = dot(between, face) / dot(n, face);
  return overB ? ManifoldPoint{a, a + n * separation, separation, name}
               : ManifoldPoint{b - n * separation, b, separation, name};
}

// Two edges side by side, as where plates lean against each other: between the normals of the faces that end there any is as
// good, and that of a face would hold or let go by its own tilt. As if both were a little round: in the middle where edge
// lies on edge, turning towards a face's normal as the other edge gets over that face.
bool lineContact(const BoxPair& p, const FaceAxis& ofA, const FaceAxis& ofB, double margin, Manifold& out) {
  int fa = ofA.index, fb = ofB.index - 3;
  if (p.q[fa][fb] > kSameFace) return false;
  int i = kNext[fa], j = kNext[fb];  // the edges' directions
  for (int x : {kNext[fa], kLast[fa]})
    for (int y : {kNext[fb], kLast[fb]})
      if (p.q[x][y] > p.q[i][j]) i = x, j = y;
  double sine2 = 1 - p.q[i][j] * p.q[i][j], along = p.a[i] < p.b[j] ? p.a[i] : p.b[j];
  if (sine2 * along * along > p.tolerance.same * p.tolerance.same) return false;
  int ka = 3 - fa - i, kb = 3 - fb - j;
  Vec3 unitA[3], unitB[3];
  for (int k = 0; k < 3; k++) {
    unitA[k][k] = 1;
    unitB[k] = {p.c[0][k], p.c[1][k], p.c[2][k]};
  }
  double signA = p.t[fa] < 0 ? -1 : 1, signB = p.s[fb] < 0 ? -1 : 1;
  Vec3 nA = unitA[fa] * signA, nB = unitB[fb] * signB;  // from a to b
  if (dot(nA, nB) < 0) return false;
  bool upA = dot(unitA[ka], nB) > 0, upB = dot(unitB[kb], nA) < 0;
  Vec3 onA = nA * p.a[fa] + unitA[ka] * (upA ? p.a[ka] : -p.a[ka]);
  Vec3 onB = Vec3{p.t[0], p.t[1], p.t[2]} - nB * p.b[fb] + unitB[kb] * (upB ? p.b[kb] : -p.b[kb]);
  Vec3 between = onB - onA, across = nB - nA;
  double round = kRoundShare * p.smallest;
  double tilt = dot(between, normalized(across)) / (2 * round);
  if (std::fabs(tilt) >= 0.5 * length(across)) return false;
  Vec3 n = normalized(nA + nB) * std::sqrt(1 - tilt * tilt) + normalized(across) * tilt;
  double low = p.t[i] - p.b[j] > -p.a[i] ? p.t[i] - p.b[j] : -p.a[i];
  double high = p.t[i] + p.b[j] < p.a[i] ? p.t[i] + p.b[j] : p.a[i];
  if (high - low <= p.tolerance.same) return false;
  out.normal = n;
  out.count = 0;
  for (int end : {0, 1}) {
    double at = end ? high : low;
    bool atB = at != (end ? p.a[i] : -p.a[i]), positiveB = (p.c[i][j] > 0) == (end == 1);
    int corner = atB ? (positiveB ? 1 << j : 0) | (signB < 0 ? 1 << fb : 0) | (upB ? 1 << kb : 0)
                     : (end ? 1 << i : 0) | (signA > 0 ? 1 << fa : 0) | (upA ? 1 << ka : 0);
    onA[i] = at;
    const Vec3 alsoOnB = onB + unitB[j] * ((at - onB[i]) / unitB[j][i]);
    const ManifoldPoint point = edgeOverFace(onA, alsoOnB, n, nA, nB, atB ? cornerOfB(corner) : cornerOfA(corner));
    if (point.separation <= margin) out.points[out.count++] = point;
  }
  return out.count > 0;
}

// A corner of the polygon while it is cut. It is where two lines meet: edges of the incident face (0..3) or sides of
// the reference face (4..7: u+, u-, v+, v-); `before` and `after` in the order around the polygon.
struct ClipCorner {
  double u, v, d;
  int before, after;
};

double towards(int label, const ClipCorner& corner) {
  double x = label < 6 ? corner.u : corner.v;
  return label & 1 ? -x : x;
}

bool anyBeyond(const ClipCorner* corners, int count, int label, double limit) {
  for (int i = 0; i < count; i++)
    if (towards(label, corners[i]) > limit) return true;
  return false;
}

// Cuts what is beyond `limit` on one side. `label` is the side's; in: <= 8 corners, out: one more at most.
int cutSide(const ClipCorner* from, int count, ClipCorner* to, int label, double limit, double slack) {
  int kept = 0;
  for (int i = 0; i < count; i++) {
    const ClipCorner& c = from[i];
    const ClipCorner& next = from[i + 1 == count ? 0 : i + 1];
    double dc = towards(label, c) - limit, dn = towards(label, next) - limit;
    bool inside = dc <= slack, nextInside = dn <= slack;
    if (inside) to[kept++] = c;
    if (inside == nextInside) continue;
    double f = dc / (dc - dn);
    f = f < 0 ? 0 : f > 1 ? 1 : f;
    ClipCorner& cut = to[kept++];
    cut = {c.u + (next.u - c.u) * f, c.v + (next.v - c.v) * f, c.d + (next.d - c.d) * f, c.after, label};
    if (!inside) cut.before = label, cut.after = c.after;
  }
  return kept;
}

// A face of a box with a line on it: which corner or edge of the box is meant.
struct FaceFrame {
  int axis, sign;  // of the face's normal
  int u, v;        // the other two axes

  static FaceFrame of(int axis, int sign) { return {axis, sign, kNext[axis], kLast[axis]}; }
};
// Incident lines: 0 is v+, 1 is u-, 2 is v-, 3 is u+. Side lines: 4 is u+, 5 is u-, 6 is v+, 7 is v-.
bool lineIsU(int line) { return line < 4 ? line & 1 : line < 6; }
bool linePositive(int line) { return line < 4 ? line == 0 || line == 3 : !(line & 1); }

int cornerName(const FaceFrame& f, int line1, int line2) {
  if (!lineIsU(line1)) std::swap(line1, line2);
  return (f.sign > 0 ? 1 << f.axis : 0) | (linePositive(line1) ? 1 << f.u : 0) | (linePositive(line2) ? 1 << f.v : 0);
}
int edgeName(const FaceFrame& f, int line) {
  bool side = linePositive(line);
  // Along v for a u line: the next axes after v are axis, u. Along u: v, axis.
  return lineIsU(line) ? boxEdge(f.v, f.sign > 0, side) : boxEdge(f.u, side, f.sign > 0);
}

struct FaceContact {
  FaceFrame reference, incident;
  double refHalf[3];
  PatchPoint points[8];
  ReducedPatch kept;
};

std::uint32_t featureName(const FaceContact& face, bool refIsA, const ClipCorner& corner) {
  bool first = corner.before >= 4, second = corner.after >= 4;
  if (first && second) {
    int name = cornerName(face.reference, corner.before, corner.after);
    return refIsA ? cornerOfA(name) : cornerOfB(name);
  }
  if (!first && !second) {
    int name = cornerName(face.incident, corner.before, corner.after);
    return refIsA ? cornerOfB(name) : cornerOfA(name);
  }
  int ref = edgeName(face.reference, first ? corner.before : corner.after);
  int inc = edgeName(face.incident, first ? corner.after : corner.before);
  return refIsA ? edgeCrossing(ref, inc) : edgeCrossing(inc, ref);
}

// Cuts the face of the other box that looks at the reference face most against the sides of the reference face, in
// the frame of the reference box, where a side is a comparison.
void clipFace(const BoxPair& p, int axisIndex, double margin, FaceContact& face) {
  bool refIsA = axisIndex < 3;
  int axis = refIsA ? axisIndex : axisIndex - 3;
  double m[3][3], centre[3];  // axes (columns) and centre of the incident box
  const double* ref = refIsA ? p.a : p.b;
  const double* inc = refIsA ? p.b : p.a;
  for (int i = 0; i < 3; i++) {
    for (int k = 0; k < 3; k++) m[i][k] = refIsA ? p.c[i][k] : p.c[k][i];
    centre[i] = refIsA ? p.t[i] : -p.s[i];
    face.refHalf[i] = ref[i];
  }
  int sign = centre[axis] < 0 ? -1 : 1;
  constexpr double kTie = 1e-9;
  int incAxis = 0;
  for (int k = 1; k < 3; k++)
    if (std::fabs(m[axis][k]) > std::fabs(m[axis][incAxis]) + kTie) incAxis = k;
  int incSign = m[axis][incAxis] * sign > 0 ? -1 : 1;
  face.reference = FaceFrame::of(axis, sign);
  face.incident = FaceFrame::of(incAxis, incSign);
  int u = face.reference.u, v = face.reference.v, iu = face.incident.u, iv = face.incident.v;

  ClipCorner corners[2][9];
  auto along = [&](int row, double su, double sv) {
    return centre[row] + m[row][incAxis] * (incSign * inc[incAxis]) + m[row][iu] * (su * inc[iu]) +
           m[row][iv] * (sv * inc[iv]);
  };
  constexpr int kTurn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  for (int k = 0; k < 4; k++) {
    auto [su, sv] = kTurn[k];
    corners[0][k] = {along(u, su, sv), along(v, su, sv), sign * along(axis, su, sv) - ref[axis], (k + 3) & 3, k};
  }
  int count = 4, current = 0;
  for (int label = 4; label < 8 && count > 0; label++) {
    double limit = label < 6 ? ref[u] : ref[v];
    if (!anyBeyond(corners[current], count, label, limit + p.tolerance.slack)) continue;
    count = cutSide(corners[current], count, corners[current ^ 1], label, limit, p.tolerance.slack);
    current ^= 1;
  }
  int near = 0;
  for (int k = 0; k < count; k++) {
    const ClipCorner& corner = corners[current][k];
    if (corner.d > margin) continue;
    face.points[near++] = {corner.u, corner.v, corner.d, featureName(face, refIsA, corner)};
  }
  face.kept = reducePatch(face.points, near, p.tolerance, *p.loaded);
}

bool faceContact(const BoxPair& p, int axisIndex, double margin, const Transform& bInA, Manifold& out) {
  FaceContact face;
  clipFace(p, axisIndex, margin, face);
  if (face.kept.count == 0) return false;
  bool refIsA = axisIndex < 3;
  const FaceFrame& f = face.reference;
  Vec3 refNormal;
  refNormal[f.axis] = f.sign;
  if (!refIsA) refNormal = {f.sign * p.c[0][f.axis], f.sign * p.c[1][f.axis], f.sign * p.c[2][f.axis]};
  out.normal = refIsA ? refNormal : -refNormal;
  out.count = face.kept.count;
  out.partial = face.kept.partial;
  for (int k = 0; k < out.count; k++) {
    const PatchPoint& point = face.points[k];
    double x[3];
    x[f.axis] = f.sign * face.refHalf[f.axis];
    x[f.u] = point.u;
    x[f.v] = point.v;
    Vec3 onRef{x[0], x[1], x[2]};
    if (!refIsA) {
      for (int i = 0; i < 3; i++)
        onRef[i] = bInA.position[i] + (p.c[i][0] * x[0] + p.c[i][1] * x[1] + p.c[i][2] * x[2]);
    }
    Vec3 onInc = onRef + refNormal * point.separation;
    out.points[k] = {refIsA ? onRef : onInc, refIsA ? onInc : onRef, point.separation, point.feature};
  }
  return true;
}

// The deepest corner below a face alone, wherever that is: the last resort, so that no overlap goes unseen.
void cornerContact(const BoxPair& p, const FaceAxis& face, const Transform& bInA, Manifold& out) {
  bool refIsA = face.index < 3;
  int axis = refIsA ? face.index : face.index - 3, name = 0;
  double sign = (refIsA ? p.t[axis] : p.s[axis]) < 0 ? -1 : 1;  // the normal is sign times that axis, from a to b
  Mat3 r = toMatrix(bInA.rotation);
  Vec3 normal;
  normal[axis] = sign;
  if (!refIsA) normal = r * normal;
  Vec3 towards = refIsA ? -transposeTimes(r, normal) : normal;  // in the frame of the box whose corner it is
  const double* half = refIsA ? p.b : p.a;
  Vec3 corner;
  for (int k = 0; k < 3; k++) {
    corner[k] = towards[k] > 0 ? half[k] : -half[k];
    if (towards[k] > 0) name |= 1 << k;
  }
  Vec3 onA = refIsA ? r * corner + bInA.position - normal * face.separation : corner;
  out.normal = normal;
  out.count = 1;
  out.points[0] = {onA, onA + normal * face.separation, face.separation, refIsA ? cornerOfB(name) : cornerOfA(name)};
}

double deepestOf(const Manifold& m) {
  double least = 1e30;
  for (int i = 0; i < m.count; i++) least = m.points[i].separation < least ? m.points[i].separation : least;
  return least;
}

}  // namespace

void collideBoxBox(const Shape& a, const Shape& b, const Transform& bInA, double margin, const LoadedPoints& loaded,
                   Manifold& out) {
  BoxPair p = makePair(a, b, bInA, loaded);
  FaceAxis face, otherFace;
  if (!testFaces(p, margin, face, otherFace)) return;
  EdgeAxis edge;
  if (!testEdges(p, margin, face.separation + p.tolerance.edge, edge)) return;
  if (edge.edgeA >= 0 && edgeContact(p, edge, margin, out)) return;
  const bool refIsA = face.index < 3;
  if (lineContact(p, refIsA ? face : otherFace, refIsA ? otherFace : face, margin, out)) return;
  faceContact(p, face.index, margin, bInA, out);
  double deepest = deepestOf(out);
  if (face.separation >= 0 || deepest <= face.separation + p.tolerance.edge) return;
  // The face axes overlap, but what lies over the reference face is not as deep, or nothing lies there. Either the boxes are
  // apart (corner beside corner, which only an edge axis sees), or another axis was better, but not by its bias: try the
  // others.
  edge = {};
  if (!testEdges(p, margin, -1e30, edge) || edge.separation > 0) return;
  if (otherFace.separation > face.separation - p.tolerance.edge) {
    Manifold trial;
    if (faceContact(p, otherFace.index, margin, bInA, trial) && deepestOf(trial) < deepest) {
      out = trial;
      deepest = deepestOf(out);
      if (deepest <= face.separation + p.tolerance.edge) return;
    }
  }
  if (edge.edgeA >= 0 && edge.separation < deepest && edgeContact(p, edge, margin, out)) return;
  if (out.count == 0) cornerContact(p, face, bInA, out);
}

}  // namespace brickfall
