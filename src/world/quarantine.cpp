#include "world/quarantine.h"

#include <algorithm>

#include "brickfall/limits.h"

namespace brickfall {

void Quarantine::hold(BodyIndex body) {
  BodyMotion& m = registry_.bodies.motion[body];
  m.linearVelocity = m.angularVelocity = {};
  registry_.bodies.data[body].quarantined = true;
  report_.quarantined.push_back(registry_.idOf(body));
  caught_.push_back(body);
}

void Quarantine::isolateHeld() {
  for (BodyIndex body : caught_) upkeep_.isolate(body);
  caught_.clear();
}

void quarantineAbsurd(const Registry& registry, const Activity& activity, double dt, Quarantine quarantine) {
  const BodySet& bodies = registry.bodies;
  for (BodyIndex body : activity.awake) {
    if (bodies.still[body]) continue;
    const BodyMotion& m = bodies.motion[body];
    const BodyData& data = bodies.data[body];
    Vec3 velocity = m.linearVelocity + bodies.freeWay(body, data.force) * (bodies.mass[body].invMass * dt);
    Vec3 spin = m.angularVelocity;
    if (!(data.torque == Vec3{})) spin += bodies.worldInvInertia(body) * data.torque * dt;
    // A grain of a millimetre that is hit may well spin at a million rad/s: the grain is lost only if its surface is
    // too fast.
    const double turning = length(spin) * std::min(1.0, bodies.mass[body].outerRadius);
    bool fine = length(velocity) < lost::kSpeed && turning < lost::kSpeed;  // false for NaN
    if (!fine) quarantine.hold(body);
  }
  quarantine.isolateHeld();
}

}  // namespace brickfall
