#include "solver/joint/rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/point_matcher.h"
#include "math/wide_pair.h"
#include "solver/island.h"
#include "solver/joint/arcs.h"
#include "solver/joint/spins.h"
#include "solver/joint/springs.h"

namespace brickfall {

//! of a body's inertia / dt^2 | too small: swings lose energy | too large: chains under a great load fly apart
constexpr double kSlow = 0.5;  // a force whose geometric stiffness is less turns slowly enough for the step by itself

Mat3 bending(Vec3 arm, Vec3 force, double resist) {
  const double size = length(arm), turning = std::fabs(dot(arm, force));
  if (!(turning > 0)) return Mat3{} * 0.0;
  const Vec3 along = arm * (1 / size);
  const double stiffness = turning * turning / (turning + kSlow * resist);
  Mat3 out;
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++)
      out.row[i][j] = stiffness * ((i == j ? 1 : 0) - (1 - kLastBit / kTrifle) * along[i] * along[j]);
  return out;
}

namespace {

//! not of the method: the rule of the trapezoid (springs.h)
constexpr double kSpringShare = 0.25;  // of a spring's stiffness, that the solve knows, of the second difference
//! of the force | too small: cost | too large: joints stretch
constexpr float kFollowed = 1e-3f;  // a smaller change of a multiplier is left

//! of the time | too small: errors of long steps are blows in short ones | too large: they stay for long
constexpr double kForgets = 0.8;  // of Joint::over, a step

//! of the force | too small: in a snap, the stiffness of forces is gone before they are
//! | too large: swings lose energy, since that stiffness comes late
constexpr float kFallsTo = 0.5f;  // geometric stiffness follows a force that falls no further within a solve

//! of the time step of reference, at the island's scale | too small: what a snap took comes back in short steps
//! | too large: short pendulums lose amplitude
constexpr double kSteadyStep = 0.5;  // in shorter steps a turn that goes on may change by less, as the square

//! of a body's outer radius, or rad | too small: winches lag behind
//! | too large: a length that is changed at once is a blow
constexpr double kWinds = 0.25;  // so much of an error is looked at where a length or a limit was changed from outside

//! rad | too small: fast pendulums are braked | too large: light links tear the joints of a chain
constexpr double kFarTurn = 0.3;  // of B against A, in a step: further turns are braked
//! of the arm's inertia / dt^2 | too small: as too large a kFarTurn | too large: links move as one
constexpr double kBrake = 10;

//! not of the method: more than any force
constexpr float kNoLimit = 1e30f;  // N, N m

void addBending(SolveMass& mass, Vec3 arm, Vec3 force, double resist, double sign) {
  const Mat3 more = bending(arm, force, resist) * sign;
  for (int row = 0, at = 0; row < 3; row++)
    for (int column = 0; column <= row; column++, at++) mass.inertia[at] += float(more.row[row][column]);
}

struct Firmness {
  double hard = 0;   // N/m or N m/rad
  double inert = 0;  // N/m: the inertia of both ends along the way / dt^2
  double dt = 0;
  double correct = 0;  // of an old error
  double most = 0;     // m or rad: no more of it is looked at
  double acts = 1;     // of a motor's strength
};

// N/m: what the solve knows of a spring, of the second difference of its stretch.
double knownOf(const Joint& spring, double inert) {
  return kSpringShare * spring.stiffness * resolvedPart(spring.stiffness, inert);
}

bool isLimit(JointLaw law) { return law == JointLaw::atMost || law == JointLaw::atLeast; }
bool isHard(JointLaw law) { return law == JointLaw::hard || isLimit(law); }

// One equation from its law.
void write(const Joint& joint, const JointEquation& from, const Firmness& firm, double before, float held, int lane,
           JointEquations& out) {
  out.least[lane] = -kNoLimit;
  out.most[lane] = kNoLimit;
  out.k[lane] = float(firm.hard);
  out.other[lane] = 0;
  if (isLimit(from.law) && from.room < kNoLimit)
    out.other[lane] =
        std::copysign(std::min(out.k[lane] * float(from.room), kNoLimit), from.law == JointLaw::atMost ? 1.0f : -1.0f);
  auto place = [&](double share) {
    const double error = share < 1 ? std::clamp(from.error, -firm.most, firm.most) : from.error;
    return held - float(firm.hard * share * error);
  };
  switch (from.law) {
    case JointLaw::none:
    case JointLaw::across:
      out.k[lane] = out.trial[lane] = out.least[lane] = out.most[lane] = 0;
      return;
    case JointLaw::hard:
      out.trial[lane] = place(firm.correct);
      return;
    case JointLaw::atMost:
      out.trial[lane] = place(from.error > 0 ? firm.correct : 1);
      out.most[lane] = 0;
      return;
    case JointLaw::atLeast:
      out.trial[lane] = place(from.error < 0 ? firm.correct : 1);
      out.least[lane] = 0;
      return;
    case JointLaw::motor:
      out.trial[lane] = held + float(firm.hard * from.speed * firm.dt);
      out.most[lane] = float(firm.acts * joint.strength);
      out.least[lane] = -out.most[lane];
      return;
    case JointLaw::spring: {
      const double follows = knownOf(joint, firm.inert), ends = joint.stiffness - follows / kSpringShare;
      out.k[lane] = float(follows + ends + joint.damping / firm.dt);
      out.trial[lane] = float(follows * before - joint.stiffness * from.error);
      if (joint.type == JointType::drag) {
        out.most[lane] = float(joint.strength);
        out.least[lane] = -out.most[lane];
      }
      return;
    }
  }
}

// The other bound of a limit.
JointEquation otherBound(const JointEquation& e) {
  const bool most = e.law == JointLaw::atMost;
  return {most ? JointLaw::atLeast : JointLaw::atMost, e.error + (most ? e.room : -e.room), 0, e.room};
}
// The bound that is nearer where this way ends.
JointEquation boundAhead(const JointEquation& e, double way) {
  const bool other = isLimit(e.law) && (e.law == JointLaw::atMost ? -1 : 1) * (e.error + way) - 0.5 * e.room > 0;
  return other ? otherBound(e) : e;
}
float heldBy(JointLaw law, double force) {
  return float(law == JointLaw::atMost    ? std::min(force, 0.0)
               : law == JointLaw::atLeast ? std::max(force, 0.0)
                                          : force);
}

}  // namespace

RowGrip JointRows::grip(std::size_t k, const StepContext& context) const {
  Vec3 force = at(k, *context.ties).force;
  if (!ties(k, context)) return {};
  if (force == Vec3{}) force = {0, 1e-30, 0};
  return {force, double(kNoLimit)};
}

// Puts the geometric stiffness of this force into the masses, in the place of that which is there. The torque of a cone
// turns with both bodies: half with each.
void JointRows::bend(std::size_t k, Vec3f force, Vec3f torque) {
  if (asOne_) return;  // no turn but that of all, which needs none
  JointStart& start = starts[k];
  const JointRecord& r = records[k];
  if (!start.coned) torque = {};
  auto change = [&](Vec3f f, Vec3f t, double share) {
    for (int end = 0; end < 2; end++) {
      if (start.resist[end] == 0) continue;
      SolveMass& mass = (*masses_)[end == 0 ? r.bodyA : r.bodyB];
      const Vec3 arm = toDouble(end == 0 ? start.anchorA : start.anchorB);
      if (f != Vec3f{}) addBending(mass, arm, toDouble(end == 0 ? -f : f), double(start.resist[end]), share);
      if (t == Vec3f{}) continue;
      const double own = double(start.resist[end] - start.swung[end]);
      addBending(mass, normalized(toDouble(t)), toDouble(t) * 0.5, own, share);
    }
  };
  change(start.bent, start.twisted, -1);
  change(force, torque, 1);
  start.bent = force;
  start.twisted = torque;
}

float JointRows::alongLine(std::size_t k, const joint::Forces& f) const {
  return starts[k].coned ? f.turn[1] : f.way[0];
}

// A line turns with its ends, and its force with it: that resists a way across as the arms of a joint resist a turn. Of
// pressure as of tension, likewise. A cone is a line of turns, as long as its angle.
void JointRows::turnLine(std::size_t k, float force) {
  JointStart& start = starts[k];
  start.turned = force;
  const int first = start.coned ? kJointLanes : 0;
  JointEquations& e = start.coned ? records[k].turn : records[k].way;
  const double span = std::max(double(start.span), kNoGap), turning = std::fabs(double(force)) / span,
               stiffness = turning > 0 ? turning * turning / (turning + kSlow * double(start.inert)) : 0;
  double way = 0;
  for (int i = 0; i < kJointLanes; i++) {
    const double before = double(start.before[first + i]);
    if (start.across >> (first + i) & 1) way += before * before;
  }
  const double far = std::clamp(std::sqrt(way) / (kFarTurn * span) - 1, 0.0, 1.0);
  for (int i = 0; i < kJointLanes; i++) {
    if (!(start.across >> (first + i) & 1)) continue;
    e.k[i] = float(stiffness);
    e.trial[i] = e.k[i] * start.before[first + i] * float(1 - far);
    e.least[i] = -kNoLimit;
    e.most[i] = kNoLimit;
  }
}

namespace {

// Arms are frozen in a step. Where they turn too far for that, friction takes from the turn: of a pendulum nothing, of
// links that are flung about what no step could follow. What turns about an axis through its centre, as a wheel does,
// swings no arm.
void brake(JointStart& start, Vec3 spin, double dt, JointEquations& turn) {
  double turned = length(spin) * dt, least = std::numeric_limits<double>::infinity();
  if (!(turned > kFarTurn)) return;
  auto look = [&](int end, Vec3f arm) {
    if (!(start.resist[end] > 0)) return;
    least = std::min(least, double(start.swung[end]));
    turned = std::min(turned, length(cross(spin, normalized(toDouble(arm)))) * dt);
  };
  look(0, start.anchorA);
  look(1, start.anchorB);
  const double far = turned / kFarTurn - 1;
  if (!(far > 0)) return;
  for (int i = 0; i < 3; i++)
    if (turn.k[i] == 0 && turn.most[i] == 0 && turn.least[i] == 0) {
      turn.k[i] = float(std::min(far, 1.0) * kBrake * least);
      turn.most[i] = kNoLimit;
      turn.least[i] = -kNoLimit;
      start.across &= ~(1u << (kJointLanes + i));
    }
}

// Velocities of the last step's way: those of now are up to date where a body swings.
Vec3 before(const Island& island, std::uint32_t local, Vec3 now, Vec3 FreeMotion::*late, const StepContext& context) {
  return local < island.bodies.size() ? now - context.free[island.bodies[local]].*late : now;
}

// Of both ends against each other; 0: nothing moves that end.
float together(const float (&resist)[2]) {
  const float gives = (resist[0] > 0 ? 1 / resist[0] : 0) + (resist[1] > 0 ? 1 / resist[1] : 0);
  return gives > 0 ? 1 / gives : 0;
}

void measureArm(JointStart& start, int end, const Island& island, std::uint32_t local, BodyIndex body,
                const StepContext& context, Vec3 arm) {
  const BodySet& bodies = *context.bodies;
  const BodyMass& mass = bodies.mass[body];
  const double dt2 = island.dt * island.dt;
  start.swung[end] = float(mass.mass * lengthSquared(arm) / dt2);
  start.resist[end] = float((meanInertia(mass) + mass.mass * lengthSquared(arm)) / dt2);
  // What is fixed or kinematic turns as a whole.
  const bool own = local < island.bodies.size() && !context.free[body].asOne;
  start.symmetry[end] = own ? toFloat(bodies.motion[body].orientation * mass.symmetryAxis) : Vec3f{};
}

// In the first step of a swing what drives acts by half, as all does (solver/joint/swings.h).
double shareOfMotors(const Island& island, const JointRecord& r, const Joint& joint, const BodySet& bodies) {
  auto begins = [&](std::uint32_t local, BodyIndex body) {
    return local >= island.bodies.size() || bodies.data[body].steady.dt == 0;
  };
  const bool swings = joint.speed != 0 && island.plan.endVelocities && island.facts.grounded;
  return swings && begins(r.bodyA, joint.bodyA) && begins(r.bodyB, joint.bodyB) ? 0.5 : 1;
}

// In an island that turns as one, a joint is written where that takes it: what is left of errors turns with the bodies.
// It gives no torque by that, and its way has all arcs.
JointSystem systemOf(const Joint& joint, const JointPose& pose, Vec3 turning, const RigidWay& rigid,
                     const BodySet& bodies) {
  if (!rigid.turns()) return equationsOf(joint, pose, turning);
  auto placeOf = [&](BodyIndex body) {
    const BodyMotion& m = bodies.motion[body];
    const Quat rotation = normalized(quatFromRotationVector(rigid.turn) * m.rotation);
    return JointPlace{m.position + rigid.of(m.position), rotation, toMatrix(rotation), bodies.data[body].localCentre};
  };
  JointPose led(joint, placeOf(joint.bodyA), placeOf(joint.bodyB));
  led.spinsB = pose.spinsB;
  JointSystem system = equationsOf(joint, led, turning);
  system.onA = system.onB = 0.5;
  system.arcs = JointArcs::none;
  return system;
}

}  // namespace

void JointRows::prepare(Island& island, Ties& ties, const StepContext& context) {
  if (size() == 0) return;
  const BodySet& bodies = *context.bodies;
  masses_ = &island.masses;
  returned = held_ = 0;
  support = {};
  timePasses_ = true, asOne_ = island.rigid.turns();
  findLoads(island, context);
  for (std::size_t k = 0; k < size(); k++) {
    const Joint& joint = at(k, ties);
    JointRecord& r = records[k];
    JointStart& start = starts[k];
    const JointPose pose = withSpins({joint, bodies}, joint, bodies, island.dt);
    const BodyMotion &a = bodies.motion[joint.bodyA], &b = bodies.motion[joint.bodyB];
    const Vec3 spinA = before(island, r.bodyA, a.angularVelocity, &FreeMotion::lateSpin, context),
               spinB = before(island, r.bodyB, b.angularVelocity, &FreeMotion::lateSpin, context);
    const JointSystem system = systemOf(joint, pose, (spinB - spinA) * island.dt, island.rigid, bodies);
    const Vec3 armA = pose.armA + pose.way * system.onA, armB = pose.armB - pose.way * (1 - system.onB);
    r.armA = toFloat(armA);
    r.armB = toFloat(armB);
    start.anchorA = toFloat(pose.armA);
    start.anchorB = toFloat(pose.armB);
    measureArm(start, 0, island, r.bodyA, joint.bodyA, context, pose.armA);
    measureArm(start, 1, island, r.bodyB, joint.bodyB, context, pose.armB);
    start.bent = start.twisted = {};
    start.follows = start.hard = start.across = 0;
    const Vec3 speed = before(island, r.bodyB, b.linearVelocity, &FreeMotion::late, context) + cross(spinB, armB) -
                       before(island, r.bodyA, a.linearVelocity, &FreeMotion::late, context) - cross(spinA, armA);
    const double size = std::max(bodies.mass[joint.bodyA].outerRadius * (r.bodyA < island.bodies.size()),
                                 bodies.mass[joint.bodyB].outerRadius * (r.bodyB < island.bodies.size()));
    // A way that grew over a longer step is an arc of it: corrected at once, it would be a blow.
    const double part = island.dt / std::max(island.dt, joint.over), correct = double(kCorrect) * part * part;
    const bool arcs = island.plan.endVelocities;
    const double farthest = !arcs ? double(kNoLimit) : joint.wound > 0 ? kWinds : kSamePlace;
    start.correct = float(correct);
    const double firm = kFirmness * double(start.load) / (island.dt * island.dt);
    double gives = 0;
    if (r.bodyA < island.bodies.size()) gives += givenWay(bodies.mass[joint.bodyA], pose.armA);
    if (r.bodyB < island.bodies.size()) gives += givenWay(bodies.mass[joint.bodyB], pose.armB);
    const double inert = 1 / (gives * island.dt * island.dt);
    start.coned = system.turn.of[2].law == JointLaw::across;
    start.inert = start.coned ? together(start.resist) : float(inert);
    const double acts = shareOfMotors(island, r, joint, bodies);
    auto writeSet = [&](const EquationSet& set, const double(&held)[kJointLanes], Vec3 moves, double hard, int first,
                        JointEquations& out) {
      for (int i = 0; i < 3; i++) out.axes[i].unit = toFloat(set.axes[i]);
      for (int i = 0; i < kJointLanes; i++) {
        start.before[first + i] = float(dot(set.axes[i % 3], moves) * island.dt);
        const JointEquation e = boundAhead(set.of[i], double(start.before[first + i]));
        const JointLaw law = e.law;
        const bool follows = isHard(law) || law == JointLaw::motor;
        start.error[first + i] = float(e.error);
        start.room[first + i] = isLimit(law) && e.room < double(kNoLimit) ? float(e.room) : 0;
        start.held[first + i] = follows ? heldBy(law, held[i]) : 0;
        if (follows) start.follows |= 1u << (first + i);
        if (isHard(law)) start.hard |= 1u << (first + i);
        if (law == JointLaw::across) start.across |= 1u << (first + i);
        // What drives or rubs a turn need not be as firm.
        const double firmness = law == JointLaw::motor && first > 0 ? firm * size * size : hard;
        write(joint, e, {firmness, inert, island.dt, correct, farthest * (first == 0 ? size : 1.0), acts},
              double(start.before[first + i]), start.held[first + i], i, out);
      }
    };
    writeSet(system.way, joint.way, speed, firm, 0, r.way);
    const double firmTurn = kFirmness * double(start.turning) / (island.dt * island.dt);
    writeSet(system.turn, joint.turn, spinB - spinA, firmTurn * size * size, kJointLanes, r.turn);
    brake(start, spinB - spinA, island.dt, r.turn);
    bend(k, toFloat(joint.force), toFloat(joint.torque));
    start.span = float(system.span);
    if (start.across != 0) turnLine(k, float(start.coned ? joint.turn[1] : joint.way[0]));
    start.arc = {};
    start.arcs = arcs ? system.arcs : JointArcs::none;
    if (start.arcs == JointArcs::none) continue;
    if (joint.type == JointType::spring)
      r.way.trial[0] -= float(knownOf(joint, inert)) *
                        dot(r.way.axes[0].unit, arcAt(k, spinA * -island.dt, spinB * -island.dt, speed * -island.dt));
    start.arc = arcAt(k, spinA * island.dt, spinB * island.dt, speed * island.dt);
    joint::takeArc(start.arc, r.way);
  }
}

// Force and torque on B.
bool JointRows::follow(std::size_t k, const SolveMotion* motion, float slack) {
  JointRecord& r = records[k];
  JointStart& start = starts[k];
  const joint::Forces f = joint::forcesAt(r, motion);
  float by[2] = {}, all[2] = {};
  auto larger = [](float& most, float value) { most = std::max(most, value); };
  // What floats round of the ways of both ends is no change.
  const float turned = length(motion[r.bodyA].th) + length(motion[r.bodyB].th),
              gone = length(motion[r.bodyA].d) + length(motion[r.bodyB].d) +
                     length(motion[r.bodyA].th) * length(r.armA) + length(motion[r.bodyB].th) * length(r.armB);
  float rounds[2] = {};
  for (int i = 0; i < kJointLanes && slack > 0; i++) {
    if (start.follows >> i & 1) larger(rounds[0], float(kLastBit) * r.way.k[i] * gone);
    if (start.follows >> (i + kJointLanes) & 1) larger(rounds[1], float(kLastBit) * r.turn.k[i] * turned);
  }
  for (int i = 0; i < kJointLanes; i++) {
    if (start.follows >> i & 1) larger(by[0], std::fabs(f.way[i] - start.held[i]));
    if (start.follows >> (i + kJointLanes) & 1) larger(by[1], std::fabs(f.turn[i] - start.held[i + kJointLanes]));
    larger(all[0], std::fabs(f.way[i]));
    larger(all[1], std::fabs(f.turn[i]));
  }
  if (by[0] <= slack * all[0] + rounds[0] && by[1] <= slack * all[1] + rounds[1]) return false;
  for (int i = 0; i < kJointLanes; i++) {
    auto take = [&](int lane, float force, float& trial) {
      if (!(start.follows >> lane & 1)) return;
      trial += force - start.held[lane];
      start.held[lane] = force;
    };
    take(i, f.way[i], r.way.trial[i]);
    take(i + kJointLanes, f.turn[i], r.turn.trial[i]);
  }
  return true;
}

// m: what the arcs of turns and of a way add to the way of B against A. A line knows it along itself.
Vec3f JointRows::arcAt(std::size_t k, Vec3 turnA, Vec3 turnB, Vec3 way) const {
  const JointStart& start = starts[k];
  const ArmTurns turnsA = ArmTurns::of(turnA, start.symmetry[0]), turnsB = ArmTurns::of(turnB, start.symmetry[1]);
  const Vec3 arc = turnsB.arc(toDouble(start.anchorB)) - turnsA.arc(toDouble(start.anchorA));
  if (start.arcs == JointArcs::points) return toFloat(arc);
  if (start.arcs == JointArcs::slide) {
    const Vec3 between = (toDouble(records[k].armA) - toDouble(start.anchorA)) * 2.0;
    return toFloat(arcOfSlide(between, turnsA, turnA, turnB, way, arc));
  }
  const Vec3 along = toDouble(records[k].way.axes[0].unit);
  return toFloat(along * (dot(along, arc) + arcOfLine(std::max(double(start.span), kNoGap), along, way + arc)));
}

Vec3f JointRows::arcNow(std::size_t k, const SolveMotion* motion) const {
  const JointRecord& r = records[k];
  return arcAt(k, toDouble(motion[r.bodyA].th), toDouble(motion[r.bodyB].th),
               toDouble(wide::store3(joint::relativeMotion(r, motion).way)));
}

// True if the arcs have changed.
bool JointRows::followArcs(std::size_t k, const SolveMotion* motion, float slack) {
  JointRecord& r = records[k];
  JointStart& start = starts[k];
  if (start.arcs == JointArcs::none) return false;
  const Vec3f arc = arcNow(k, motion), by = arc - start.arc;
  float most = 0, force = 0;
  for (int i = 0; i < kJointLanes; i++) {
    most = std::max(most, std::fabs(r.way.k[i] * dot(r.way.axes[i % 3].unit, by)));
    force = std::max(force, std::fabs(start.held[i]));
  }
  if (!(most > slack * force)) return false;
  joint::takeArc(by, r.way);
  start.arc = arc;
  return true;
}

// A limit that its other bound holds is written for that: what is far from the bound is told by fewer digits. True if
// any changed.
bool JointRows::watchBounds(std::size_t k, const SolveMotion* motion) {
  JointRecord& r = records[k];
  JointStart& start = starts[k];
  const joint::Relative moved = joint::relativeMotion(r, motion);
  bool any = false;
  for (int i = 0; i < 2 * kJointLanes; i++) {
    if (!(start.room[i] > 0)) continue;
    const int lane = i % kJointLanes;
    JointEquations& e = i < kJointLanes ? r.way : r.turn;
    const bool most = e.most[lane] == 0;
    const float trial = joint::trialOf(e, i < kJointLanes ? moved.way : moved.turn)[lane];
    if (!(most ? trial > e.other[lane] : trial < e.other[lane])) continue;
    auto counts = [&](float error) { return (error > 0) == most && error != 0 ? start.correct * error : error; };
    const float error = start.error[i] + (most ? start.room[i] : -start.room[i]);
    e.trial[lane] += e.k[lane] * (counts(start.error[i]) - error) - start.held[i];
    start.held[i] = 0;
    start.error[i] = error;
    e.most[lane] = most ? kNoLimit : 0;
    e.least[lane] = most ? 0 : -kNoLimit;
    e.other[lane] = -e.other[lane];
    any = true;
  }
  return any;
}

bool JointRows::renewBounds(std::size_t k, const SolveMotion* motion, float, bool over) {
  if (!over) return false;
  const bool turned = watchBounds(k, motion), followed = follow(k, motion, kFollowed) || turned;
  if (!timePasses_) return followed;
  if (!followArcs(k, motion, kFollowed) && !followed) return false;
  const Reading now = joint::readingAt(records[k], motion);
  const Vec3f force = wide::store3(now.force);
  if (length(force) > kFallsTo * length(starts[k].bent)) bend(k, force, wide::store3(now.torque));
  if (starts[k].across != 0) {
    const float along = alongLine(k, joint::forcesAt(records[k], motion));
    if (std::fabs(along) > kFallsTo * std::fabs(starts[k].turned)) turnLine(k, along);
  }
  return true;
}

void JointRows::sumBoundary(const Boundary& b, BoundarySums& sums) const {
  for (std::uint32_t i = 0; i < b.count; i++) {
    const SidePair<wide::Halves> side(b, i, i);
    const JointRecord& r = records[b.sides[i] / 2 - b.firstRow];
    const bool onB = b.sides[i] & 1;
    const Reading now = joint::readingAt(r, b.motion);
    wide::V arm = wide::load3Padded(onB ? r.armB : r.armA);
    if (!b.single) arm = arm + (wide::load3Padded(b.masses[onB ? r.bodyB : r.bodyA].position) - b.centre);
    side.add({now.force, now.force}, {now.torque, now.torque}, {arm, arm}, sums);
    if (!sums.matrix) continue;
    const Stiffness s = joint::stiffnessAt(r, b.motion);
    StiffnessOf<wide::Halves> two;
    for (int n = 0; n < 3; n++) {
      two.A[n] = {s.A[n], s.A[n]};
      two.B[n] = {wide::V{}, wide::V{}};
      two.C[n] = {s.C[n], s.C[n]};
    }
    sums.matrix->add(two, wide::Halves(arm, arm), false);
  }
}

// Its turn goes on nearly as in the last step, a line's as well: by how much it may change, goes as the square of the
// step. What goes to and fro within some steps loses energy because it is not resolved: given back, it would tear light
// links apart.
bool JointRows::turnsSteadily(std::size_t k, const SolveMotion* motion, float most) const {
  const JointStart& start = starts[k];
  const joint::Relative moved = joint::relativeMotion(records[k], motion);
  const wide::V ways = joint::alongAxes(records[k].way, moved.way),
                turns = joint::alongAxes(records[k].turn, moved.turn);
  for (int i = 0; i < 3; i++) {
    if (!(std::fabs(turns[i] - start.before[i + kJointLanes]) <= most)) return false;
    if ((start.across >> i & 1) != 0 && !(std::fabs(ways[i] - start.before[i]) <= most * start.span)) return false;
  }
  return true;
}

// Springs and motors give; brakes take, and limits and ropes that did not act before.
void JointRows::watchEnergy(std::size_t k, const Joint& joint, const joint::Forces& f) {
  const JointRecord& r = records[k];
  for (int i = 0; i < kJointLanes; i++) {
    auto look = [&](int lane, const JointEquations& e, double before, float now) {
      if (now == 0 || (starts[k].across >> lane & 1) != 0) return;
      const bool hard = (starts[k].hard >> lane & 1) != 0, oneSided = e.least[i] == 0 || e.most[i] == 0;
      if (!hard && (e.trial[i] != 0 || (starts[k].follows >> lane & 1) != 0)) giveNone_ = false;
      if (!hard || (oneSided && before == 0)) keepEnergy_ = false;
    };
    look(i, r.way, joint.way[i], f.way[i]);
    look(i + kJointLanes, r.turn, joint.turn[i], f.turn[i]);
  }
  if (joint.wound > 0) giveNone_ = false;
  keepEnergy_ = keepEnergy_ && giveNone_ && steady_;
}

// J: what a motor gave, by the mean of its old and new speed: what flies has those of the middle of a step.
double JointRows::givenByMotor(std::size_t k, const SolveMotion* motion, const joint::Forces& f) const {
  const JointStart& start = starts[k];
  const std::uint32_t motors = start.follows & ~start.hard;
  if (motors == 0) return 0;
  const joint::Relative moved = joint::relativeMotion(records[k], motion);
  const wide::V ways = joint::alongAxes(records[k].way, moved.way),
                turns = joint::alongAxes(records[k].turn, moved.turn);
  double sum = 0;
  for (int i = 0; i < kJointLanes; i++) {
    if (motors >> i & 1) sum += 0.5 * double(f.way[i]) * (double(start.before[i]) + double(ways[i]));
    const int turn = i + kJointLanes;
    if (motors >> turn & 1) sum += 0.5 * double(f.turn[i]) * (double(start.before[turn]) + double(turns[i]));
  }
  return std::max(0.0, sum);
}

// An island that rests goes on with the forces that it has: what is left of errors would add up.
bool JointRows::store(Island& island, Ties& ties, StepContext&) {
  const bool changed = !island.resting();
  steady_ = changed;
  giveNone_ = keepEnergy_ = changed && island.plan.swings && island.facts.swung && island.facts.grounded;
  const double steps = std::min(1.0, island.dt / (kSteadyStep * kReferenceStep * island.facts.scale.time));
  for (std::size_t k = 0; k < size() && changed; k++) {
    Joint& joint = at(k, ties);
    const joint::Forces f = joint::forcesAt(records[k], island.motion.data());
    steady_ = steady_ && turnsSteadily(k, island.motion.data(), float(kTrifle * steps * steps));
    watchEnergy(k, joint, f);
    starts[k].driven = givenByMotor(k, island.motion.data(), f);
    for (int i = 0; i < kJointLanes; i++) {
      joint.way[i] = double(f.way[i]);
      joint.turn[i] = double(f.turn[i]);
    }
    joint.over = std::max(island.dt, kForgets * joint.over);
    joint.force = toDouble(wide::store3(joint::sumOf(records[k].way, f.way)));
    joint.torque = toDouble(wide::store3(joint::sumOf(records[k].turn, f.turn)));
  }
  return changed;
}

// Motors by their law, whatever the way; what holds places by what it took before. Springs: springs.h.
double JointRows::mostWork(std::size_t k) const {
  double sum = returned / double(size());
  for (int i = 0; i < 2 * kJointLanes; i++) {
    if ((starts[k].hard | ~starts[k].follows) >> i & 1) continue;
    const JointEquations& e = i < kJointLanes ? records[k].way : records[k].turn;
    const double stiffness = e.k[i % kJointLanes], trial = e.trial[i % kJointLanes];
    if (trial != 0) sum += stiffness > 0 ? trial * trial / (4 * stiffness) : std::numeric_limits<double>::infinity();
  }
  return sum;
}

void JointRows::tellShare(Ties& ties, float share) const {
  for (JointIndex index : tieOf) {
    Joint& joint = ties.joints.slots[index];
    joint.earlierForce += joint.force * double(share);
    joint.earlierTorque += joint.torque * double(share);
  }
}

// No time passes: places stay, and what takes time gives nothing.
void JointRows::startImpact(const Island&, const StepContext&, double) {
  timePasses_ = false;
  for (std::size_t k = 0; k < size(); k++) {
    bend(k, {}, {});
    JointRecord& r = records[k];
    JointStart& start = starts[k];
    for (int i = 0; i < 2 * kJointLanes; i++) {
      JointEquations& e = i < kJointLanes ? r.way : r.turn;
      const int lane = i % kJointLanes;
      // What is not hard, and limits that are not reached.
      const bool open = (e.most[lane] == 0 && e.trial[lane] > 0) || (e.least[lane] == 0 && e.trial[lane] < 0);
      if (!(start.hard >> i & 1) || open) e.k[lane] = 0;
      e.trial[lane] = e.other[lane] = start.held[i] = 0;
    }
  }
}

void JointRows::keepImpactForces(const Island& island) {
  for (std::size_t k = 0; k < size(); k++) follow(k, island.motion.data(), 0);
}

void JointRows::endImpact(const Island& island, Ties& ties, const StepContext& context, bool solved) {
  if (!solved) return;
  for (std::size_t k = 0; k < size(); k++) {
    Joint& joint = at(k, ties);
    const Reading f = joint::readingAt(records[k], island.motion.data());
    const double share = island.dt / context.dt;
    joint.earlierForce += toDouble(wide::store3(f.force)) * share;
    joint.earlierTorque += toDouble(wide::store3(f.torque)) * share;
  }
}

}  // namespace brickfall
