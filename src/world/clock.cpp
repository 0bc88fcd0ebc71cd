#include "world/clock.h"

#include <algorithm>

namespace brickfall {

namespace {

//! - | too small: nothing rests while time steps vary | too large: contacts keep the stiffness of time steps long past
constexpr double kKeepStiffness = 2.2;  // factor between time steps within which contacts stay as they are
//! - | too small: steps that spread widely change contacts often
//! | too large: as kKeepStiffness at its least: the next step changes contacts again
constexpr double kFollowStiffness = 2;  // factor to which the stiffness step follows a step beyond kKeepStiffness
//! - | too small: a few pictures of equal length, by chance, change all contacts
//! | too large: contacts keep the stiffness of time steps long past
constexpr int kSteadySteps = 30;  // so many steps of one length: then contacts get the stiffness of that step

}  // namespace

bool Clock::beginSubstep(double dt) {
  const double lastStiffnessDt = stiffnessDt;
  const bool same = dt == lastDt;
  steadySteps = same ? std::min(steadySteps, kSteadySteps - 1) + 1 : 0;
  if (stiffnessDt == 0 || steadySteps == kSteadySteps)
    stiffnessDt = dt;
  else if (dt > kKeepStiffness * stiffnessDt || stiffnessDt > kKeepStiffness * dt)
    stiffnessDt = std::clamp(stiffnessDt, dt / kFollowStiffness, dt * kFollowStiffness);
  lastDt = dt;
  return !same || stiffnessDt != lastStiffnessDt;
}

}  // namespace brickfall
