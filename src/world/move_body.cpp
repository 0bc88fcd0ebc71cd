#include "world/move_body.h"

#include <cmath>

#include "brickfall/limits.h"
#include "solver/finish/motion.h"

namespace brickfall {

namespace {

// Finite, and not lost in space.
bool isSane(const BodyMotion& m) {
  return isFinite(m.position) && isFinite(m.rotation) && isFinite(m.linearVelocity) && isFinite(m.angularVelocity) &&
         std::fabs(m.position.x) < lost::kDistance && std::fabs(m.position.y) < lost::kDistance &&
         std::fabs(m.position.z) < lost::kDistance;
}

}  // namespace

bool moveBody(BodyIndex body, BodySet& bodies, const StepContext& context) {
  const SolvedMotion& s = context.solved[body];
  BodyMotion& m = bodies.motion[body];
  BodyMotion next = m;
  next.position = m.position + s.d;
  next.rotation = rotationAtEnd(body, context);
  next.linearVelocity = s.velocity;
  next.orientation = toMatrix(next.rotation);
  // Angular momentum carries over exactly; the spin follows from the new orientation.
  next.angularVelocity = bodies.spinAt(body, next.orientation, s.angularMomentum);
  if (!isSane(next)) return false;
  m = next;
  bodies.data[body].steady = s.steady;
  bodies.data[body].impactLoss = s.impactLoss;
  return true;
}

}  // namespace brickfall
