#include "solver/mortar/rows.h"

#include <algorithm>
#include <cmath>

#include "base/assert.h"
#include "solver/face/point_forces.h"
#include "solver/island.h"

namespace brickfall {

namespace {

//! of the kern | too small: more passes | too large: points go further out than the bending needs
constexpr float kWidens = 1;  // so much further go points out in a pass
//! of the firmness | too small: what is about to break moves as if it were loose
//! | too large: cost: thousands of caps are met and left in one solve
constexpr double kLeastFirmness = 0.003;  // of a joint that its bodies' velocities will break

// The points of a joint go out as it is damaged. Forces keep their sum and their moments: a force further out is less.
void placePoints(Mortar& m, const MortarPose& pose) {
  const float arm = std::max(m.arm, mortar::armOf(m.damage)), by = m.arm / arm;
  if (by == 1) return;
  const double k = mortar::stiffnessOf(m);
  auto gapAt = [&](int i, double out, int axis) { return mortar::gapAt(pose, mortar::placeOf(m, i, out))[axis]; };
  float* const places[3] = {m.opening, m.slip1, m.slip2};
  for (int axis = 0; axis < 3; axis++) {
    double force[4], mean = 0;
    for (int i = 0; i < 4; i++) {
      force[i] = -k * (gapAt(i, double(m.arm), axis) - double(places[axis][i]));
      mean += 0.25 * force[i];
    }
    for (int i = 0; i < 4; i++)
      places[axis][i] = float(gapAt(i, double(arm), axis) + (mean + (force[i] - mean) * double(by)) / k);
  }
  m.arm = arm;
}

}  // namespace

void MortarRows::takeRoom(const Island& island, const Ties& ties) {
  if (records.size() == size()) return;
  std::pmr::vector<FaceRecord> fresh(size(), records.get_allocator());
  starts.assign(size(), {});
  for (std::size_t k = 0; k < size(); k++) {
    const RowEnds ends = endsIn(island, ties, k);
    BRICKFALL_ASSERT(ends.a != kNoIndex && ends.b != kNoIndex, "mortar of another island");
    fresh[k].bodyA = ends.a;
    fresh[k].bodyB = ends.b;
    starts[k].before = at(k, ties).force;
  }
  records.swap(fresh);
}

void MortarRows::giveRoom() {
  if (records.empty()) return;
  auto empty = [](auto& list) { std::decay_t<decltype(list)>(list.get_allocator()).swap(list); };
  empty(records);
  empty(starts);
}

RowEnds MortarRows::endsIn(const Island& island, const Ties& ties, std::size_t k) const {
  if (!records.empty()) return ends(k);
  const std::size_t own = island.bodies.size();
  auto localOf = [&](BodyIndex body) {
    const auto place = std::lower_bound(island.bodies.begin(), island.bodies.end(), body);
    if (place != island.bodies.end() && *place == body) return std::uint32_t(place - island.bodies.begin());
    const auto partner = std::find(island.partners.begin(), island.partners.end(), body);
    if (partner == island.partners.end()) return kNoIndex;
    return std::uint32_t(own + std::size_t(partner - island.partners.begin()));
  };
  const Mortar& m = at(k, ties);
  return {localOf(m.bodyA), localOf(m.bodyB)};
}

RowGrip MortarRows::grip(std::size_t k, const StepContext& context) const {
  Vec3 force = toDouble(at(k, *context.ties).force);
  if (force == Vec3{}) force = {0, 1e-30, 0};
  return {force, double(kLargestPointForce)};
}

void MortarRows::writeCaps(std::size_t k, const Mortar& m) {
  FaceRecord& r = records[k];
  const MortarStart& start = starts[k];
  const double left = std::min(double(start.left), mortar::pullLeft(m.damage, start.arm));
  const float pull = float(left * mortar::pullOf(m));
  // Pulled no harder than its cap lets it be, or it would slide for nothing.
  const double pressure = std::max(double(start.pressure), -double(pull));
  const float shear = float(double(start.left) * mortar::shearOf(m) + double(m.shared->friction) * pressure);
  for (int i = 0; i < 4; i++) {
    r.leastN[i] = -pull;
    r.limit[i] = std::max(0.0f, shear);
  }
}

void mortar::addHolding(const Mortar& m, const BodySet& bodies, Vec3 along, Holding& out) {
  const double pull = std::fabs(dot(MortarPose(m, bodies).n, along)), left = mortar::strengthOf(m);
  const double shear = std::sqrt(std::max(0.0, 1 - pull * pull));
  out.force += left * kMortarPoints * (pull * mortar::pullOf(m) + shear * mortar::shearOf(m));
  out.energy += (1 - m.damage) * (pull * pull * mortar::pullEnergy(m) + shear * shear * mortar::shearEnergy(m));
}

// A joint that goes on opening after a blow still owes what the blow crushes. As if it had been intact: all of that is
// owed from its damage on (mortar::energyLeft).
void MortarRows::takeCrushes(const Island& island, const Ties& ties) {
  for (std::size_t k = 0; k < size(); k++) starts[k].tougher = at(k, ties).tougher;
  if (island.blows.crushes.empty()) return;
  std::pmr::vector<float> tougher(island.bodies.size() + island.partners.size(), 1, island.memory);
  for (const Crush& crush : island.blows.crushes)
    tougher[crush.body] = std::max(tougher[crush.body], float(crush.tougher));
  for (std::size_t k = 0; k < size(); k++) {
    const double owed = double(std::max(tougher[records[k].bodyA], tougher[records[k].bodyB])) - 1;
    starts[k].tougher = std::max(starts[k].tougher, float(1 + owed / std::max(1 - at(k, ties).damage, kTrifle)));
  }
}

void MortarRows::prepare(Island& island, Ties& ties, const StepContext& context) {
  for (std::size_t k = 0; k < size(); k++) {
    Mortar& m = at(k, ties);
    const MortarPose pose(m, *context.bodies);
    placePoints(m, pose);
    writeFace(k, m, pose);
    writeStart(k, m, pose, island, *context.bodies);
  }
  takeCrushes(island, ties);
  for (std::size_t k = 0; k < size(); k++) {
    writeSprings(k, at(k, ties));
    writeCaps(k, at(k, ties));
  }
}

// Under pressure a face bears the more bending the further out its points are, and bends no further than it must. So
// they go out within the step. What they hold keeps its sum and its moments.
void MortarRows::widen(std::size_t k, const Mortar& m) {
  FaceRecord& r = records[k];
  MortarStart& start = starts[k];
  const float to = std::min(start.arm + kWidens, mortar::kBroadest), by = to / start.arm;
  auto scale = [](float* of, float factor) {
    const float mean = 0.25f * (of[0] + of[1] + of[2] + of[3]);
    for (int i = 0; i < 4; i++) of[i] = mean + (of[i] - mean) * factor;
  };
  for (float* place : {r.s1, r.s2, start.opens, start.goes1, start.goes2}) scale(place, by);
  for (float* force : {start.heldN, start.held1, start.held2}) scale(force, 1 / by);
  start.arm = to;
  writeSprings(k, m);
  writeCaps(k, m);
}

// m: so much further than by turn x arm, of B against A.
Vec3f MortarRows::arcBy(std::size_t k, Vec3 turnA, Vec3 turnB, const Island& island) const {
  const Vec3 armA = toDouble(records[k].armA), armB = toDouble(records[k].armB);
  return toFloat(mortar::arcOfArm(turnB, armB) - mortar::arcOfArm(turnA, armA) -
                 mortar::arcOfArm(island.rigid.turn, armB - armA));
}

// What a blow made spin, or what meets something, may turn by less than its velocity told, along a shorter arc; and two
// bodies that a blow turns together, by more. True if that was worth a force that breaks the joint. What begins to turn
// against the other body is taken as it ends (advance).
bool MortarRows::renewArc(std::size_t k, const Mortar& m, const Island& island, const BodySet& bodies) {
  FaceRecord& r = records[k];
  MortarStart& start = starts[k];
  // A shorter arc is off by less than twice this one. Nor does what stood begin to go along arcs: it overshoots.
  if (!(3 * double(start.longest) * double(r.k[0]) > mortar::pullOf(m))) return false;
  auto turnOf = [&](std::uint32_t local, BodyIndex body) {
    if (local < island.bodies.size()) return toDouble(island.motion[local].th) + island.rigid.turn;
    return bodies.motion[body].angularVelocity * island.dt;
  };
  const Vec3 turnA = turnOf(r.bodyA, m.bodyA), turnB = turnOf(r.bodyB, m.bodyB);
  const Vec3 shared = lengthSquared(turnA) < lengthSquared(turnB) ? turnA : turnB;
  Vec3f arc = arcBy(k, turnA, turnB, island);
  const double far = length(toDouble(arc)),
               most = std::max(double(start.longest), length(toDouble(arcBy(k, shared, shared, island))));
  if (far > most) arc = arc * float(most / far);
  const Vec3f more = arc - start.arc;
  if (!(length(toDouble(more)) * double(r.k[0]) > mortar::pullOf(m))) return false;
  start.arc = arc;
  const float moreN = dot(r.n, more), more1 = dot(r.t1, more), more2 = dot(cross(r.n, r.t1), more);
  for (int i = 0; i < 4; i++) {
    r.trialN[i] -= r.k[i] * moreN;
    r.trial1[i] -= r.k[i] * more1;
    r.trial2[i] -= r.k[i] * more2;
  }
  return true;
}

// Where the face and its points are, and what they hold.
void MortarRows::writeFace(std::size_t k, const Mortar& m, const MortarPose& pose) {
  FaceRecord& r = records[k];
  MortarStart& start = starts[k];
  r.n = toFloat(pose.n);
  r.t1 = toFloat(pose.t1);
  r.armA = toFloat(pose.armA);
  r.armB = toFloat(pose.armB);
  const double stiffness = mortar::stiffnessOf(m);
  double pressure = 0;
  for (int i = 0; i < 4; i++) {
    const mortar::PointPlace at = mortar::placeOf(m, i, double(m.arm));
    const Vec3 gap = mortar::gapAt(pose, at);
    r.s1[i] = float(at.s1);
    r.s2[i] = float(at.s2);
    start.heldN[i] = float(-stiffness * (gap.x - double(m.opening[i])));
    start.held1[i] = float(-stiffness * (gap.y - double(m.slip1[i])));
    start.held2[i] = float(-stiffness * (gap.z - double(m.slip2[i])));
    pressure += 0.25 * double(start.heldN[i]);
  }
  start.stiffness = float(stiffness);
  start.arm = m.arm;
  start.pressure = float(std::max(pressure, -mortar::pullOf(m)));
  start.pull = start.shear = start.crush = 0;
}

// Ways by the velocities at the start, which are the ways of the last step. What turns goes on along an arc.
void MortarRows::writeStart(std::size_t k, const Mortar& m, const MortarPose& pose, const Island& island,
                            const BodySet& bodies) {
  const FaceRecord& r = records[k];
  MortarStart& start = starts[k];
  // Of something kinematic those of its last step, and what of their change is a blow.
  struct Velocities {
    Vec3 linear, angular;
  };
  auto lastOf = [&](std::uint32_t local, BodyIndex body) -> Velocities {
    const BodyMotion& motion = bodies.motion[body];
    if (local < island.bodies.size()) return {motion.linearVelocity, motion.angularVelocity};
    const BodyData& data = bodies.data[body];
    const double jump = bodies.speedJump(body);
    return {data.lastLinearVelocity + (motion.linearVelocity - data.lastLinearVelocity) * jump,
            data.lastAngularVelocity + (motion.angularVelocity - data.lastAngularVelocity) * jump};
  };
  const Velocities a = lastOf(r.bodyA, m.bodyA), b = lastOf(r.bodyB, m.bodyB);
  auto turnOf = [&](std::uint32_t local, Vec3 spin) {
    if (const RigidWay* chunk = local < island.bodies.size() ? island.chunks.of(local) : nullptr) return chunk->turn;
    return spin * island.dt;
  };
  start.arc = arcBy(k, turnOf(r.bodyA, bodies.motion[m.bodyA].angularVelocity),
                    turnOf(r.bodyB, bodies.motion[m.bodyB].angularVelocity), island);
  const bool own = r.bodyA < island.bodies.size() && r.bodyB < island.bodies.size();
  const Vec3 gone =
      toDouble(own ? start.arc : arcBy(k, turnOf(r.bodyA, a.angular), turnOf(r.bodyB, b.angular), island));
  start.longest = float(length(toDouble(start.arc)));
  auto inFace = [&](Vec3 v) { return Vec3{dot(pose.n, v), dot(pose.t1, v), dot(pose.t2, v)}; };
  const Vec3 move = inFace(b.linear + cross(b.angular, pose.armB) - a.linear - cross(a.angular, pose.armA));
  const Vec3 turn = inFace(b.angular - a.angular), arc = inFace(gone);
  for (int i = 0; i < 4; i++) {
    const double s1 = double(r.s1[i]), s2 = double(r.s2[i]);
    start.opens[i] = float((move.x + turn.y * s2 - turn.z * s1) * island.dt - arc.x);
    start.goes1[i] = float((move.y - turn.x * s2) * island.dt - arc.y);
    start.goes2[i] = float((move.z + turn.x * s1) * island.dt - arc.z);
  }
}

// No more than stops the motion that the joint starts with within its energy. What is about to break need not be firm.
void MortarRows::writeSprings(std::size_t k, const Mortar& m) {
  FaceRecord& r = records[k];
  MortarStart& start = starts[k];
  double worn = 0, standing = 0;
  for (int i = 0; i < 4; i++) {
    const double held = std::sqrt(double(start.held1[i]) * start.held1[i] + double(start.held2[i]) * start.held2[i]);
    standing = std::max({standing, -double(start.heldN[i]) / mortar::pullOf(m), held / mortar::shearOf(m)});
    const double along = std::sqrt(double(start.goes1[i]) * start.goes1[i] + double(start.goes2[i]) * start.goes2[i]);
    worn += 0.5 * (mortar::pullOf(m) * std::max(0.0, double(start.opens[i])) / mortar::pullEnergy(m) +
                   mortar::shearOf(m) * along / mortar::shearEnergy(m));
  }
  const double whole = mortar::strengthOf(m), stood = m.opens ? 0 : standing,
               most = worn > 0 ? stood + mortar::energyLeft(m.damage, double(start.tougher)) / worn : whole;
  start.left = float(std::min(whole, most));
  // A tie that is less firm holds less of its force, or it would give more than it holds.
  const float held = float(most < whole ? std::max(most / whole, kLeastFirmness) : 1);
  const float arcN = dot(r.n, start.arc), arc1 = dot(r.t1, start.arc), arc2 = dot(cross(r.n, r.t1), start.arc);
  for (int i = 0; i < 4; i++) {
    r.k[i] = held * start.stiffness;
    r.trialN[i] = held * start.heldN[i] - r.k[i] * arcN;
    r.trial1[i] = held * start.held1[i] - r.k[i] * arc1;
    r.trial2[i] = held * start.held2[i] - r.k[i] * arc2;
  }
  r.near = 0;
  if (m.crushed) return;
  const double press = mortar::pressOf(m), way = double(r.k[0]) * mortar::yieldOf(m) / press;
  r.near = -float(press);
  r.yields = std::uint16_t(std::min(way * double(kYieldParts), 65535.0));
}

// What springs hold between the bodies of this row, and no more: caps take.
double MortarRows::mostWork(std::size_t k) const {
  const MortarStart& start = starts[k];
  double sum = 0;
  for (int i = 0; i < 4; i++)
    sum += double(start.heldN[i]) * start.heldN[i] + double(start.held1[i]) * start.held1[i] +
           double(start.held2[i]) * start.held2[i];
  return start.stiffness > 0 ? sum / (2 * double(start.stiffness)) : 0.0;
}

// No time passes.
void MortarRows::startImpact(const Island&, const StepContext&, double) {
  for (FaceRecord& r : records)
    for (int i = 0; i < 4; i++) r.k[i] = r.trialN[i] = r.trial1[i] = r.trial2[i] = r.leastN[i] = r.limit[i] = 0;
}

}  // namespace brickfall
