// The types of joints: each is a list of equations, written from the poses of its bodies at the start of a step. A new
// type is a function here.
#pragma once
#include <limits>

#include "dynamics/joint.h"

namespace brickfall {

// How an equation answers.
enum class JointLaw : std::uint8_t {
  none,
  hard,     // holds what it measures at 0: firm, with a multiplier
  atMost,   // the same, from one side: pulls back what is above 0 ...
  atLeast,  // ... pushes back what is below 0
  motor,    // reaches a speed, with no more than its strength
  spring,   // pulls what it measures to 0 with its stiffness and damping, with no more than its strength
  across  // the stiffness that the force along a line has by its direction, against a change of the way; of a cone, too
};

struct JointEquation {
  JointLaw law = JointLaw::none;
  double error = 0;                                       // m or rad: what it measures
  double speed = 0;                                       // m/s or rad/s, of a motor
  double room = std::numeric_limits<double>::infinity();  // m or rad: to a limit's other bound
};

// Along or about three axes, and the first once more.
struct EquationSet {
  Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};  // unit, world
  JointEquation of[kJointLanes];
};
// m or rad: how far a joint is from what it holds.
double errorOf(const EquationSet& set);

// What the arcs of turns add to a joint's ways.
enum class JointArcs : std::uint32_t {
  none,
  points,  // held at one place: ends of arms
  line,    // held at a distance: along the line
  slide,   // held to a line that turns with A
};

struct JointSystem {
  EquationSet way, turn;
  JointArcs arcs = JointArcs::none;
  // Of the way from the anchor of A to that of B: where its forces act on each. Each at its own anchor, or a force
  // beside a gaping of micrometres spins a thin rod about its axis.
  double onA = 0, onB = 1;
  double position = 0;  // JointState::position
  double span = 0;      // m: of a line between two points; rad: of a cone
};

// `turning` is the turn of B against A that is expected, rad: a cone lies where it leads to.
JointSystem equationsOf(const Joint& joint, const JointPose& pose, Vec3 turning = {});

}  // namespace brickfall
