#include "solver/joint/velocity_system.h"

#include <algorithm>
#include <utility>

#include "solver/finish/motion.h"
#include "solver/joint/spins.h"
#include "solver/support.h"

namespace brickfall {

//! x the load that hangs by it | too small: joints keep a part of their velocity
//! | too large: doubles round
constexpr double kStiff = 1e5;  // in units of mass: of an equation of velocities

JointPlace placeAtEnd(const Island& island, std::uint32_t local, const StepContext& context) {
  const BodyIndex body = bodyOf(island, local);
  const BodyMotion& m = context.bodies->motion[body];
  JointPlace place;
  if (local < island.bodies.size()) {
    place.position = m.position + context.solved[body].d;
    place.rotation = rotationAtEnd(body, context);
  } else {
    place.position = m.position + m.linearVelocity * island.dt;
    place.rotation = normalized(quatFromRotationVector(m.angularVelocity * island.dt) * m.rotation);
  }
  place.orientation = toMatrix(place.rotation);
  place.localCentre = context.bodies->data[body].localCentre;
  return place;
}

VelocitySystem::VelocitySystem(Island& island, StepContext& context)
    : island_(island),
      context_(context),
      place_(island.bodies.size() + island.partners.size(), kNoPlace, island.memory),
      bodies_(island.memory),
      partners_(island.memory),
      equations_(island.memory),
      matrix_(island.memory),
      step_(island.memory) {}

VelocitySystem::Body VelocitySystem::bodyAt(std::uint32_t local) const {
  const BodySet& bodies = *context_.bodies;
  Body out;
  out.body = bodyOf(island_, local);
  out.place = placeAtEnd(island_, local, context_);
  if (moves(local)) {
    const SolvedMotion& s = context_.solved[out.body];
    const Mat3& end = out.place.orientation;
    out.inertia = end * bodies.mass[out.body].inertia * transpose(end);
    out.invInertia = end * bodies.mass[out.body].invInertia * transpose(end);
    out.mass = bodies.mass[out.body].mass;
    out.startMove = s.velocity;
    out.startSpin = bodies.spinAt(out.body, end, s.angularMomentum);
  } else {
    out.startMove = bodies.motion[out.body].linearVelocity;
    out.startSpin = bodies.motion[out.body].angularVelocity;
  }
  out.move = out.startMove;
  out.spin = out.startSpin;
  return out;
}

// Of a large island only what lies on a jointed body and is heavier, as in its solve (solver/joint_block.h).
void VelocitySystem::enterLoads(std::pmr::vector<std::uint32_t>& found) {
  const std::size_t own = island_.bodies.size();
  auto enter = [&](std::uint32_t local) {
    place_[local] = std::uint32_t(found.size());
    found.push_back(local);
  };
  auto massOf = [&](std::uint32_t local) { return context_.bodies->mass[island_.bodies[local]].mass; };
  auto presses = [&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    return ends.a < own && ends.b < own && kind.ties(k, context_);
  };
  std::pmr::vector<char> jointed(own + island_.partners.size(), 0, island_.memory);
  for (std::uint32_t local : found) jointed[local] = 1;
  if (!island_.plan.large) {
    growSupported(island_, jointed, presses);
    for (std::uint32_t local = 0; local < own; local++)
      if (jointed[local] && place_[local] == kNoPlace) enter(local);
    return;
  }
  std::as_const(island_.rows).each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    auto lies = [&](std::uint32_t load, std::uint32_t under) {
      return jointed[under] && place_[load] == kNoPlace && massOf(load) > massOf(under);
    };
    if (!presses(kind, k)) return;
    if (lies(ends.a, ends.b)) enter(ends.a);
    if (lies(ends.b, ends.a)) enter(ends.b);
  });
}

void VelocitySystem::findBodies(bool loads) {
  const std::size_t own = island_.bodies.size();
  const JointRows& joints = island_.rows.joints;
  std::pmr::vector<std::uint32_t> found(island_.memory);
  found.reserve(own);
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
  if (loads) enterLoads(found);
  Adjacency near(island_.memory);
  near.fill(std::uint32_t(found.size()), [&](auto visit) {
    std::as_const(island_.rows).each([&]<class Kind>(const Kind& kind, std::size_t k) {
      if (!loads && !Kind::kLasts) return;
      const RowEnds ends = kind.ends(k);
      if (ends.a < own && ends.b < own && place_[ends.a] != kNoPlace && place_[ends.b] != kNoPlace)
        visit(place_[ends.a], place_[ends.b]);
    });
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

double VelocitySystem::firmness(std::size_t row, bool turn) const {
  const JointRecord& r = island_.rows.joints.records[row];
  auto radius = [&](std::uint32_t local) {
    return moves(local) ? context_.bodies->mass[at(local).body].outerRadius : 0.0;
  };
  const double size = std::max(radius(r.bodyA), radius(r.bodyB)),
               firm = kStiff * double(island_.rows.joints.starts[row].load);
  return turn ? firm * size * size : firm;
}

VelocitySystem::Posed VelocitySystem::posed(std::size_t row, const Joint& joint) const {
  const JointRecord& r = island_.rows.joints.records[row];
  const JointPose pose = withSpins({joint, at(r.bodyA).place, at(r.bodyB).place}, joint, *context_.bodies, island_.dt);
  const JointSystem system = equationsOf(joint, pose);
  // What flies keeps its angular momentum: impulses act at one place on both.
  const bool flies = island_.groups.flies(island_.groups.groupOf(moves(r.bodyA) ? r.bodyA : r.bodyB));
  const double middle = 0.5 * (system.onA + system.onB);
  return {pose, system, pose.armA + pose.way * (flies ? middle : system.onA),
          pose.armB - pose.way * (1 - (flies ? middle : system.onB))};
}

void VelocitySystem::findEquations(const Ties& ties) {
  const JointRows& joints = island_.rows.joints;
  equations_.reserve(6 * joints.size());
  for (std::uint32_t k = 0; k < joints.size(); k++) {
    const Joint& joint = joints.at(k, ties);
    const Posed p = posed(k, joint);
    auto add = [&](const EquationSet& set, const double(&held)[kJointLanes], bool turn) {
      for (int i = 0; i < kJointLanes; i++) {
        const JointLaw law = set.of[i].law;
        const bool hard = law == JointLaw::hard, limit = law == JointLaw::atMost || law == JointLaw::atLeast;
        if (!hard && !(limit && held[i] != 0)) continue;
        equations_.push_back({k, turn, limit, law == JointLaw::atMost ? -1.0f : 1.0f, set.axes[i % 3], p.armA, p.armB,
                              firmness(k, turn)});
      }
    };
    add(p.system.way, joint.way, false);
    add(p.system.turn, joint.turn, true);
  }
}

VelocitySystem::Speeds VelocitySystem::speedsOf(const Equation& e) const {
  const JointRecord& r = island_.rows.joints.records[e.row];
  const Body &a = at(r.bodyA), &b = at(r.bodyB);
  return {(b.move + cross(b.spin, e.armB)) - (a.move + cross(a.spin, e.armA)), b.spin - a.spin};
}

void VelocitySystem::clearToInertia() {
  matrix_.clear();
  for (std::uint32_t i = 0; i < bodies_.size(); i++) {
    BodyBlock block = {};
    for (int k = 0; k < 3; k++) {
      block[k][k] = bodies_[i].mass;
      for (int j = 0; j < 3; j++) block[3 + k][3 + j] = bodies_[i].inertia.row[k][j];
    }
    matrix_.add(i, i, block);
  }
}

// Returns the first equation of the next row.
std::size_t VelocitySystem::sumOfRow(std::size_t first, BodyBlock& K) const {
  std::size_t end = first;
  for (; end < equations_.size() && equations_[end].row == equations_[first].row; end++) {
    const Equation& e = equations_[end];
    if (e.open) continue;
    const int corner = e.turn ? 3 : 0;
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) K[corner + i][corner + j] += e.stiffness * e.axis[i] * e.axis[j];
  }
  return end;
}

void VelocitySystem::addRow(const Equation& of, const BodyBlock& K) {
  const JointRecord& r = island_.rows.joints.records[of.row];
  addTie(matrix_, K, {placeOf(r.bodyA), of.armA}, {placeOf(r.bodyB), of.armB});
}

void VelocitySystem::solveMore() {
  matrix_.solve(step_.data());
  for (std::size_t i = 0; i < bodies_.size(); i++)
    for (int k = 0; k < 3; k++) {
      bodies_[i].move[k] += step_[6 * i + std::size_t(k)];
      bodies_[i].spin[k] += step_[6 * i + 3 + std::size_t(k)];
    }
}

}  // namespace brickfall
