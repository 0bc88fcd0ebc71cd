#include "geometry/hull_triangles.h"

#include <cmath>

namespace brickfall {

namespace {

__extension__ typedef __int128 Wide;

GridPoint difference(GridPoint a, GridPoint b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
// Differences have 31 bits, so products have 60 and their difference 61.
GridPoint cross(GridPoint a, GridPoint b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Wide dot(GridPoint a, GridPoint b) { return Wide(a.x) * b.x + Wide(a.y) * b.y + Wide(a.z) * b.z; }
double length(GridPoint a) {
  double x = double(a.x), y = double(a.y), z = double(a.z);
  return std::sqrt(x * x + y * y + z * z);
}
GridPoint areaVector(GridPoint a, GridPoint b, GridPoint c) { return cross(difference(b, a), difference(c, a)); }

struct Face {
  HullTriangle triangle;
  GridPoint normal;          // not unit; its length is twice the area
  double leastHeight = 0;    // scaled like heights: points that are not further above are dropped
  std::vector<int> outside;  // points above this face that no other face has taken
  int furthest = -1;         // of them
  Wide furthestHeight = 0;
  bool alive = true;
  bool visible = false;
};

struct HorizonEdge {
  int from, to;
  int beyond;  // the face on the far side, which stays
};

class QuickHull {
 public:
  QuickHull(std::span<const GridPoint> points, const GridSimplex& start, double flatness)
      : points_(points), flatness_(flatness), coneAt_(points.size(), -1) {
    int a = start.corner[0], b = start.corner[1], c = start.corner[2], d = start.corner[3];
    GridPoint base = areaVector(points_[std::size_t(a)], points_[std::size_t(b)], points_[std::size_t(c)]);
    if (dot(base, difference(points_[std::size_t(d)], points_[std::size_t(a)])) > 0) {
      int swap = b;
      b = c, c = swap;
    }
    addFace({{a, b, c}, {1, 2, 3}});
    addFace({{b, a, d}, {0, 3, 2}});
    addFace({{c, b, d}, {0, 1, 3}});
    addFace({{a, c, d}, {0, 2, 1}});
    for (int p = 0; p < int(points_.size()); p++) {
      if (p != a && p != b && p != c && p != d) assign(p, 0);
    }
  }

  void run() {
    for (std::size_t f = 0; f < faces_.size(); f++) {
      if (faces_[f].alive && faces_[f].furthest >= 0) addPoint(int(f));
    }
  }

  std::vector<HullTriangle> triangles() const {
    std::vector<int> place(faces_.size(), -1);
    std::vector<HullTriangle> out;
    for (std::size_t f = 0; f < faces_.size(); f++) {
      if (!faces_[f].alive) continue;
      place[f] = int(out.size());
      out.push_back(faces_[f].triangle);
    }
    for (HullTriangle& t : out) {
      for (int& neighbour : t.across) neighbour = place[std::size_t(neighbour)];
    }
    return out;
  }

 private:
  GridPoint point(int index) const { return points_[std::size_t(index)]; }
  Face& face(int index) { return faces_[std::size_t(index)]; }
  // > 0: above the face. Scaled by twice the face's area.
  Wide heightAbove(const Face& f, int p) const {
    return dot(f.normal, difference(point(p), point(f.triangle.corner[0])));
  }

  int addFace(const HullTriangle& triangle) {
    Face f;
    f.triangle = triangle;
    f.normal = areaVector(point(triangle.corner[0]), point(triangle.corner[1]), point(triangle.corner[2]));
    f.leastHeight = flatness_ * length(f.normal);
    faces_.push_back(std::move(f));
    return int(faces_.size()) - 1;
  }

  // Gives the point to the first face from `firstFace` on that it is above; one that is above none lies inside.
  bool assign(int p, std::size_t firstFace) {
    for (std::size_t k = firstFace; k < faces_.size(); k++) {
      Face& f = faces_[k];
      if (!f.alive) continue;
      Wide height = heightAbove(f, p);
      if (!(double(height) > f.leastHeight)) continue;
      f.outside.push_back(p);
      if (height > f.furthestHeight) f.furthestHeight = height, f.furthest = p;
      return true;
    }
    return false;
  }

  // Replaces all that the face's furthest point sees by a cone from the point to the horizon.
  void addPoint(int seed) {
    int eye = face(seed).furthest;
    findHorizon(seed, eye);
    std::size_t firstNew = faces_.size();
    for (const HorizonEdge& edge : horizon_) {
      int cone = addFace({{edge.from, edge.to, eye}, {edge.beyond, -1, -1}});
      coneAt_[std::size_t(edge.from)] = cone;
      HullTriangle& beyond = face(edge.beyond).triangle;
      for (int k = 0; k < 3; k++) {
        if (beyond.corner[k] == edge.to) beyond.across[k] = cone;
      }
    }
    for (std::size_t k = firstNew; k < faces_.size(); k++) {
      int next = coneAt_[std::size_t(faces_[k].triangle.corner[1])];
      faces_[k].triangle.across[1] = next;
      face(next).triangle.across[2] = int(k);
    }
    for (int old : visible_) {
      std::vector<int> orphans = std::move(face(old).outside);
      face(old).outside.clear();
      for (int p : orphans) {
        if (p != eye && !assign(p, firstNew)) assign(p, 0);
      }
    }
  }

  void findHorizon(int seed, int eye) {
    visible_.assign(1, seed);
    horizon_.clear();
    face(seed).visible = true, face(seed).alive = false;
    for (std::size_t k = 0; k < visible_.size(); k++) {
      HullTriangle t = face(visible_[k]).triangle;
      for (int e = 0; e < 3; e++) {
        Face& neighbour = face(t.across[e]);
        if (neighbour.visible) continue;
        if (heightAbove(neighbour, eye) > 0) {
          neighbour.visible = true, neighbour.alive = false;
          visible_.push_back(t.across[e]);
        } else {
          horizon_.push_back({t.corner[e], t.corner[(e + 1) % 3], t.across[e]});
        }
      }
    }
  }

  std::span<const GridPoint> points_;
  double flatness_;
  std::vector<Face> faces_;
  std::vector<int> visible_;
  std::vector<HorizonEdge> horizon_;
  std::vector<int> coneAt_;  // by point: the new face that starts there
};

}  // namespace

bool coplanar(GridPoint a, GridPoint b, GridPoint c, GridPoint d) {
  return dot(areaVector(a, b, c), difference(d, a)) == 0;
}

GridSimplex widestSimplex(std::span<const GridPoint> points) {
  GridSimplex s;
  double longest = 0, area = 0;
  for (std::size_t k = 1; k < points.size(); k++) {
    double distance = length(difference(points[k], points[0]));
    if (distance > longest) longest = distance, s.corner[1] = int(k);
  }
  if (!(longest > 0)) return s;
  GridPoint a = points[0], b = points[std::size_t(s.corner[1])];
  for (std::size_t k = 1; k < points.size(); k++) {
    double twice = length(areaVector(a, b, points[k]));
    if (twice > area) area = twice, s.corner[2] = int(k);
  }
  s.width = area / longest;
  if (!(area > 0)) return s;
  GridPoint normal = areaVector(a, b, points[std::size_t(s.corner[2])]);
  Wide largest = 0;
  for (std::size_t k = 1; k < points.size(); k++) {
    Wide volume = dot(normal, difference(points[k], a));
    if (volume < 0) volume = -volume;
    if (volume > largest) largest = volume, s.corner[3] = int(k);
  }
  s.height = double(largest) / area;
  return s;
}

std::vector<HullTriangle> hullTriangles(std::span<const GridPoint> points, const GridSimplex& start, double flatness) {
  QuickHull hull(points, start, flatness);
  hull.run();
  return hull.triangles();
}

}  // namespace brickfall
