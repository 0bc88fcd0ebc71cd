#include "narrowphase/hull_view.h"

namespace brickfall {
namespace {

// The unit cube. Corner bits: 1 = x+, 2 = y+, 4 = z+. Faces: x-, x+, y-, y+, z-, z+. Each row is a face,
// counter-clockwise seen from outside.
constexpr int kCubeFaces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};

struct CubeTopology {
  HullEdge edges[24];
  std::uint16_t firstEdge[6];
};

constexpr CubeTopology makeCube() {
  CubeTopology cube{};
  int pairs = 0;
  int half[8][8] = {};  // half edge from corner to corner, + 1
  for (int f = 0; f < 6; f++)
    for (int k = 0; k < 4; k++) {
      int from = kCubeFaces[f][k], to = kCubeFaces[f][(k + 1) % 4];
      int e = half[to][from] ? (half[to][from] - 1) ^ 1 : 2 * pairs++;
      half[from][to] = e + 1;
      cube.edges[e].origin = std::uint8_t(from);
      cube.edges[e].face = std::uint8_t(f);
      if (k == 0) cube.firstEdge[f] = std::uint16_t(e);
    }
  for (int f = 0; f < 6; f++)
    for (int k = 0; k < 4; k++) {
      int a = kCubeFaces[f][k], b = kCubeFaces[f][(k + 1) % 4], c = kCubeFaces[f][(k + 2) % 4];
      cube.edges[half[a][b] - 1].next = std::uint16_t(half[b][c] - 1);
    }
  return cube;
}
constexpr CubeTopology kCube = makeCube();

}  // namespace

HullView viewOf(const Shape& shape, HullStorage& storage) {
  HullView view;
  if (shape.type == ShapeType::hull) {
    const Hull& hull = *shape.hull;
    view.vertices = hull.vertices.data();
    view.planes = hull.planes.data();
    view.firstEdge = hull.firstEdge.data();
    view.edges = hull.edges.data();
    view.vertexCount = int(hull.vertices.size());
    view.faceCount = int(hull.planes.size());
    view.edgeCount = int(hull.edges.size());
    view.centroid = hull.centroid;
    view.innerRadius = 1e30;
    for (const HullPlane& plane : hull.planes) {
      double depth = plane.offset - dot(plane.normal, hull.centroid);
      if (depth < view.innerRadius) view.innerRadius = depth;
    }
    return view;
  }
  Vec3 h = shape.halfExtents;
  for (int v = 0; v < 8; v++) storage.vertices[v] = {v & 1 ? h.x : -h.x, v & 2 ? h.y : -h.y, v & 4 ? h.z : -h.z};
  for (int f = 0; f < 6; f++) {
    storage.planes[f] = {};
    storage.planes[f].normal[f / 2] = f & 1 ? 1 : -1;
    storage.planes[f].offset = h[f / 2];
  }
  view.vertices = storage.vertices;
  view.planes = storage.planes;
  view.firstEdge = kCube.firstEdge;
  view.edges = kCube.edges;
  view.vertexCount = 8;
  view.faceCount = 6;
  view.edgeCount = 24;
  view.innerRadius = h.x < h.y ? (h.x < h.z ? h.x : h.z) : (h.y < h.z ? h.y : h.z);
  return view;
}

HullView viewOf(const Shape& shape, const Transform& pose, HullStorage& storage) {
  HullView view = viewOf(shape, storage);
  Mat3 r = toMatrix(pose.rotation);
  for (int i = 0; i < view.vertexCount; i++) storage.vertices[i] = r * view.vertices[i] + pose.position;
  for (int i = 0; i < view.faceCount; i++) {
    Vec3 normal = r * view.planes[i].normal;
    storage.planes[i] = {normal, view.planes[i].offset + dot(normal, pose.position)};
  }
  view.vertices = storage.vertices;
  view.planes = storage.planes;
  view.centroid = r * view.centroid + pose.position;
  return view;
}

int supportVertex(const HullView& hull, Vec3 direction) {
  int best = 0;
  double furthest = dot(hull.vertices[0], direction);
  for (int i = 1; i < hull.vertexCount; i++) {
    double along = dot(hull.vertices[i], direction);
    if (along > furthest) furthest = along, best = i;
  }
  return best;
}

int faceAround(const HullView& hull, int vertex, Vec3 direction) {
  constexpr double kTie = 1e-9;
  int best = -1;
  double most = -2;
  for (int e = 0; e < hull.edgeCount; e++) {
    if (hull.edges[e].origin != vertex) continue;
    int face = hull.edges[e].face;
    double along = dot(hull.planes[face].normal, direction);
    if (along > most + kTie) most = along, best = face;
  }
  return best;
}

}  // namespace brickfall
