// The tree against looking at every triangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/mesh_samples.h"
#include "support/random_geometry.h"

namespace {

using namespace brickfall;
using namespace brickfall::test;

struct Sample {
  std::string name;
  MeshTree tree;
};
std::vector<Sample> samples(int triangles) {
  std::vector<Sample> out;
  for (const NamedMesh& mesh : sampleMeshes(triangles)) out.push_back({mesh.name, treeOf(mesh.data)});
  out.push_back({"soup", treeOf(soupMesh(triangles, 5))});
  out.push_back({"grid", treeOf(gridMesh(8, 8, 0.25))});
  out.push_back({"cube", treeOf(cubeMesh())});
  return out;
}

Triangle moved(const Triangle& t, const Transform& pose) {
  Mat3 turn = toMatrix(pose.rotation);
  Triangle out;
  for (int k = 0; k < 3; k++) out.corner[k] = turn * t.corner[k] + pose.position;
  return out;
}

std::vector<FacePair> allPairs(const MeshTree& a, const MeshTree& b, const Transform& bInA) {
  std::vector<FacePair> out;
  for (std::uint32_t j = 0; j < b.mesh().count(); j++) {
    Triangle t = moved(b.mesh().triangle(j), bInA);
    for (std::uint32_t i = 0; i < a.mesh().count(); i++)
      if (trianglesOverlap(a.mesh().triangle(i), t)) out.push_back({i, j});
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(MeshTree, HoldsItsTrianglesAndIsBalanced) {
  for (int triangles : {12, 1000, 20000})
    for (const Sample& sample : samples(triangles)) {
      EXPECT_EQ(sample.tree.validate(), "") << sample.name;
      EXPECT_LE(sample.tree.height(), 4 + 2.0 * std::log2(double(sample.tree.mesh().count()))) << sample.name;
    }
  // One triangle; many at one place; a row whose mean parts off only one at a time.
  EXPECT_EQ(treeOf({{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}}).validate(), "");
  MeshData heap, row;
  for (int i = 0; i < 300; i++) {
    double turn = 2e-3 * i, x = std::ldexp(1.0, -i / 4);
    for (Vec3 p : {Vec3{0, 0, 0}, Vec3{std::cos(turn), std::sin(turn), 1}, Vec3{-std::cos(turn), -std::sin(turn), 1}})
      heap.indices.push_back(std::uint32_t(heap.vertices.size())), heap.vertices.push_back(p);
    for (Vec3 p : {Vec3{x, 0, 0}, Vec3{x * 1.1, 0, 0}, Vec3{x, x / 10, 0}})
      row.indices.push_back(std::uint32_t(row.vertices.size())), row.vertices.push_back(p);
  }
  for (const MeshData& data : {heap, row}) {
    MeshTree tree = treeOf(data);
    EXPECT_EQ(tree.validate(), "");
    EXPECT_LE(tree.height(), 60);
  }
}

// Random poses; poses at which the two meshes touch or share planes, edges and corners.
TEST(MeshTree, OverlapFindsExactlyThePairsOfBruteForce) {
  std::vector<Sample> list = samples(150);
  Random random(11);
  int overlapping = 0, apart = 0, aligned = 0;
  std::size_t pairs = 0;
  for (const Sample& a : list)
    for (const Sample& b : list)
      for (int i = 0; i < 24; i++) {
        Transform pose{randomDirection(random) * random.between(0, 2.2), randomRotation(random)};
        if (i % 3 == 0) {  // on the grids' lines
          pose = {{0.25 * int(random.below(8)), i % 2 ? 0.0 : 0.5, 0.25 * int(random.below(8))}, {}};
          aligned++;
        }
        std::vector<FacePair> expected = allPairs(a.tree, b.tree, pose);
        ASSERT_EQ(overlappingFaces(a.tree, b.tree, pose), expected) << a.name << " " << b.name << " " << i;
        std::optional<FacePair> first = firstOverlap(a.tree, b.tree, pose);
        ASSERT_EQ(first.has_value(), !expected.empty());
        if (first) {
          ASSERT_TRUE(std::binary_search(expected.begin(), expected.end(), *first));
        }
        (expected.empty() ? apart : overlapping)++;
        pairs += expected.size();
      }
  EXPECT_GT(overlapping, 400);
  EXPECT_GT(apart, 150);
  EXPECT_GT(aligned, 300);
  EXPECT_GT(pairs, 10000u);
}

TEST(MeshTree, DistanceIsThatOfBruteForce) {
  std::vector<Sample> list = samples(150);
  Random random(12);
  int apart = 0, meeting = 0;
  for (const Sample& a : list)
    for (const Sample& b : list)
      for (int i = 0; i < 6; i++) {
        Transform pose{randomDirection(random) * random.between(0.5, 4), randomRotation(random)};
        double least = 1e300;
        for (std::uint32_t j = 0; j < b.tree.mesh().count() && least > 0; j++) {
          Triangle t = moved(b.tree.mesh().triangle(j), pose);
          for (std::uint32_t k = 0; k < a.tree.mesh().count(); k++)
            least = std::min(least, triangleDistance(a.tree.mesh().triangle(k), t).distance);
        }
        MeshDistance found = meshDistance(a.tree, b.tree, pose);
        ASSERT_NEAR(found.distance, least, 1e-13) << a.name << " " << b.name;
        ASSERT_NEAR(length(found.onB - found.onA), found.distance, 1e-12);
        ASSERT_LT(length(closestPoint(a.tree.mesh().triangle(found.faces.a), found.onA).point - found.onA), 1e-11);
        Triangle t = moved(b.tree.mesh().triangle(found.faces.b), pose);
        ASSERT_LT(length(closestPoint(t, found.onB).point - found.onB), 1e-11);
        (least > 0 ? apart : meeting)++;
      }
  EXPECT_GT(apart, 100);
  EXPECT_GT(meeting, 50);
}

// Swapping the meshes swaps the pairs; moving both together changes nothing, as long as nothing just touches.
TEST(MeshTree, SwapAndCommonMotionChangeNothing) {
  std::vector<Sample> list = samples(400);
  Random random(13);
  int overlapping = 0;
  for (int i = 0; i < 600; i++) {
    const MeshTree& a = list[random.below(5)].tree;
    const MeshTree& b = list[random.below(5)].tree;
    Transform poseA = randomPose(random, 3);
    Transform bInA{randomDirection(random) * random.between(0.2, 2.2), randomRotation(random)};
    Transform poseB = poseA * bInA, relative = inverse(poseA) * poseB;
    std::vector<FacePair> pairs = overlappingFaces(a, b, bInA), swapped = overlappingFaces(b, a, inverse(bInA));
    for (FacePair& p : swapped) std::swap(p.a, p.b);
    std::sort(swapped.begin(), swapped.end());
    ASSERT_EQ(swapped, pairs) << i;
    ASSERT_EQ(overlappingFaces(a, b, relative), pairs) << i;
    double there = meshDistance(a, b, bInA).distance;
    ASSERT_NEAR(meshDistance(b, a, inverse(bInA)).distance, there, 1e-12);
    ASSERT_NEAR(meshDistance(a, b, relative).distance, there, 1e-12);
    overlapping += !pairs.empty();
  }
  EXPECT_GT(overlapping, 150);
  EXPECT_LT(overlapping, 550);
}

TEST(MeshTree, ScalingScales) {
  Random random(14);
  for (const NamedMesh& sample : sampleMeshes(300))
    for (double scale : {1e-3, 1e4}) {
      MeshData large = sample.data;
      for (Vec3& v : large.vertices) v *= scale;
      MeshTree a = treeOf(sample.data), b = treeOf(large);
      for (int i = 0; i < 20; i++) {
        Transform pose{randomDirection(random) * random.between(0.5, 3), randomRotation(random)};
        Transform wide{pose.position * scale, pose.rotation};
        EXPECT_EQ(overlappingFaces(b, b, wide), overlappingFaces(a, a, pose)) << sample.name;
        EXPECT_NEAR(meshDistance(b, b, wide).distance, scale * meshDistance(a, a, pose).distance, 1e-10 * scale);
      }
    }
}

TEST(MeshTree, RayIsThatOfBruteForceAndSlipsThroughNoEdge) {
  Random random(15);
  int hits = 0, misses = 0, fronts = 0;
  for (const Sample& sample : samples(500))
    for (int i = 0; i < 1000; i++) {
      const TriangleMesh& mesh = sample.tree.mesh();
      Vec3 origin = randomDirection(random) * random.between(0, i % 2 ? 3 : 1e5);
      Vec3 target = randomVector(random, 1.2);
      if (i % 4 == 0) target = mesh.vertices()[random.below(std::uint32_t(mesh.vertices().size()))];
      Vec3 direction = normalized(target - origin);
      double limit = i % 3 == 0 ? length(target - origin) : 1e6;
      std::optional<MeshRayHit> hit = sample.tree.castRay(origin, direction, limit);
      double least = 1e300;
      for (std::uint32_t f = 0; f < mesh.count(); f++) {
        Triangle t = mesh.triangle(f);
        Vec3 n = cross(t.corner[1] - t.corner[0], t.corner[2] - t.corner[0]);
        double slope = dot(n, direction), distance = dot(n, t.corner[0] - origin) / slope;
        if (!(distance >= 0 && distance <= limit)) continue;
        Vec3 p = origin + direction * distance;
        bool inside = true;
        for (int k = 0; k < 3; k++)  // well inside
          inside = inside && dot(cross(n, t.corner[(k + 1) % 3] - t.corner[k]), p - t.corner[k]) > 1e-6 * length(n);
        if (inside) least = std::min(least, distance);
      }
      if (least < 1e300) {
        ASSERT_TRUE(hit) << sample.name << " " << i;
        ASSERT_LE(hit->distance, least + 1e-9 * (1 + length(origin))) << sample.name << " " << i;
      }
      (hit ? hits : misses)++;
      if (!hit) continue;
      ASSERT_LE(hit->distance, limit);
      Triangle t = mesh.triangle(hit->face);
      ASSERT_LT(length(closestPoint(t, hit->point).point - hit->point), 1e-9 * (1 + length(origin)));
      ASSERT_LE(dot(hit->normal, direction), 1e-9);
      fronts += hit->front;
    }
  EXPECT_GT(hits, 2500);
  EXPECT_GT(misses, 500);
  EXPECT_GT(fronts, 1500);
  // From inside a closed mesh every ray hits, through vertices and edges too.
  MeshTree ball = treeOf(sphereMesh(300));
  for (Vec3 v : ball.mesh().vertices())
    EXPECT_TRUE(ball.castRay({0.01, 0.02, 0.03}, normalized(v - Vec3{0.01, 0.02, 0.03}), 10));
  for (std::uint32_t f = 0; f < ball.mesh().count(); f++) {
    Triangle t = ball.mesh().triangle(f);
    Vec3 middle = (t.corner[0] + t.corner[1]) * 0.5;
    EXPECT_TRUE(ball.castRay({}, normalized(middle), 10));
  }
}

TEST(MeshTree, ClosestPointAndFacesNearAreThoseOfBruteForce) {
  Random random(16);
  int near = 0;
  std::size_t found = 0;
  for (const Sample& sample : samples(500))
    for (int i = 0; i < 200; i++) {
      const TriangleMesh& mesh = sample.tree.mesh();
      Vec3 p = randomVector(random, i % 2 ? 1.5 : 30);
      double least = 1e300;
      for (std::uint32_t f = 0; f < mesh.count(); f++)
        least = std::min(least, length(closestPoint(mesh.triangle(f), p).point - p));
      std::optional<MeshPoint> point = sample.tree.closestPoint(p, 1e9);
      ASSERT_TRUE(point);
      ASSERT_EQ(point->distance, least);
      ASSERT_FALSE(sample.tree.closestPoint(p, least * (1 - 1e-9)));
      near += sample.tree.closestPoint(p, least).has_value();

      Aabb box = grown({p, p}, random.between(0, 0.5));
      std::vector<std::uint32_t> faces;
      sample.tree.facesNear(box, faces);
      ASSERT_TRUE(std::is_sorted(faces.begin(), faces.end()));
      found += faces.size();
      for (std::uint32_t f = 0; f < mesh.count(); f++) {
        Triangle t = mesh.triangle(f);
        Vec3 inside = (t.corner[0] + t.corner[1] + t.corner[2]) * (1.0 / 3);
        bool reaches = false;
        for (Vec3 q : {t.corner[0], t.corner[1], t.corner[2], inside}) reaches = reaches || contains(box, {q, q});
        if (reaches) {
          ASSERT_TRUE(std::binary_search(faces.begin(), faces.end(), f)) << sample.name;
        }
      }
    }
  EXPECT_EQ(near, 1400);
  EXPECT_GT(found, 3000u);
}

}  // namespace
