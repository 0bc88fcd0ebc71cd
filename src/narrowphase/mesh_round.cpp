// Sphere and capsule on a face. A ball touches a surface where the distance to its core has a local least value: on a face
// above which the core is, or at an edge or corner from which the surface falls away on all sides (MeshFace).
#include "narrowphase/features.h"
#include "narrowphase/mesh_collide.h"
#include "narrowphase/segment.h"

namespace brickfall {

namespace {

constexpr double kParallelSquared = 1e-6;  // sine squared between a capsule and an edge that it lies along

struct RoundQuery {
  const MeshFace& face;
  Vec3 start, along;
  double radius, margin;
  std::vector<MeshContactPoint>& out;

  // A point of the core, the surface's point nearest to it, and the direction between them.
  void add(Vec3 core, Vec3 onMesh, Vec3 normal, double distance, std::uint32_t feature) const {
    double separation = distance - radius;
    if (separation <= margin) out.push_back({normal, onMesh, core - normal * radius, separation, feature});
  }
};

// The part of the core above the triangle: its ends.
void addFace(const RoundQuery& q) {
  double from = 0, to = 1, slack = 1e-9 * q.radius;
  for (int k = 0; k < 3; k++) {
    Vec3 outward = q.face.outward(k);
    double first = dot(outward, q.start - q.face.corner(k)) - slack, slope = dot(outward, q.along);
    if (slope > 0) {
      double t = -first / slope;
      to = t < to ? t : to;
    } else if (slope < 0) {
      double t = -first / slope;
      from = t > from ? t : from;
    } else if (first > 0) {
      return;
    }
  }
  if (!(from <= to)) return;
  bool one = !(lengthSquared(q.along) > 0);
  for (int end = 0; end < (one ? 1 : 2); end++) {
    Vec3 core = q.start + q.along * (end == 0 ? from : to);
    double height = q.face.height(core);
    q.add(core, core - q.face.normal() * height, q.face.normal(), height, roundPoint(end));
  }
}

void addNearest(const RoundQuery& q, int edge, const SegmentPair& pair) {
  Vec3 apart = pair.p - pair.q;
  double distance = length(apart);
  if (!(distance > 1e-6 * q.radius) || distance - q.radius > q.margin) return;
  Vec3 normal = apart * (1 / distance);
  if (pair.t > 0 && pair.t < 1) {
    if (q.face.edgePushes(edge, normal)) q.add(pair.p, pair.q, normal, distance, roundPoint(2));
  } else {
    int corner = pair.t <= 0 ? edge : (edge + 1) % 3;
    if (q.face.cornerPushes(corner, normal)) q.add(pair.p, pair.q, normal, distance, roundPoint(3));
  }
}

void addEdge(const RoundQuery& q, int k) {
  Vec3 a = q.face.corner(k), e = q.face.edge(k);
  double dd = lengthSquared(q.along), ee = lengthSquared(e);
  if (dd > 0 && lengthSquared(cross(q.along, e)) < kParallelSquared * dd * ee) {
    // It lies along the edge: both ends of the common stretch.
    double t0 = dot(a - q.start, q.along) / dd, t1 = dot(a + e - q.start, q.along) / dd;
    for (double t : {t0, t1}) {
      t = t < 0 ? 0 : t > 1 ? 1 : t;
      addNearest(q, k, nearestOfSegments(q.start + q.along * t, {}, a, e));
    }
    return;
  }
  addNearest(q, k, nearestOfSegments(q.start, q.along, a, e));
}

}  // namespace

void collideFaceRound(const MeshFace& face, Vec3 start, Vec3 end, double radius, double margin,
                      std::vector<MeshContactPoint>& out) {
  if (!(face.height((start + end) * 0.5) > 0)) return;
  RoundQuery query{face, start, end - start, radius, margin, out};
  addFace(query);
  for (int k = 0; k < 3; k++) addEdge(query, k);
}

}  // namespace brickfall
