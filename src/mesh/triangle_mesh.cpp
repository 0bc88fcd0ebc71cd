// Making a mesh: check what was given, merge equal vertices, drop what has no area, find neighbours. Everything by sorting,
// so that the result depends on nothing but what was given, in O(n log n).
#include "brickfall/geometry/triangle_mesh.h"

#include <algorithm>
#include <string>

namespace brickfall {

namespace {

constexpr double kFlat = 1e-10;  // height over longest edge below which a triangle has no area

Error badMesh(ErrorCode code, const std::string& text) { return {code, text}; }

// For each given vertex the first one at the same place. Minus zero is zero.
std::vector<std::uint32_t> firstAtPlace(std::span<const Vec3> given) {
  std::vector<std::uint32_t> order(given.size()), first(given.size());
  for (std::uint32_t i = 0; i < order.size(); i++) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const Vec3 &p = given[i], &q = given[j];
    if (p.x != q.x) return p.x < q.x;
    if (p.y != q.y) return p.y < q.y;
    if (p.z != q.z) return p.z < q.z;
    return i < j;
  });
  for (std::size_t k = 0; k < order.size(); k++)
    first[order[k]] = k > 0 && given[order[k]] == given[order[k - 1]] ? first[order[k - 1]] : order[k];
  return first;
}

bool hasArea(Vec3 a, Vec3 b, Vec3 c) {
  double longest = std::max({lengthSquared(b - a), lengthSquared(c - b), lengthSquared(a - c)});
  double limit = kFlat * longest;
  return lengthSquared(cross(b - a, c - a)) > limit * limit;
}

// A face with its corners turned so that the smallest comes first; equal faces have equal keys.
struct FaceKey {
  std::uint32_t corner[3];
  std::uint32_t face;

  FaceKey(const TriangleMesh::Face& f, std::uint32_t number) : face(number) {
    int start = f.vertex[1] < f.vertex[0] ? 1 : 0;
    if (f.vertex[2] < f.vertex[start]) start = 2;
    for (int k = 0; k < 3; k++) corner[k] = f.vertex[(start + k) % 3];
  }
  bool sameCorners(const FaceKey& o) const {
    return corner[0] == o.corner[0] && corner[1] == o.corner[1] && corner[2] == o.corner[2];
  }
  bool operator<(const FaceKey& o) const {
    for (int k = 0; k < 3; k++)
      if (corner[k] != o.corner[k]) return corner[k] < o.corner[k];
    return face < o.face;
  }
};

struct EdgeKey {
  std::uint32_t low, high;  // vertices
  std::uint32_t side;       // 3 * face + corner that it starts from
  bool forwards;            // from low to high

  bool sameEdge(const EdgeKey& o) const { return low == o.low && high == o.high; }
  bool operator<(const EdgeKey& o) const {
    return low != o.low ? low < o.low : high != o.high ? high < o.high : side < o.side;
  }
};

}  // namespace

Result<TriangleMesh> TriangleMesh::create(std::span<const Vec3> vertices, std::span<const std::uint32_t> indices) {
  if (vertices.size() > kMaxVertices)
    return badMesh(ErrorCode::limitExceeded, "vertices: found " + std::to_string(vertices.size()) +
                                                 ", expected at most " + std::to_string(kMaxVertices));
  if (indices.size() % 3 != 0)
    return badMesh(ErrorCode::invalidArgument,
                   "indices: found " + std::to_string(indices.size()) + ", expected three a triangle");
  if (indices.size() / 3 > kMaxTriangles)
    return badMesh(ErrorCode::limitExceeded, "indices: found " + std::to_string(indices.size() / 3) +
                                                 " triangles, expected at most " + std::to_string(kMaxTriangles));
  for (std::size_t i = 0; i < vertices.size(); i++) {
    Vec3 p = vertices[i];
    if (std::fabs(p.x) <= kLargestCoordinate && std::fabs(p.y) <= kLargestCoordinate &&
        std::fabs(p.z) <= kLargestCoordinate)
      continue;
    return badMesh(ErrorCode::invalidArgument, "vertices[" + std::to_string(i) + "]: found (" + std::to_string(p.x) +
                                                   ", " + std::to_string(p.y) + ", " + std::to_string(p.z) +
                                                   "), expected coordinates within 1e6 m");
  }
  for (std::size_t i = 0; i < indices.size(); i++)
    if (indices[i] >= vertices.size())
      return badMesh(ErrorCode::invalidArgument, "indices[" + std::to_string(i) + "]: found " +
                                                     std::to_string(indices[i]) + ", expected less than the " +
                                                     std::to_string(vertices.size()) + " vertices");
  TriangleMesh mesh;
  mesh.takeFaces(vertices, indices);
  if (mesh.faces_.empty())
    return badMesh(ErrorCode::badGeometry,
                   "indices: found no triangle with an area (of " + std::to_string(indices.size() / 3) + ")");
  mesh.dropUnused();
  mesh.connect();
  return mesh;
}

void TriangleMesh::takeFaces(std::span<const Vec3> given, std::span<const std::uint32_t> indices) {
  std::vector<std::uint32_t> first = firstAtPlace(given);
  vertices_.assign(given.begin(), given.end());
  for (std::uint32_t i = 0; i < first.size(); i++) report_.mergedVertices += first[i] != i;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    Face f{{first[indices[i]], first[indices[i + 1]], first[indices[i + 2]]}, std::uint32_t(i / 3)};
    if (hasArea(vertices_[f.vertex[0]], vertices_[f.vertex[1]], vertices_[f.vertex[2]]))
      faces_.push_back(f);
    else
      report_.degenerateTriangles++;
  }
  std::vector<FaceKey> keys;
  keys.reserve(faces_.size());
  for (std::uint32_t i = 0; i < faces_.size(); i++) keys.emplace_back(faces_[i], i);
  std::sort(keys.begin(), keys.end());
  std::vector<bool> doubled(faces_.size());
  for (std::size_t i = 1; i < keys.size(); i++)
    if (keys[i].sameCorners(keys[i - 1])) doubled[keys[i].face] = true, report_.doubledTriangles++;
  if (report_.doubledTriangles == 0) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < faces_.size(); i++)
    if (!doubled[i]) faces_[kept++] = faces_[i];
  faces_.resize(kept);
}

// Vertices keep their order.
void TriangleMesh::dropUnused() {
  std::vector<std::uint32_t> number(vertices_.size(), kNoTriangle);
  for (const Face& f : faces_)
    for (std::uint32_t v : f.vertex) number[v] = 0;
  std::uint32_t kept = 0;
  for (std::size_t v = 0; v < vertices_.size(); v++) {
    if (number[v] == kNoTriangle) continue;
    number[v] = kept;
    vertices_[kept++] = vertices_[v];
  }
  report_.unusedVertices = int(vertices_.size()) - report_.mergedVertices - int(kept);
  vertices_.resize(kept);
  for (Face& f : faces_)
    for (std::uint32_t& v : f.vertex) v = number[v];
  bounds_ = {vertices_[0], vertices_[0]};
  for (Vec3 p : vertices_) bounds_ = {min(bounds_.lower, p), max(bounds_.upper, p)};
}

void TriangleMesh::connect() {
  std::vector<EdgeKey> edges;
  edges.reserve(3 * faces_.size());
  for (std::uint32_t f = 0; f < faces_.size(); f++)
    for (std::uint32_t k = 0; k < 3; k++) {
      std::uint32_t from = faces_[f].vertex[k], to = faces_[f].vertex[(k + 1) % 3];
      edges.push_back({std::min(from, to), std::max(from, to), 3 * f + k, from < to});
    }
  std::sort(edges.begin(), edges.end());
  neighbours_.assign(3 * faces_.size(), kNoTriangle);
  std::vector<std::uint32_t> degree(vertices_.size() + 1);
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t end = i + 1;
    while (end < edges.size() && edges[end].sameEdge(edges[i])) end++;
    if (end - i == 2 && edges[i].forwards != edges[i + 1].forwards) {
      neighbours_[edges[i].side] = edges[i + 1].side / 3;
      neighbours_[edges[i + 1].side] = edges[i].side / 3;
    } else {
      (end - i == 1 ? report_.openEdges : report_.oddEdges)++;
    }
    degree[edges[i].low]++;
    degree[edges[i].high]++;
    i = end;
  }
  ringStart_.assign(vertices_.size() + 1, 0);
  for (std::size_t v = 0; v < vertices_.size(); v++) ringStart_[v + 1] = ringStart_[v] + degree[v];
  ring_.resize(ringStart_.back());
  std::vector<std::uint32_t> next(ringStart_.begin(), ringStart_.end() - 1);
  // Edges are sorted by their lower vertex, so first the lower, then the higher neighbours come in ascending order.
  for (bool upper : {false, true})
    for (std::size_t i = 0; i < edges.size(); i++) {
      if (i > 0 && edges[i].sameEdge(edges[i - 1])) continue;
      if (upper)
        ring_[next[edges[i].low]++] = edges[i].high;
      else
        ring_[next[edges[i].high]++] = edges[i].low;
    }
}

}  // namespace brickfall
