#include "viewer_core/frame.h"

#include <algorithm>

namespace brickfall::viewer {

int BodyList::find(Serial serial) const {
  const auto found = std::lower_bound(bodies.begin(), bodies.end(), serial,
                                      [](const ListedBody& body, Serial wanted) { return body.serial < wanted; });
  return found != bodies.end() && found->serial == serial ? int(found - bodies.begin()) : -1;
}

double blendAt(const Frame& frame, double now) {
  if (!(frame.shownFor > 0)) return 1;
  return std::clamp((now - frame.madeAt) / frame.shownFor, 0.0, 1.0);
}

// Between two frames a body turns little: the straight line between its rotations is as good as the arc.
Transform poseAt(const FrameBody& body, double blend) {
  if (blend >= 1) return body.pose;
  const Quat &a = body.before.rotation, &b = body.pose.rotation;
  const double along = a.x * b.x + a.y * b.y + a.z * b.z + a.w * b.w;
  const double from = 1 - blend, to = along < 0 ? -blend : blend;
  Transform pose;
  pose.position = body.before.position * from + body.pose.position * blend;
  pose.rotation = {a.x * from + b.x * to, a.y * from + b.y * to, a.z * from + b.z * to, a.w * from + b.w * to};
  pose.rotation = normalized(pose.rotation);
  return pose;
}

}  // namespace brickfall::viewer
