// From the points of many faces to a few manifolds. A floor of many triangles gives one manifold; ground with slopes one for
// each direction. Of the points of a direction up to four are kept that span the largest area, those that touch before those
// that are only near.
#include <algorithm>

#include "narrowphase/clipping.h"
#include "narrowphase/mesh_collide.h"

namespace brickfall {

namespace {

constexpr double kSameNormal = 0.999;  // cosine of 2.56 degrees
constexpr double kTouching = 2e-4;     // m beyond the nearest point: counts as touching with it
constexpr double kSamePlace = 1e-4;    // of the shape's size: nearer points are one

// Picks points in the plane of a manifold, by their coordinates in it.
class Picker {
 public:
  Picker(const MeshContactPoint* points, int count, Vec3 normal, double same)
      : points_(points), count_(count), same_(same) {
    Vec3 a = std::fabs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    u_ = normalized(cross(normal, a)), v_ = cross(normal, u_);
  }

  // Adds up to four in all, of those no further away than `limit`.
  void pick(double limit) {
    for (int n = chosenCount; n < kMaxManifoldPoints; n++) {
      int best = -1;
      double most = n == 0 ? -1e300 : 0;
      for (int i = 0; i < count_; i++) {
        if (points_[i].separation > limit) continue;
        double gain = gainOf(i);
        if (gain > (n == 0 ? most : most * (1 + 1e-6))) most = gain, best = i;
      }
      if (best < 0) return;
      chosen[chosenCount++] = best;
    }
  }

  int chosen[kMaxManifoldPoints] = {};
  int chosenCount = 0;

 private:
  double u(int i) const { return dot(u_, points_[i].onMesh - points_[0].onMesh); }
  double v(int i) const { return dot(v_, points_[i].onMesh - points_[0].onMesh); }
  // Twice the area, positive if r is left of p q.
  double area(int p, int q, int r) const { return (u(q) - u(p)) * (v(r) - v(p)) - (v(q) - v(p)) * (u(r) - u(p)); }
  double apart(int p, int q) const {
    double du = u(p) - u(q), dv = v(p) - v(q);
    return std::sqrt(du * du + dv * dv);
  }

  // What a point adds: the outermost along a fixed direction, the furthest from it, then the area outside what is chosen.
  double gainOf(int i) const {
    const int* c = chosen;
    if (chosenCount == 0) return u(i) + 0.1 * v(i);
    for (int k = 0; k < chosenCount; k++)
      if (apart(c[k], i) < same_) return 0;
    if (chosenCount == 1) return apart(c[0], i);
    if (chosenCount == 2) {
      double twice = std::fabs(area(c[0], c[1], i)), along = apart(c[0], c[1]);
      return twice > same_ * along ? twice : 0;
    }
    double turn = area(c[0], c[1], c[2]) > 0 ? 1 : -1, outside = 0;
    for (int k = 0; k < 3; k++) {
      double beyond = -turn * area(c[k], c[(k + 1) % 3], i);
      outside = beyond > outside ? beyond : outside;
    }
    return outside > same_ * same_ ? outside : 0;
  }

  const MeshContactPoint* points_;
  int count_;
  double same_;
  Vec3 u_, v_;
};

void fill(Manifold& m, Vec3 normal, const MeshContactPoint* points, int count, double size) {
  double nearest = points[0].separation;
  for (int i = 1; i < count; i++) nearest = std::min(nearest, points[i].separation);
  Picker picker(points, count, normal, kSamePlace * size);
  picker.pick(nearest + kTouching);
  picker.pick(1e30);
  m.normal = normal;
  m.count = 0;
  m.rolls = false;
  for (int k = 0; k < picker.chosenCount; k++) {
    const MeshContactPoint& p = points[picker.chosen[k]];
    // Along the common normal.
    double separation = dot(normal, p.onShape - p.onMesh);
    m.rolls = m.rolls || p.wanders;
    m.points[m.count++] = {p.onMesh, p.onMesh + normal * separation, separation, p.feature};
  }
}

// Corners of the outline of points in a plane, in order, by their numbers: the lower side from left to right, then the upper
// one (Andrew 1979). Sorts the points.
int outlineOfPoints(PatchPoint* sorted, int count, PatchPoint* out) {
  std::sort(sorted, sorted + count, [](const PatchPoint& p, const PatchPoint& q) {
    return p.u != q.u ? p.u < q.u : p.v != q.v ? p.v < q.v : p.separation < q.separation;
  });
  int kept = 0;
  auto walk = [&](int i, int base) {
    const PatchPoint& next = sorted[i];
    auto isLeft = [&] {
      const PatchPoint &p = out[kept - 2], &q = out[kept - 1];
      return (q.u - p.u) * (next.v - p.v) - (q.v - p.v) * (next.u - p.u) > 0;
    };
    while (kept >= base + 2 && !isLeft()) kept--;
    if (kept < kMaxPatchPoints) out[kept++] = next;
  };
  for (int i = 0; i < count; i++) walk(i, 0);
  const int lower = kept - 1;
  for (int i = count - 2; i >= 0; i--) walk(i, lower);
  return kept > 1 ? kept - 1 : kept;
}

constexpr int kMostCapPoints = 512;

void fillCap(Manifold& m, Vec3 normal, const MeshContactPoint* points, int count, double size,
             std::span<const std::uint32_t> loaded) {
  const Vec3 a = std::fabs(normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 u = normalized(cross(normal, a)), v = cross(normal, u), origin = points[0].onMesh;
  PatchPoint flat[kMostCapPoints], corners[kMaxPatchPoints];
  LoadedPoints carry;
  count = std::min(count, kMostCapPoints);
  for (int i = 0; i < count; i++) {
    const Vec3 p = points[i].onMesh - origin;
    flat[i] = {dot(u, p), dot(v, p), points[i].separation, std::uint32_t(i)};
  }
  const int around = outlineOfPoints(flat, count, corners);
  for (int i = 0; i < around && carry.count < kMaxManifoldPoints; i++)
    if (std::find(loaded.begin(), loaded.end(), points[corners[i].feature].feature) != loaded.end())
      carry.add(corners[i].feature);
  const ReducedPatch reduced = reducePatch(corners, around, contactTolerances(size), carry);
  m.normal = normal;
  m.count = reduced.count;
  m.partial = reduced.partial;
  m.rolls = false;
  for (int i = 0; i < m.count; i++) {
    const MeshContactPoint& p = points[corners[i].feature];
    const double separation = dot(normal, p.onShape - p.onMesh);
    m.rolls = m.rolls || p.wanders;
    m.points[i] = {p.onMesh, p.onMesh + normal * separation, separation, p.feature};
  }
}

// The nearest point that is left gives a normal; all like it go with it. In place: what is taken moves to the front.
template <class Fill> void gather(std::vector<MeshContactPoint>& points, MeshManifolds& out, const Fill& fillOne) {
  out.count = 0;
  std::size_t taken = 0;
  while (taken < points.size() && out.count < kMaxMeshManifolds) {
    std::size_t nearest = taken;
    for (std::size_t i = taken + 1; i < points.size(); i++)
      if (points[i].separation < points[nearest].separation) nearest = i;
    Vec3 normal = points[nearest].normal;
    std::size_t end = taken;
    for (std::size_t i = taken; i < points.size(); i++)
      if (dot(points[i].normal, normal) > kSameNormal) std::swap(points[i], points[end++]);
    fillOne(out.list[out.count++], normal, points.data() + taken, int(end - taken));
    taken = end;
  }
}

}  // namespace

void gatherPoints(std::vector<MeshContactPoint>& points, double size, MeshManifolds& out) {
  gather(points, out, [&](Manifold& m, Vec3 normal, const MeshContactPoint* group, int count) {
    fill(m, normal, group, count, size);
  });
}

void gatherCapPoints(std::vector<MeshContactPoint>& points, double size, std::span<const std::uint32_t> loaded,
                     MeshManifolds& out) {
  gather(points, out, [&](Manifold& m, Vec3 normal, const MeshContactPoint* group, int count) {
    if (std::any_of(group, group + count, [](const MeshContactPoint& p) { return p.wanders; }))
      fill(m, normal, group, count, size);
    else
      fillCap(m, normal, group, count, size, loaded);
  });
}

}  // namespace brickfall
