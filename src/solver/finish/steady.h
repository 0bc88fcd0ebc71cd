// Whether contacts go on as they are through a step: only then may motions be made of second order in the time step.
#pragma once
#include "solver/finish/motion.h"

namespace brickfall {

// m/s, along the normal: by how much the velocity of point i of a contact, of B against A, changes.
double changeAtPoint(const ContactRecord& row, int i, const VelocityChange& a, const VelocityChange& b);

// Point i neither lands nor leaves: it closes and parts by no more than small shocks do.
// `expected` (m/s): the change that the arc of a turning body makes.
bool isSteady(const ContactRecord& row, const ContactStart& start, int i, const VelocityChange& a,
              const VelocityChange& b, double dt, double expected = 0);

}  // namespace brickfall
