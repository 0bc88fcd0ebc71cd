#include "slow_boxes.h"

#include <algorithm>
#include <cmath>

namespace brickfall::test {

namespace {

double pointDistance(Vec3 point, const Obb& box) {
  Vec3 local = toLocal(box, point), outside;
  for (int k = 0; k < 3; k++) outside[k] = std::max(0.0, std::fabs(local[k]) - box.halfExtents[k]);
  return length(outside);
}

// Closest points of two segments: the pair of parameters that minimises a quadratic in the unit square.
void segments(Vec3 p, Vec3 q, Vec3 r, Vec3 s, Vec3& onFirst, Vec3& onSecond) {
  Vec3 u = q - p, v = s - r, w = p - r;
  // In the longest precision there is: of nearly parallel edges the determinant is small.
  using Long = long double;
  auto product = [](Vec3 f, Vec3 g) { return Long(f.x) * Long(g.x) + Long(f.y) * Long(g.y) + Long(f.z) * Long(g.z); };
  Long longA = product(u, u), longB = product(u, v), longC = product(v, v), longD = product(u, w),
       longE = product(v, w);
  Long det = longA * longC - longB * longB;
  double a = double(longA), b = double(longB), c = double(longC), d = double(longD), e = double(longE);
  double best = -1;
  auto offer = [&](double x, double y) {
    x = std::clamp(x, 0.0, 1.0), y = std::clamp(y, 0.0, 1.0);
    Vec3 first = p + u * x, second = r + v * y;
    double squared = lengthSquared(first - second);
    if (best < 0 || squared < best) best = squared, onFirst = first, onSecond = second;
  };
  // The second parameter from the first, or along nearly parallel edges their errors would not go together.
  if (det > 0) {
    double x = std::clamp(double((longB * longE - longC * longD) / det), 0.0, 1.0);
    offer(x, c > 0 ? (e + b * x) / c : 0);
  }
  for (double x : {0.0, 1.0}) offer(x, c > 0 ? (e + b * x) / c : 0);
  for (double y : {0.0, 1.0}) offer(a > 0 ? (b * y - d) / a : 0, y);
}

bool edgeMeets(Vec3 from, Vec3 to, const Obb& box) {
  Vec3 start = toLocal(box, from), along = toLocal(box, to) - start;
  double low = 0, high = 1;
  for (int k = 0; k < 3; k++) {
    double h = box.halfExtents[k];
    if (along[k] == 0) {
      if (std::fabs(start[k]) > h) return false;
      continue;
    }
    double one = (-h - start[k]) / along[k], other = (h - start[k]) / along[k];
    low = std::max(low, std::min(one, other));
    high = std::min(high, std::max(one, other));
  }
  return low <= high;
}

}  // namespace

SlowBox::SlowBox(const Obb& from) : box(from), corner(corners(from)) {}

const std::array<SlowBox::Edge, 12>& SlowBox::edges() {
  static const std::array<Edge, 12> all = {
      {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};
  return all;
}

bool SlowBox::contains(Vec3 point, double slack) const {
  Vec3 local = abs(toLocal(box, point));
  return local.x <= box.halfExtents.x + slack && local.y <= box.halfExtents.y + slack &&
         local.z <= box.halfExtents.z + slack;
}

bool slowOverlap(const SlowBox& a, const SlowBox& b) {
  for (const SlowBox::Edge& e : SlowBox::edges()) {
    if (edgeMeets(a.corner[std::size_t(e.from)], a.corner[std::size_t(e.to)], b.box)) return true;
    if (edgeMeets(b.corner[std::size_t(e.from)], b.corner[std::size_t(e.to)], a.box)) return true;
  }
  return false;  // an edge inside the other solid meets it, so containment is covered
}

double slowDistance(const SlowBox& a, const SlowBox& b) {
  if (slowOverlap(a, b)) return 0;
  double best = length(a.box.centre - b.box.centre);
  for (Vec3 p : a.corner) best = std::min(best, pointDistance(p, b.box));
  for (Vec3 p : b.corner) best = std::min(best, pointDistance(p, a.box));
  for (const SlowBox::Edge& e : SlowBox::edges()) {
    for (const SlowBox::Edge& f : SlowBox::edges()) {
      Vec3 onA, onB;
      segments(a.corner[std::size_t(e.from)], a.corner[std::size_t(e.to)], b.corner[std::size_t(f.from)],
               b.corner[std::size_t(f.to)], onA, onB);
      best = std::min(best, length(onA - onB));
    }
  }
  return best;
}

double slowDepth(const SlowBox& a, const SlowBox& b, double parallel) {
  // Directions from the axes, not the corners: a side may be without length.
  double least = 1e300;
  auto offer = [&](Vec3 axis) {
    if (!(length(axis) > parallel)) return;
    axis = normalized(axis);
    double lowA = 1e300, highA = -1e300, lowB = 1e300, highB = -1e300;
    for (Vec3 p : a.corner) {
      double along = dot(axis, p - a.box.centre);
      lowA = std::min(lowA, along), highA = std::max(highA, along);
    }
    for (Vec3 p : b.corner) {
      double along = dot(axis, p - a.box.centre);
      lowB = std::min(lowB, along), highB = std::max(highB, along);
    }
    least = std::min(least, std::min(highA - lowB, highB - lowA));
  };
  for (int i = 0; i < 3; i++) {
    offer(a.box.axes.row[i]);
    offer(b.box.axes.row[i]);
    for (int j = 0; j < 3; j++) offer(cross(a.box.axes.row[i], b.box.axes.row[j]));
  }
  return least;
}

double slowGap(const SlowBox& a, const SlowBox& b) { return slowOverlap(a, b) ? -slowDepth(a, b) : slowDistance(a, b); }

std::vector<Vec3> slowContact(const SlowBox& a, const SlowBox& b, double slack) {
  std::vector<Vec3> out;
  for (Vec3 p : a.corner) {
    if (pointDistance(p, b.box) <= slack) out.push_back(p);
  }
  for (Vec3 p : b.corner) {
    if (pointDistance(p, a.box) <= slack) out.push_back(p);
  }
  for (const SlowBox::Edge& e : SlowBox::edges()) {
    for (const SlowBox::Edge& f : SlowBox::edges()) {
      Vec3 p = a.corner[std::size_t(e.from)], q = a.corner[std::size_t(e.to)], r = b.corner[std::size_t(f.from)],
           s = b.corner[std::size_t(f.to)], onA, onB;
      if (!(length(cross(normalized(q - p), normalized(s - r))) > 1e-3)) continue;
      segments(p, q, r, s, onA, onB);
      if (length(onA - onB) <= slack) out.push_back((onA + onB) * 0.5);
    }
  }
  return out;
}

}  // namespace brickfall::test
