#include "fcl_meshes.h"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>

namespace brickfall::test {

struct FclMesh::Model {
  std::shared_ptr<fcl::BVHModel<fcl::OBBRSSd>> tree = std::make_shared<fcl::BVHModel<fcl::OBBRSSd>>();
};

namespace {

fcl::Transform3d poseOf(const Transform& t) {
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  pose.linear() = fcl::Quaterniond(t.rotation.w, t.rotation.x, t.rotation.y, t.rotation.z).toRotationMatrix();
  pose.translation() = fcl::Vector3d(t.position.x, t.position.y, t.position.z);
  return pose;
}

}  // namespace

FclMesh::FclMesh(const TriangleMesh& mesh) : model_(std::make_unique<Model>()) {
  std::vector<fcl::Vector3d> points;
  std::vector<fcl::Triangle> triangles;
  for (Vec3 v : mesh.vertices()) points.push_back({v.x, v.y, v.z});
  for (const TriangleMesh::Face& f : mesh.faces()) triangles.push_back({f.vertex[0], f.vertex[1], f.vertex[2]});
  model_->tree->beginModel(int(triangles.size()), int(points.size()));
  model_->tree->addSubModel(points, triangles);
  model_->tree->endModel();
}
FclMesh::~FclMesh() = default;

std::vector<FacePair> FclMesh::overlappingFaces(const FclMesh& a, const FclMesh& b, const Transform& bInA) {
  fcl::CollisionRequestd request(10'000'000, true);
  fcl::CollisionResultd result;
  fcl::collide(a.model_->tree.get(), fcl::Transform3d::Identity(), b.model_->tree.get(), poseOf(bInA), request, result);
  std::vector<FacePair> out;
  for (std::size_t i = 0; i < result.numContacts(); i++) {
    FacePair pair{std::uint32_t(result.getContact(i).b1), std::uint32_t(result.getContact(i).b2)};
    out.push_back(pair);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());  // one entry for each point of contact
  return out;
}

double FclMesh::distance(const FclMesh& a, const FclMesh& b, const Transform& bInA) {
  fcl::DistanceRequestd request(true);
  fcl::DistanceResultd result;
  return fcl::distance(a.model_->tree.get(), fcl::Transform3d::Identity(), b.model_->tree.get(), poseOf(bInA), request,
                       result);
}

}  // namespace brickfall::test
