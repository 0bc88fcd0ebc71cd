// One tree: faces near a box, nearest point, ray.
#include <algorithm>

#include "brickfall/geometry/mesh_tree.h"
#include "mesh/box_pair.h"

namespace brickfall {

namespace {

constexpr int kStack = 320;
constexpr float kSlack = 2e-6f;  // of the size of the tree and the query: rounding of single-precision boxes

struct Entry {
  std::int32_t node;
  float bound;
};

V lanes(Vec3 v) { return V{float(v.x), float(v.y), float(v.z), 0}; }

// Coordinates along the box's axes (lanes 0 .. 2) of a vector.
V along(const MeshTree::Node& n, V v) {
  return wide::load(n.x) * wide::spread<0>(v) + wide::load(n.y) * wide::spread<1>(v) +
         wide::load(n.z) * wide::spread<2>(v);
}
V centreOf(const MeshTree::Node& n) { return V{n.x[3], n.y[3], n.z[3], 0}; }

// Square of the distance of a point from a box.
float squaredDistance(const MeshTree::Node& n, V point) {
  V gap = wide::max(absolute(along(n, point - centreOf(n))) - wide::load(n.half), wide::set(0));
  gap = gap * gap;
  return gap[0] + gap[1] + gap[2];
}

// Where a ray enters the box grown by `slack`; negative if it misses it or enters beyond `limit`.
float entersAt(const MeshTree::Node& n, V origin, V direction, float slack, float limit) {
  V o = along(n, origin - centreOf(n)), d = along(n, direction);
  float enter = 0, exit = limit;
  for (int k = 0; k < 3; k++) {
    float half = n.half[k] + slack;
    if (std::fabs(d[k]) < 1e-12f) {
      if (std::fabs(o[k]) > half) return -1;
      continue;
    }
    float inverse = 1 / d[k], t0 = (-half - o[k]) * inverse, t1 = (half - o[k]) * inverse;
    if (t0 > t1) std::swap(t0, t1);
    enter = t0 > enter ? t0 : enter;
    exit = t1 < exit ? t1 : exit;
  }
  float rounding = 4e-6f * exit + slack;
  return enter <= exit + rounding ? enter : -1;
}

// The three volumes of ray and edge have opposite signs seen from the two sides of an edge, bit for bit: a ray that passes
// one triangle meets the other. Distance along the ray, or negative.
double rayMeets(const Triangle& t, Vec3 origin, Vec3 direction, bool& front) {
  Vec3 a = t.corner[0] - origin, b = t.corner[1] - origin, c = t.corner[2] - origin;
  double u = dot(direction, cross(b, c)), v = dot(direction, cross(c, a)), w = dot(direction, cross(a, b));
  bool positive = u >= 0 && v >= 0 && w >= 0, negative = u <= 0 && v <= 0 && w <= 0;
  double sum = u + v + w;
  if (!(positive || negative) || sum == 0) return -1;
  front = sum < 0;
  return (u * dot(direction, a) + v * dot(direction, b) + w * dot(direction, c)) / sum;
}

}  // namespace

void MeshTree::facesNear(const Aabb& box, std::vector<std::uint32_t>& out) const {
  out.clear();
  if (!overlaps(box, mesh_.bounds())) return;
  // Only the part that can meet anything: so far bounds cost no digits.
  Aabb part{max(box.lower, mesh_.bounds().lower), min(box.upper, mesh_.bounds().upper)};
  Vec3 centre = (part.lower + part.upper) * 0.5 - middle_, half = (part.upper - part.lower) * 0.5;
  Node region{};
  region.x[0] = region.y[1] = region.z[2] = 1;
  region.x[3] = float(centre.x), region.y[3] = float(centre.y), region.z[3] = float(centre.z);
  for (int k = 0; k < 3; k++) region.half[k] = float(half[k]);
  float slack = kSlack * float(radius_) * 2;
  std::int32_t stack[kStack];
  int count = 0;
  stack[count++] = 0;
  while (count > 0) {
    const Node& n = nodes_[std::size_t(stack[--count])];
    if (!BoxPair(region, unmoved(n)).meet(slack)) continue;
    if (n.child >= 0) {
      stack[count++] = n.child + 1;
      stack[count++] = n.child;
      continue;
    }
    const Triangle& t = triangles_[std::size_t(~n.child)];
    Aabb bounds{min(min(t.corner[0], t.corner[1]), t.corner[2]), max(max(t.corner[0], t.corner[1]), t.corner[2])};
    if (overlaps(bounds, box)) out.push_back(order_[std::size_t(~n.child)]);
  }
  std::sort(out.begin(), out.end());
}

std::optional<MeshPoint> MeshTree::closestPoint(Vec3 point, double maxDistance) const {
  if (!(maxDistance >= 0)) return {};
  std::optional<MeshPoint> best;
  double nearest = maxDistance;
  V at = lanes(point - middle_);
  float slack = kSlack * float(2 * radius_ + length(point - middle_)), limit;
  auto shorten = [&] {
    float reach = float(std::fmin(nearest, 1e18)) * (1 + 1e-6f) + slack;
    limit = reach * reach * (1 + 1e-6f);
  };
  shorten();
  Entry stack[kStack];
  int count = 0;
  stack[count++] = {0, squaredDistance(nodes_[0], at)};
  while (count > 0) {
    Entry entry = stack[--count];
    if (entry.bound > limit) continue;
    const Node& n = nodes_[std::size_t(entry.node)];
    if (n.child >= 0) {
      Entry next[2];
      for (int k = 0; k < 2; k++) next[k] = {n.child + k, squaredDistance(nodes_[std::size_t(n.child + k)], at)};
      bool firstNearer = next[0].bound <= next[1].bound;
      stack[count++] = next[firstNearer];
      stack[count++] = next[!firstNearer];
      continue;
    }
    TrianglePoint found = brickfall::closestPoint(triangles_[std::size_t(~n.child)], point);
    double distance = length(found.point - point);
    std::uint32_t face = order_[std::size_t(~n.child)];
    if (!(distance < nearest || (distance == nearest && (!best || face < best->face)))) continue;
    best = MeshPoint{found.point, distance, face, found.part, found.index};
    nearest = distance;
    shorten();
  }
  return best;
}

std::optional<MeshRayHit> MeshTree::castRay(Vec3 origin, Vec3 direction, double maxDistance) const {
  if (!(maxDistance >= 0)) return {};
  // From where the ray can first meet anything, so that a far origin costs no digits.
  double skip = dot(middle_ - origin, direction) - 1.01 * radius_;
  skip = skip > 0 ? skip : 0;
  Vec3 start = origin + direction * skip;
  double limit = maxDistance - skip;
  std::optional<MeshRayHit> best;
  V o = lanes(start - middle_), d = lanes(direction);
  float slack = kSlack * float(2 * radius_ + length(start - middle_));
  auto shortened = [&] { return float(std::fmin(limit, 1e30)) * (1 + 1e-6f) + slack; };
  Entry stack[kStack];
  int count = 0;
  float enter = entersAt(nodes_[0], o, d, slack, shortened());
  if (enter >= 0) stack[count++] = {0, enter};
  while (count > 0) {
    Entry entry = stack[--count];
    if (entry.bound > shortened()) continue;
    const Node& n = nodes_[std::size_t(entry.node)];
    if (n.child >= 0) {
      Entry next[2];
      for (int k = 0; k < 2; k++)
        next[k] = {n.child + k, entersAt(nodes_[std::size_t(n.child + k)], o, d, slack, shortened())};
      bool firstNearer = next[0].bound <= next[1].bound;
      if (next[firstNearer].bound >= 0) stack[count++] = next[firstNearer];
      if (next[!firstNearer].bound >= 0) stack[count++] = next[!firstNearer];
      continue;
    }
    bool front = true;
    double distance = rayMeets(triangles_[std::size_t(~n.child)], start, direction, front);
    std::uint32_t face = order_[std::size_t(~n.child)];
    if (!(distance >= 0) || !(distance < limit || (distance == limit && (!best || face < best->face)))) continue;
    Vec3 normal = mesh_.normal(face);
    best = MeshRayHit{start + direction * distance, front ? normal : -normal, skip + distance, face, front};
    limit = distance;
  }
  return best;
}

}  // namespace brickfall
