// Adds a row's action to the residuals of its bodies.
#pragma once
#include "solver/reaction.h"
#include "solver/solve_body.h"

namespace brickfall {

// Adds a row's force and torque on B, about its centre, to the residuals of those of its ends that are the island's
// own.
BRICKFALL_LANES void addTo(Wrench* residual, std::uint32_t bodies, RowEnds ends, Arms arms, wide::V force,
                           wide::V torque) {
  if (ends.a < bodies) {
    Wrench& r = residual[ends.a];
    wide::store(wide::load(&r.force.x) - force, &r.force.x);
    wide::store(wide::load(&r.torque.x) - (wide::cross3(arms.a, force) + torque), &r.torque.x);
  }
  if (ends.b < bodies) {
    Wrench& r = residual[ends.b];
    wide::store(wide::load(&r.force.x) + force, &r.force.x);
    wide::store(wide::load(&r.torque.x) + (wide::cross3(arms.b, force) + torque), &r.torque.x);
  }
}

}  // namespace brickfall
