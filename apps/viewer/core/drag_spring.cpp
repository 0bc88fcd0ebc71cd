#include "viewer_core/drag_spring.h"

#include <algorithm>

namespace brickfall::viewer {

namespace {

constexpr double kRate = 14;                // 1/s, of the spring: slower feels like rubber, faster shakes what is held
constexpr double kTurnDamping = 4;          // 1/s: what hangs from the mouse stops swinging
constexpr double kReferenceGravity = 9.81;  // m/s2, of the limit

double trace(const Mat3& m) { return m.row[0].x + m.row[1].y + m.row[2].z; }
Mat3 crossMatrix(Vec3 v) { return {{{0, -v.z, v.y}, {v.z, 0, -v.x}, {-v.y, v.x, 0}}}; }

}  // namespace

Status checkDraggable(const World& world, BodyId body) {
  const Result<BodyState> state = world.state(body);
  if (!state) return Error{ErrorCode::staleId, "body: it is gone"};
  if (state->quarantined) return Error{ErrorCode::wrongState, "body: it is quarantined, remove it"};
  if (state->type != BodyType::dynamic) return Error{ErrorCode::wrongState, "body: it is fixed, no force moves it"};
  return {};
}

Vec3 heldPoint(const World& world, const DragSpring& spring) {
  const Result<BodyState> state = world.state(spring.body);
  return state ? transformPoint(Transform{state->position, state->rotation}, spring.local) : spring.target;
}

// The acceleration of the held point is that of a critically damped spring at the end of the step (implicit: stable for any dt),
// x'' = w^2 (target - x) - 2 w x'. The force for it follows from the point's inverse mass, K = 1/m + [r]^T I^-1 [r], which is many
// times that of the body where it is held by a corner.
Status pull(World& world, DragSpring& spring, double dt) {
  if (Status fine = checkDraggable(world, spring.body); !fine) return fine;
  const BodyState s = *world.state(spring.body);
  const Mat3 turn = toMatrix(s.rotation);
  const Mat3 inertia = turn * world.massProperties(spring.body)->inertia * transpose(turn);
  const Vec3 point = heldPoint(world, spring), arm = point - s.centreOfMass;
  const Vec3 speed = s.linearVelocity + cross(s.angularVelocity, arm);
  const Vec3 wanted = ((spring.target - point - speed * dt) * (kRate * kRate) - speed * (2 * kRate)) *
                      (1 / (1 + 2 * kRate * dt + kRate * kRate * dt * dt));
  const Mat3 across = crossMatrix(arm);
  const double lightness = 1 / s.mass;
  const Mat3 response = diagonal(Vec3{lightness, lightness, lightness}) + transpose(across) * inverse(inertia) * across;
  // Damps turns about the held point, about which it swings; what that does to the point the force makes good.
  const double spread = s.mass * dot(arm, arm);
  const Vec3 swing =
      inertia * s.angularVelocity + s.angularVelocity * spread - arm * (s.mass * dot(arm, s.angularVelocity));
  const double heavier = 1 + 2 * spread / trace(inertia);
  const Vec3 torque = swing * -(kTurnDamping / (1 + kTurnDamping * heavier * dt));
  Vec3 force = inverse(response) * (wanted - cross(inverse(inertia) * torque, arm));
  const double most = spring.strength * s.mass * kReferenceGravity;
  force *= std::min(1.0, most / std::max(length(force), 1e-300));
  spring.force = length(force);
  if (Status pushed = world.applyForceAtPoint(spring.body, force, point); !pushed) return pushed;
  return world.applyTorque(spring.body, torque);
}

}  // namespace brickfall::viewer
