// Plane against hull: the deepest corner, and with it the face around it that looks at the plane most.
#include "narrowphase/clipping.h"
#include "narrowphase/features.h"
#include "narrowphase/hull_view.h"
#include "narrowphase/pairs.h"

namespace brickfall {

void collidePlaneHull(const Shape&, const Shape& hullShape, const Transform& bInA, double margin,
                      const LoadedPoints& loaded, Manifold& out) {
  HullStorage storage;
  HullView hull = viewOf(hullShape, storage);
  // The plane in the frame of the hull: up . p + height = distance from it.
  Vec3 up = rotate(conjugate(bInA.rotation), Vec3{0, 1, 0});
  double height = bInA.position.y;
  int deepest = supportVertex(hull, -up);
  if (!(dot(up, hull.vertices[deepest]) + height <= margin)) return;

  int face = faceAround(hull, deepest, -up);
  PatchPoint patch[kMaxHullVertices];
  int count = 0;
  int e = hull.firstEdge[face];
  do {
    int vertex = hull.edges[e].origin;
    Vec3 p = rotate(bInA.rotation, hull.vertices[vertex]) + bInA.position;
    if (p.y <= margin) patch[count++] = {p.x, p.z, p.y, cornerOfB(vertex)};
    e = hull.edges[e].next;
  } while (e != hull.firstEdge[face]);
  const ReducedPatch reduced = reducePatch(patch, count, contactTolerances(hull.innerRadius), loaded);

  out.normal = {0, 1, 0};
  out.count = reduced.count;
  out.partial = reduced.partial;
  for (int i = 0; i < out.count; i++) {
    const PatchPoint& p = patch[i];
    out.points[i] = {{p.u, 0, p.v}, {p.u, p.separation, p.v}, p.separation, p.feature};
  }
}

}  // namespace brickfall
