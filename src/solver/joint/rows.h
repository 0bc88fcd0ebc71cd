// Joints as rows of an island's solve.
//
// A hard equation is as firm as a hundred of the heaviest bodies that hang together by it, whatever it ties itself: a
// chain of light links must hold a heavy ball. Its multiplier is the whole force of the last step, and follows the
// force within the solve (Uzawa): then stiffness is no physics, it only says how many rounds that takes.
//
// Arms are frozen in a step, which makes the solve a leapfrog: no loss, but it is explicit in the direction of forces,
// and flies apart where light bodies turn under large ones. So the stiffness that forces have by their direction
// (geometric stiffness) goes into the solve, against the change of each body's turn from step to step: that is a
// matrix beside the body's inertia. It is stable at any step; where steps are short enough to do without, it fades.
//
// The end of an arm goes along an arc: by the frozen arm alone, a joint gapes by a second order of the turn, which the
// next steps correct. So the solve knows the arc.
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "solver/boundary.h"
#include "solver/joint/equations.h"
#include "solver/joint/record.h"
#include "solver/lasting_rows.h"
#include "solver/renewals.h"

namespace brickfall {

//! x the load that hangs by it | too small: more rounds until a heavy body is held; friction leaves gains
//! | too large: floats leave light bodies out of balance; quiet joints are braked with those that gained
constexpr double kFirmness = 100;  // in units of mass / dt^2: of a hard equation; and of the friction that takes gains,
                                   // x the inertia of a joint's lighter body

// N m: geometric stiffness of a force at the end of an arm that turns with a body, beside its inertia, about all that
// turns the arm. A turn about the arm moves no end of it: there a thin link has next to no inertia, and any part of
// the stiffness would spin it up. Of pressure as of tension, or what buckles would buckle at any speed. `resist`: the
// body's inertia about that end / dt^2.
Mat3 bending(Vec3 arm, Vec3 force, double resist);

// Facts of a joint at the start of a step that the record does not have.
struct JointStart {
  Vec3f anchorA, anchorB;              // m, from the centres of mass: where forces turn with the bodies
  Vec3f symmetry[2];                   // unit: axis about which each body turns first; 0: none
  Vec3f bent;                          // N, on B: the force whose geometric stiffness is in the masses
  Vec3f twisted;                       // N m, on B: the torque of a cone, likewise
  Vec3f arc;                           // m: what the arcs of both anchors add to the way of B against A; in `trial`
  float resist[2] = {};                // N m: inertia of each body about its anchor / dt^2; 0: nothing moves it
  float load = 0;                      // kg: of what hangs together by joints, and of what touches it
  float turning = 0;                   // kg: the same, of a turn that moves all that hangs by it
  float held[2 * kJointLanes] = {};    // N, N m: multiplier in `trial`, ways and then turns
  float before[2 * kJointLanes] = {};  // m, rad: way of the last step along each axis
  float error[2 * kJointLanes] = {};   // m, rad: of hard equations
  float room[2 * kJointLanes] = {};    // m, rad: of limits, from this bound to the other
  std::uint32_t follows = 0;           // bit per equation that has a multiplier
  float swung[2] = {};                 // N m: the part of `resist` that is the arm's
  JointArcs arcs = JointArcs::none;    // that the solve knows of
  std::uint32_t hard = 0;              // bit per equation that gives no energy: holds a place
  std::uint32_t across = 0;            // bit per equation across a line, or along the bound of a cone
  bool coned = false;                  // its torques turn with both bodies
  float span = 0;                      // m: of the line; rad: of the cone
  float turned = 0;                    // N, of its force, or N m: as in `bent`
  float inert = 0;    // N/m: inertia of both anchors against each other / dt^2; of a cone N m: of turns
  float correct = 0;  // share of an old error that the step corrects
  double driven = 0;  // J: what its motor gave in the step
};

struct JointRows : LastingRows<JointRows, JointSet, &Ties::joints> {
  explicit JointRows(std::pmr::memory_resource* memory) : LastingRows(memory), records(memory), starts(memory) {}
  std::pmr::vector<JointRecord> records;
  std::pmr::vector<JointStart> starts;
  BalanceChange support;  // what partners gave at the end of the step (velocities.h)
  double returned = 0;    // J: what all of them gave in this step, for rounding and as wound up (velocities.h)

  // --- functions of every kind of row (contact/rows.h)
  Vec3 armOf(std::size_t k, bool ofB, const StepContext&) const {
    return toDouble(ofB ? records[k].armB : records[k].armA);
  }
  static constexpr double kPoints = 2;
  static constexpr bool kLasts = true;
  static constexpr bool kYields = false;
  static constexpr bool kFirm = true;
  static constexpr std::size_t kRecordSize = sizeof(JointRecord) + sizeof(JointStart);
  float strength(std::size_t, const StepContext&) const { return 1e4f; }  // chains share clusters
  // A slack rope ties nothing.
  bool ties(std::size_t k, const StepContext& context) const {
    const Joint& joint = at(k, *context.ties);
    return joint.type != JointType::rope || joint.way[0] != 0;
  }
  bool turnsAsOne(std::size_t k, const Ties& ties) const {
    const JointType type = at(k, ties).type;
    return type == JointType::fixed || type == JointType::prismatic;
  }
  bool makesOne(std::size_t k, const Ties& ties) const { return at(k, ties).type == JointType::fixed; }
  RowGrip grip(std::size_t k, const StepContext& context) const;
  Vec3 normal(std::size_t k) const { return toDouble(records[k].way.axes[0].unit); }

  void prepare(Island& island, Ties& ties, const StepContext& context);
  void read(std::size_t k, std::size_t count, const SolveMotion* motion, Reading* out) const {
    for (std::size_t i = 0; i < count; i++) out[i] = joint::readingAt(records[k + i], motion);
  }
  void sumBoundary(const Boundary& boundary, BoundarySums& sums) const;
  Reaction react(std::size_t k, const SolveMotion* motion) const {
    const Reading now = joint::readingAt(records[k], motion);
    const Arms at = arms(k);
    return {now.force, now.torque, at.a, at.b};
  }
  void readStiff(const std::uint32_t* rows, std::size_t count, const SolveMotion* motion, Resist how,
                 StiffReaction* out) const {
    for (std::size_t i = 0; i < count; i++) out[i] = reactStiff(rows[i], motion, how);
  }
  StiffReaction reactStiff(std::size_t k, const SolveMotion* motion, Resist) const {
    return {react(k, motion), joint::stiffnessAt(records[k], motion)};
  }
  // In doubles from the start. Floats of so firm a matrix would round to less than nothing where a joint is free, and
  // the whole would have no factor.
  void writeStiffness(std::size_t k, const SolveMotion* motion, const StiffReaction&, BodyBlock& K) const {
    joint::writeStiffness(records[k], motion, K);
  }
  bool boundsFollow(std::size_t) const { return true; }
  // The forces found become multipliers; geometric stiffness grows with them.
  bool renewBounds(std::size_t k, const SolveMotion* motion, float slack, bool over);
  // J: of all places that are held, by how far they are off at the end of these motions, as firm as they are.
  double apart(const SolveMotion* motion) const;
  bool store(Island& island, Ties& ties, StepContext& context);
  void tellShare(Ties& ties, float share) const;
  double mostWork(std::size_t k) const;
  // `returned` is told with the first row.
  double returnedWork(std::size_t k) const { return starts[k].driven + (k == 0 ? returned : 0); }
  void advance(const Island&, Ties&, const StepContext&) const {}
  // There is a motor that turns. One that holds still rubs: it is a brake, and drives nothing.
  bool driven(const Ties& ties) const {
    return std::any_of(tieOf.begin(), tieOf.end(), [&](JointIndex index) {
      const Joint& joint = ties.joints.slots[index];
      return joint.driven && joint.speed != 0;
    });
  }
  // In this step, of bodies that swing on joints alone: nothing that can give energy acts.
  bool giveNone() const { return giveNone_; }
  // Nor anything that takes it, unless something snaps: all that acts holds places, as it did before.
  bool keepEnergy() const { return keepEnergy_; }
  // Whatever else acts, nothing goes to and fro within some steps, as in a snap.
  bool steady() const { return steady_; }
  void stopKeeping() { keepEnergy_ = false; }
  // J: of what a swing keeps, all that is no energy of the step's end (swings.cpp); then by how much that grew
  // (velocities.cpp).
  void hold(double energy) { held_ = energy; }
  double held() const { return held_; }

  // --- what the world asks of the rows of an island
  void hashRecord(Mix& h, std::size_t k, const Ties& ties) const;
  void checkRanges(Findings& f) const;
  template <class Visit> void eachResistance(Visit&&) const {}
  void startAfresh(Ties& ties) const;
  static double elasticEnergy(JointIndex joint, const StepContext& context);
  void addWork(const Island& island, const StepContext& context, TieWork& sum) const;

  // --- impacts at their moment (solver/impact.h). Joints hold velocities in them, not places.
  void startImpact(const Island& island, const StepContext& context, double blink);
  void keepImpactForces(const Island& island);
  void endImpact(const Island& island, Ties& ties, const StepContext& context, bool solved);

 private:
  void findLoads(const Island& island, const StepContext& context);
  void bend(std::size_t k, Vec3f force, Vec3f torque);
  void turnLine(std::size_t k, float force);
  float alongLine(std::size_t k, const joint::Forces& f) const;
  Vec3f arcAt(std::size_t k, Vec3 turnA, Vec3 turnB, Vec3 way) const;
  Vec3f arcNow(std::size_t k, const SolveMotion* motion) const;
  bool followArcs(std::size_t k, const SolveMotion* motion, float slack);
  bool follow(std::size_t k, const SolveMotion* motion, float slack);
  bool watchBounds(std::size_t k, const SolveMotion* motion);
  bool turnsSteadily(std::size_t k, const SolveMotion* motion, float most) const;
  void watchEnergy(std::size_t k, const Joint& joint, const joint::Forces& f);
  double givenByMotor(std::size_t k, const SolveMotion* motion, const joint::Forces& f) const;

  std::pmr::vector<SolveMass>* masses_ = nullptr;  // of the island, since prepare
  bool asOne_ = false;                             // the island turns as one: Island::rigid
  bool timePasses_ = true;                         // no impact is solved
  bool giveNone_ = false, keepEnergy_ = false, steady_ = false;
  double held_ = 0;
};

}  // namespace brickfall
