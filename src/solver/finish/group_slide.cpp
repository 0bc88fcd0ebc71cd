// Moved by its velocity at the end of the step, a sliding body goes v dt / 2 too short in all: 4 % of a slide from 2
// m/s at 1/60 s. Sliding friction does not depend on the place, so the mean of old and new velocity feeds in no energy.
#include "solver/finish/finish.h"

#include <algorithm>

#include "solver/finish/motion.h"
#include "solver/rigid_sum.h"
#include "solver/support.h"
#include "solver/union_find.h"

namespace brickfall {

namespace {

// The velocities of a group along the ground with this normal, or their changes.
RigidMotion alongGround(const RigidSum& sum, Vec3 normal) {
  const Vec3 v = sum.velocity();
  return {sum.centre(), v - normal * dot(normal, v),
          normal * (dot(normal, sum.angularMomentum()) / dot(normal, sum.inertia() * normal))};
}

class GroupSlides {
 public:
  GroupSlides(const Island& island, StepContext& context)
      : island_(island),
        context_(context),
        groupOf_(count_, 0, island.memory),
        normals_(count_, Vec3{}, island.memory),
        stays_(count_, 0, island.memory) {}

  // False if no body slides.
  bool findGroups(const std::pmr::vector<char>& moved);
  bool judgeGround();
  void findChanges();
  void judgeOpen();
  void correct();

 private:
  bool isGround(std::uint32_t body) const { return held_[body]; }
  // The row presses a group on what it slides on: ground, or another group.
  bool presses(RowEnds ends) const {
    return isGround(ends.a) ? !isGround(ends.b) : isGround(ends.b) || groupOf_[ends.a] != groupOf_[ends.b];
  }
  bool slides(std::uint32_t body) const {
    return !isGround(body) && !stays_[groupOf_[body]] && normals_[groupOf_[body]] != Vec3{};
  }
  // How a correction would move the bodies back.
  EndChanges takenBack(RowEnds ends) const {
    auto of = [this](std::uint32_t body) { return slides(body) ? changes_[body] : VelocityChange{}; };
    return {of(ends.a), of(ends.b)};
  }

  const Island& island_;
  StepContext& context_;
  std::uint32_t count_ = std::uint32_t(island_.bodies.size());
  std::pmr::vector<char> held_{island_.memory};  // bodies and partners: counts as ground
  std::pmr::vector<std::uint32_t> groupOf_;      // body -> the group's lowest body
  // By group:
  std::pmr::vector<Vec3> normals_;  // of the ground; zero: the group touches no ground
  std::pmr::vector<char> stays_;    // the group is not corrected
  // By body: the change of its group's velocity at the body; zero if the group is not corrected.
  std::pmr::vector<VelocityChange> changes_{island_.memory};
};

// Groups: bodies that press on each other. A body that sticks to something fixed, directly or through a chain of
// sticking contacts, is in no group: it counts as ground. So does what was moved as a chunk. What slides on a group, on
// a face that lies as the ground does, is a group of its own: its velocity changes otherwise.
bool GroupSlides::findGroups(const std::pmr::vector<char>& moved) {
  findSupported(island_, held_, [&](const auto& kind, std::size_t k) { return kind.sticks(k, context_); });
  for (std::size_t i = 0; i < moved.size(); i++) held_[i] = held_[i] || moved[i];
  if (std::find(held_.begin(), held_.end(), 0) == held_.end()) return false;
  Vec3 ground;
  island_.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if (ground == Vec3{} && isGround(ends.a) != isGround(ends.b) && kind.carriesForce(k, context_))
      ground = kind.normal(k);
  });
  auto now = [&](std::uint32_t body) {
    const SolvedMotion& s = context_.solved[island_.bodies[body]];
    return VelocityChange{s.velocity, context_.bodies->worldInvInertia(island_.bodies[body]) * s.angularMomentum};
  };
  UnionFind sets(count_, island_.memory);
  island_.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    if (isGround(ends.a) || isGround(ends.b) || !kind.ties(k, context_)) return;
    const bool lies = length(cross(ground, kind.normal(k))) <= kShapesRound;
    if (!lies || !kind.slips(k, {now(ends.a), now(ends.b)}, island_.dt, context_)) sets.join(ends.a, ends.b);
  });
  for (std::uint32_t i = 0; i < count_; i++) groupOf_[i] = sets.find(i);
  return true;
}

// True if there is a group that slides.
bool GroupSlides::judgeGround() {
  island_.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    if (!presses(ends) || !kind.carriesForce(k, context_)) return;
    const Vec3 n = kind.normal(k);
    const bool changes =
        kind.courseOf(k, changesOf(ends, island_, context_), {island_.dt}, context_) == RowCourse::changes;
    for (std::uint32_t body : {ends.a, ends.b}) {
      if (isGround(body)) continue;
      const std::uint32_t group = groupOf_[body];
      if (normals_[group] == Vec3{}) normals_[group] = n;
      stays_[group] = stays_[group] || changes || !(length(cross(normals_[group], n)) <= kShapesRound);
    }
  });
  for (std::uint32_t i = 0; i < count_; i++)
    if (slides(i)) return true;
  return false;
}

// For groups that slide: how the velocity of each changes, as that of a rigid body.
void GroupSlides::findChanges() {
  const BodySet& bodies = *context_.bodies;
  std::pmr::vector<RigidSum> changes(count_, RigidSum(island_.origin), island_.memory);
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!slides(i)) continue;
    const BodyIndex body = island_.bodies[i];
    const Mat3 inertia = bodies.worldInertia(body);
    const double m = bodies.mass[body].mass;
    const VelocityChange change = changeOf(body, context_);
    changes[groupOf_[i]].add(m, bodies.motion[body].position, inertia, change.move * m, inertia * change.turn);
  }
  changes_.resize(count_);
  for (std::uint32_t i = 0; i < count_; i++)
    if (slides(i)) {
      const RigidMotion slide = alongGround(changes[groupOf_[i]], normals_[groupOf_[i]]);
      changes_[i] = {slide.at(bodies.motion[island_.bodies[i]].position), slide.spin};
    }
}

// A group that would be moved towards a body that one of its open points is about to meet is not corrected.
void GroupSlides::judgeOpen() {
  island_.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    if ((!slides(ends.a) && !slides(ends.b)) || kind.carriesForce(k, context_)) return;
    if (!isGround(ends.a) && !isGround(ends.b) && groupOf_[ends.a] == groupOf_[ends.b]) return;
    if (!kind.wouldMeet(k, takenBack(ends), changesOf(ends, island_, context_), island_.dt)) return;
    for (std::uint32_t body : {ends.a, ends.b})
      if (!isGround(body)) stays_[groupOf_[body]] = 1;
  });
}

void GroupSlides::correct() {
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!slides(i)) continue;
    const double half = -0.5 * island_.dt;
    shift(island_.bodies[i], changes_[i].move * half, changes_[i].turn * half, context_);
  }
}

}  // namespace

void finishSlides(Island& island, const std::pmr::vector<char>& moved, StepContext& context) {
  if (!island.grounded() || island.facts.fastest <= context.settings.restSpeed) return;
  if (island.bodies.size() == 1 && !island.facts.partnersGo) return;
  for (BodyIndex partner : island.partners)
    if (context.bodies->motion[partner].angularVelocity != Vec3{}) return;
  GroupSlides slides(island, context);
  if (!slides.findGroups(moved) || !slides.judgeGround()) return;
  slides.findChanges();
  slides.judgeOpen();
  slides.correct();
}

}  // namespace brickfall
