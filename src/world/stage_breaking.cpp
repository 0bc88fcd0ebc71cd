// Ties break: mortar whose energy is spent, and joints that bore too much.
//
// A blow on a joint is told as its mean over the step. So what a joint bore is judged over the same time whatever the
// step: its mean over kReferenceStep, or the step if that is longer.
#include <algorithm>

#include "solver/mortar/law.h"
#include "world/diary.h"
#include "world/load_shift.h"
#include "world/registry.h"
#include "world/stage_hash.h"
#include "world/stages.h"
#include "world/upkeep.h"

namespace brickfall {

namespace {

// True if the joint breaks.
bool bear(Joint& joint, double dt) {
  const double share = std::min(1.0, dt / kReferenceStep);
  joint.meanForce += (length(joint.force + joint.earlierForce) - joint.meanForce) * share;
  joint.meanTorque += (length(joint.torque + joint.earlierTorque) - joint.meanTorque) * share;
  return joint.meanForce > joint.breakForce || joint.meanTorque > joint.breakTorque;
}

void tellBreak(JointIndex index, const Ties& ties, const Registry& registry, std::vector<BreakEvent>& out) {
  const Joint& joint = ties.joints.slots[index];
  const JointPose pose(joint, registry.bodies);
  out.push_back({{index + 1, joint.generation, registry.worldNumber},
                 registry.idOf(joint.bodyA),
                 registry.idOf(joint.bodyB),
                 pose.pointA + pose.way * 0.5,
                 joint.force + joint.earlierForce,
                 joint.torque + joint.earlierTorque});
}

void breakJoints(const Registry& registry, double dt, Ties& ties, Diary& diary, Upkeep upkeep) {
  if (!ties.joints.any()) return;
  std::vector<JointIndex> broken;
  ties.joints.eachAwake([&](const Link& link) {
    if (bear(ties.joints.slots[link.index], dt)) broken.push_back(link.index);
  });
  for (JointIndex joint : broken) {
    tellBreak(joint, ties, registry, diary.events.breaks);
    upkeep.unjoin(joint);
  }
}

void crumbleMortar(const Registry& registry, double time, const StepContext& context, const Activity& activity,
                   Ties& ties, Diary& diary, Upkeep upkeep) {
  std::vector<MortarIndex> broken;
  auto tell = [&](MortarIndex index, bool breaks) {
    const Mortar& m = ties.mortar.slots[index];
    diary.events.mortar.push_back({{index + 1, m.generation, registry.worldNumber},
                                   registry.idOf(m.bodyA),
                                   registry.idOf(m.bodyB),
                                   MortarPose(m, registry.bodies).centre,
                                   modeOf(m),
                                   workOn(m),
                                   breaks});
  };
  noteOpenings(time, context, activity, ties);
  ties.mortar.eachAwake([&](const Link& link) {
    Mortar& m = ties.mortar.slots[link.index];
    if (m.damage > 0 && !m.cracked) {
      m.cracked = true;
      tell(link.index, false);
    }
    if (m.ends) broken.push_back(link.index);
  });
  for (MortarIndex index : broken) {
    Mortar& m = ties.mortar.slots[index];
    if (!m.crushed) {
      tell(index, true);
      noteBreak(index, time, ties.mortar);
    }
    if (m.crushed || modeOf(m) != MortarMode::crushing)
      upkeep.crumble(index);
    else
      ties.mortar.crush(index);
  }
}

}  // namespace

void breakTies(const Registry& registry, const Clock& clock, const StepContext& context, const Activity& activity,
               Ties& ties, Diary& diary, Upkeep upkeep) {
  breakJoints(registry, context.dt, ties, diary, upkeep);
  if (ties.mortar.any()) crumbleMortar(registry, clock.time + clock.lastDt, context, activity, ties, diary, upkeep);
}

void hashBreaking(const Ties& ties, HashItems& out) {
  ties.joints.eachAwake(out.links(ties));
  ties.mortar.eachAwake(out.links(ties));
}

}  // namespace brickfall
