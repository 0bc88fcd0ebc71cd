// Reads all forces at the present motion and sums them into each body's residual. Solves nothing.
#include <algorithm>
#include <cmath>

#include "solver/contact_kernel.h"
#include "solver/island.h"

namespace brickfall {

namespace {

// A point that carried nothing in the last step has no frozen normal force to bound its friction by. It gets the present
// one, but no more than stops the approach and carries the pair's weight.
void updateNewLimits(ContactRecord& r, const Contact& c, const ContactStart& start, const kernel::PointForces& f,
                     double dt) {
  alignas(16) float fn[4];
  kernel::store(f.n, fn);
  for (int i = 0; i < c.count; i++) {
    if (!(r.newPoints >> i & 1)) continue;
    float stopping = c.effectiveMass * (std::max(0.0f, -start.approach[i]) + float(kReferenceGravity * dt)) / float(dt);
    r.limit[i] = c.friction * std::max(0.0f, std::min(fn[i], stopping));
  }
}

}  // namespace

void lightPass(Island& island, const ContactSet& contacts, bool updateLimits, double dt, double& visits) {
  std::size_t bodies = island.bodies.size();
  island.residual.resize(bodies);
  for (std::size_t i = 0; i < bodies; i++) island.residual[i] = inertiaResidual(island.masses[i], island.motion[i]);
  for (std::size_t k = 0; k < island.records.size(); k++) {
    ContactRecord& r = island.records[k];
    kernel::Frame frame = kernel::frame(r);
    kernel::PointMotion moved = kernel::pointMotion(r, frame, island.motion.data());
    kernel::PointForces f = kernel::pointForces(r, moved);
    if (updateLimits &&
        r.newPoints) {  // before forces are summed: the residual that is judged is that of the new bounds
      updateNewLimits(r, contacts.contacts[r.contact], island.starts[k], f, dt);
      f = kernel::pointForces(r, moved);
    }
    kernel::WideWrench w = kernel::wrench(r, frame, f);
    Vec3f force = wide::store3(w.force);
    if (r.bodyA < bodies) {
      island.residual[r.bodyA].force -= force;
      island.residual[r.bodyA].torque -= wide::store3(wide::cross3(frame.armA, w.force) + w.torque);
    }
    if (r.bodyB < bodies) {
      island.residual[r.bodyB].force += force;
      island.residual[r.bodyB].torque += wide::store3(wide::cross3(frame.armB, w.force) + w.torque);
    }
  }
  visits += 4.0 * double(island.records.size());
}

double worstResidual(const Island& island, const BodySet& bodies) {
  double worst = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    const BodyMass& m = bodies.mass[island.bodies[i]];
    double weight = m.mass * kReferenceGravity;
    double error = std::max(double(length(island.residual[i].force)) / weight,
                            double(length(island.residual[i].torque)) / (weight * m.innerRadius));
    if (!(error <= worst)) worst = error;  // also takes NaN
  }
  return worst;
}

double rmsResidual(const Island& island, const BodySet& bodies) {
  double sum = 0;
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    double error = double(length(island.residual[i].force)) / (bodies.mass[island.bodies[i]].mass * kReferenceGravity);
    sum += error * error;
  }
  return std::sqrt(sum / double(island.bodies.size()));
}

}  // namespace brickfall
