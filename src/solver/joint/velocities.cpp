#include "solver/joint/velocities.h"

#include <algorithm>
#include <cmath>

#include "solver/body_matrix.h"
#include "solver/finish/motion.h"
#include "solver/joint/equations.h"
#include "solver/numbering.h"
#include "solver/renewals.h"

namespace brickfall {

namespace {

//! x the load that hangs by it | too small: joints keep a part of their velocity
//! | too large: doubles round
constexpr double kStiff = 1e5;  // in units of mass: of an equation of velocities
//! - | too small: joints keep a part of their velocity | too large: cost
constexpr int kHoldRounds = 2;  // each leaves a part of what the last left

//! of a joint's inertia | too small: chains under a great load are braked
//! | too large: links that an impulse turns far fly apart
constexpr double kLight = 0.1;  // a lighter turn, by the impulse on its arm in a step, is rubbed against
//! of force x radius | too small: swings lose what floats and residuals round | too large: joints may owe energy
constexpr double kForcesRound = 1e-5;
//! of the energy that moves | too small: as a small kForcesRound | too large: what flies apart gains energy
constexpr double kMostOwed = 1e-4;
//! of the work of both halves of a step | too small: wide swings lose energy | too large: snaps return what they took
constexpr double kReturns = 0.5;

class HeldVelocities {
 public:
  HeldVelocities(Island& island, StepContext& context)
      : island_(island),
        context_(context),
        place_(island.bodies.size() + island.partners.size(), kNoPlace, island.memory),
        bodies_(island.memory),
        partners_(island.memory),
        equations_(island.memory),
        frictions_(island.memory),
        step_(island.memory),
        matrix_(island.memory) {}

  // Returns the energy that friction took, J.
  double run(Ties& ties) {
    findBodies();
    findEquations(ties);
    if (equations_.empty() || !hold()) return 0;
    if (findFrictions() && !hold()) return 0;
    const double taken = takeGain(ties);
    tell(ties);
    return taken;
  }

 private:
  // At the end of the step.
  struct Body {
    BodyIndex body = 0;
    JointPlace place;
    Vec3 startMove, startSpin, move, spin;  // m/s, rad/s
    Mat3 inertia, invInertia;
    double mass = 0;
    Vec3 impulse, turning;  // N s, N m s: sums
  };
  // What the joints gave is measured. They may give what they took before, since smooth swings go up and down by a
  // second order. More than that comes from turns that no step can follow: friction takes it.
  double takeGain(Ties& ties) {
    const Gain gain = gainOf(ties);
    const double wound = windUp(ties);
    JointRows& joints = island_.rows.joints;
    double lent = 0, weights = 0;
    for (JointIndex joint : joints.jointOf) lent += ties.joints.slots[joint].lent;
    for (const Body& body : bodies_)
      weights += body.mass * length(context_.gravity) * context_.bodies->mass[body.body].outerRadius;
    const double held = energy();
    const double owed = std::min(kForcesRound * gain.loads, kMostOwed * (held + weights));
    const double sum = gain.sum - wound;
    const double taken = rub(held, sum - lent - owed);
    const double kept = std::min({lent - sum, kReturns * gain.parts, kTrifle * held});
    for (JointIndex joint : joints.jointOf)
      ties.joints.slots[joint].lent = std::max(-owed, kept) / double(joints.size());
    joints.returned = std::clamp(sum, 0.0, lent + owed) + owed + wound;
    return taken;
  }

  // J: work of joints whose length or limits were changed from outside, as far as they went that way.
  double windUp(Ties& ties) {
    double sum = 0;
    const JointRows& joints = island_.rows.joints;
    for (std::uint32_t k = 0; k < joints.size(); k++) {
      Joint& joint = ties.joints.slots[joints.jointOf[k]];
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
      const double gone = turns ? turn : way;
      if (force * gone > 0) sum += std::fabs(force) * std::min(std::fabs(gone), joint.wound);
      joint.wound = std::max(0.0, joint.wound - std::fabs(gone));
    }
    return sum;
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
      assemble();
      if (!matrix_.factor()) return false;
      for (int i = 0; i < kHoldRounds; i++) relax();
      if (!letGo()) break;
    }
    return true;
  }

  // J: what the joints gave in this step, by the mean of the velocities before and after it, and what of it is owed to
  // gravity, which acts along the way that was solved.
  struct Gain {
    double sum = 0, parts = 0, loads = 0;
  };
  Gain gainOf(const Ties& ties) const {
    Gain gain;
    const JointRows& joints = island_.rows.joints;
    for (std::uint32_t k = 0; k < joints.size(); k++) {
      const JointRecord& r = joints.records[k];
      const Joint& joint = ties.joints.slots[joints.jointOf[k]];
      const Body &a = at(r.bodyA), &b = at(r.bodyB);
      const Vec3 wA = mean(r.bodyA, a, true), wB = mean(r.bodyB, b, true);
      const Vec3 w = wB - wA, u = mean(r.bodyB, b, false) + cross(wB, toDouble(r.armB)) - mean(r.bodyA, a, false) -
                                  cross(wA, toDouble(r.armA));
      double sum = 0;
      for (int i = 0; i < kJointLanes; i++) {
        if ((joints.starts[k].hard | joints.starts[k].across) >> i & 1)
          sum += joint.way[i] * dot(toDouble(r.way.axes[i % 3].unit), u);
        if (joints.starts[k].hard >> (i + kJointLanes) & 1)
          sum += joint.turn[i] * dot(toDouble(r.turn.axes[i % 3].unit), w);
      }
      gain.sum += sum * island_.dt;
      gain.parts += std::fabs(sum * island_.dt);
      const double sizeA = moves(r.bodyA) ? context_.bodies->mass[a.body].outerRadius : 1e300,
                   sizeB = moves(r.bodyB) ? context_.bodies->mass[b.body].outerRadius : 1e300;
      gain.loads += length(joint.force) * std::min(sizeA, sizeB) + length(joint.torque);
    }
    for (const Equation& e : equations_) {
      const JointRecord& r = joints.records[e.row];
      const Body &a = at(r.bodyA), &b = at(r.bodyB);
      const Vec3 wA = mean(r.bodyA, a, true), wB = mean(r.bodyB, b, true);
      const Vec3 u = mean(r.bodyB, b, false) + cross(wB, e.armB) - mean(r.bodyA, a, false) - cross(wA, e.armA);
      const double work = e.impulse * dot(e.axis, e.turn ? wB - wA : u);
      gain.sum += work;
      gain.parts += std::fabs(work);
    }
    for (const Body& body : bodies_)
      gain.sum += island_.dt * dot(context_.gravity * context_.bodies->data[body.body].gravityScale +
                                       context_.bodies->data[body.body].force * (1 / body.mass),
                                   (body.move - body.startMove) * body.mass);
    return gain;
  }
  Vec3 mean(std::uint32_t local, const Body& body, bool spin) const {
    if (!moves(local)) return spin ? body.startSpin : body.startMove;
    const FreeMotion& free = context_.free[body.body];
    return (spin ? free.startSpin + body.spin : free.startVelocity + body.move) * 0.5;
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
      const double far = f.turn ? lengthSquared(f.free(w)) * h2
                                : lengthSquared(f.free(u)) * h2 / std::max(1e-12, lengthSquared(f.armA + f.armB));
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

  struct Equation {
    std::uint32_t row = 0;
    bool turn = false, oneSided = false;
    float sign = 0;  // of a one-sided force
    Vec3 axis, armA, armB;
    double stiffness = 0, impulse = 0;
    bool open = false;
  };

  Body bodyAt(std::uint32_t local) const {
    const BodySet& bodies = *context_.bodies;
    const std::size_t own = island_.bodies.size();
    Body out;
    out.body = local < own ? island_.bodies[local] : island_.partners[local - own];
    const BodyMotion& m = bodies.motion[out.body];
    JointPlace& place = out.place;
    if (local < own) {
      const SolvedMotion& s = context_.solved[out.body];
      place.position = m.position + s.d;
      place.rotation = rotationAtEnd(out.body, context_);
      const Mat3 end = toMatrix(place.rotation);
      out.inertia = end * bodies.mass[out.body].inertia * transpose(end);
      out.invInertia = end * bodies.mass[out.body].invInertia * transpose(end);
      out.mass = bodies.mass[out.body].mass;
      out.startMove = s.velocity;
      out.startSpin = spinAtEnd(out.body, s.angularMomentum, context_);
    } else {
      place.position = m.position + m.linearVelocity * island_.dt;
      place.rotation = normalized(quatFromRotationVector(m.angularVelocity * island_.dt) * m.rotation);
      out.startMove = m.linearVelocity;
      out.startSpin = m.angularVelocity;
    }
    place.orientation = toMatrix(place.rotation);
    place.localCentre = bodies.data[out.body].localCentre;
    out.move = out.startMove;
    out.spin = out.startSpin;
    return out;
  }

  void findBodies() {
    const std::size_t own = island_.bodies.size();
    const JointRows& joints = island_.rows.joints;
    std::pmr::vector<std::uint32_t> found(island_.memory);
    for (std::size_t k = 0; k < joints.size(); k++)
      for (std::uint32_t local : {joints.records[k].bodyA, joints.records[k].bodyB}) {
        if (place_[local] != kNoPlace) continue;
        if (local >= own) {
          place_[local] = std::uint32_t(partners_.size());
          partners_.push_back(bodyAt(local));
          continue;
        }
        place_[local] = std::uint32_t(found.size());
        found.push_back(local);
      }
    Adjacency near(island_.memory);
    near.fill(std::uint32_t(found.size()), [&](auto visit) {
      for (const JointRecord& r : joints.records)
        if (r.bodyA < own && r.bodyB < own) visit(place_[r.bodyA], place_[r.bodyB]);
    });
    const auto places = nearPlaces(near);
    matrix_.shape(lowestPlaces(near, places));
    bodies_.resize(found.size());
    for (std::size_t i = 0; i < found.size(); i++) {
      bodies_[places[i]] = bodyAt(found[i]);
      place_[found[i]] = places[i];
    }
    step_.resize(6 * bodies_.size());
  }

  bool moves(std::uint32_t local) const { return local < island_.bodies.size(); }
  const Body& at(std::uint32_t local) const { return moves(local) ? bodies_[place_[local]] : partners_[place_[local]]; }

  void findEquations(const Ties& ties) {
    const JointRows& joints = island_.rows.joints;
    for (std::uint32_t k = 0; k < joints.size(); k++) {
      const JointRecord& r = joints.records[k];
      const Joint& joint = ties.joints.slots[joints.jointOf[k]];
      const Body &a = at(r.bodyA), &b = at(r.bodyB);
      const JointPose pose(joint, a.place, b.place);
      const JointSystem system = equationsOf(joint, pose);
      // Impulses act at one place on both: they change no angular momentum.
      const double middle = 0.5 * (system.onA + system.onB);
      const Vec3 armA = pose.armA + pose.way * middle, armB = pose.armB - pose.way * (1 - middle);
      const double firm = kStiff * double(joints.starts[k].load);
      const double size = std::max(moves(r.bodyA) ? context_.bodies->mass[a.body].outerRadius : 0,
                                   moves(r.bodyB) ? context_.bodies->mass[b.body].outerRadius : 0);
      auto add = [&](const EquationSet& set, const double(&held)[kJointLanes], bool turn) {
        for (int i = 0; i < kJointLanes; i++) {
          const JointLaw law = set.of[i].law;
          const bool hard = law == JointLaw::hard, limit = law == JointLaw::atMost || law == JointLaw::atLeast;
          if (!hard && !(limit && held[i] != 0)) continue;
          equations_.push_back({k, turn, limit, law == JointLaw::atMost ? -1.0f : 1.0f, set.axes[i % 3], armA, armB,
                                turn ? firm * size * size : firm});
        }
      };
      add(system.way, joint.way, false);
      add(system.turn, joint.turn, true);
    }
  }

  // m/s or rad/s: of B against A.
  double speedOf(const Equation& e) const {
    const JointRecord& r = island_.rows.joints.records[e.row];
    const Body &a = at(r.bodyA), &b = at(r.bodyB);
    if (e.turn) return dot(e.axis, b.spin - a.spin);
    return dot(e.axis, (b.move + cross(b.spin, e.armB)) - (a.move + cross(a.spin, e.armA)));
  }

  void assemble() {
    matrix_.clear();
    for (std::uint32_t i = 0; i < bodies_.size(); i++) {
      BodyBlock block = {};
      for (int k = 0; k < 3; k++) {
        block[k][k] = bodies_[i].mass;
        for (int j = 0; j < 3; j++) block[3 + k][3 + j] = bodies_[i].inertia.row[k][j];
      }
      matrix_.add(i, i, block);
    }
    for (std::size_t first = 0, end = 0; first < equations_.size(); first = end) {
      BodyBlock K = {}, block;
      for (end = first; end < equations_.size() && equations_[end].row == equations_[first].row; end++) {
        const Equation& e = equations_[end];
        if (e.open) continue;
        const int corner = e.turn ? 3 : 0;
        for (int i = 0; i < 3; i++)
          for (int j = 0; j < 3; j++) K[corner + i][corner + j] += e.stiffness * e.axis[i] * e.axis[j];
      }
      for (const Friction& f : frictions_) {
        if (f.row != equations_[first].row) continue;
        const int corner = f.turn ? 3 : 0;
        for (int i = 0; i < 3; i++) {
          Vec3 unit;
          unit[i] = 1;
          const Vec3 column = f.free(unit);
          for (int j = 0; j < 3; j++) K[corner + i][corner + j] += (friction_ * f.stiffness + f.always) * column[j];
        }
      }
      const JointRecord& r = island_.rows.joints.records[equations_[first].row];
      const Vec3 armA = equations_[first].armA, armB = equations_[first].armB;
      if (moves(r.bodyA)) {
        congruence(K, armA, armA, 1, block);
        matrix_.add(place_[r.bodyA], place_[r.bodyA], block);
      }
      if (moves(r.bodyB)) {
        congruence(K, armB, armB, 1, block);
        matrix_.add(place_[r.bodyB], place_[r.bodyB], block);
      }
      if (!moves(r.bodyA) || !moves(r.bodyB)) continue;
      const bool aFirst = place_[r.bodyA] < place_[r.bodyB];
      congruence(K, aFirst ? armB : armA, aFirst ? armA : armB, -1, block);
      matrix_.add(std::max(place_[r.bodyA], place_[r.bodyB]), std::min(place_[r.bodyA], place_[r.bodyB]), block);
    }
  }

  // Sums an impulse along an equation's axis, on B and back on A.
  template <class Give> void give(const Equation& e, double impulse, Give giveTo) const {
    const JointRecord& r = island_.rows.joints.records[e.row];
    const Vec3 p = e.axis * impulse;
    const Vec3 linear = e.turn ? Vec3{} : p;
    if (moves(r.bodyA)) giveTo(place_[r.bodyA], -linear, e.turn ? -p : cross(e.armA, -p));
    if (moves(r.bodyB)) giveTo(place_[r.bodyB], linear, e.turn ? p : cross(e.armB, p));
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
    std::fill(step_.begin(), step_.end(), 0.0);
    for (const Equation& e : equations_) {
      if (e.open) continue;
      give(e, -e.stiffness * speedOf(e), [&](std::uint32_t place, Vec3 linear, Vec3 angular) {
        for (int k = 0; k < 3; k++) {
          step_[6 * place + std::size_t(k)] += linear[k];
          step_[6 * place + 3 + std::size_t(k)] += angular[k];
        }
      });
    }
    for (const Friction& f : frictions_)
      giveAll(f, frictionOf(f) - f.impulse, [&](std::uint32_t place, Vec3 linear, Vec3 angular) {
        for (int k = 0; k < 3; k++) {
          step_[6 * place + std::size_t(k)] += linear[k];
          step_[6 * place + 3 + std::size_t(k)] += angular[k];
        }
      });
    matrix_.solve(step_.data());
    for (std::size_t i = 0; i < bodies_.size(); i++)
      for (int k = 0; k < 3; k++) {
        bodies_[i].move[k] += step_[6 * i + std::size_t(k)];
        bodies_[i].spin[k] += step_[6 * i + 3 + std::size_t(k)];
        bodies_[i].impulse = bodies_[i].turning = {};
      }
    for (Equation& e : equations_) {
      if (e.open) continue;
      e.impulse -= e.stiffness * speedOf(e);
    }
    for (Equation& e : equations_)
      give(e, e.impulse, [&](std::uint32_t place, Vec3 linear, Vec3 angular) {
        bodies_[place].impulse += linear;
        bodies_[place].turning += angular;
      });
    for (Friction& f : frictions_) {
      f.impulse = frictionOf(f);
      giveAll(f, f.impulse, [&](std::uint32_t place, Vec3 linear, Vec3 angular) {
        bodies_[place].impulse += linear;
        bodies_[place].turning += angular;
      });
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
      Joint& joint = ties.joints.slots[island_.rows.joints.jointOf[e.row]];
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

  Island& island_;
  StepContext& context_;
  double friction_ = 0;
  std::pmr::vector<std::uint32_t> place_;  // of a body in the matrix, of a partner in its list
  std::pmr::vector<Body> bodies_;          // by place
  std::pmr::vector<Body> partners_;
  std::pmr::vector<Equation> equations_;  // by row
  std::pmr::vector<Friction> frictions_;
  std::pmr::vector<double> step_;
  BlockEnvelope matrix_;
};

}  // namespace

BalanceChange supportAtEnd(const Island& island) { return island.rows.joints.support; }

double holdVelocities(Island& island, Ties& ties, StepContext& context) {
  if (!island.plan.arcs) return 0;
  return HeldVelocities(island, context).run(ties);
}

}  // namespace brickfall
