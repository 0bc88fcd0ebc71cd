#include "solver/joint/swings.h"

#include <algorithm>
#include <cmath>

#include "solver/finish/motion.h"
#include "solver/joint/springs.h"
#include "solver/joint/velocity_system.h"
#include "solver/renewals.h"

namespace brickfall {

namespace {

//! x sqrt(gravity x radius) | too small: bridges swing by millimetres for ever | too large: small swings lose amplitude
constexpr double kFades = 0.012;  // swings that were not faster lately fade
//! s, at the reference's scale | too small: swings fade where they turn back | too large: what hangs moves on for long
constexpr double kFadingTime = 3;  // in which the memory of a faster speed fades; speeds themselves in a second

// By outside forces alone.
SteadyChange outsideChange(const BodySet& bodies, BodyIndex body, Vec3 gravity) {
  const BodyData& data = bodies.data[body];
  SteadyChange change;
  change.linear = gravity * data.gravityScale + data.force * bodies.mass[body].invMass;
  change.angular = bodies.worldInvInertia(body) * data.torque;
  change.swings = true;
  return change;
}

class Swings : VelocitySystem {
 public:
  Swings(Island& island, StepContext& context)
      : VelocitySystem(island, context), others_(island.memory), motors_(island.memory) {}

  // Half of a step's forces, where the step ends: velocities become those of that moment.
  void run(Ties& ties) {
    findBodies(true);
    findEquations(ties);
    addMotors(ties);
    addResisting();
    findOthers();
    resist();
    if (!findHalf(ties)) return;
    rememberHalf();
    rememberWhole(ties);
    island_.rows.joints.hold(heldEnergy());
    for (std::uint32_t i = 0; i < island_.bodies.size(); i++) {
      if (place_[i] == kNoPlace || flies(i)) continue;
      const Body& body = bodies_[place_[i]];
      const Mat3 end = toMatrix(body.place.rotation);
      accelerate(body.body, body.move, end * context_.bodies->mass[body.body].inertia * transpose(end) * body.spin,
                 context_);
    }
  }

 private:
  // A row of another kind on a body of the system. It gives half of what it gave in the step: so what is at rest stays.
  // Where that would part its bodies, it holds them as firmly as joints do: the rest of its force was an impact's.
  struct OtherRow {
    RowEnds ends;
    Vec3 armA, armB, force, torque;  // N, N m: on B
    BodyBlock stiffness = {};        // in units of mass
    enum { holds, gives, open } state = gives;
    double impulse[6] = {}, last[6] = {};  // N s, N m s: all, and of the last round
  };
  void findOthers() {
    const double h2 = kFirmness * island_.dt * island_.dt;
    std::as_const(island_.rows).each([&]<class Kind>(const Kind& kind, std::size_t k) {
      if (Kind::kLasts || !kind.ties(k, context_)) return;
      const RowEnds ends = kind.ends(k);
      if (placeOf(ends.a) == kNoPlace && placeOf(ends.b) == kNoPlace) return;
      const StiffReaction x = kind.reactStiff(k, island_.motion.data(), Resist::exactly);
      OtherRow s{ends, toDouble(wide::store3(x.armA)), toDouble(wide::store3(x.armB)), toDouble(wide::store3(x.force)),
                 toDouble(wide::store3(x.torque))};
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
          s.stiffness[i][j] = h2 * double(x.stiffness.A[i][j]);
          s.stiffness[i][j + 3] = s.stiffness[j + 3][i] = h2 * double(x.stiffness.B[i][j]);
          s.stiffness[i + 3][j + 3] = h2 * double(x.stiffness.C[i][j]);
        }
      others_.push_back(s);
    });
  }
  void addOthers() {
    for (const OtherRow& s : others_) {
      if (s.state != OtherRow::holds) continue;
      addTie(matrix_, s.stiffness, {placeOf(s.ends.a), s.armA}, {placeOf(s.ends.b), s.armB});
    }
  }
  // What rows give that gave less, or what those that hold are still to give.
  void pushOthers(bool holding) {
    const double half = 0.5 * island_.dt;
    for (const OtherRow& s : others_) {
      if (s.state != (holding ? OtherRow::holds : OtherRow::gives)) continue;
      const Vec3 p = holding ? Vec3{s.last[0], s.last[1], s.last[2]} : s.force * half;
      const Vec3 t = holding ? Vec3{s.last[3], s.last[4], s.last[5]} : s.torque * half;
      if (const std::uint32_t a = placeOf(s.ends.a); a != kNoPlace) push(a, -p, -t - cross(s.armA, p));
      if (const std::uint32_t b = placeOf(s.ends.b); b != kNoPlace) push(b, p, t + cross(s.armB, p));
    }
  }
  // What the change of velocities asks of those that hold.
  void holdOthers() {
    for (OtherRow& s : others_) {
      if (s.state != OtherRow::holds) continue;
      auto changeAt = [&](std::uint32_t local, Vec3 arm, double(&out)[6], double sign) {
        if (placeOf(local) == kNoPlace) return;
        const Body& body = at(local);
        const Vec3 move = body.move + cross(body.spin, arm);
        for (int k = 0; k < 3; k++) out[k] += sign * move[k], out[k + 3] += sign * body.spin[k];
      };
      double change[6] = {};
      changeAt(s.ends.b, s.armB, change, 1);
      changeAt(s.ends.a, s.armA, change, -1);
      for (int i = 0; i < 6; i++) {
        s.last[i] = 0;
        for (int j = 0; j < 6; j++) s.last[i] -= s.stiffness[i][j] * change[j];
        s.impulse[i] += s.last[i];
      }
    }
  }
  // W: of the force that the row gave in the step, by the changes of velocity. Above 0, its bodies part.
  double powerOf(const OtherRow& s) const {
    double sum = 0;
    auto add = [&](std::uint32_t local, Vec3 arm, double sign) {
      if (placeOf(local) == kNoPlace) return;
      const Body& body = at(local);
      sum += sign * (dot(s.force, body.move + cross(body.spin, arm)) + dot(s.torque, body.spin));
    };
    add(s.ends.b, s.armB, 1);
    add(s.ends.a, s.armA, -1);
    return sum;
  }
  // True if any row changed. One that parts its bodies holds them instead; one that pulls where it pressed opens, until
  // they meet; one that pushes by more than half of what it gave gives just that.
  bool boundOthers() {
    bool any = false;
    for (OtherRow& s : others_) {
      const double half = 0.5 * island_.dt;
      const double given = dot(Vec3{s.impulse[0], s.impulse[1], s.impulse[2]}, s.force), parts = powerOf(s);
      const double most = half * lengthSquared(s.force);
      const double slowly = kTrifle * half * length(s.force) * length(context_.gravity);
      const auto before = s.state;
      if (s.state == OtherRow::gives && parts > slowly)
        s.state = OtherRow::holds;
      else if (s.state == OtherRow::open && parts < -slowly)
        s.state = OtherRow::holds;
      else if (s.state == OtherRow::holds && given < -kTrifle * most)
        s.state = OtherRow::open;
      else if (s.state == OtherRow::holds && given > (1 + kTrifle) * most)
        s.state = OtherRow::gives;
      any = any || s.state != before;
    }
    return any;
  }

  // The change of velocities over half of the step. False if it has no solution.
  bool findHalf(const Ties& ties) {
    for (int round = 0; round < kBoundRounds; round++) {
      assemble([](std::uint32_t, BodyBlock&) {});
      addOthers();
      if (!factor()) return false;
      pushHalf(ties);
      pushOthers(false);
      pushMotors();
      for (OtherRow& s : others_) std::fill_n(s.impulse, 6, 0.0);
      findChange();
      const bool others = boundOthers(), motors = boundMotors();
      if (!others && !motors) break;
    }
    return true;
  }
  // A body of which no change of velocity is remembered.
  bool beginsAt(std::uint32_t local) const {
    return moves(local) && context_.bodies->data[at(local).body].steady.dt == 0;
  }
  bool begins(std::uint32_t local) const { return !moves(local) || (beginsAt(local) && !flies(local)); }
  // In the first step of a swing half of what holds places or drives acts, and half at its end: joints tell the whole.
  // Springs gave theirs.
  void rememberWhole(Ties& ties) {
    const JointRows& joints = island_.rows.joints;
    for (std::size_t k = 0; k < joints.size(); k++) {
      if (!begins(joints.records[k].bodyA) || !begins(joints.records[k].bodyB)) continue;
      Joint& joint = joints.at(k, ties);
      const JointRecord& r = joints.records[k];
      const std::uint32_t whole = joint.speed == 0 ? joints.starts[k].hard : joints.starts[k].follows;
      for (int i = 0; i < kJointLanes; i++) {
        auto tell = [&](int lane, double& force, const JointEquations& of, Vec3& sum) {
          if (!(whole >> lane & 1)) return;
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
  // J. What a leapfrog keeps is not the energy of the step's end. With v the velocity there, a half of its change in a
  // step, M the inertia and S what resists turns besides, it is v (M + S) v / 2 - a (M + S) a / 2 and the energy of
  // places. This is what it has beside that energy.
  double heldEnergy() const {
    double sum = 0;
    for (const Body& body : bodies_) {
      const Vec3 spin = body.startSpin + body.spin;
      const Mat3 end = toMatrix(body.place.rotation);
      const Vec3 own = end * (context_.bodies->mass[body.body].inertia * (transpose(end) * spin));
      sum += 0.5 * (dot(spin, body.inertia * spin) - dot(spin, own) - body.mass * lengthSquared(body.move) -
                    dot(body.spin, body.inertia * body.spin));
    }
    return sum;
  }
  // Inertia with what resists turns in the solve, turned with the body. Else a thin link has the inertia about its axis
  // that it had where its axis was: spins grow fourfold in a step.
  void resist() {
    const double h2 = island_.dt * island_.dt;
    for (std::uint32_t i = 0; i < island_.bodies.size(); i++) {
      if (place_[i] == kNoPlace) continue;
      const float* m = island_.masses[i].inertia;
      const Vec3 rows[3] = {{double(m[0]), double(m[1]), double(m[3])},
                            {double(m[1]), double(m[2]), double(m[4])},
                            {double(m[3]), double(m[4]), double(m[5])}};
      Body& body = bodies_[place_[i]];
      const Mat3 turned = body.place.orientation * transpose(context_.bodies->motion[body.body].orientation);
      body.inertia = turned * Mat3{{rows[0] * h2, rows[1] * h2, rows[2] * h2}} * transpose(turned);
    }
  }
  // Impulses of outside forces, and of springs, over half of the step.
  void pushHalf(const Ties& ties) {
    clear();
    for (std::uint32_t i = 0; i < island_.bodies.size(); i++) {
      if (place_[i] == kNoPlace || flies(i)) continue;
      const Body& body = bodies_[place_[i]];
      const BodyData& data = context_.bodies->data[body.body];
      push(place_[i], (context_.gravity * (body.mass * data.gravityScale) + data.force) * (0.5 * island_.dt),
           data.torque * (0.5 * island_.dt));
    }
    pushSprings(ties);
  }
  // The change of velocities that these impulses and the equations give.
  void findChange() {
    for (auto* list : {&bodies_, &partners_})
      for (Body& body : *list) body.move = body.spin = {};
    for (int round = 0; round < kHoldRounds; round++) {
      if (round > 0) {
        clear();
        pushOthers(true);
      }
      eachRow(hard_, [&](std::size_t first, std::size_t end) {
        give(first, end, [&](std::uint32_t place, Vec3 linear, Vec3 angular) { push(place, linear, angular); });
      });
      solveMore();
      holdOthers();
      for (Motor& m : motors_) {
        const Equation& e = equations_[m.equation];
        if (!e.open) m.impulse += missing(e, speedsOf(e));
      }
    }
  }
  // A motor leads its joint to its speed, as far as half of its strength does. One without speed rubs: it holds what it
  // held.
  struct Motor {
    std::size_t equation = 0;
    double most = 0, impulse = 0;  // N s, N m s: of half of the step
    double pushes = 0;             // what it gives if it is too weak
  };
  void addMotors(const Ties& ties) {
    const JointRows& joints = island_.rows.joints;
    for (std::uint32_t k = 0; k < joints.size(); k++) {
      const Joint& joint = joints.at(k, ties);
      const JointRecord& r = joints.records[k];
      if (!joint.driven || (moves(r.bodyA) && flies(r.bodyA)) || (moves(r.bodyB) && flies(r.bodyB))) continue;
      const bool turn = joint.type == JointType::revolute, rubs = joint.speed == 0;
      if (rubs && std::fabs(turn ? joint.turn[0] : joint.way[0]) >= (1 - kTrifle) * joint.strength) continue;
      const Posed p = posed(k, joint);
      Equation e{
          k, turn, false, 0, turn ? p.system.turn.axes[0] : p.system.way.axes[0], p.armA, p.armB, firmness(k, turn)};
      const Body &a = at(r.bodyA), &b = at(r.bodyB);
      const Vec3 way = b.startMove + cross(b.startSpin, p.armB) - a.startMove - cross(a.startSpin, p.armA);
      if (!rubs) e.wanted = joint.speed - dot(e.axis, turn ? b.startSpin - a.startSpin : way);
      motors_.push_back({equations_.size(), 0.5 * island_.dt * joint.strength});
      equations_.push_back(e);
    }
    hard_ = equations_.size();
  }
  void pushMotors() {
    for (Motor& m : motors_) {
      m.impulse = 0;
      const Equation& e = equations_[m.equation];
      giveBoth(e, e.turn ? Vec3{} : e.axis * m.pushes, e.turn ? e.axis * m.pushes : Vec3{},
               [&](std::uint32_t place, Vec3 linear, Vec3 angular) { push(place, linear, angular); });
    }
  }
  // True if any was too weak.
  bool boundMotors() {
    bool any = false;
    for (Motor& m : motors_) {
      Equation& e = equations_[m.equation];
      if (e.open || std::fabs(m.impulse) <= m.most) continue;
      e.open = true;
      m.pushes = std::copysign(m.most, m.impulse);
      any = true;
    }
    return any;
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

  void pushSprings(const Ties& ties) {
    const JointRows& joints = island_.rows.joints;
    for (std::size_t k = 0; k < joints.size(); k++) {
      const Joint& joint = joints.at(k, ties);
      if (joint.type != JointType::spring && joint.type != JointType::drag) continue;
      const JointRecord& r = joints.records[k];
      const Body &a = this->at(r.bodyA), &b = this->at(r.bodyB);
      const Posed at = posed(k, joint);
      const Vec3 speed = b.startMove + cross(b.startSpin, at.armB) - a.startMove - cross(a.startSpin, at.armA);
      const Vec3 p = springForce(joints, k, joint, at.system.way, speed, island_.dt) * (0.5 * island_.dt);
      if (moves(r.bodyA) && !flies(r.bodyA)) push(place_[r.bodyA], -p, cross(at.armA, -p));
      if (moves(r.bodyB) && !flies(r.bodyB)) push(place_[r.bodyB], p, cross(at.armB, p));
    }
  }

  std::size_t hard_ = 0;  // equations that hold, and motors
  std::pmr::vector<OtherRow> others_;
  std::pmr::vector<Motor> motors_;
};

}  // namespace

void beginSwings(const Island& island, const StepContext& context, BodySet& bodies) {
  std::pmr::vector<char> jointed(island.bodies.size() + island.partners.size(), 0, island.memory);
  for (const JointRecord& r : island.rows.joints.records) jointed[r.bodyA] = jointed[r.bodyB] = 1;
  // What flew until now has no late velocities of springs: it may go on to fly.
  std::pmr::vector<char> begins(jointed.size(), 0, island.memory);
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    SteadyChange& steady = bodies.data[island.bodies[i]].steady;
    if (steady.swings ? steady.dt > 0 : !jointed[i]) continue;
    begins[i] = island.facts.grounded && !steady.swings;
    steady = outsideChange(bodies, island.bodies[i], context.gravity);
  }
  addSpringsBefore(island, context, begins, bodies);
}

void finishSwings(Island& island, Ties& ties, StepContext& context) { Swings(island, context).run(ties); }

bool isDriven(const Island& island, const StepContext& context) { return island.rows.joints.driven(*context.ties); }

bool hasBounds(const Island& island) {
  auto isBounded = [](const JointEquations& e) {
    for (int i = 0; i < kJointLanes; i++)
      if (e.k[i] > 0 && (e.least[i] == 0 || e.most[i] == 0)) return true;
    return false;
  };
  const auto& records = island.rows.joints.records;
  return std::any_of(records.begin(), records.end(),
                     [&](const JointRecord& r) { return isBounded(r.way) || isBounded(r.turn); });
}

bool hasSwung(const Island& island) { return !(island.fastestLately <= kFades); }

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
  if (!island.facts.grounded || hasSwung(island)) return;
  if (isDriven(island, context)) return;
  for (BodyIndex body : island.bodies) {
    bodies.motion[body].linearVelocity *= 1 - part;
    bodies.motion[body].angularVelocity *= 1 - part;
  }
}

}  // namespace brickfall
