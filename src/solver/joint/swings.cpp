#include "solver/joint/swings.h"

#include <algorithm>
#include <cmath>

#include "solver/finish/motion.h"
#include "solver/joint/velocity_system.h"

namespace brickfall {

namespace {

//! x sqrt(gravity x radius) | too small: bridges swing by millimetres for ever | too large: small swings lose amplitude
constexpr double kFades = 0.012;  // swings that were not faster lately fade
//! s, at the reference's scale | too small: swings fade where they turn back | too large: what hangs moves on for long
constexpr double kFadingTime = 8;  // in which the memory of a faster speed fades; speeds themselves in a second

class Swings : VelocitySystem {
 public:
  Swings(Island& island, StepContext& context) : VelocitySystem(island, context) {}

  // Half of a step's forces, where the step ends: velocities become those of that moment.
  void run(Ties& ties) {
    findBodies();
    findEquations(ties);
    addMotors(ties);
    const std::size_t hard = equations_.size();
    addResisting();
    resist();
    assemble([](std::uint32_t, BodyBlock&) {});
    if (!factor()) return;
    const bool sprung = pushHalf(ties, true);
    findChange(hard);
    rememberHalf();
    rememberWhole(ties);
    // A spring that just began to act has no half to give yet.
    if (sprung && begins()) {
      pushHalf(ties, false);
      findChange(hard);
    }
    for (std::uint32_t i = 0; i < island_.bodies.size(); i++) {
      if (place_[i] == kNoPlace || flies(i)) continue;
      const Body& body = bodies_[place_[i]];
      const Mat3 end = toMatrix(body.place.rotation);
      accelerate(body.body, body.move, end * context_.bodies->mass[body.body].inertia * transpose(end) * body.spin,
                 context_);
    }
  }

 private:
  // A body of which no change of velocity is remembered.
  bool begins() const {
    return std::any_of(bodies_.begin(), bodies_.end(),
                       [&](const Body& body) { return context_.bodies->data[body.body].steady.dt == 0; });
  }
  bool begins(std::uint32_t local) const {
    return !moves(local) || (context_.bodies->data[at(local).body].steady.dt == 0 && !flies(local));
  }
  // In the first step of a swing half of what holds places acts, and half at its end: joints tell the whole. Springs
  // and motors gave theirs.
  void rememberWhole(Ties& ties) {
    const JointRows& joints = island_.rows.joints;
    for (std::size_t k = 0; k < joints.size(); k++) {
      if (!begins(joints.records[k].bodyA) || !begins(joints.records[k].bodyB)) continue;
      Joint& joint = ties.joints.slots[joints.jointOf[k]];
      const JointRecord& r = joints.records[k];
      for (int i = 0; i < kJointLanes; i++) {
        auto tell = [&](int lane, double& force, const JointEquations& of, Vec3& sum) {
          if (!(joints.starts[k].hard >> lane & 1)) return;
          sum += toDouble(of.axes[i % 3].unit) * force;
          force *= 2;
        };
        tell(i, joint.way[i], r.way, joint.force);
        tell(i + kJointLanes, joint.turn[i], r.turn, joint.torque);
      }
    }
  }
  void rememberHalf() {
    for (std::uint32_t i = 0; i < island_.bodies.size(); i++) {
      if (place_[i] == kNoPlace || flies(i)) continue;
      const Body& body = bodies_[place_[i]];
      SteadyChange change;
      change.linear = body.move * (2 / island_.dt), change.angular = body.spin * (2 / island_.dt);
      change.dt = island_.dt;
      change.swings = true;
      rememberSteady(body.body, change, context_);
    }
  }
  // Inertia with what resists turns in the solve.
  void resist() {
    const double h2 = island_.dt * island_.dt;
    for (std::uint32_t i = 0; i < island_.bodies.size(); i++) {
      if (place_[i] == kNoPlace) continue;
      const float* m = island_.masses[i].inertia;
      const Vec3 rows[3] = {{double(m[0]), double(m[1]), double(m[3])},
                            {double(m[1]), double(m[2]), double(m[4])},
                            {double(m[3]), double(m[4]), double(m[5])}};
      for (int r = 0; r < 3; r++) bodies_[place_[i]].inertia.row[r] = rows[r] * h2;
    }
  }
  // Impulses of outside forces, and of springs, over half of the step. True if there are springs.
  bool pushHalf(const Ties& ties, bool springs) {
    clear();
    for (std::uint32_t i = 0; i < island_.bodies.size(); i++) {
      if (place_[i] == kNoPlace || flies(i)) continue;
      const Body& body = bodies_[place_[i]];
      const BodyData& data = context_.bodies->data[body.body];
      push(place_[i], (context_.gravity * (body.mass * data.gravityScale) + data.force) * (0.5 * island_.dt),
           data.torque * (0.5 * island_.dt));
    }
    return springs && pushSprings(ties);
  }
  // The change of velocities that these impulses and the equations give.
  void findChange(std::size_t hard) {
    for (Body& body : bodies_) body.move = body.spin = {};
    for (int round = 0; round < kHoldRounds; round++) {
      if (round > 0) clear();
      for (std::size_t i = 0; i < hard && round > 0; i++)
        give(equations_[i], -equations_[i].stiffness * speedOf(equations_[i]),
             [&](std::uint32_t place, Vec3 linear, Vec3 angular) { push(place, linear, angular); });
      solveMore();
    }
  }
  // Those that are strong enough hold a speed; others give what they can, whatever moves.
  void addMotors(const Ties& ties) {
    const JointRows& joints = island_.rows.joints;
    for (std::uint32_t k = 0; k < joints.size(); k++) {
      const Joint& joint = ties.joints.slots[joints.jointOf[k]];
      const bool turn = joint.type == JointType::revolute;
      if (!joint.driven || !(std::fabs(turn ? joint.turn[0] : joint.way[0]) < (1 - kTrifle) * joint.strength)) continue;
      const Posed p = posed(k, joint);
      equations_.push_back(
          {k, turn, false, 0, turn ? p.system.turn.axes[0] : p.system.way.axes[0], p.armA, p.armB, firmness(k, turn)});
    }
  }
  // What resists a motion in the solve resists it here: lines a way across them, brakes a turn.
  void addResisting() {
    const JointRows& joints = island_.rows.joints;
    const double h2 = island_.dt * island_.dt;
    for (std::uint32_t k = 0; k < joints.size(); k++) {
      const JointRecord& r = joints.records[k];
      auto add = [&](bool turn, Vec3f axis, float stiffness) {
        equations_.push_back(
            {k, turn, false, 0, toDouble(axis), toDouble(r.armA), toDouble(r.armB), double(stiffness) * h2});
      };
      for (int i = 0; i < 3; i++) {
        if (joints.starts[k].across >> i & 1) add(false, r.way.axes[i].unit, r.way.k[i]);
        if (brakes(k, i)) add(true, r.turn.axes[i].unit, r.turn.k[i]);
      }
    }
  }
  bool brakes(std::uint32_t k, int lane) const {
    const JointRows& joints = island_.rows.joints;
    const int at = lane + kJointLanes;
    return !((joints.starts[k].hard | joints.starts[k].follows) >> at & 1) && joints.records[k].turn.k[lane] > 0;
  }
  bool flies(std::uint32_t local) const { return island_.groups.flies(island_.groups.groupOf(local)); }

  // Springs, by their force where the step ends; those too fast for the step have given all of it.
  bool pushSprings(const Ties& ties) {
    bool any = false;
    const JointRows& joints = island_.rows.joints;
    for (std::uint32_t k = 0; k < joints.size(); k++) {
      const Joint& joint = ties.joints.slots[joints.jointOf[k]];
      if (joint.type != JointType::spring && joint.type != JointType::drag) continue;
      any = true;
      const JointRecord& r = joints.records[k];
      const Body &a = this->at(r.bodyA), &b = this->at(r.bodyB);
      const Posed at = posed(k, joint);
      const EquationSet& set = at.system.way;
      const Vec3 speed = b.startMove + cross(b.startSpin, at.armB) - a.startMove - cross(a.startSpin, at.armA);
      const double slowed = joint.damping / (1 + joint.damping / (2 * double(joints.starts[k].inert) * island_.dt));
      Vec3 force;
      for (int i = 0; i < 3; i++)
        if (set.of[i].law == JointLaw::spring)
          force -= set.axes[i] *
                   (joint.stiffness * joints.resolved(k, joint) * set.of[i].error + slowed * dot(set.axes[i], speed));
      if (joint.type == JointType::drag && length(force) > joint.strength) force *= joint.strength / length(force);
      const Vec3 p = force * (0.5 * island_.dt);
      if (moves(r.bodyA) && !flies(r.bodyA)) push(place_[r.bodyA], -p, cross(at.armA, -p));
      if (moves(r.bodyB) && !flies(r.bodyB)) push(place_[r.bodyB], p, cross(at.armB, p));
    }
    return any;
  }
};

}  // namespace

void finishSwings(Island& island, Ties& ties, StepContext& context) { Swings(island, context).run(ties); }

bool isDriven(const Island& island, const StepContext& context) { return island.rows.joints.driven(*context.ties); }

void fadeSwing(Island& island, const StepContext& context, BodySet& bodies) {
  const double part = std::min(1.0, island.dt / island.facts.scale.time);
  island.fastestLately *= 1 - part / kFadingTime;
  for (BodyIndex body : island.bodies) {
    const double radius = bodies.mass[body].outerRadius;
    const double speed =
        std::max(length(bodies.motion[body].linearVelocity), length(bodies.motion[body].angularVelocity) * radius);
    const double unit = std::sqrt(length(context.gravity) * radius);
    if (!(speed <= island.fastestLately * unit)) island.fastestLately = unit > 0 ? std::min(1.0, speed / unit) : 1;
  }
  if (!island.facts.grounded || !(island.fastestLately <= kFades)) return;
  if (isDriven(island, context)) return;
  for (BodyIndex body : island.bodies) {
    bodies.motion[body].linearVelocity *= 1 - part;
    bodies.motion[body].angularVelocity *= 1 - part;
  }
}

}  // namespace brickfall
