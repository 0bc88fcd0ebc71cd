#include "viewer_window/debug_layers.h"

#include <algorithm>
#include <cmath>

#include "viewer_window/outline.h"

namespace brickfall::viewer {
namespace {

constexpr std::uint32_t kMoving = 0x38E070, kSleeping = 0x5A8CE8, kFixed = 0xB8B8B8, kLost = 0xE040E0;
constexpr std::uint32_t kBounds = 0xF0C030, kPressing = 0xFF5030, kNear = 0x60D0FF, kFriction = 0xFFE060;
constexpr std::uint32_t kSpring = 0xFF40C0, kSelected = 0xFFFFFF;
constexpr double kNormalLength = 0.04;  // m, of a contact that does not press
constexpr double kLongestForce = 0.6;   // m

std::uint32_t colourOf(Activity activity) {
  switch (activity) {
    case Activity::asleep:
      return kSleeping;
    case Activity::fixed:
      return kFixed;
    case Activity::quarantined:
      return kLost;
    default:
      return kMoving;
  }
}

void addShape(Lines& lines, const ShapeDef& shape, const Transform& body, std::uint32_t colour) {
  const Transform pose = body * shape.local;
  const Vec3 x = rotate(pose.rotation, {1, 0, 0}), y = rotate(pose.rotation, {0, 1, 0}),
             z = rotate(pose.rotation, {0, 0, 1});
  const double r = shape.radius;
  switch (shape.type) {
    case ShapeType::box:
      lines.addBox(pose, shape.halfExtents, colour, 0.9f);
      break;
    case ShapeType::sphere:
      lines.addCircle(pose.position, x * r, y * r, colour);
      lines.addCircle(pose.position, y * r, z * r, colour);
      lines.addCircle(pose.position, z * r, x * r, colour);
      break;
    case ShapeType::capsule:
    case ShapeType::cylinder:
    case ShapeType::cone: {
      const Vec3 low = pose.position - y * shape.halfHeight, high = pose.position + y * shape.halfHeight;
      const double top = shape.type == ShapeType::cone ? shape.topRadius : r;
      lines.addCircle(low, x * r, z * r, colour);
      if (top > 0) lines.addCircle(high, x * top, z * top, colour);
      for (const Vec3 side : {x, z, -x, -z}) lines.add(low + side * r, high + side * top, colour);
      break;
    }
    case ShapeType::hull:
    case ShapeType::mesh:
      break;  // by their edges
    case ShapeType::plane:
      break;  // without end: it is what is seen as the ground
  }
}

// Forces differ by orders of magnitude: their length grows with the square root.
double lengthOf(double force, double unit) {
  return std::min(kLongestForce, kNormalLength + 0.12 * std::sqrt(force / unit));
}

void addContacts(Lines& lines, const Frame& frame) {
  double largest = 1;
  for (const FrameContact& contact : frame.contacts) largest = std::max(largest, double(contact.normalForce));
  const double unit = std::min(largest, 200.0);
  for (const FrameContact& contact : frame.contacts) {
    const bool presses = contact.normalForce > 0;
    const double reach = presses ? lengthOf(contact.normalForce, unit) : kNormalLength;
    const std::uint32_t colour = presses ? kPressing : kNear;
    lines.add(contact.point, contact.point + contact.normal * reach, colour, presses ? 1.0f : 0.7f);
    const double cross = 0.006;
    lines.add(contact.point - Vec3{cross, 0, 0}, contact.point + Vec3{cross, 0, 0}, colour);
    lines.add(contact.point - Vec3{0, 0, cross}, contact.point + Vec3{0, 0, cross}, colour);
    const double friction = length(contact.frictionForce);
    if (friction > 1e-3) {
      lines.add(contact.point, contact.point + contact.frictionForce * (lengthOf(friction, unit) / friction),
                kFriction);
    }
  }
}

}  // namespace

const std::vector<std::pair<Vec3, Vec3>>& DebugLayers::edgesOf(const ListedBody& body, std::size_t shape) {
  const auto [known, isNew] = edges_.try_emplace({body.serial, shape});
  if (!isNew) return known->second;
  if (const Result<ShapeMesh> mesh = makeShapeMesh(body.shapes[shape]); mesh) known->second = outlineOf(*mesh);
  return known->second;
}

void DebugLayers::addShapes(Lines& lines, const ListedBody& body, const Transform& pose, std::uint32_t colour) {
  for (std::size_t i = 0; i < body.shapes.size(); i++) {
    const ShapeDef& shape = body.shapes[i];
    addShape(lines, shape, pose, colour);
    if (shape.type != ShapeType::hull && shape.type != ShapeType::mesh) continue;
    const Transform place = pose * shape.local;
    for (const auto& [from, to] : edgesOf(body, i))
      lines.add(transformPoint(place, from), transformPoint(place, to), colour, 0.9f);
  }
}

void DebugLayers::addLayers(Lines& lines, const Frame& frame, double blend, const ViewOptions& options) {
  if (frame.info != run_) edges_.clear();
  run_ = frame.info;
  if (options.colliders) {
    for (std::size_t i = 0; i < frame.bodies.size(); i++) {
      const FrameBody& body = frame.bodies[i];
      addShapes(lines, frame.list->bodies[i], poseAt(body, blend), colourOf(body.activity));
    }
  }
  if (options.bounds) {
    for (std::size_t i = 0; i < std::min(frame.bounds.size(), kMostBounds); i++) {
      const Aabb& box = frame.bounds[i].box;
      if (box.upper.x - box.lower.x < 1e4 && box.upper.z - box.lower.z < 1e4) lines.addBox(box, kBounds, 0.55f);
    }
  }
  if (options.contacts) addContacts(lines, frame);
}

void DebugLayers::addHands(Lines& lines, const Frame& frame, double blend, Serial selected) {
  if (frame.drag) {
    lines.add(frame.drag->grabbed, frame.drag->target, kSpring);
    lines.addBox(grown({frame.drag->target, frame.drag->target}, 0.015), kSpring);
  }
  const int place = selected != 0 ? frame.list->find(selected) : -1;
  if (place < 0) return;
  addShapes(lines, frame.list->bodies[std::size_t(place)], poseAt(frame.bodies[std::size_t(place)], blend), kSelected);
}

}  // namespace brickfall::viewer
