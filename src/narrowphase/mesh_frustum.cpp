// Cylinder or cone on a face. The axis of touch with the triangle decides, if the surface lets the edge or corner that it
// touches push there (MeshFace); else the face's own normal does, as far as the shape lies over it.
#include "geometry/frustum.h"
#include "geometry/hull.h"
#include "geometry/touch_axis.h"
#include "narrowphase/features.h"
#include "narrowphase/mesh_collide.h"
#include "narrowphase/outline.h"

namespace brickfall {

namespace {

constexpr double kFlushCapOnEdge = 0.998;  // cosine of 3.6 degrees

// A triangle as the search for the axis takes it: corners and edges; its face is offered as such.
Shape triangleShape(const MeshFace& face, Hull& hull) {
  Shape shape;
  for (int k = 0; k < 3; k++) {
    hull.vertices[std::size_t(k)] = face.corner(k);
    hull.edges[std::size_t(2 * k)].origin = std::uint8_t(k);
    hull.edges[std::size_t(2 * k + 1)].origin = std::uint8_t((k + 1) % 3);
  }
  hull.centroid = (face.corner(0) + face.corner(1) + face.corner(2)) * (1.0 / 3);
  const double height = dot(face.normal(), face.corner(0));
  hull.planes[0] = {face.normal(), height};
  hull.planes[1] = {-face.normal(), -height};
  shape.type = ShapeType::hull;
  shape.hull = &hull;
  return shape;
}

struct FrustumOnFace {
  const MeshFace& face;
  const Shape& shape;
  const Transform& pose;
  double margin, inner;
  ContactTolerances tolerances;
  std::vector<MeshContactPoint>& out;

  void add(Vec3 normal, Vec3 onMesh, double separation, std::uint32_t feature, bool wanders = true) const {
    if (separation <= margin)
      out.push_back({normal, onMesh, onMesh + normal * separation, separation, feature, wanders});
  }

  void addFace() const {
    Outline over = outlineOf(shape, pose, -face.normal(), cornerOfB(0));
    for (int k = 0; k < 3; k++)
      cutToSide(over, face.outward(k), dot(face.outward(k), face.corner(k)), tolerances.slack, face.name(k));
    for (int i = 0; i < over.count; i++) {
      const double height = face.height(over.corner[i].p);
      add(face.normal(), over.corner[i].p - face.normal() * height, height, over.corner[i].feature, over.wanders);
    }
  }

  // The edge k lies along a cap, or beside a line of the side: two points, else one.
  void addEdge(int k, const TouchAxis& axis) const {
    Outline edge;
    edge.add(face.corner(k), face.name(k)), edge.add(face.corner((k + 1) % 3), face.name(k) + 3);
    Outline shown = outlineOf(shape, pose, -axis.normal, cornerOfB(0));
    if (shown.face && -dot(shown.normal, axis.normal) > kFlushCapOnEdge) {
      shown = outlineOf(shape, pose, shown.normal, cornerOfB(0));
      cutToFace(edge, shown, tolerances.slack);
      const double alike = -dot(shown.normal, axis.normal);
      for (int i = 0; i < edge.count; i++) {
        const double height = dot(shown.normal, edge.corner[i].p - shown.corner[0].p) / alike;
        add(axis.normal, edge.corner[i].p, height, edge.corner[i].feature, false);
      }
      if (edge.count > 0) return;
    }
    const Outline line = lineOf(shape, pose, -axis.normal, cornerOfB(0));
    const Vec3 e = face.edge(k);
    if (line.count == 2) {
      const Vec3 start = line.corner[0].p, along = line.corner[1].p - start;
      const double squared = lengthSquared(e), pace = dot(along, e) / squared,
                   first = dot(start - face.corner(k), e) / squared;
      const double low = first < first + pace ? first : first + pace,
                   high = first < first + pace ? first + pace : first;
      const double from = low > 0 ? low : 0, to = high < 1 ? high : 1;
      const double sine = length(cross(along, e)) / std::sqrt(squared * lengthSquared(along));
      if (to > from && (to - from) * std::sqrt(squared) * sine < 0.05 * inner) {
        for (double t : {from, to}) {
          const Vec3 onMesh = face.corner(k) + e * t, onSide = start + along * ((t - first) / pace);
          add(axis.normal, onMesh, dot(axis.normal, onSide - onMesh),
              0x10000000u | (face.name(k) + (t == to ? 3u : 0u)));
        }
        return;
      }
    }
    add(axis.normal, axis.onA, axis.separation, 0x20000000u | face.name(k));
  }

  // Which part of the triangle reaches furthest along the axis, if it may push there: 0 .. 2 an edge, 3 .. 5 a corner; else -1.
  int pusher(Vec3 normal) const {
    double reach[3], most = -1e300;
    for (int k = 0; k < 3; k++) reach[k] = dot(normal, face.corner(k)), most = reach[k] > most ? reach[k] : most;
    for (int k = 0; k < 3; k++) {
      const double level = 1e-6 * length(face.edge(k));
      if (most - reach[k] < level && most - reach[(k + 1) % 3] < level) return face.edgePushes(k, normal) ? k : -1;
    }
    for (int k = 0; k < 3; k++)
      if (reach[k] == most) return face.cornerPushes(k, normal) ? 3 + k : -1;
    return -1;
  }
};

}  // namespace

void collideFaceFrustum(const MeshFace& face, const Shape& shape, const Transform& pose, double margin, Hull& triangle,
                        std::vector<MeshContactPoint>& out) {
  const Frustum frustum = frustumOf(shape);
  if (!(face.height(transformPoint(pose, Vec3{0, frustum.centre(), 0})) > 0)) return;
  const Vec3 down = transposeTimes(toMatrix(pose.rotation), -face.normal());
  const double above = face.height(transformPoint(pose, frustum.furthest(down)));
  if (!(above <= margin)) return;
  const std::optional<TouchAxis> axis = findTouchAxis(triangleShape(face, triangle), shape, pose, margin);
  if (!axis) return;
  const double inner = innerRadius(shape);
  const FrustumOnFace pair{face, shape, pose, margin, inner, contactTolerances(inner), out};
  const bool better = axis->separation > above + pair.tolerances.face;
  const int pusher = better ? pair.pusher(axis->normal) : -1;
  if (pusher < 0) {
    // A way out that the surface does not allow here is much shorter: the neighbour beyond the edge pushes.
    if (above < 0 && axis->separation > above + inner * 0.1 && axis->separation > 0.5 * above) return;
    pair.addFace();
  } else if (pusher < 3) {
    pair.addEdge(pusher, *axis);
  } else {
    pair.add(axis->normal, axis->onA, axis->separation, 0x20000000u | (face.name(pusher - 3) + 0x01000000u));
  }
}

}  // namespace brickfall
