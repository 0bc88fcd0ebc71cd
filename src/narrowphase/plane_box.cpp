// Plane against box: the corners of the face that looks at the plane most. It always holds the deepest corner, has
// never more than four, and on a tie (box on an edge or corner) either face has the corners that touch.
#include "narrowphase/features.h"
#include "narrowphase/pairs.h"

namespace brickfall {

void collidePlaneBox(const Shape&, const Shape& box, const Transform& bInA, double margin, Manifold& out) {
  Mat3 r = toMatrix(bInA.rotation);
  Vec3 up = r.row[1], h = box.halfExtents;
  double reach = h.x * std::fabs(up.x) + h.y * std::fabs(up.y) + h.z * std::fabs(up.z);
  if (!(bInA.position.y - reach <= margin)) return;
  constexpr double kTie = 1e-9;
  int axis = 0;
  for (int k = 1; k < 3; k++)
    if (std::fabs(up[k]) > std::fabs(up[axis]) + kTie) axis = k;
  int next = (axis + 1) % 3, last = (axis + 2) % 3;
  int bottom = up[axis] > 0 ? -1 : 1;

  constexpr int kTurn[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  out.normal = {0, 1, 0};
  for (auto [s, t] : kTurn) {
    Vec3 corner;
    corner[axis] = bottom * h[axis];
    corner[next] = s * h[next];
    corner[last] = t * h[last];
    Vec3 p = r * corner + bInA.position;
    if (p.y > margin) continue;
    int name = (corner.x > 0 ? 1 : 0) | (corner.y > 0 ? 2 : 0) | (corner.z > 0 ? 4 : 0);
    out.points[out.count++] = {{p.x, 0, p.z}, p, p.y, cornerOfB(name)};
  }
}

}  // namespace brickfall
