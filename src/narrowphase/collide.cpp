// Picks the function of the pair and brings the arguments into its order.
#include "narrowphase/collide.h"

#include "narrowphase/pairs.h"

namespace brickfall {
namespace {

using PairFunction = void (*)(const Shape&, const Shape&, const Transform&, double, const LoadedPoints&, Manifold&);

// Of a pair that never has more points than are kept.
template <auto function>
void few(const Shape& a, const Shape& b, const Transform& bInA, double margin, const LoadedPoints&, Manifold& out) {
  function(a, b, bInA, margin, out);
}

// The order in which a pair's function takes its arguments. Two planes have none.
constexpr int kRanks = 6;
static_assert(kRanks == kShapeTypeCount - 2,
              "a new shape needs a row and a column in kPairs; meshes have none, cones a cylinder's");
int rank(ShapeType type) {
  switch (type) {
    case ShapeType::plane:
      return 0;
    case ShapeType::sphere:
      return 1;
    case ShapeType::capsule:
      return 2;
    case ShapeType::box:
      return 3;
    case ShapeType::hull:
      return 4;
    case ShapeType::cylinder:
    case ShapeType::cone:
      return 5;
    case ShapeType::mesh:
      return -1;
  }
  return -1;
}

// clang-format off
constexpr PairFunction kPairs[kRanks][kRanks] = {
    // plane    sphere                     capsule                      box                       hull                     cylinder, cone
    {nullptr, few<collidePlaneSphere>,  few<collidePlaneCapsule>,   few<collidePlaneBox>,    collidePlaneHull,        collidePlaneFrustum},        // plane
    {nullptr, few<collideSphereSphere>, few<collideSphereCapsule>,  few<collideSphereBox>,   few<collideSphereHull>,  few<collideSphereFrustum>},  // sphere
    {nullptr, nullptr,                  few<collideCapsuleCapsule>, few<collideCapsuleHull>, few<collideCapsuleHull>, collideConvexFrustum},       // capsule
    {nullptr, nullptr,                  nullptr,                    collideBoxBox,           collideHullHull,         collideConvexFrustum},       // box
    {nullptr, nullptr,                  nullptr,                    nullptr,                 collideHullHull,         collideConvexFrustum},       // hull
    {nullptr, nullptr,                  nullptr,                    nullptr,                 nullptr,                 collideConvexFrustum},       // cylinder, cone
};
// clang-format on

// A manifold found in the frame of b, with b in the first place, as seen from a.
void mirror(const Transform& bInA, Manifold& m) {
  Mat3 r = toMatrix(bInA.rotation);
  m.normal = -(r * m.normal);
  for (int i = 0; i < m.count; i++) {
    ManifoldPoint& p = m.points[i];
    p.onA = r * p.onB + bInA.position;
    p.onB = p.onA + m.normal * p.separation;
  }
}

}  // namespace

void collide(const Shape& a, const Shape& b, const Transform& bInA, double margin, Manifold& out,
             const LoadedPoints& loaded) {
  out.count = 0;
  out.partial = out.rolls = false;
  int ra = rank(a.type), rb = rank(b.type);
  if (ra < 0 || rb < 0) return;  // mesh_collide.h: several manifolds
  PairFunction function = ra <= rb ? kPairs[ra][rb] : kPairs[rb][ra];
  if (!function) return;
  if (ra <= rb) {
    function(a, b, bInA, margin, loaded, out);
  } else {
    function(b, a, inverse(bInA), margin, loaded, out);
    mirror(bInA, out);
  }
}

}  // namespace brickfall
