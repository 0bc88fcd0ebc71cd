#include "geometry/mesh_shape.h"

#include <vector>

#include "brickfall/geometry/mesh_tree.h"
#include "geometry/core.h"
#include "geometry/polytope.h"
#include "geometry/touch_axis.h"

namespace brickfall {

namespace {

// A face as a convex shape of its own.
class FaceShape {
 public:
  FaceShape() {
    hull_.vertices.resize(3);
    shape_.type = ShapeType::hull;
    shape_.hull = &hull_;
  }
  FaceShape(const FaceShape&) = delete;
  const Shape& operator()(const Triangle& t) {
    for (std::size_t k = 0; k < 3; k++) hull_.vertices[k] = t.corner[k];
    hull_.centroid = (t.corner[0] + t.corner[1] + t.corner[2]) * (1.0 / 3);
    return shape_;
  }

 private:
  Hull hull_;
  Shape shape_;
};

// Room that is kept from call to call: fast bodies are swept in every step, and a step takes nothing from the heap.
struct Scratch {
  FaceShape face;
  std::vector<std::uint32_t> faces;  // near the shape

  Scratch() { faces.reserve(4096); }
};
Scratch& scratch() {
  thread_local Scratch kept;
  return kept;
}

struct Span {
  double low, high;
};
Span along(Vec3 axis, const Vec3* points, int count) {
  Span s{dot(axis, points[0]), dot(axis, points[0])};
  for (int i = 1; i < count; i++) {
    double x = dot(axis, points[i]);
    s.low = x < s.low ? x : s.low;
    s.high = x > s.high ? x : s.high;
  }
  return s;
}

// Overlap of a face and a box or hull: the least over the face's normal, the shape's, and crossed edges.
double polytopeOverlap(const Triangle& t, const Polytope& p) {
  double overlap = 1e300;
  auto see = [&](double found) { overlap = found < overlap ? found : overlap; };
  Vec3 n = normalized(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]));
  if (dot(n, p.centre - t.corner[0]) < 0) n = -n;
  see(dot(n, t.corner[0]) - along(n, p.vertices, p.vertexCount).low);
  for (int f = 0; f < p.faceCount && overlap > 0; f++)
    see(p.planes[f].offset - along(p.planes[f].normal, t.corner, 3).low);
  for (int k = 0; k < 3; k++) {
    Vec3 e = t.corner[(k + 1) % 3] - t.corner[k];
    for (int j = 0; j < p.edgeCount && overlap > 0; j++) {
      Vec3 d = p.edges[j].end - p.edges[j].start, axis = cross(e, d);
      double squared = lengthSquared(axis);
      if (!(squared > 1e-12 * lengthSquared(e) * lengthSquared(d))) continue;
      axis *= 1 / std::sqrt(squared);
      Span face = along(axis, t.corner, 3), shape = along(axis, p.vertices, p.vertexCount);
      double up = face.high - shape.low, down = shape.high - face.low;
      see(up < down ? up : down);
    }
  }
  return overlap;
}

// Of a ball around a point or segment.
double roundOverlap(const Triangle& t, const Shape& face, const Shape& shape, const Transform& pose) {
  Shape core = shape;
  core.radius = 0;
  double distance = shapeDistance(face, core, pose).distance;
  if (distance > 0) return shape.radius - distance;
  Vec3 n = normalized(cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]));
  if (shape.type == ShapeType::sphere) return shape.radius;
  Vec3 tip = rotate(pose.rotation, Vec3{0, shape.halfHeight, 0});
  if (dot(n, pose.position - t.corner[0]) < 0) n = -n;
  double up = dot(n, pose.position + tip - t.corner[0]), down = dot(n, pose.position - tip - t.corner[0]);
  return shape.radius - (up < down ? up : down);
}

double frustumOverlap(const Shape& face, const Shape& shape, const Transform& pose) {
  std::optional<TouchAxis> axis = findTouchAxis(face, shape, pose, 0);
  return axis ? -axis->separation : 0;
}

Vec3 middleOf(const Shape& shape, const Transform& pose) {
  return shape.type == ShapeType::hull ? transformPoint(pose, shape.hull->centroid) : pose.position;
}

bool noPair(const Shape& shape) { return shape.type == ShapeType::mesh || shape.type == ShapeType::plane; }

}  // namespace

void keepMeshRoom() { scratch(); }

double meshPenetration(const Shape& mesh, const Shape& shape, const Transform& pose) {
  if (noPair(shape)) return 0;
  auto& [face, faces] = scratch();
  mesh.mesh->facesNear(bounds(shape, pose), faces);
  if (faces.empty()) return 0;
  bool round = isRound(shape.type), turned = isFrustum(shape.type);
  std::optional<Polytope> polytope;
  if (!round && !turned) polytope.emplace(shape, pose);
  double depth = 0;
  for (std::uint32_t f : faces) {
    Triangle t = mesh.mesh->mesh().triangle(f);
    double overlap = round    ? roundOverlap(t, face(t), shape, pose)
                     : turned ? frustumOverlap(face(t), shape, pose)
                              : polytopeOverlap(t, *polytope);
    depth = overlap > depth ? overlap : depth;
  }
  return depth;
}

DistanceResult meshShapeDistance(const Shape& mesh, const Shape& shape, const Transform& pose) {
  if (noPair(shape)) return {};
  const MeshTree& tree = *mesh.mesh;
  auto& [face, faces] = scratch();
  // The face nearest to the middle gives a distance that no other need exceed.
  std::uint32_t first = tree.closestPoint(middleOf(shape, pose), 1e300)->face;
  DistanceResult best = shapeDistance(face(tree.mesh().triangle(first)), shape, pose);
  if (!(best.distance > 0)) return best;
  tree.facesNear(grown(bounds(shape, pose), best.distance), faces);
  for (std::uint32_t f : faces) {
    DistanceResult found = shapeDistance(face(tree.mesh().triangle(f)), shape, pose);
    if (found.distance < best.distance) best = found;
    if (!(best.distance > 0)) break;
  }
  return best;
}

std::optional<double> meshTimeOfImpact(const Shape& mesh, const Shape& shape, const Transform& pose, Vec3 motion,
                                       double target) {
  if (noPair(shape)) return {};
  const MeshTree& tree = *mesh.mesh;
  Aabb now = bounds(shape, pose), then{now.lower + motion, now.upper + motion};
  auto& [face, faces] = scratch();
  tree.facesNear(grown(merged(now, then), target > 0 ? target + 1e-6 : 1e-6), faces);
  std::optional<double> first;
  for (std::uint32_t f : faces) {
    Triangle t = tree.mesh().triangle(f);
    Vec3 n = tree.mesh().normal(f);
    if (!(dot(n, motion) < 0) || !(dot(n, middleOf(shape, pose) - t.corner[0]) > 0)) continue;
    std::optional<double> met = timeOfImpact(face(t), shape, pose, motion, target);
    if (met && (!first || *met < *first)) first = met;
  }
  return first;
}

}  // namespace brickfall
