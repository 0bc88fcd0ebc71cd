#include "fcl_oracle.h"

#include <fcl/geometry/shape/box.h>
#include <fcl/narrowphase/collision.h>

namespace brickfall::test {

bool fclBoxesOverlap(Vec3 halfA, Vec3 halfB, const Transform& bInA) {
  auto make = [](Vec3 h) { return std::make_shared<fcl::Boxd>(2 * h.x, 2 * h.y, 2 * h.z); };
  fcl::Transform3d pose = fcl::Transform3d::Identity();
  Quat q = bInA.rotation;
  pose.linear() = fcl::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
  pose.translation() = fcl::Vector3d(bInA.position.x, bInA.position.y, bInA.position.z);
  fcl::CollisionObjectd a(make(halfA)), b(make(halfB), pose);
  fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(&a, &b, request, result) > 0;
}

}  // namespace brickfall::test
