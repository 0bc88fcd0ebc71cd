// Mesh trees against FCL's OBBRSS trees, on the same meshes in the same poses: build, all pairs of overlapping triangles, first
// pair, distance. Each measurement of one is followed by the same of the other, so that both see the same machine; the figures
// are medians over rounds of the ratio. Answers are compared, and the bench fails where they differ.
//
//   mesh [triangles ...]      default 1000 10000 100000
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <memory>

#include "support/mesh_samples.h"
#include "support/random_geometry.h"

namespace {

using namespace brickfall;
using namespace brickfall::test;
using Model = fcl::BVHModel<fcl::OBBRSSd>;

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

std::shared_ptr<Model> modelOf(const TriangleMesh& mesh) {
  std::vector<fcl::Vector3d> points;
  std::vector<fcl::Triangle> triangles;
  for (Vec3 v : mesh.vertices()) points.push_back({v.x, v.y, v.z});
  for (const TriangleMesh::Face& f : mesh.faces()) triangles.push_back({f.vertex[0], f.vertex[1], f.vertex[2]});
  auto model = std::make_shared<Model>();
  model->beginModel(int(triangles.size()), int(points.size()));
  model->addSubModel(points, triangles);
  model->endModel();
  return model;
}

fcl::Transform3d poseOf(const Transform& t) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = fcl::Quaterniond(t.rotation.w, t.rotation.x, t.rotation.y, t.rotation.z).toRotationMatrix();
  pose.translation() = fcl::Vector3d(t.position.x, t.position.y, t.position.z);
  return pose;
}

struct Ratio {
  std::vector<double> ours, theirs;
  template <class Ours, class Theirs> void measure(Ours a, Theirs b) {
    double t0 = seconds();
    a();
    double t1 = seconds();
    b();
    double t2 = seconds();
    ours.push_back(t1 - t0);
    theirs.push_back(t2 - t1);
  }
  static double median(std::vector<double> v) {
    std::sort(v.begin(), v.end());
    return v.empty() ? 0 : v[v.size() / 2];
  }
  // Robust against what else the machine does: the median over poses.
  double ratio() const {
    std::vector<double> ratios;
    for (std::size_t i = 0; i < ours.size(); i++) ratios.push_back(theirs[i] / ours[i]);
    return median(std::move(ratios));
  }
};

int differences = 0;

struct Poses {
  std::vector<Transform> overlapping, apart;
};

// Poses at which the two meshes overlap a little or much, and poses that are apart.
Poses posesOf(const MeshTree& a, const MeshTree& b, int count) {
  Random random(7);
  Poses out;
  while (int(out.overlapping.size()) < count || int(out.apart.size()) < count) {
    Transform pose{randomDirection(random) * random.between(0.1, 2.4), randomRotation(random)};
    auto& list = firstOverlap(a, b, pose) ? out.overlapping : out.apart;
    if (int(list.size()) < count) list.push_back(pose);
  }
  return out;
}

void compare(const std::string& name, const MeshData& dataA, const MeshData& dataB, int count) {
  MeshTree a = treeOf(dataA), b = treeOf(dataB);
  Ratio build, all, first, none, distance;
  std::shared_ptr<Model> modelA, modelB;
  for (int round = 0; round < 3; round++)
    build.measure([&, mesh = a.mesh()]() mutable { a = MeshTree::build(std::move(mesh)); },
                  [&] { modelA = modelOf(a.mesh()); });
  modelB = modelOf(b.mesh());
  std::size_t pairs = 0;
  Poses poses = posesOf(a, b, count);
  auto collide = [&](const Transform& pose, std::size_t most) {
    fcl::CollisionRequestd request(most, false);
    fcl::CollisionResultd result;
    fcl::collide(modelA.get(), fcl::Transform3d::Identity(), modelB.get(), poseOf(pose), request, result);
    return result.numContacts();
  };
  for (const Transform& pose : poses.overlapping) {
    std::size_t ours = 0, theirs = 0;
    all.measure([&] { ours = overlappingFaces(a, b, pose).size(); }, [&] { theirs = collide(pose, 100'000'000); });
    pairs += ours;
    if (ours != theirs) differences++, std::printf("%s: %zu pairs, FCL %zu\n", name.c_str(), ours, theirs);
    first.measure([&] { ours = firstOverlap(a, b, pose).has_value(); }, [&] { theirs = collide(pose, 1); });
    if (ours != theirs) differences++, std::printf("%s: first pair differs\n", name.c_str());
  }
  for (const Transform& pose : poses.apart) {
    std::size_t ours = 0, theirs = 0;
    none.measure([&] { ours = firstOverlap(a, b, pose).has_value(); }, [&] { theirs = collide(pose, 1); });
    if (ours != theirs) differences++, std::printf("%s: overlap differs\n", name.c_str());
    double near = 0, fclNear = 0;
    distance.measure([&] { near = meshDistance(a, b, pose).distance; },
                     [&] {
                       fcl::DistanceRequestd request(true);
                       fcl::DistanceResultd result;
                       fclNear = fcl::distance(modelA.get(), fcl::Transform3d::Identity(), modelB.get(), poseOf(pose),
                                               request, result);
                     });
    if (std::fabs(near - fclNear) > 1e-9)
      differences++, std::printf("%s: distance %.12g, FCL %.12g\n", name.c_str(), near, fclNear);
  }
  auto us = [](const Ratio& r) { return 1e6 * Ratio::median(r.ours); };
  std::printf(
      "%-18s %7zu  build %9.0f us %5.2fx | all %9.1f us %5.2fx (%zu pairs) | first %8.1f us %5.2fx | none %8.1f us "
      "%5.2fx | "
      "distance %9.1f us %5.2fx\n",
      name.c_str(), a.mesh().count(), 1e6 * Ratio::median(build.ours), build.ratio(), us(all), all.ratio(),
      pairs / poses.overlapping.size(), us(first), first.ratio(), us(none), none.ratio(), us(distance),
      distance.ratio());
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<int> sizes;
  for (int i = 1; i < argc; i++) sizes.push_back(std::atoi(argv[i]));
  if (sizes.empty()) sizes = {1000, 10000, 100000};
  std::printf("median time of ours, and how many times as long FCL takes (median of the ratios)\n");
  for (int size : sizes) {
    int count = size > 50000 ? 10 : 40;
    std::vector<NamedMesh> meshes = sampleMeshes(size);
    for (std::size_t i = 0; i < meshes.size(); i++) {
      const NamedMesh& other = meshes[(i + 1) % meshes.size()];
      compare(meshes[i].name + "-" + other.name, meshes[i].data, other.data, count);
    }
  }
  std::printf("%d differences\n", differences);
  return differences == 0 ? 0 : 1;
}
