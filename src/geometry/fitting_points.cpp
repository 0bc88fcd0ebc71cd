// Hulls, covariances and principal axes for the fits.
#include "geometry/fitting_points.h"

#include <algorithm>

#include "geometry/hull_triangles.h"
#include "math/symmetric_eigen.h"

namespace brickfall {

namespace {

constexpr double kThinnest = 2e-6;  // share of the size below which points count as being in a plane or on a line
constexpr double kFlat = 1e-7;  // what sticks out of the hull by less is left out; extents are measured on all points

Vec3 anyAcross(Vec3 d) { return normalized(cross(std::fabs(d.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}, d)); }

std::vector<GridPoint> onGrid(std::span<const Vec3> scaled) {
  std::vector<GridPoint> grid;
  grid.reserve(scaled.size());
  auto whole = [](double x) { return std::int64_t(std::floor(x * kGridSteps + 0.5)); };
  for (Vec3 p : scaled) grid.push_back({whole(p.x), whole(p.y), whole(p.z)});
  std::sort(grid.begin(), grid.end(), [](GridPoint a, GridPoint b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  });
  auto equal = [](GridPoint a, GridPoint b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
  grid.erase(std::unique(grid.begin(), grid.end(), equal), grid.end());
  return grid;
}

Vec3 offGrid(GridPoint p) { return Vec3{double(p.x), double(p.y), double(p.z)} * (1 / kGridSteps); }

FitHull flatHull(std::span<const GridPoint> grid, Vec3 normal) {
  FitHull out;
  out.dimensions = 2;
  out.direction = normal;
  Vec3 u = anyAcross(normal), v = cross(normal, u);
  std::vector<PlanePoint> plane;
  for (GridPoint p : grid) plane.push_back({dot(offGrid(p), u), dot(offGrid(p), v)});
  for (std::uint32_t k : planeHull(plane)) out.corners.push_back(offGrid(grid[k]));
  for (std::uint32_t k = 2; k < out.corners.size(); k++) out.triangles.insert(out.triangles.end(), {0, k - 1, k});
  return out;
}

// Adds f(p) f(p)^T, f(p) = p - about, of a triangle times its area: the integral of a quadratic is exact from the corners
// and the centre (Gottschalk 2000, section 4.5).
void addOuter(Mat3& sum, Vec3 v, double weight) {
  for (int i = 0; i < 3; i++) sum.row[i] += v * (v[i] * weight);
}

}  // namespace

std::vector<std::uint32_t> planeHull(std::span<const PlanePoint> points) {
  std::vector<std::uint32_t> order(points.size()), chain;
  for (std::uint32_t k = 0; k < order.size(); k++) order[k] = k;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const PlanePoint &p = points[a], &q = points[b];
    return p.u != q.u ? p.u < q.u : p.v != q.v ? p.v < q.v : a < b;
  });
  auto left = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const PlanePoint &p = points[a], &q = points[b], &r = points[c];
    return (q.u - p.u) * (r.v - q.v) - (q.v - p.v) * (r.u - q.u) > 0;
  };
  // Andrew's monotone chain: the lower half from left to right, then the upper half back.
  auto add = [&](std::uint32_t c, std::size_t least) {
    while (chain.size() >= least + 2 && !left(chain[chain.size() - 2], chain.back(), c)) chain.pop_back();
    chain.push_back(c);
  };
  for (std::uint32_t k : order) add(k, 0);
  std::size_t least = chain.empty() ? 0 : chain.size() - 1;
  for (std::size_t k = order.size(); k-- > 1;) add(order[k - 1], least);
  if (chain.size() > 1) chain.pop_back();
  return chain;
}

FitHull fitHull(std::span<const Vec3> scaled) {
  std::vector<GridPoint> grid = onGrid(scaled);
  GridSimplex start = widestSimplex(grid);
  FitHull out;
  Vec3 corner[4];
  for (int k = 0; k < 4; k++) corner[k] = offGrid(grid[std::size_t(start.corner[k])]);
  if (grid.size() == 1) {
    out.corners = {corner[0]};
    return out;
  }
  if (!(start.width >= kThinnest * kGridSteps)) {
    out.dimensions = 1;
    out.corners = {corner[0], corner[1]};
    out.direction = normalized(corner[1] - corner[0]);
    return out;
  }
  if (!(start.height >= kThinnest * kGridSteps)) {
    return flatHull(grid, normalized(cross(corner[1] - corner[0], corner[2] - corner[0])));
  }
  out.dimensions = 3;
  std::vector<std::uint32_t> place(grid.size(), 0xffffffffu);
  for (const HullTriangle& triangle : hullTriangles(grid, start, kFlat * kGridSteps)) {
    for (int k : triangle.corner) {
      if (place[std::size_t(k)] == 0xffffffffu) {
        place[std::size_t(k)] = std::uint32_t(out.corners.size());
        out.corners.push_back(offGrid(grid[std::size_t(k)]));
      }
      out.triangles.push_back(place[std::size_t(k)]);
    }
  }
  return out;
}

Mat3 surfaceCovariance(std::span<const Vec3> points, std::span<const std::uint32_t> triangles) {
  Mat3 sum = diagonal(Vec3{});
  Vec3 moment;
  double total = 0;
  for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
    Vec3 p = points[triangles[t]], q = points[triangles[t + 1]], r = points[triangles[t + 2]];
    double area = length(cross(q - p, r - p)) * 0.5;
    Vec3 three = p + q + r;
    moment += three * (area / 3);
    total += area;
    addOuter(sum, three, area / 12);
    for (Vec3 v : {p, q, r}) addOuter(sum, v, area / 12);
  }
  if (!(total > 0)) return pointCovariance(points);
  Vec3 mean = moment * (1 / total);
  sum = sum * (1 / total);
  addOuter(sum, mean, -1);
  return sum;
}

Mat3 pointCovariance(std::span<const Vec3> points) {
  Mat3 sum = diagonal(Vec3{});
  Vec3 mean;
  const double share = 1 / double(points.size());
  for (Vec3 p : points) mean += p * share;
  for (Vec3 p : points) addOuter(sum, p - mean, share);
  return sum;
}

Mat3 principalAxes(const Mat3& symmetric) {
  SymmetricEigen e = symmetricEigen(symmetric);
  int order[3] = {0, 1, 2};
  std::stable_sort(order, order + 3, [&](int a, int b) { return e.values[a] > e.values[b]; });
  Vec3 first = e.axes.row[order[0]], second = e.axes.row[order[1]];
  return {{first, second, cross(first, second)}};
}

}  // namespace brickfall
