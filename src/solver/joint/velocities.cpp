#include "solver/joint/velocities.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/finish/motion.h"
#include "solver/joint/velocity_system.h"
#include "solver/renewals.h"

namespace brickfall {

namespace {

//! of a joint's inertia | too small: chains under a great load are braked
//! | too large: links that an impulse turns far fly apart
constexpr double kLight = 0.2;  // a lighter turn, by the impulse on its arm in a step, is rubbed against

class HeldVelocities : VelocitySystem {
 public:
  HeldVelocities(Island& island, StepContext& context) : VelocitySystem(island, context), frictions_(island.memory) {}

  // Returns the energy that friction took, J.
  double run(Ties& ties) {
    findBodies();
    findEquations(ties);
    if (equations_.empty() || !hold() || (findFrictions() && !hold())) {
      island_.rows.joints.stopKeeping();
      return 0;
    }
    const double taken = takeGain(ties);
    tell(ties);
    return taken;
  }

 private:
  // What the joints gave is measured. What swings on joints alone may get back what smooth steps lost, since its energy
  // goes up and down by a second order. Elsewhere joints owe what floats round, and give nothing. More than that comes
  // from turns that no step can follow: friction takes it.
  double takeGain(Ties& ties) {
    const Gain gain = gainOf(ties);
    const double wound = windUp(ties);
    JointRows& joints = island_.rows.joints;
    double lent = 0, weights = 0;
    for (JointIndex joint : joints.tieOf) lent += ties.joints.slots[joint].lent;
    for (const Body& body : bodies_)
      weights += body.mass * length(context_.gravity) * context_.bodies->mass[body.body].outerRadius;
    const double held = energy();
    // A snap would take it in each of its steps, and never return it.
    const double owed = joints.steady() ? kFloatsRound * std::min(gain.loads, held + weights) : 0;
    const double sum = gain.sum - wound, smooth = mostReturned();
    double before = 0;
    const double share = joints.held() / double(joints.size());
    for (JointIndex joint : joints.tieOf) before += std::exchange(ties.joints.slots[joint].held, share);
    joints.hold(std::max(joints.held() - before, -std::max(lent, 0.0)));
    const bool steady = joints.keepEnergy();
    if (!swingsOn(held)) joints.stopKeeping();
    if (joints.giveNone()) {
      // What a snap took it would return in a later step.
      const double kept = std::max(std::min(lent, 0.0), lent - std::max(sum, 0.0));
      const double rest = joints.keepEnergy() ? lent + joints.held() : steady ? kept : 0;
      for (JointIndex joint : joints.tieOf) ties.joints.slots[joint].lent = rest / double(joints.size());
      joints.returned = 0;
      return !joints.keepEnergy() || sum > smooth ? rub(held, sum) : 0;
    }
    const double owes = joints.steady() ? std::min(lent, 0.0) : 0;
    const double taken = rub(held, sum - owes - owed);
    for (JointIndex joint : joints.tieOf)
      ties.joints.slots[joint].lent = std::max(-owed, std::min(owes - sum, 0.0)) / double(joints.size());
    joints.returned = (sum > 0 ? owed : 0) + wound;
    return taken;
  }

  // The swing is smooth. More than a trifle of the work that moves it is a snap's; what joints do not explain is not
  // resolved. False as well where no step of this length is remembered.
  bool swingsOn(double energyAtEnd) const {
    double gain = energyAtEnd, moved = 0;
    for (const Body& body : bodies_) {
      const BodyData& data = context_.bodies->data[body.body];
      if (data.steady.dt != island_.dt) return false;
      const FreeMotion& free = context_.free[body.body];
      const SolvedMotion& s = context_.solved[body.body];
      const double work =
          dot(context_.gravity * (body.mass * data.gravityScale) + data.force, s.d) + dot(data.torque, s.th);
      gain -= 0.5 * body.mass * lengthSquared(free.startVelocity) + work +
              0.5 * dot(free.startSpin, context_.bodies->worldInertia(body.body) * free.startSpin);
      moved += std::fabs(work);
    }
    const double held = island_.rows.joints.held();
    return std::fabs(gain + held) <= std::fabs(gain) && std::fabs(held) <= kTrifle * moved;
  }

  // J, in a step. Smooth swings go up and down by a small part of what gravity changes in it; snaps would return what
  // they took within a step.
  double mostReturned() const {
    double work = 0;
    for (const Body& body : bodies_) {
      const BodyData& data = context_.bodies->data[body.body];
      work += dot(context_.gravity * (body.mass * data.gravityScale) + data.force, context_.solved[body.body].d);
    }
    return kTrifle * std::fabs(work);
  }

  // J: work of joints whose length or limits were changed from outside, as far as they went that way.
  double windUp(Ties& ties) {
    double sum = 0;
    const JointRows& joints = island_.rows.joints;
    for (std::uint32_t k = 0; k < joints.size(); k++) {
      Joint& joint = joints.at(k, ties);
      if (!(joint.wound > 0)) continue;
      const JointRecord& r = joints.records[k];
      const Body &a = at(r.bodyA), &b = at(r.bodyB);
      const Vec3 wA = mean(r.bodyA, a, true), wB = mean(r.bodyB, b, true);
      const Vec3 u =
          mean(r.bodyB, b, false) + cross(wB, toDouble(r.armB)) - mean(r.bodyA, a, false) - cross(wA, toDouble(r.armA));
      const double way = dot(toDouble(r.way.axes[0].unit), u) * island_.dt,
                   turn = dot(toDouble(r.turn.axes[0].unit), wB - wA) * island_.dt;
      const bool turns = joint.type == JointType::spherical || joint.type == JointType::revolute;
      const double force = turns ? joint.turn[0] + joint.turn[3] : joint.way[0] + joint.way[3];
      const double gone = turns ? turn : joint.type == JointType::distance ? grown(joint, a, b) : way;
      if (force * gone > 0) sum += std::fabs(force) * std::min(std::fabs(gone), joint.wound);
      joint.wound = std::max(0.0, joint.wound - std::fabs(gone));
    }
    return sum;
  }

  // m: what its ends have parted in the step, which velocities along a rod do not tell: it holds them.
  double grown(const Joint& rod, const Body& a, const Body& b) const {
    return length(JointPose(rod, a.place, b.place).way) - length(JointPose(rod, *context_.bodies).way);
  }

  // Friction that takes this, if it can. Friction as firm as joints are, and none, both leave velocities that joints
  // allow: so does each mean of the two, and one of them takes just this. Returns what it took, J.
  double rub(double held, double over) {
    if (!(over > 0)) return 0;
    const std::pmr::vector<Body> bodies(bodies_, island_.memory);
    const std::pmr::vector<Equation> equations(equations_, island_.memory);
    const std::pmr::vector<Friction> frictions(frictions_, island_.memory);
    friction_ = kFirmness;
    const double share = hold() ? shareThatTakes(over, bodies) : 0;
    auto mean = [share](auto was, auto is) { return share > 0 ? was + (is - was) * share : was; };
    for (std::size_t i = 0; i < bodies_.size(); i++) {
      bodies_[i].move = mean(bodies[i].move, bodies_[i].move);
      bodies_[i].spin = mean(bodies[i].spin, bodies_[i].spin);
    }
    for (std::size_t i = 0; i < equations_.size(); i++)
      equations_[i].impulse = mean(equations[i].impulse, equations_[i].impulse);
    for (std::size_t i = 0; i < frictions_.size(); i++)
      frictions_[i].impulse = mean(frictions[i].impulse, frictions_[i].impulse);
    return held - energy();
  }

  // Of the way from these velocities to the present ones, on which energy falls by `over`, or as far as it falls.
  double shareThatTakes(double over, const std::pmr::vector<Body>& from) const {
    double linear = 0, square = 0;
    for (std::size_t i = 0; i < from.size(); i++) {
      const Vec3 move = bodies_[i].move - from[i].move, spin = bodies_[i].spin - from[i].spin;
      linear += from[i].mass * dot(from[i].move, move) + dot(from[i].spin, from[i].inertia * spin);
      square += 0.5 * from[i].mass * lengthSquared(move) + 0.5 * dot(spin, from[i].inertia * spin);
    }
    if (!(linear < 0) || !(square > 0)) return 0;
    const double root = linear * linear - 4 * square * over;
    return std::min(1.0, (-linear - std::sqrt(std::max(0.0, root))) / (2 * square));
  }

  // False if it has no solution.
  bool hold() {
    for (int round = 0; round < kBoundRounds; round++) {
      for (Body& body : bodies_) body.move = body.startMove, body.spin = body.startSpin;
      for (Equation& e : equations_) e.impulse = 0;
      for (Friction& f : frictions_) f.impulse = {};
      assembleAll();
      if (!factor()) return false;
      for (int i = 0; i < kHoldRounds; i++) relax();
      if (!letGo()) break;
    }
    return true;
  }

  // J: what the joints gave in this step, by the mean of the velocities before and after it, and what of it is owed to
  // gravity, which acts along the way that was solved.
  struct Gain {
    double sum = 0, loads = 0;
  };
  Gain gainOf(const Ties& ties) const {
    Gain gain;
    const JointRows& joints = island_.rows.joints;
    for (std::uint32_t k = 0; k < joints.size(); k++) {
      const JointRecord& r = joints.records[k];
      const Joint& joint = joints.at(k, ties);
      const Body &a = at(r.bodyA), &b = at(r.bodyB);
      const Vec3 wA = mean(r.bodyA, a, true), wB = mean(r.bodyB, b, true);
      const Vec3 w = wB - wA, u = mean(r.bodyB, b, false) + cross(wB, toDouble(r.armB)) - mean(r.bodyA, a, false) -
                                  cross(wA, toDouble(r.armA));
      double sum = 0;
      for (int i = 0; i < kJointLanes; i++) {
        if ((joints.starts[k].hard | joints.starts[k].across) >> i & 1)
          sum += joint.way[i] * dot(toDouble(r.way.axes[i % 3].unit), u);
        if ((joints.starts[k].hard | joints.starts[k].across) >> (i + kJointLanes) & 1)
          sum += joint.turn[i] * dot(toDouble(r.turn.axes[i % 3].unit), w);
      }
      gain.sum += sum * island_.dt;
      const double sizeA = moves(r.bodyA) ? context_.bodies->mass[a.body].outerRadius : 1e300,
                   sizeB = moves(r.bodyB) ? context_.bodies->mass[b.body].outerRadius : 1e300;
      gain.loads += length(joint.force) * std::min(sizeA, sizeB) + length(joint.torque);
    }
    for (const Equation& e : equations_) {
      const JointRecord& r = joints.records[e.row];
      const Body &a = at(r.bodyA), &b = at(r.bodyB);
      const Vec3 wA = mean(r.bodyA, a, true), wB = mean(r.bodyB, b, true);
      const Vec3 u = mean(r.bodyB, b, false) + cross(wB, e.armB) - mean(r.bodyA, a, false) - cross(wA, e.armA);
      gain.sum += e.impulse * dot(e.axis, e.turn ? wB - wA : u);
    }
    for (const Body& body : bodies_) {
      const BodyData& data = context_.bodies->data[body.body];
      const FreeMotion& free = context_.free[body.body];
      const Vec3 weight = context_.gravity * (body.mass * data.gravityScale) + data.force;
      if (!island_.plan.endVelocities || island_.facts.partnersMove) {
        gain.sum += island_.dt * dot(weight, body.move - body.startMove);
        continue;
      }
      // What halves of forces gave, and gravity along the way.
      const SolvedMotion& s = context_.solved[body.body];
      const Vec3 move = (free.startVelocity + body.move) * 0.5, spin = (free.startSpin + body.spin) * 0.5;
      const Vec3 later = s.steady.linear * (0.5 * s.steady.dt) - free.late,
                 laterSpin = s.steady.angular * (0.5 * s.steady.dt) - free.lateSpin;
      gain.sum +=
          body.mass * dot(later, move) + dot(laterSpin, body.inertia * spin) + dot(weight, move * island_.dt - s.d);
    }
    return gain;
  }
  Vec3 mean(std::uint32_t local, const Body& body, bool spin) const {
    if (!moves(local)) return spin ? body.startSpin : body.startMove;
    const FreeMotion& free = context_.free[body.body];
    const Vec3 sum = spin ? free.startSpin + body.spin : free.startVelocity + body.move;
    if (island_.plan.endVelocities && !island_.facts.partnersMove) return sum * 0.5;
    const Lead lead = leadOf(body.body, context_);
    return (spin ? sum - lead.before.turn - lead.after.turn : sum - lead.before.move - lead.after.move) * 0.5;
  }

  // Friction of joints against what they leave free, where it goes far in the step.
  struct Friction {
    std::uint32_t row = 0;
    bool turn = false;
    Vec3 held[3];  // axes
    int count = 0;
    Vec3 armA, armB;
    double stiffness = 0, always = 0;
    Vec3 impulse;
    Vec3 free(Vec3 v) const {
      for (int i = 0; i < count; i++) v -= held[i] * dot(held[i], v);
      return v;
    }
  };
  // True if any acts from the start.
  bool findFrictions() {
    bool any = false;
    const JointRows& joints = island_.rows.joints;
    for (std::size_t first = 0, end = 0; first < equations_.size(); first = end) {
      for (end = first; end < equations_.size() && equations_[end].row == equations_[first].row;) end++;
      Friction f;
      f.row = equations_[first].row;
      f.armA = equations_[first].armA, f.armB = equations_[first].armB;
      int ways = 0, turns = 0;
      for (std::size_t i = first; i < end; i++) (equations_[i].turn ? turns : ways)++;
      f.turn = ways >= 3;
      for (std::size_t i = first; i < end; i++)
        if (equations_[i].turn == f.turn && f.count < 3) f.held[f.count++] = equations_[i].axis;
      if (f.count >= 3) continue;
      const JointRecord& r = joints.records[f.row];
      const Body &a = at(r.bodyA), &b = at(r.bodyB);
      const Vec3 w = b.spin - a.spin, u = b.move + cross(b.spin, f.armB) - a.move - cross(a.spin, f.armA);
      double least = 1e300;
      const double h2 = island_.dt * island_.dt;
      auto take = [&](bool there, double resist, double mass) {
        if (there) least = std::min(least, f.turn ? resist * h2 : mass);
      };
      take(moves(r.bodyA), double(joints.starts[f.row].resist[0]), a.mass);
      take(moves(r.bodyB), double(joints.starts[f.row].resist[1]), b.mass);
      // A line turns by its way across it, over its length.
      const double span = !f.turn && joints.starts[f.row].across != 0 ? double(joints.starts[f.row].span) : 0,
                   reach = std::max(span * span, lengthSquared(f.armA + f.armB));
      const double far = lengthSquared(f.free(f.turn ? w : u)) * h2 / (f.turn ? 1 : std::max(1e-12, reach));
      f.stiffness = least * std::min(far, 1.0);
      if (f.turn) {
        Vec3 impulse;
        for (std::size_t i = first; i < end; i++)
          if (!equations_[i].turn) impulse += equations_[i].axis * equations_[i].impulse;
        auto stiff = [&](bool there, float resist, Vec3f arm) {
          if (!there) return;
          const double inertia = double(resist) * h2,
                       spun = island_.dt * length(impulse) * double(length(arm)) / inertia;
          f.always = std::max(f.always, std::max(0.0, spun / kLight - 1) * least);
        };
        stiff(moves(r.bodyA), joints.starts[f.row].resist[0], joints.starts[f.row].anchorA);
        stiff(moves(r.bodyB), joints.starts[f.row].resist[1], joints.starts[f.row].anchorB);
      }
      any = any || f.always > 0;
      frictions_.push_back(f);
    }
    return any;
  }

  void assembleAll() {
    std::size_t next = 0;  // both lists are in the order of rows
    assemble([&](std::uint32_t row, BodyBlock& K) {
      if (next == frictions_.size() || frictions_[next].row != row) return;
      const Friction& f = frictions_[next++];
      const int corner = f.turn ? 3 : 0;
      for (int i = 0; i < 3; i++) {
        Vec3 unit;
        unit[i] = 1;
        const Vec3 column = f.free(unit);
        for (int j = 0; j < 3; j++) K[corner + i][corner + j] += (friction_ * f.stiffness + f.always) * column[j];
      }
    });
  }

  Vec3 frictionOf(const Friction& f) const {
    const JointRecord& r = island_.rows.joints.records[f.row];
    const Body &a = at(r.bodyA), &b = at(r.bodyB);
    const Vec3 w = b.spin - a.spin, u = b.move + cross(b.spin, f.armB) - a.move - cross(a.spin, f.armA);
    return f.free(f.turn ? w : u) * -(friction_ * f.stiffness + f.always);
  }
  template <class Give> void giveAll(const Friction& f, Vec3 p, Give giveTo) const {
    const JointRecord& r = island_.rows.joints.records[f.row];
    const Vec3 linear = f.turn ? Vec3{} : p;
    if (moves(r.bodyA)) giveTo(place_[r.bodyA], -linear, f.turn ? -p : cross(f.armA, -p));
    if (moves(r.bodyB)) giveTo(place_[r.bodyB], linear, f.turn ? p : cross(f.armB, p));
  }

  // The impulses that follow from the velocities that they lead to.
  void relax() {
    clear();
    auto pushAt = [&](std::uint32_t place, Vec3 linear, Vec3 angular) { push(place, linear, angular); };
    eachRow(equations_.size(), [&](std::size_t first, std::size_t end) { give(first, end, pushAt); });
    for (const Friction& f : frictions_) giveAll(f, frictionOf(f) - f.impulse, pushAt);
    solveMore();
    for (Body& body : bodies_) body.impulse = body.turning = {};
    auto sumAt = [&](std::uint32_t place, Vec3 linear, Vec3 angular) {
      bodies_[place].impulse += linear;
      bodies_[place].turning += angular;
    };
    eachRow(equations_.size(), [&](std::size_t first, std::size_t end) { take(first, end, sumAt); });
    for (Friction& f : frictions_) {
      f.impulse = frictionOf(f);
      giveAll(f, f.impulse, sumAt);
    }
    for (Body& body : bodies_) {
      body.move = body.startMove + body.impulse * (1 / body.mass);
      body.spin = body.startSpin + body.invInertia * body.turning;
    }
  }

  // One-sided equations that pull the wrong way. True if there are any.
  bool letGo() {
    bool any = false;
    for (Equation& e : equations_) {
      if (!e.oneSided || e.open || !(e.impulse * double(e.sign) < 0)) continue;
      e.open = true;
      any = true;
    }
    return any;
  }

  double energy() const {
    double sum = 0;
    for (const Body& body : bodies_)
      sum += 0.5 * body.mass * lengthSquared(body.move) + 0.5 * dot(body.spin, body.inertia * body.spin);
    return sum;
  }

  void tell(Ties& ties) {
    for (const Body& body : bodies_)
      accelerate(body.body, body.move - body.startMove, body.inertia * (body.spin - body.startSpin), context_);
    for (const Equation& e : equations_) support(e.row, e.armA, e.turn, e.axis * e.impulse);
    for (const Friction& f : frictions_) support(f.row, f.armA, f.turn, f.impulse);
    for (const Equation& e : equations_) {
      Joint& joint = ties.joints.slots[island_.rows.joints.tieOf[e.row]];
      (e.turn ? joint.earlierTorque : joint.earlierForce) += e.axis * (e.impulse / context_.dt);
    }
  }

  // Books an impulse on B that a fixed or kinematic body gives or takes.
  void support(std::uint32_t row, Vec3 armA, bool turn, Vec3 onB) {
    const JointRecord& r = island_.rows.joints.records[row];
    if (moves(r.bodyA) == moves(r.bodyB)) return;
    const Body &a = at(r.bodyA), &partner = moves(r.bodyA) ? at(r.bodyB) : a;
    const Vec3 centre = a.place.position + armA, p = moves(r.bodyB) ? onB : -onB, linear = turn ? Vec3{} : p;
    BalanceChange& sum = island_.rows.joints.support;
    sum.linear += linear;
    sum.angular += turn ? p : cross(centre, p);
    sum.energy += turn ? dot(p, partner.startSpin)
                       : dot(p, partner.startMove + cross(partner.startSpin, centre - partner.place.position));
  }

  double friction_ = 0;
  std::pmr::vector<Friction> frictions_;
};

}  // namespace

BalanceChange supportAtEnd(const Island& island) { return island.rows.joints.support; }

bool keepsEnergy(const Island& island) { return island.rows.joints.keepEnergy(); }
double heldEnergy(const Island& island) { return island.rows.joints.held(); }

double holdVelocities(Island& island, Ties& ties, StepContext& context) {
  if (!island.plan.holds) return 0;
  return HeldVelocities(island, context).run(ties);
}

}  // namespace brickfall
