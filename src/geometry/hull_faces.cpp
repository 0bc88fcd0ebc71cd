// Regions of triangles grow from the largest triangle outwards, one triangle at a time, as long as all corners lie within
// the tolerance of the first one's plane. Measuring distances, not angles, takes slivers in whatever way they point. A
// triangle is added only where the region stays a disc, so that its border is always one loop.
#include "geometry/hull_faces.h"

#include <algorithm>

#include "brickfall/math.h"

namespace brickfall {

namespace {

Vec3 toVec(GridPoint p) { return {double(p.x), double(p.y), double(p.z)}; }

class FaceMerger {
 public:
  FaceMerger(std::span<const GridPoint> points, std::span<const HullTriangle> triangles, double tolerance)
      : points_(points),
        triangles_(triangles),
        tolerance_(tolerance),
        region_(triangles.size(), -1),
        inRegion_(points.size(), -1),
        degree_(points.size(), 0) {}

  std::vector<std::vector<int>> run() {
    growRegions();
    std::vector<std::vector<int>> faces;
    while (!collectFaces(faces)) {
      if (!dissolveFlat(faces)) return {};
    }
    std::erase_if(faces, [](const std::vector<int>& face) { return face.empty(); });
    return faces;
  }

 private:
  const HullTriangle& triangle(int t) const { return triangles_[std::size_t(t)]; }
  GridPoint point(int p) const { return points_[std::size_t(p)]; }
  Vec3 corner(int t, int k) const { return toVec(point(triangle(t).corner[k])); }
  int& region(int t) { return region_[std::size_t(t)]; }
  Vec3 areaVector(int t) const { return cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0)); }

  void growRegions() {
    std::vector<int> order(triangles_.size());
    std::vector<double> area(triangles_.size());
    for (std::size_t t = 0; t < order.size(); t++) order[t] = int(t), area[t] = lengthSquared(areaVector(int(t)));
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      double areaA = area[std::size_t(a)], areaB = area[std::size_t(b)];
      return areaA != areaB ? areaA > areaB : a < b;
    });
    for (int seed : order) {
      if (region(seed) < 0) grow(seed);
    }
  }

  void grow(int seed) {
    int id = regionCount_++;
    Vec3 normal = normalized(areaVector(seed));
    std::vector<int> members{seed};
    take(seed, id);
    // Triangles refused because they would pinch the region may fit later, so the border is walked until nothing changes.
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t k = 0; k < members.size(); k++) {
        for (int t : triangle(members[k]).across) {
          if (region(t) >= 0 || !isFlat(t, normal, seed) || !staysDisc(t, id)) continue;
          take(t, id);
          members.push_back(t);
          changed = true;
        }
      }
    }
  }

  void take(int t, int id) {
    region(t) = id;
    for (int p : triangle(t).corner) inRegion_[std::size_t(p)] = id;
  }

  bool isFlat(int t, Vec3 normal, int seed) const {
    if (!(dot(areaVector(t), normal) >= 0)) return false;
    const int* base = triangle(seed).corner;
    for (int p : triangle(t).corner) {
      bool flat = tolerance_ > 0 ? std::fabs(dot(normal, toVec(point(p)) - corner(seed, 0))) <= tolerance_
                                 : coplanar(point(base[0]), point(base[1]), point(base[2]), point(p));
      if (!flat) return false;
    }
    return true;
  }

  bool staysDisc(int t, int id) {
    int shared = 0, apex = 0;
    for (int k = 0; k < 3; k++) {
      if (region(triangle(t).across[k]) == id) shared++, apex = triangle(t).corner[(k + 2) % 3];
    }
    return shared == 2 || (shared == 1 && inRegion_[std::size_t(apex)] != id);
  }

  bool isBorder(int t, int k) { return region(triangle(t).across[k]) != region(t); }

  // Corners where at least three faces meet, by region. False if a face is left with fewer than three or has more than
  // one border.
  bool collectFaces(std::vector<std::vector<int>>& faces) {
    std::fill(degree_.begin(), degree_.end(), 0);
    std::vector<int> edges(std::size_t(regionCount_), 0), firstTriangle(std::size_t(regionCount_), -1);
    std::vector<int> firstEdge(std::size_t(regionCount_), 0);
    for (int t = 0; t < int(triangles_.size()); t++) {
      for (int k = 0; k < 3; k++) {
        if (!isBorder(t, k)) continue;
        degree_[std::size_t(triangle(t).corner[k])]++;
        std::size_t r = std::size_t(region(t));
        if (edges[r]++ == 0) firstTriangle[r] = t, firstEdge[r] = k;
      }
    }
    faces.assign(std::size_t(regionCount_), {});
    bool good = true;
    for (std::size_t r = 0; r < faces.size(); r++) {
      if (edges[r] == 0) continue;
      int walked = walkBorder(firstTriangle[r], firstEdge[r], faces[r]);
      if (walked != edges[r]) broken_ = true;
      if (walked != edges[r] || faces[r].size() < 3) good = false;
    }
    return good;
  }

  int walkBorder(int firstTriangle, int firstEdge, std::vector<int>& face) {
    int t = firstTriangle, k = firstEdge, walked = 0;
    do {
      int from = triangle(t).corner[k];
      if (degree_[std::size_t(from)] >= 3) face.push_back(from);
      walked++;
      k = (k + 1) % 3;
      while (!isBorder(t, k)) {  // turn about the corner, from triangle to triangle
        int pivot = triangle(t).corner[k];
        t = triangle(t).across[k];
        for (int j = 0; j < 3; j++) {
          if (triangle(t).corner[j] == pivot) k = j;
        }
      }
    } while (t != firstTriangle || k != firstEdge);
    return walked;
  }

  // A region with two corners left is a sliver between two faces: it goes to its neighbour.
  bool dissolveFlat(const std::vector<std::vector<int>>& faces) {
    if (broken_) return false;
    for (int t = 0; t < int(triangles_.size()); t++) {
      int r = region(t);
      if (faces[std::size_t(r)].size() >= 3) continue;
      for (int k = 0; k < 3; k++) {
        if (!isBorder(t, k)) continue;
        int into = region(triangle(t).across[k]);
        std::replace(region_.begin(), region_.end(), r, into);
        return true;
      }
    }
    return false;
  }

  std::span<const GridPoint> points_;
  std::span<const HullTriangle> triangles_;
  double tolerance_;
  std::vector<int> region_;    // by triangle
  std::vector<int> inRegion_;  // by point: the last region that took it
  std::vector<int> degree_;    // by point: faces that meet there
  int regionCount_ = 0;
  bool broken_ = false;
};

}  // namespace

std::vector<std::vector<int>> mergedFaces(std::span<const GridPoint> points, std::span<const HullTriangle> triangles,
                                          double tolerance) {
  return FaceMerger(points, triangles, tolerance).run();
}

}  // namespace brickfall
