// Capsule against box or hull. The capsule's axis is a segment; what happens depends on where it runs:
//   outside the hull   the nearest points decide, exactly: an end above a face, or a place beside an edge
//   through the hull   the axis of least overlap decides: a face, or an edge crossed with the segment
// If the normal is that of a face, or nearly, and the segment runs along it, the capsule lies on it: the segment is
// cut to the face and both its ends touch.
#include <algorithm>

#include "narrowphase/features.h"
#include "narrowphase/hull_view.h"
#include "narrowphase/pairs.h"
#include "narrowphase/segment.h"

namespace brickfall {
namespace {

constexpr double kLiesOnFace = 0.998, kRunsAlongFace = 0.0632;  // cosine and sine of 3.6 degrees
constexpr double kLoss = 0.005;  // of the smaller shape: depth that lying on the face may hide or add
constexpr double kParallel2 = 1e-8;

struct Segment {
  Vec3 p, d;  // p + t d, 0 <= t <= 1
};

// What decides, in the frame of the hull.
struct CapsuleAxis {
  Vec3 normal;          // unit, out of the hull
  double distance = 0;  // of the segment from the hull along it; negative = through it
  Vec3 onSegment;
  double t = 0;
  int face = -1;  // lies on this face
};

double heightAbove(const HullPlane& plane, Vec3 p) { return dot(plane.normal, p) - plane.offset; }

// The stretch of the segment above a face: between the planes through the face's edges along its normal.
bool cutToFace(const HullView& hull, int face, const Segment& segment, double& from, double& to) {
  Vec3 normal = hull.planes[face].normal;
  from = 0, to = 1;
  int e = hull.firstEdge[face];
  do {
    Vec3 a = hull.vertices[hull.edges[e].origin];
    e = hull.edges[e].next;
    Vec3 outward = cross(hull.vertices[hull.edges[e].origin] - a, normal);
    double start = dot(outward, segment.p - a), slope = dot(outward, segment.d);
    if (slope > 0) to = std::min(to, -start / slope);
    if (slope < 0) from = std::max(from, -start / slope);
    if (slope == 0 && start > 0) return false;
  } while (e != hull.firstEdge[face]);
  return from <= to;
}

// Segment outside: its nearest point. An end right above a face, or the best of the edges.
CapsuleAxis nearestOutside(const HullView& hull, const Segment& segment) {
  CapsuleAxis best;
  best.distance = 1e30;
  for (int e = 0; e < hull.edgeCount; e += 2) {
    Vec3 a = hull.vertices[hull.edges[e].origin], along = hull.vertices[hull.edges[e + 1].origin] - a;
    SegmentPair pair = nearestOfSegments(segment.p, segment.d, a, along);
    double distance = length(pair.p - pair.q);
    if (distance < best.distance * (1 - 1e-9)) {
      best.distance = distance;
      best.normal = distance > 0 ? (pair.p - pair.q) * (1 / distance) : Vec3{};
      best.onSegment = pair.p;
      best.t = pair.s;
    }
  }
  for (int f = 0; f < hull.faceCount; f++)
    for (int end = 0; end < 2; end++) {
      Vec3 p = segment.p + segment.d * double(end);
      double height = heightAbove(hull.planes[f], p), from, to;
      if (height <= 0 || height > best.distance || !cutToFace(hull, f, {p, {}}, from, to)) continue;
      best = {hull.planes[f].normal, height, p, double(end), f};
    }
  return best;
}

// The edge axis of least overlap: the segment's normals are a great circle on the Gauss sphere, an edge's are an arc.
CapsuleAxis bestEdgeAxis(const HullView& hull, const Segment& segment) {
  CapsuleAxis best;
  best.distance = -1e30;
  double dd = lengthSquared(segment.d);
  for (int e = 0; e < hull.edgeCount; e += 2) {
    Vec3 n1 = hull.planes[hull.edges[e].face].normal, n2 = hull.planes[hull.edges[e + 1].face].normal;
    if (dot(n1, segment.d) * dot(n2, segment.d) >= 0) continue;
    Vec3 a = hull.vertices[hull.edges[e].origin], along = hull.vertices[hull.edges[e + 1].origin] - a;
    Vec3 axis = cross(segment.d, along);
    double length2 = lengthSquared(axis);
    if (length2 < kParallel2 * dd * lengthSquared(along)) continue;
    axis *= 1 / std::sqrt(length2);
    if (dot(axis, n1 + n2) < 0) axis = -axis;
    double distance = dot(axis, segment.p - a);
    if (distance <= best.distance) continue;
    SegmentPair pair = nearestOfSegments(segment.p, segment.d, a, along);
    best = {axis, distance, pair.p, pair.s, -1};
  }
  return best;
}

// The face axis on which the nearer end of the segment is highest.
CapsuleAxis bestFaceAxis(const HullView& hull, const Segment& segment, double faceBias) {
  CapsuleAxis best;
  best.distance = -1e30;
  for (int f = 0; f < hull.faceCount; f++) {
    double h0 = heightAbove(hull.planes[f], segment.p), h1 = heightAbove(hull.planes[f], segment.p + segment.d);
    double height = std::min(h0, h1);
    if (height <= best.distance + faceBias) continue;
    double t = h0 <= h1 ? 0 : 1;
    best = {hull.planes[f].normal, height, segment.p + segment.d * t, t, f};
  }
  return best;
}

int faceAlong(const HullView& hull, Vec3 normal) {
  int best = 0;
  for (int f = 1; f < hull.faceCount; f++)
    if (dot(hull.planes[f].normal, normal) > dot(hull.planes[best].normal, normal) + 1e-9) best = f;
  return best;
}

}  // namespace

void collideCapsuleHull(const Shape& capsule, const Shape& b, const Transform& bInA, double margin, Manifold& out) {
  HullStorage storage;
  HullView hull = viewOf(b, storage);
  // The capsule's axis in the frame of the hull.
  Quat back = conjugate(bInA.rotation);
  Vec3 half = rotate(back, Vec3{0, capsule.halfHeight, 0});
  Segment segment{-rotate(back, bInA.position) - half, half * 2.0};
  double smaller = std::min(capsule.radius, hull.innerRadius);
  ContactTolerances tolerance = contactTolerances(smaller);

  CapsuleAxis axis = bestFaceAxis(hull, segment, tolerance.face);
  if (!(axis.distance - capsule.radius <= margin)) return;
  CapsuleAxis edge = bestEdgeAxis(hull, segment);
  bool outside = std::max(axis.distance, edge.distance) > 1e-9 * capsule.radius;
  if (outside) {
    axis = nearestOutside(hull, segment);
    if (!(axis.distance - capsule.radius <= margin)) return;
  } else if (edge.distance > axis.distance + tolerance.edge) {
    axis = edge;
  }

  // Points in the frame of the hull: on its surface, then out along the normal.
  Vec3 onHull[2];
  double separation[2] = {};
  std::uint32_t feature[2];
  Vec3 normal = axis.normal;
  int count = 0, face = axis.face >= 0 ? axis.face : faceAlong(hull, normal);
  double from, to;
  bool lies =
      dot(hull.planes[face].normal, normal) > kLiesOnFace &&
      (axis.face >= 0 || std::fabs(dot(hull.planes[face].normal, segment.d)) < kRunsAlongFace * length(segment.d));
  if (lies && cutToFace(hull, face, segment, from, to)) {
    normal = hull.planes[face].normal;
    for (int end = 0; end < 2; end++) {
      if (end == 1 && (to - from) * 2 * capsule.halfHeight < tolerance.same) break;
      Vec3 p = segment.p + segment.d * (end == 0 ? from : to);
      double height = heightAbove(hull.planes[face], p);
      if (height - capsule.radius > margin) continue;
      onHull[count] = p - normal * height;
      separation[count] = height - capsule.radius;
      feature[count++] = roundPoint(end);
    }
  }
  // A segment that leaves the face at a slight angle can be nearest just beside it, or, running through the hull, go deeper
  // below that face than it takes to push it out another way: then the one point says more.
  double nearer = count == 2 && separation[1] < separation[0] ? separation[1] : separation[0];
  double off = nearer - (axis.distance - capsule.radius);
  bool below = axis.face < 0 && off < -kLoss * smaller;
  if (count == 0 || (outside && off > kLoss * smaller) || below) {
    normal = axis.normal;
    onHull[0] = axis.onSegment - normal * axis.distance;
    separation[0] = axis.distance - capsule.radius;
    feature[0] = roundPoint(axis.t == 0 ? 0 : axis.t == 1 ? 1 : 2);
    count = 1;
  }
  out.normal = -rotate(bInA.rotation, normal);
  out.count = count;
  for (int i = 0; i < count; i++) {
    Vec3 onB = transformPoint(bInA, onHull[i]);
    out.points[i] = {onB - out.normal * separation[i], onB, separation[i], feature[i]};
  }
}

}  // namespace brickfall
