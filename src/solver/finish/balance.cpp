#include "solver/finish/balance.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/finish/motion.h"
#include "solver/joint/springs.h"
#include "solver/joint/velocities.h"
#include "solver/rigid_sum.h"
#include "solver/support.h"

namespace brickfall {

namespace {

//! m/s | too small: columns that lean under a great load fall; stacks sway on
//! | too large: bodies that rock in a small island are braked
constexpr double kSwaySpeed = 0.1;

using Bodies = std::span<const std::uint32_t>;

// The impulse of ties on a body in this step, N s and N m s. It is the change of the body's momenta beyond outside
// forces, plus the residual that the solve left, which no tie gave.
struct Impulse {
  Vec3 linear, angular;
};
Impulse leftOver(const Island& island, std::size_t i) {
  if (island.residual.size() != island.bodies.size()) return {};
  return {toDouble(island.residual[i].force) * island.dt, toDouble(island.residual[i].torque) * island.dt};
}
// By the motion that was solved, whatever it was finished to.
Impulse fromTies(const Island& island, std::size_t i, const StepContext& context) {
  const BodyIndex body = island.bodies[i];
  const Impulse left = leftOver(island, i);
  const Vec3 way =
      island.rigid.endOf(context.bodies->motion[body].position) + toDouble(island.motion[i].d) - context.free[body].d;
  const Vec3 turn = toDouble(island.motion[i].th) - toDouble(island.masses[i].thFree);
  return {way * (context.bodies->mass[body].mass / island.dt) + left.linear,
          context.bodies->worldInertia(body) * turn * (1 / island.dt) + left.angular};
}

// What a group's ties give back in this step of what they took in earlier ones.
struct Returned {
  bool owed = false;    // impacts go on: their rebound is to come
  double rebounds = 0;  // J, work of rebounds
  double lasting = 0;   // J, by ties that last
};

Mat3 inertiaAtEnd(const StepContext& context, BodyIndex body) {
  const Mat3 end = toMatrix(rotationAtEnd(body, context));
  return end * context.bodies->mass[body].inertia * transpose(end);
}

struct GroupEnergy {
  double start = 0, end = 0;  // J, kinetic
  double outside = 0;         // J, work of gravity and outside forces
  double ties = 0;            // J, work of ties: from energy stored in them, and by kinematic bodies through them
  double lent = 0;            // J, that impacts took in earlier steps
  double moved = 0;           // J, work of outside forces, gains and losses both counted positive
  // Energy that rebounds gave may be energy that impacts took before.
  double gain(const Returned& back) const {
    return end - start - outside - std::min(lent, std::max(0.0, back.rebounds));
  }
  double fromTies(const Returned& back) const { return std::max(0.0, ties - std::max(0.0, back.rebounds)); }
  double all() const { return start + moved; }  // the end of a step that failed is no measure
  double slack() const { return kFloatsRound * all(); }
};
// Energies in a frame that moves at `frame` (m/s) with the body that the group presses on. Otherwise the work of a body
// that slides on a belt is lost in the rounding of the belt's work.
//
// Where something kinematic drives bodies that swing on joints, or a body has locks, ties are judged by what they gave
// in the solve. Its steps are those of a leapfrog: gravity acts before a way. So ties act on the mean of old and new
// velocity of the solve, and gravity along the way less half of the change of velocity. Groups that fly have gone the
// mean of both already. All else is judged by the velocities of the step's start and end, and by the way between.
GroupEnergy energyOf(const Island& island, Bodies group, Vec3 frame, const StepContext& context) {
  GroupEnergy sum;
  const bool told = island.plan.endVelocities && !island.facts.partnersMove, leaps = island.facts.jointed && !told;
  const Vec3 carried = frame * island.dt;
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const FreeMotion& free = context.free[body];
    const SolvedMotion& s = context.solved[body];
    const BodyData& data = context.bodies->data[body];
    const double m = context.bodies->mass[body].mass;
    const Lead lead = leaps ? leadOf(body, context) : Lead{};
    const Mat3 inertia = context.bodies->worldInertia(body);
    const Vec3 move = free.startVelocity - lead.before.move, spin = free.startSpin - lead.before.turn;
    const Vec3 endMove = s.velocity - lead.after.move;
    const Vec3 endSpin = leaps ? spinAtEnd(body, s.angularMomentum, context) - lead.after.turn : Vec3{};
    sum.start += 0.5 * m * lengthSquared(move - frame) + 0.5 * dot(spin, inertia * spin);
    sum.end +=
        leaps ? 0.5 * m * lengthSquared(endMove - frame) + 0.5 * dot(endSpin, inertiaAtEnd(context, body) * endSpin)
              : kineticEnergyAtEnd(body, frame, context);
    const Vec3 way = leaps ? (move + endMove) * (0.5 * island.dt) - carried : s.d - carried;
    const Vec3 turn = leaps ? (spin + endSpin) * (0.5 * island.dt) : s.th;
    const Vec3 fell = leaps && !s.flying ? s.d - (endMove - move) * (0.5 * island.dt) - carried : way;
    const double work = dot(context.gravity * (m * data.gravityScale) + data.force, fell) + dot(data.torque, turn);
    sum.outside += work;
    sum.moved += std::fabs(work);
    sum.lent += data.impactLoss;
    if (told) continue;
    const Impulse given = fromTies(island, i, context);
    sum.ties += (dot(given.linear, way) + dot(given.angular, turn)) * (1 / island.dt);
  }
  // Ties gave what is not from outside.
  if (told) sum.ties = sum.end - sum.start - sum.outside;
  return sum;
}

// The residual that a solve left has acted like a force from nowhere. Velocities take back the same share of its
// impulse on each body, just enough that no energy is gained. Bodies in balance, or without contacts, are left alone,
// and momentum comes out better than it was. Returns the excess that is left.
double takeResidual(const Island& island, Bodies group, Vec3 frame, StepContext& context, double excess) {
  // With a share x of all impulses, energy changes by linear x + square x^2.
  double linear = 0, square = 0;
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const SolvedMotion& s = context.solved[body];
    const Impulse left = leftOver(island, i);
    const Vec3 spin = spinAtEnd(body, left.angular, context);
    linear += dot(left.linear, s.velocity - frame) + dot(spin, s.angularMomentum);
    square += 0.5 * lengthSquared(left.linear) * context.bodies->mass[body].invMass + 0.5 * dot(left.angular, spin);
  }
  if (!(linear < 0) || !(square > 0)) return excess;
  double share = std::min(1.0, -linear / (2 * square)), root = linear * linear - 4 * square * excess;
  if (root > 0) share = std::min(share, (-linear - std::sqrt(root)) / (2 * square));
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const Impulse left = leftOver(island, i);
    accelerate(body, left.linear * (share * context.bodies->mass[body].invMass), left.angular * share, context);
  }
  return excess + linear * share + square * share * share;
}

// The motion of a group that flies, at the end of the step.
RigidMotion motionOf(const Island& island, Bodies group, const StepContext& context) {
  RigidSum sum(island.origin);
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const SolvedMotion& s = context.solved[body];
    const double m = context.bodies->mass[body].mass;
    sum.add(m, context.bodies->motion[body].position + s.d, inertiaAtEnd(context, body), s.velocity * m,
            s.angularMomentum);
  }
  return sum.motion();
}
// The motion of the body that a group presses on.
RigidMotion motionOf(const Island& island, std::uint32_t partner, const StepContext& context) {
  const BodyIndex body = island.partners[partner - island.bodies.size()];
  const BodyMotion& m = context.bodies->motion[body];
  return {m.position, m.linearVelocity + context.bodies->surfaceVelocity(body), m.angularVelocity};
}

// Energy of a group as a function of the share x that is left of its motion against a rigid motion:
// rigid + cross x + relative x^2.
struct RelativeEnergy {
  double relative = 0, cross = 0;  // J
};

// The velocity and the angular momentum that the body would have in a rigid motion, at the end of the step.
std::pair<Vec3, Vec3> inRigidMotion(BodyIndex body, const RigidMotion& rigid, const StepContext& context) {
  return {rigid.at(context.bodies->motion[body].position + context.solved[body].d),
          inertiaAtEnd(context, body) * rigid.spin};
}

RelativeEnergy energyAgainst(const Island& island, Bodies group, const RigidMotion& rigid, Vec3 frame,
                             const StepContext& context) {
  RelativeEnergy out;
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const SolvedMotion& s = context.solved[body];
    const auto [v, l] = inRigidMotion(body, rigid, context);
    const Vec3 dv = s.velocity - v, dl = s.angularMomentum - l;
    const double m = context.bodies->mass[body].mass;
    out.relative += 0.5 * m * lengthSquared(dv) + 0.5 * dot(dl, spinAtEnd(body, dl, context));
    out.cross += m * dot(v - frame, dv) + dot(rigid.spin, dl);
  }
  return out;
}

// Takes `excess` (J) from the motion of the bodies against a rigid motion. A group that flies is taken against its own
// rigid motion: linear and angular momentum are kept. Returns the rest of the excess, if the bodies had no more to
// give.
double takeRelative(const Island& island, Bodies group, const RigidMotion& rigid, Vec3 frame, StepContext& context,
                    double excess) {
  const auto [relative, cross] = energyAgainst(island, group, rigid, frame, context);
  if (!(relative > 0)) return excess;
  // relative (1 - x^2) + cross (1 - x) = excess; if no x fits, x = 0 takes most.
  const double root = cross * cross + 4 * relative * (relative + cross - excess);
  const double most = excess < 0 ? 1 + kTrifle : 1;
  const double kept = root > 0 ? std::clamp((-cross + std::sqrt(root)) / (2 * relative), 0.0, most) : 0;
  for (std::uint32_t i : group) {
    const BodyIndex body = island.bodies[i];
    const SolvedMotion& s = context.solved[body];
    const auto [v, l] = inRigidMotion(body, rigid, context);
    accelerate(body, (v - s.velocity) * (1 - kept), (l - s.angularMomentum) * (1 - kept), context);
  }
  return excess - relative * (1 - kept * kept) - cross * (1 - kept);
}

// Energy that compressed contacts give back is no error, but it keeps standing columns swaying. While no body of a
// small island is faster than kSwaySpeed, it is taken from the bodies that a chain of loaded contacts connects to the
// ground. The common sliding velocity that friction cannot stop is left to them.
void dampSway(const Island& island, StepContext& context, double excess) {
  std::pmr::vector<char> stands(island.memory);
  findSupported(island, stands, [&](const auto& kind, std::size_t k) { return kind.carriesForce(k, context); });
  std::pmr::vector<std::uint32_t> standing(island.memory);
  for (std::uint32_t i = 0; i < island.bodies.size(); i++)
    if (stands[i]) standing.push_back(i);
  const Vec3 slide = slideLeft(island, stands, context, [&](BodyIndex body) { return context.solved[body].velocity; });
  double energy = 0;
  for (std::uint32_t i : standing) {
    const BodyIndex body = island.bodies[i];
    const Vec3 spin = context.solved[body].angularMomentum;
    energy += 0.5 * context.bodies->mass[body].mass * lengthSquared(context.solved[body].velocity - slide) +
              0.5 * dot(spin, spinAtEnd(body, spin, context));
  }
  if (!(energy > 0)) return;
  const double lost = 1 - std::sqrt(std::max(0.0, 1 - excess / energy));
  for (std::uint32_t i : standing) {
    const SolvedMotion& s = context.solved[island.bodies[i]];
    accelerate(island.bodies[i], (slide - s.velocity) * lost, s.angularMomentum * -lost, context);
  }
}

// By group.
std::pmr::vector<Returned> returnedBy(const Island& island, const StepContext& context) {
  std::pmr::vector<Returned> out(island.groups.count(), Returned{}, island.memory);
  const std::size_t count = island.bodies.size();
  island.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    Returned& group = out[island.groups.groupOf(ends.a < count ? ends.a : ends.b)];
    group.rebounds += kind.reboundWork(k, island.motion.data());
    group.lasting += kind.returnedWork(k);
    group.owed = group.owed || kind.owes(k, context);
  });
  return out;
}

// The last check of a step: takes excess energy from the groups of an island.
class LastCheck {
 public:
  LastCheck(const Island& island, StepContext& context) : island_(island), context_(context) {}
  // Returns the energy taken, J.
  double run(std::size_t g, const Returned& back) {
    const Bodies group = island_.groups.bodies(g);
    if (island_.groups.flies(g) && group.size() == 1) return 0;  // free motion
    const bool flies = island_.groups.flies(g);
    const double taken = flies ? checkFlying(g, back) : checkSupported(g, back);
    keepLosses(group, flies ? Vec3{} : motionOf(island_, island_.groups.partner(g), context_).move, back);
    return taken;
  }

 private:
  // For a group that something fixed or kinematic supports. First the residual that the solve left is taken back: all
  // that it can give to make up for any gain, from whatever cause. Then the excess over all work of the ties is taken
  // from the group's motion against the body that it presses on.
  double checkSupported(std::size_t g, const Returned& back) {
    const Bodies group = island_.groups.bodies(g);
    const RigidMotion under = motionOf(island_, island_.groups.partner(g), context_);
    const bool driven = movesAgainst(under), jointed = island_.facts.jointed;
    GroupEnergy energy = energyOf(island_, group, under.move, context_);
    if (swingsOn(group)) {
      takeRelative(island_, group, under, under.move, context_, lapse(energy));
      return 0;
    }
    auto given = [&] {
      const double fromTies = energy.fromTies(back);
      return driven ? fromTies : std::min(fromTies, mostWork(g));
    };
    double excess = energy.gain(back) - (driven || jointed ? given() : 0);
    if (!(excess > energy.slack())) return 0;
    takeResidual(island_, group, under.move, context_, excess);
    energy = energyOf(island_, group, under.move, context_);
    excess = energy.gain(back);
    if (excess > energy.slack() && !driven && !island_.plan.large && !jointed && island_.facts.fastest <= kSwaySpeed) {
      dampSway(island_, context_, excess);
      return 0;
    }
    excess -= given();
    if (!(excess > energy.slack())) return 0;
    // First from the motion of its bodies against each other: their common momentum is theirs to keep on smooth ground.
    // On joints it would part what they hold.
    double left = jointed
                      ? excess
                      : takeRelative(island_, group, motionOf(island_, group, context_), under.move, context_, excess);
    if (left > energy.slack()) left = takeRelative(island_, group, under, under.move, context_, left);
    if (left > energy.slack() && (jointed || group.size() == 1)) left = takeWay(group, under.move, left);
    return excess - left;
  }

  // J: what a step of bodies that swing on joints alone made of nothing. Energy goes up and down by a second order, as
  // the joints tell.
  double lapse(const GroupEnergy& energy) const { return energy.gain({}) + heldEnergy(island_); }
  // Nothing but gravity and joints acts on the group, and its swing is smooth: it keeps what a leapfrog keeps.
  bool swingsOn(Bodies group) const {
    if (!keepsEnergy(island_) || island_.groups.count() > 1) return false;
    return std::none_of(group.begin(), group.end(), [&](std::uint32_t i) {
      const BodyData& data = context_.bodies->data[island_.bodies[i]];
      return data.linearDamping > 0 || data.angularDamping > 0 || data.dragArea > 0;
    });
  }

  // What has no velocity left to give has gone too far against the forces on it: a body alone, or what hangs on joints
  // with all that it touches. It goes a share of its way.
  double takeWay(Bodies group, Vec3 frame, double excess) {
    double climbed = 0;
    for (std::uint32_t i : group) {
      const BodyIndex body = island_.bodies[i];
      const SolvedMotion& s = context_.solved[body];
      const BodyData& data = context_.bodies->data[body];
      const Vec3 force = context_.gravity * (context_.bodies->mass[body].mass * data.gravityScale) + data.force;
      climbed -= dot(force, s.d - frame * island_.dt) + dot(data.torque, s.th);
    }
    if (!(climbed > 0)) return excess;
    const double less = std::min(1.0, excess / climbed);
    for (std::uint32_t i : group)
      shorten(island_.bodies[i], 1 - less, 1 - less, frame * (island_.dt * less), false, context_);
    return excess - less * climbed;
  }

  // A partner of the island moves, seen from a body that goes straight on: its ties work.
  bool movesAgainst(const RigidMotion& under) const {
    if (!island_.facts.partnersMove) return false;
    return std::any_of(island_.partners.begin(), island_.partners.end(), [&](BodyIndex partner) {
      const BodyMotion& m = context_.bodies->motion[partner];
      return m.linearVelocity != under.move || m.angularVelocity != Vec3{};
    });
  }

  // J: the most that the group's ties can give against partners at rest. In a solve that failed they do more. Contacts
  // beside joints are pressed by all that hangs there, and may store 1 % of all that moves: they give rebounds alone.
  double mostWork(std::size_t g) const {
    const std::size_t count = island_.bodies.size();
    double sum = releasedBySprings(island_, std::uint32_t(g), context_);
    island_.rows.each([&]<class Kind>(const Kind& kind, std::size_t k) {
      if (island_.plan.endVelocities && !Kind::kLasts && !Kind::kYields) return;
      const RowEnds ends = kind.ends(k);
      if (island_.groups.groupOf(ends.a < count ? ends.a : ends.b) == g) sum += kind.mostWork(k);
    });
    return sum;
  }

  // For a group that flies: any gain went into its own motion. Energy that compression took in one step and gives back
  // in the next counts as a gain, too, unless a rebound gives it.
  double checkFlying(std::size_t g, const Returned& back) {
    const Bodies group = island_.groups.bodies(g);
    const GroupEnergy energy = energyOf(island_, group, {}, context_);
    const double excess = energy.gain(back) - back.lasting - releasedBySprings(island_, std::uint32_t(g), context_);
    if (!(excess > energy.slack())) return 0;
    const double left = takeRelative(island_, group, motionOf(island_, group, context_), {}, context_, excess);
    // No momenta fit those ways: the group goes as if it met nothing, what is held as one body. Locks hold it as well.
    if (!(left > energy.slack()) || island_.facts.locked) return excess - left;
    auto flewAhead = [&](std::uint32_t i) { return context_.aheadOf(island_.bodies[i]) > 0; };
    if (island_.facts.firm && std::none_of(group.begin(), group.end(), flewAhead)) {
      goAsOne(group, island_, context_);
    } else {
      for (std::uint32_t i : group) goFreely(island_.bodies[i], context_);
    }
    return excess;
  }

  // While impacts go on, all that the group has lost since they began may come back: to each body by the energy that it
  // had and has, since the group may part before.
  void keepLosses(Bodies group, Vec3 frame, const Returned& back) {
    if (!back.owed) return;
    const GroupEnergy all = energyOf(island_, group, frame, context_);
    const double loss = std::max(0.0, all.lent - (all.end - all.start - all.outside));
    const double had = all.start + all.end + all.lent;
    if (!(had > 0)) return;
    for (std::uint32_t i : group) {
      const GroupEnergy own = energyOf(island_, {&i, 1}, frame, context_);
      keepLoss(island_.bodies[i], loss * ((own.start + own.end + own.lent) / had), context_);
    }
  }

  const Island& island_;
  StepContext& context_;
};

}  // namespace

double checkEnergy(const Island& island, StepContext& context) {
  const std::pmr::vector<Returned> back = returnedBy(island, context);
  LastCheck check(island, context);
  double taken = 0;
  for (std::size_t g = 0; g < back.size(); g++) taken += check.run(g, back[g]);
  return taken;
}

}  // namespace brickfall
