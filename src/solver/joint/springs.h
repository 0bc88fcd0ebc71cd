// Springs and drags. A spring acts by the mean of its forces at both ends of a step (the rule of the trapezoid), half
// of it before the way and half behind: so it gives what it held before, less what it holds afterwards.
#pragma once
#include "solver/island.h"
#include "solver/joint/equations.h"

namespace brickfall {

// The part of a spring that swings slowly enough for the step. What is too fast acts by its force at the end, which
// damps it. inert: N/m, of both ends against each other / dt^2.
double resolvedPart(double stiffness, double inert);
// kg m2: about an axis through the centre, the mean of all.
double meanInertia(const BodyMass& mass);
// 1/kg: what a force at the end of its arm moves a body there.
double givenWay(const BodyMass& mass, Vec3 arm);

// N, on B: the force of a step, of which half is given once more where it ends. `speed`: of B against A there, m/s.
Vec3 springForce(const JointRows& joints, std::size_t k, const Joint& joint, const EquationSet& atEnd, Vec3 speed,
                 double dt);
// The change of velocities by the step before the first one, for bodies that begin to swing on springs.
void addSpringsBefore(const Island& island, const StepContext& context, std::span<const char> begins, BodySet& bodies);

// J: what the springs of a group held before the step, less what they hold afterwards. Velocities of what flies are
// those of the middle of a step: there is the place of its springs, too.
double releasedBySprings(const Island& island, std::uint32_t group, const StepContext& context);

}  // namespace brickfall
