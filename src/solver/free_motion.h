// Where a body goes in a step if nothing touches it: forces, damping, drag, and the exact torque-free turn.
#pragma once
#include <span>

#include "solver/step_context.h"

namespace brickfall {

// Over `dt` s: applies damping and drag to the bodies' velocities and predicts their free motion under the step's
// forces, with the exact turn. For bodies with contacts the solve sees at most kLargestTurn of the turn, since arms are
// frozen during a step; their momentum stays. A torque is not cut: ties bear all of it. Nor is the turn of what is held
// (FreeMotion::held). Each body's result is its own, whatever the others in the list. What `swings` starts late
// (joint/swings.h).
void predictFreeMotions(StepContext& context, BodySet& bodies, std::span<const BodyIndex> list, double dt,
                        bool hasContacts, bool swings = false);
inline void predictFreeMotion(StepContext& context, BodySet& bodies, BodyIndex body, double dt, bool hasContacts) {
  predictFreeMotions(context, bodies, {&body, 1}, dt, hasContacts);
}

// Leaves the body a share of its free turn, on the way that the whole turn takes: its energy and momentum stay as they
// are. Returns that share, as a rotation vector.
Vec3 shortenFreeTurn(StepContext& context, BodyIndex body, double share);

// The part of the turn th (world axes) that moves the body's surface elsewhere: the part about an axis of symmetry does
// not.
Vec3 visibleTurn(const BodyMass& mass, const Mat3& orientation, Vec3 th);

}  // namespace brickfall
