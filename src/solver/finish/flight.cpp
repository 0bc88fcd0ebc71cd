#include "solver/finish/flight.h"

#include "solver/support.h"

namespace brickfall {

void correctFlight(Island& island, StepContext& context) {
  if (island.resting()) {
    for (BodyIndex body : island.bodies) context.solved[body].flying = false;
    return;
  }
  Vec3 correction = context.gravity * (-0.5 * island.dt * island.dt);
  std::pmr::vector<char> supported(island.memory), near(island.memory);
  findSupported(island, supported, [&](const auto& kind, std::size_t k) { return kind.carriesForce(k, context); });
  near = supported;  // what carries force meets
  growSupported(island, near, [&](const auto& kind, std::size_t k) {
    return kind.meetsWithin(k, toFloat(correction), island.motion.data(), context);
  });
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    SolvedMotion& s = context.solved[island.bodies[i]];
    s.flying = !supported[i];
    if (near[i]) continue;
    s.d += correction * context.bodies->data[island.bodies[i]].gravityScale;
    s.lag = 0;
  }
}

}  // namespace brickfall
