// All sub-simplices (corners, edges, triangles) with the last corner are tried and the nearest point wins. That is slower
// than walking Voronoi regions by signs, and is safe where those signs are lost in rounding: every candidate is a convex
// sum of corners, so no candidate can be nearer than the truth, and a degenerate triangle is covered by its edges.
#include "geometry/simplex.h"

namespace brickfall {

namespace {

struct Candidate {
  int corner[3];
  double weight[3];
  int count = 0;
  Vec3 nearest, across;  // across: parallel to nearest in exact arithmetic
  double squared = -1;   // |nearest|^2; < 0: none yet
};

void offer(Candidate& best, const Candidate& next) {
  if (best.squared < 0 || next.squared < best.squared) best = next;
}

void tryCorner(const Simplex& s, int i, Candidate& best) {
  Vec3 a = s.corner[i].point;
  offer(best, {{i, 0, 0}, {1, 0, 0}, 1, a, a, lengthSquared(a)});
}

void tryEdge(const Simplex& s, int i, int j, Candidate& best) {
  Vec3 a = s.corner[i].point, b = s.corner[j].point, along = b - a;
  double t = -dot(a, along) / lengthSquared(along);
  if (!(t > 0 && t < 1)) return;
  Vec3 nearest = a * (1 - t) + b * t;
  Vec3 across = nearest - along * (dot(nearest, along) / lengthSquared(along));
  offer(best, {{i, j, 0}, {1 - t, t, 0}, 2, nearest, across, lengthSquared(nearest)});
}

void tryTriangle(const Simplex& s, int i, int j, int k, Candidate& best) {
  Vec3 a = s.corner[i].point, b = s.corner[j].point, c = s.corner[k].point;
  Vec3 normal = cross(b - a, c - a);
  double u = dot(normal, cross(b, c)), v = dot(normal, cross(c, a)), w = dot(normal, cross(a, b));
  if (!(u > 0 && v > 0 && w > 0)) return;
  double scale = 1 / (u + v + w);
  u *= scale, v *= scale, w *= scale;
  Vec3 nearest = a * u + b * v + c * w;
  Vec3 across = dot(normal, a) < 0 ? -normal : normal;
  offer(best, {{i, j, k}, {u, v, w}, 3, nearest, across, lengthSquared(nearest)});
}

// The origin is on the same side of each face as the corner opposite to it.
bool surroundsOrigin(const Simplex& s) {
  for (int k = 0; k < 4; k++) {
    Vec3 a = s.corner[(k + 1) & 3].point, b = s.corner[(k + 2) & 3].point, c = s.corner[(k + 3) & 3].point;
    Vec3 normal = cross(b - a, c - a);
    double opposite = dot(normal, s.corner[k].point - a), origin = -dot(normal, a);
    if (!(opposite * origin > 0)) return false;
  }
  return true;
}

}  // namespace

void reduce(Simplex& simplex, bool apart) {
  simplex.hasOrigin = !apart && simplex.count == 4 && surroundsOrigin(simplex);
  if (simplex.hasOrigin) {
    simplex.nearest = {};
    return;
  }
  Candidate best;
  int last = simplex.count - 1;
  tryCorner(simplex, last, best);
  for (int i = 0; i < last; i++) {
    tryEdge(simplex, i, last, best);
    for (int j = i + 1; j < last; j++) tryTriangle(simplex, i, j, last, best);
  }
  SimplexCorner kept[3];
  for (int k = 0; k < best.count; k++) {
    kept[k] = simplex.corner[best.corner[k]];
    kept[k].weight = best.weight[k];
  }
  for (int k = 0; k < best.count; k++) simplex.corner[k] = kept[k];
  simplex.count = best.count;
  simplex.nearest = best.nearest;
  simplex.direction = normalized(best.across);
}

}  // namespace brickfall
