#include "world/move_body.h"

#include "solver/finish/motion.h"
#include "world/quarantine.h"

namespace brickfall {

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
