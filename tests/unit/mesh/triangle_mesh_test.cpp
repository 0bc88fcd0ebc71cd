// Making meshes: what is refused, what is mended, neighbours.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "support/mesh_samples.h"

namespace {

using namespace brickfall;
using namespace brickfall::test;

Result<TriangleMesh> make(const MeshData& data) { return TriangleMesh::create(data.vertices, data.indices); }

TEST(TriangleMesh, RefusesWhatIsNoMesh) {
  MeshData good = cubeMesh();
  auto refused = [](const MeshData& data, ErrorCode code, const std::string& word) {
    Result<TriangleMesh> mesh = make(data);
    ASSERT_FALSE(mesh);
    EXPECT_EQ(mesh.error().code, code);
    EXPECT_NE(mesh.error().message.find(word), std::string::npos) << mesh.error().message;
  };
  MeshData bad = good;
  bad.vertices[3].y = NAN;
  refused(bad, ErrorCode::invalidArgument, "vertices[3]");
  bad = good;
  bad.vertices[7].z = INFINITY;
  refused(bad, ErrorCode::invalidArgument, "vertices[7]");
  bad = good;
  bad.vertices[0].x = 1.1e6;
  refused(bad, ErrorCode::invalidArgument, "vertices[0]");
  bad = good;
  bad.indices[4] = 8;
  refused(bad, ErrorCode::invalidArgument, "indices[4]");
  bad = good;
  bad.indices.pop_back();
  refused(bad, ErrorCode::invalidArgument, "found 35");
  refused({}, ErrorCode::badGeometry, "no triangle");
  bad = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {0, 1, 2}};
  refused(bad, ErrorCode::badGeometry, "no triangle");
  EXPECT_TRUE(make(good));
}

TEST(TriangleMesh, MergesDropsAndCounts) {
  MeshData data = cubeMesh();
  // Every triangle with its own corners, as files have them; a doubled, a flat and a pointlike triangle; a lost vertex.
  MeshData split;
  for (std::uint32_t i : data.indices) {
    split.indices.push_back(std::uint32_t(split.vertices.size()));
    split.vertices.push_back(data.vertices[i]);
  }
  split.vertices[0].x = split.vertices[0].x == 0 ? -0.0 : split.vertices[0].x;
  for (std::uint32_t i : {1u, 2u, 0u, 0u, 1u, 1u, 3u, 3u, 3u}) split.indices.push_back(i);
  split.vertices.push_back({9, 9, 9});
  Result<TriangleMesh> mesh = make(split);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->vertices().size(), 8u);
  EXPECT_EQ(mesh->count(), 12u);
  EXPECT_EQ(mesh->report().mergedVertices, 28);
  EXPECT_EQ(mesh->report().unusedVertices, 1);
  EXPECT_EQ(mesh->report().doubledTriangles, 1);
  EXPECT_EQ(mesh->report().degenerateTriangles, 2);
  EXPECT_TRUE(mesh->report().closed());
  EXPECT_EQ(mesh->bounds().lower, (Vec3{-0.5, -0.5, -0.5}));
  EXPECT_EQ(mesh->bounds().upper, (Vec3{0.5, 0.5, 0.5}));
}

TEST(TriangleMesh, KeepsNeedlesAndTheNumberOfTheSource) {
  MeshData data{{{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}, {0.5, 1e-11, 0}}, {0, 1, 3, 0, 1, 2}};
  Result<TriangleMesh> mesh = make(data);
  ASSERT_TRUE(mesh);
  ASSERT_EQ(mesh->count(), 1u);
  EXPECT_EQ(mesh->faces()[0].source, 1u);
  EXPECT_EQ(mesh->report().degenerateTriangles, 1);
}

TEST(TriangleMesh, NeighboursAreMutualAndShareTheEdge) {
  for (const NamedMesh& sample : sampleMeshes(1500)) {
    Result<TriangleMesh> mesh = make(sample.data);
    ASSERT_TRUE(mesh) << sample.name;
    bool terrain = sample.name == "terrain";
    EXPECT_EQ(mesh->report().closed(), !terrain) << sample.name;
    EXPECT_EQ(mesh->report().oddEdges, 0) << sample.name;
    int open = 0;
    std::vector<std::set<std::uint32_t>> rings(mesh->vertices().size());
    for (std::uint32_t f = 0; f < mesh->count(); f++)
      for (int k = 0; k < 3; k++) {
        std::uint32_t from = mesh->faces()[f].vertex[k], to = mesh->faces()[f].vertex[(k + 1) % 3];
        rings[from].insert(to);
        rings[to].insert(from);
        std::uint32_t other = mesh->neighbour(f, k);
        if (other == kNoTriangle) {
          open++;
          continue;
        }
        int back = 0;
        for (int j = 0; j < 3; j++)
          back += mesh->neighbour(other, j) == f && mesh->faces()[other].vertex[j] == to &&
                  mesh->faces()[other].vertex[(j + 1) % 3] == from;
        ASSERT_EQ(back, 1) << sample.name << " face " << f;
      }
    EXPECT_EQ(open, mesh->report().openEdges) << sample.name;
    for (std::uint32_t v = 0; v < rings.size(); v++) {
      auto ring = mesh->around(v);
      ASSERT_TRUE(std::equal(ring.begin(), ring.end(), rings[v].begin(), rings[v].end())) << sample.name << " " << v;
    }
    if (!terrain) {  // closed surfaces: Euler's number, 2 for balls and 0 for the torus
      int euler = int(mesh->vertices().size()) - int(mesh->count()) * 3 / 2 + int(mesh->count());
      EXPECT_EQ(euler, sample.name == "torus" ? 0 : 2) << sample.name;
    }
  }
}

TEST(TriangleMesh, OddEdgesCountAsOpen) {
  // Three triangles on one edge; two that disagree about their front.
  MeshData three{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {0, 1, 2, 1, 0, 3, 0, 1, 4}};
  Result<TriangleMesh> mesh = make(three);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->report().oddEdges, 1);
  EXPECT_EQ(mesh->report().openEdges, 6);
  MeshData turned{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}}, {0, 1, 2, 0, 1, 3}};
  mesh = make(turned);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->report().oddEdges, 1);
  EXPECT_EQ(mesh->neighbour(0, 0), kNoTriangle);
}

}  // namespace
