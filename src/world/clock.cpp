#include "world/clock.h"

#include <algorithm>

namespace brickfall {

namespace {

//! - | too small: nothing rests while time steps vary | too large: joints keep the stiffness of time steps long past
constexpr double kSameJoints = 2.2;  // factor between time steps within which joints stay as they are
//! - | too small: steps that spread widely change joints often | too large: the same, at once again
constexpr double kNewJoints = 2;  // factor to which they follow what is beyond
//! - | too small: pictures that take equally long by chance change all joints | too large: the same, of time steps that have changed
constexpr int kSteadySteps = 30;  // of one length: then joints get the stiffness of that

}  // namespace

bool Clock::beginSubstep(double dt) {
  const double lastJointDt = jointDt;
  const bool same = dt == lastDt;
  steadySteps = same ? std::min(steadySteps, kSteadySteps - 1) + 1 : 0;
  if (jointDt == 0 || steadySteps == kSteadySteps)
    jointDt = dt;
  else if (dt > kSameJoints * jointDt || jointDt > kSameJoints * dt)
    jointDt = std::clamp(jointDt, dt / kNewJoints, dt * kNewJoints);
  lastDt = dt;
  return !same || jointDt != lastJointDt;
}

}  // namespace brickfall
