// The same answers as FCL, at thousands of poses.
#include <gtest/gtest.h>

#include "fcl_meshes.h"
#include "support/mesh_samples.h"
#include "support/random_geometry.h"

namespace {

using namespace brickfall;
using namespace brickfall::test;

// Smallest distance of two triangles over the rounding of their coordinates: nearer than this, either answer is right.
constexpr double kUndecided = 1e-12;

Triangle moved(const Triangle& t, const Transform& pose) {
  Mat3 turn = toMatrix(pose.rotation);
  Triangle out;
  for (int k = 0; k < 3; k++) out.corner[k] = turn * t.corner[k] + pose.position;
  return out;
}

TEST(MeshesAgainstFcl, SamePairsAndDistances) {
  std::vector<NamedMesh> meshes = sampleMeshes(600);
  std::vector<MeshTree> trees;
  std::vector<std::unique_ptr<FclMesh>> theirs;
  for (const NamedMesh& mesh : meshes) {
    trees.push_back(treeOf(mesh.data));
    theirs.push_back(std::make_unique<FclMesh>(trees.back().mesh()));
  }
  Random random(21);
  int overlapping = 0, apart = 0, undecided = 0;
  std::size_t pairs = 0;
  for (int i = 0; i < 3000; i++) {
    std::size_t a = random.below(4), b = random.below(4);
    Transform pose{randomDirection(random) * random.between(0.1, 2.6), randomRotation(random)};
    std::vector<FacePair> ours = overlappingFaces(trees[a], trees[b], pose);
    std::vector<FacePair> others = FclMesh::overlappingFaces(*theirs[a], *theirs[b], pose), differ;
    std::set_symmetric_difference(ours.begin(), ours.end(), others.begin(), others.end(), std::back_inserter(differ));
    for (FacePair p : differ) {  // only where rounding decides
      Triangle t = moved(trees[b].mesh().triangle(p.b), pose);
      double distance = triangleDistance(trees[a].mesh().triangle(p.a), t).distance;
      ASSERT_LT(distance, kUndecided) << meshes[a].name << " " << meshes[b].name << " " << p.a << " " << p.b;
      undecided++;
    }
    pairs += ours.size();
    (ours.empty() ? apart : overlapping)++;
    if (!ours.empty()) continue;
    ASSERT_NEAR(meshDistance(trees[a], trees[b], pose).distance, FclMesh::distance(*theirs[a], *theirs[b], pose), 1e-9)
        << meshes[a].name << " " << meshes[b].name;
  }
  EXPECT_GT(overlapping, 1000);
  EXPECT_GT(apart, 600);
  EXPECT_GT(pairs, 50000u);
  EXPECT_LE(undecided, 2);
}

}  // namespace
