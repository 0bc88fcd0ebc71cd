// Moved by its velocity at the end of the step, a wall that rocks loses half a step of its weight's work whenever it
// begins to turn, and again as it lands: 11 % of its first swing, and 40 % of the second, at 1/60 s. What mortar joins
// moves as one body, whose weight does not depend on its place: so the mean of old and new velocity feeds in no energy.
#include "solver/finish/finish.h"

#include <algorithm>
#include <type_traits>

#include "solver/chunks.h"
#include "solver/finish/motion.h"
#include "solver/rigid_sum.h"

namespace brickfall {

namespace {

class ChunkTurns {
 public:
  ChunkTurns(const Island& island, StepContext& context)
      : island_(island),
        context_(context),
        chunkOf_(chunksOf(island, *context.ties)),
        stays_(count_, 0, island.memory) {}

  // False if mortar joins all to what is fixed.
  bool findChunks();
  void findChanges();
  void judgeRows();
  void correct();
  bool turns(std::uint32_t body) const {
    return body < count_ && chunkOf_[body] != kNoIndex && !stays_[chunkOf_[body]];
  }

 private:
  // How a correction would move the bodies back.
  EndChanges takenBack(RowEnds ends) const {
    auto of = [this](std::uint32_t body) {
      if (!turns(body)) return VelocityChange{};
      const RigidMotion& change = changes_[chunkOf_[body]];
      return VelocityChange{change.at(context_.bodies->motion[island_.bodies[body]].position), change.spin};
    };
    return {of(ends.a), of(ends.b)};
  }
  void stay(RowEnds ends) {
    for (std::uint32_t body : {ends.a, ends.b})
      if (turns(body)) stays_[chunkOf_[body]] = 1;
  }

  const Island& island_;
  StepContext& context_;
  std::uint32_t count_ = std::uint32_t(island_.bodies.size());
  std::pmr::vector<std::uint32_t> chunkOf_;  // by body: the chunk's lowest body
  // By chunk:
  std::pmr::vector<char> stays_;                           // it is not corrected
  std::pmr::vector<RigidMotion> changes_{island_.memory};  // of its velocities
  std::pmr::vector<Vec3> turns_{island_.memory};           // rad, in this step
};

bool ChunkTurns::findChunks() {
  island_.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    if (!std::remove_cvref_t<Kind>::kYields) return;
    const RowEnds ends = kind.ends(k);
    if (ends.a >= count_ || ends.b >= count_) stay(ends);
  });
  for (std::uint32_t i = 0; i < count_; i++)
    if (turns(i)) return true;
  return false;
}

void ChunkTurns::findChanges() {
  const BodySet& bodies = *context_.bodies;
  std::pmr::vector<RigidSum> changes(count_, RigidSum(island_.origin), island_.memory), ways(changes);
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!turns(i)) continue;
    const BodyIndex body = island_.bodies[i];
    const double m = bodies.mass[body].mass;
    const Mat3 inertia = bodies.worldInertia(body);
    const VelocityChange change = changeOf(body, context_);
    const SolvedMotion& s = context_.solved[body];
    const Vec3 at = bodies.motion[body].position;
    changes[chunkOf_[i]].add(m, at, inertia, change.move * m, inertia * change.turn);
    ways[chunkOf_[i]].add(m, at, inertia, s.d * m, inertia * s.th);
  }
  changes_.resize(count_);
  turns_.resize(count_);
  for (std::uint32_t i = 0; i < count_; i++) {
    if (chunkOf_[i] != i || stays_[i]) continue;
    changes_[i] = changes[i].motion();
    turns_[i] = ways[i].spin();
  }
}

// A chunk is not corrected where that would press on what it touches as no force of the solve does, or leave it: what
// begins anew in each step is work for the next. Nor towards a body that one of its open points is about to meet.
void ChunkTurns::judgeRows() {
  island_.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
    if (std::remove_cvref_t<Kind>::kYields) return;
    const RowEnds ends = kind.ends(k);
    if (!turns(ends.a) && !turns(ends.b)) return;
    const EndChanges back = takenBack(ends);
    const bool keeps = kind.carriesForce(k, context_)
                           ? kind.keepsForces(k, back, island_.dt, context_)
                           : !kind.wouldMeet(k, back, changesOf(ends, island_, context_), island_.dt);
    if (!keeps) stay(ends);
  });
}

// Arcs and all: mortar feels a micron.
void ChunkTurns::correct() {
  const double half = -0.5 * island_.dt;
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!turns(i)) continue;
    const RigidMotion& change = changes_[chunkOf_[i]];
    const Vec3 went = turns_[chunkOf_[i]], back = change.spin * half;
    const Vec3 arm = context_.bodies->motion[island_.bodies[i]].position - change.centre;
    auto turned = [&](Vec3 by) { return rotate(quatFromRotationVector(by), arm); };
    shift(island_.bodies[i], change.move * half + turned(went + back) - turned(went), back, context_);
  }
}

}  // namespace

std::pmr::vector<char> finishChunks(const Island& island, StepContext& context) {
  std::pmr::vector<char> moved(island.memory);
  const IslandFacts& facts = island.facts;
  if (!facts.mortared || facts.jointed || facts.locked || facts.partnersMove || !island.grounded() ||
      facts.fastest <= context.settings.restSpeed)
    return moved;
  ChunkTurns chunks(island, context);
  if (!chunks.findChunks()) return moved;
  chunks.findChanges();
  chunks.judgeRows();
  chunks.correct();
  moved.resize(island.bodies.size());
  for (std::uint32_t i = 0; i < moved.size(); i++) moved[i] = chunks.turns(i);
  return moved;
}

}  // namespace brickfall
