// The face in which two bodies lie on each other: a face of one, cut to the sides of an opposite face of the other.
#include <algorithm>
#include <cmath>
#include <optional>

#include "narrowphase/hull_view.h"
#include "narrowphase/outline.h"
#include "world/checks.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

//! not of the method: what mortar.h says
constexpr std::size_t kMostOutline = 16;  // corners

Vec3 twiceArea(const Outline& outline) {
  Vec3 sum;
  for (int i = 2; i < outline.count; i++)
    sum += cross(outline.corner[i - 1].p - outline.corner[0].p, outline.corner[i].p - outline.corner[0].p);
  return sum;
}

double sizeOf(const Outline& outline) {
  double most = 0;
  for (int i = 1; i < outline.count; i++) most = std::max(most, length(outline.corner[i].p - outline.corner[0].p));
  return most;
}

// What a shape offers to lie on: its flat faces, in the world.
class FlatFaces {
 public:
  FlatFaces(const Shape& shape, const Transform& pose) : endless_(shape.type == ShapeType::plane) {
    flat_ = endless_ || shape.type == ShapeType::box || shape.type == ShapeType::hull;
    if (endless_) {
      ground_.normal = rotate(pose.rotation, Vec3{0, 1, 0});
      ground_.offset = dot(ground_.normal, pose.position);
    } else if (flat_) {
      view_ = viewOf(shape, pose, storage_);
    }
  }
  FlatFaces(const FlatFaces&) = delete;
  FlatFaces& operator=(const FlatFaces&) = delete;

  bool endless() const { return endless_; }
  int count() const { return !flat_ ? 0 : endless_ ? 1 : view_.faceCount; }
  const HullPlane& plane(int face) const { return endless_ ? ground_ : view_.planes[face]; }
  Outline outline(int face) const {
    Outline out;
    out.face = true;
    out.normal = view_.planes[face].normal;
    const int first = view_.firstEdge[face];
    int e = first;
    do {
      out.add(view_.vertices[view_.edges[e].origin], 0);
      e = view_.edges[e].next;
    } while (e != first);
    return out;
  }

 private:
  bool endless_, flat_ = false;
  HullPlane ground_;
  HullStorage storage_;
  HullView view_;
};

struct SharedOutline {
  std::vector<Vec3> corners;
  double area = 0;
};

// Of too many corners those go first that cut off least.
void keepMost(std::vector<Vec3>& corners) {
  while (corners.size() > kMostOutline) {
    std::size_t least = 0;
    double leastArea = 1e300;
    for (std::size_t i = 0; i < corners.size(); i++) {
      const Vec3 before = corners[(i + corners.size() - 1) % corners.size()], at = corners[i];
      const double area = length(cross(at - before, corners[(i + 1) % corners.size()] - at));
      if (area < leastArea) leastArea = area, least = i;
    }
    corners.erase(corners.begin() + std::ptrdiff_t(least));
  }
}

// The two faces look at each other. On A's plane first, then in the middle of the gap.
std::optional<SharedOutline> sharedOutline(const FlatFaces& a, int faceA, const FlatFaces& b, int faceB, double gap) {
  const bool ofB = a.endless();
  Outline cut = ofB ? b.outline(faceB) : a.outline(faceA);
  const double areaA = length(twiceArea(cut)), size = sizeOf(cut);
  double smaller = areaA;
  if (!a.endless() && !b.endless()) {
    const Outline other = b.outline(faceB);
    smaller = std::min(areaA, length(twiceArea(other)));
    cutToFace(cut, other, 0);
  }
  if (cut.count < 3) return std::nullopt;
  const Vec3 twice = twiceArea(cut);
  if (!(length(twice) > kFloatsRound * smaller)) return std::nullopt;
  const HullPlane& opposite = ofB ? a.plane(faceA) : b.plane(faceB);
  double apart = 0;
  for (int i = 0; i < cut.count; i++) apart += dot(opposite.normal, cut.corner[i].p) - opposite.offset;
  apart /= cut.count;
  if (!(std::fabs(apart) <= gap)) return std::nullopt;
  SharedOutline out;
  out.area = 0.5 * length(twice);
  for (int i = 0; i < cut.count; i++) {
    const Vec3 p = cut.corner[i].p - opposite.normal * (0.5 * apart);
    if (out.corners.empty() || length(p - out.corners.back()) > kFloatsRound * size) out.corners.push_back(p);
  }
  while (out.corners.size() > 1 && length(out.corners.front() - out.corners.back()) <= kFloatsRound * size)
    out.corners.pop_back();
  if (out.corners.size() < 3) return std::nullopt;
  keepMost(out.corners);
  // B's own corners run the other way round.
  if (ofB) std::reverse(out.corners.begin(), out.corners.end());
  return out;
}

}  // namespace

Result<std::vector<Vec3>> World::sharedFace(BodyId a, BodyId b, double gap) const {
  const Impl& w = *impl_;
  Checks check;
  check.range("gap", gap, 0, limits::kLargestSize);
  check.condition(a != b, "b: found the same body as a, expected another");
  if (check.failed()) return check.error();
  const Result<BodyIndex> bodyA = w.registry.find(a), bodyB = w.registry.find(b);
  if (!bodyA) return bodyA.error();
  if (!bodyB) return bodyB.error();
  SharedOutline best;
  for (ShapeIndex shapeA : w.registry.bodies.shapes[*bodyA]) {
    const FlatFaces facesA(w.registry.shapes.data[shapeA].geometry,
                           w.registry.shapes.worldPose(shapeA, w.registry.bodies));
    for (ShapeIndex shapeB : w.registry.bodies.shapes[*bodyB]) {
      const FlatFaces facesB(w.registry.shapes.data[shapeB].geometry,
                             w.registry.shapes.worldPose(shapeB, w.registry.bodies));
      if (facesA.endless() && facesB.endless()) continue;
      for (int i = 0; i < facesA.count(); i++)
        for (int k = 0; k < facesB.count(); k++) {
          // Faces of hulls are rounded as they are.
          if (!(dot(facesA.plane(i).normal, facesB.plane(k).normal) < kFloatsRound - 1)) continue;
          std::optional<SharedOutline> found = sharedOutline(facesA, i, facesB, k, gap);
          if (found && found->area > best.area) best = std::move(*found);
        }
    }
  }
  return best.corners;
}

}  // namespace brickfall
