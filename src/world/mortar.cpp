// Mortar: making, reading and removing it. Every call checks first and changes nothing on an error.
#include <algorithm>
#include <cmath>
#include <utility>

#include "brickfall/fall.h"
#include "solver/mortar/law.h"
#include "solver/union_find.h"
#include "world/checks.h"
#include "world/tie_calls.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

//! not of the method: what mortar.h says
constexpr std::size_t kLeastCorners = 3, kMostCorners = 16;

struct StrengthField {
  const char* name;
  double MortarStrength::*value;
  double least, most;
};
//! not of the method: what mortar.h says
constexpr StrengthField kStrengthFields[] = {
    {"strength.tension", &MortarStrength::tension, 1, 1e9},
    {"strength.cohesion", &MortarStrength::cohesion, 1, 1e9},
    {"strength.friction", &MortarStrength::friction, 0, 10},
    {"strength.tensionEnergy", &MortarStrength::tensionEnergy, 1e-6, 1e6},
    {"strength.shearEnergy", &MortarStrength::shearEnergy, 1e-6, 1e6},
    {"strength.compression", &MortarStrength::compression, 1, 1e10},
    {"strength.crushingEnergy", &MortarStrength::crushingEnergy, 1e-6, 1e9},
    {"strength.stiffness", &MortarStrength::stiffness, 1e6, 1e13},
};

void checkStrength(Checks& check, const MortarStrength& s) {
  for (const StrengthField& field : kStrengthFields) check.range(field.name, s.*field.value, field.least, field.most);
  if (check.failed()) return;
  check.condition(s.cohesion > s.tension * s.friction, "strength.cohesion: found " + numberText(s.cohesion) +
                                                           ", expected more than tension x friction, " +
                                                           numberText(s.tension * s.friction));
}

// A convex polygon in one plane: its area, centre, normal and principal radii of gyration.
struct Face {
  Vec3 centre, normal, axis;  // the axis of the larger radius
  double area = 0, gyration[2] = {};
};

Face faceOf(const std::vector<Vec3>& outline) {
  Face face;
  const Vec3 from = outline[0];
  Vec3 twice;
  for (std::size_t i = 1; i + 1 < outline.size(); i++) twice += cross(outline[i] - from, outline[i + 1] - from);
  face.area = 0.5 * length(twice);
  if (!(face.area > 0)) return face;
  face.normal = normalized(twice);
  const Vec3 x = normalized(outline[1] - from), y = cross(face.normal, x);
  double moment[2] = {}, xx = 0, xy = 0, yy = 0;
  auto flat = [&](Vec3 p) { return std::pair{dot(p - from, x), dot(p - from, y)}; };
  for (std::size_t i = 1; i + 1 < outline.size(); i++) {
    const auto [ax, ay] = flat(outline[i]);
    const auto [bx, by] = flat(outline[i + 1]);
    const double area = 0.5 * (ax * by - ay * bx);
    moment[0] += area * (ax + bx) / 3;
    moment[1] += area * (ay + by) / 3;
    xx += area * (ax * ax + ax * bx + bx * bx) / 6;
    xy += area * (2 * ax * ay + 2 * bx * by + ax * by + bx * ay) / 12;
    yy += area * (ay * ay + ay * by + by * by) / 6;
  }
  const double cx = moment[0] / face.area, cy = moment[1] / face.area;
  xx = xx / face.area - cx * cx;
  xy = xy / face.area - cx * cy;
  yy = yy / face.area - cy * cy;
  face.centre = from + x * cx + y * cy;
  const double half = 0.5 * (xx + yy), apart = std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  face.gyration[0] = std::sqrt(std::max(0.0, half + apart));
  face.gyration[1] = std::sqrt(std::max(0.0, half - apart));
  // Of equal radii any axis is one.
  Vec3 axis = x * xy + y * (half + apart - xx);
  if (!(lengthSquared(axis) > 1e-24 * half * half)) axis = xx >= yy ? x : y;
  face.axis = normalized(axis);
  return face;
}

void checkOutline(Checks& check, const std::vector<Vec3>& outline) {
  check.condition(outline.size() >= kLeastCorners && outline.size() <= kMostCorners,
                  "outline: found " + std::to_string(outline.size()) + " corners, expected 3 .. 16");
  for (std::size_t i = 0; i < outline.size(); i++)
    check.vector("outline[" + std::to_string(i) + "]", outline[i], limits::kLargestCoordinate);
  if (check.failed()) return;
  const Face face = faceOf(outline);
  check.condition(
      face.area >= limits::kSmallestSize * limits::kSmallestSize && face.gyration[1] >= 0.1 * limits::kSmallestSize &&
          face.gyration[0] <= limits::kLargestSize,
      "outline: found a face of " + numberText(face.area) + " m2, expected one that is 0.0001 m wide at least");
  if (check.failed()) return;
  // So far corners may be off their plane, or inside the polygon of the others.
  const double most = kShapesRound * face.gyration[0];
  for (std::size_t i = 0; i < outline.size(); i++) {
    const std::string at = "outline[" + std::to_string(i) + "]";
    const Vec3 p = outline[i], next = outline[(i + 1) % outline.size()], after = outline[(i + 2) % outline.size()];
    check.condition(std::fabs(dot(face.normal, p - face.centre)) <= most,
                    at + ": found a corner off the plane of the others");
    const Vec3 edge = next - p;
    check.condition(dot(face.normal, cross(edge, after - next)) >= -most * length(edge),
                    at + ": found a corner that is dented in, expected a convex outline");
  }
}

Quat rotationWithAxes(Vec3 x, Vec3 y) {
  const Vec3 z = cross(x, y);
  const double trace = x.x + y.y + z.z;
  if (trace > 0) return normalized(Quat{y.z - z.y, z.x - x.z, x.y - y.x, 1 + trace});
  if (x.x >= y.y && x.x >= z.z) return normalized(Quat{1 + x.x - y.y - z.z, x.y + y.x, x.z + z.x, y.z - z.y});
  if (y.y >= z.z) return normalized(Quat{x.y + y.x, 1 - x.x + y.y - z.z, y.z + z.y, z.x - x.z});
  return normalized(Quat{x.z + z.x, y.z + z.y, 1 - x.x - y.y + z.z, x.y - y.x});
}

Mortar mortarFrom(const MortarDef& def, BodyIndex a, BodyIndex b, const BodySet& bodies) {
  const Face face = faceOf(def.outline);
  Mortar m;
  m.bodyA = a;
  m.bodyB = b;
  const MortarStrength& s = def.strength;
  m.strength = {float(s.tension), float(s.cohesion), float(s.tensionEnergy), float(s.shearEnergy)};
  m.area = float(face.area);
  m.gyration[0] = float(face.gyration[0]);
  m.gyration[1] = float(face.gyration[1]);
  const Quat frame = rotationWithAxes(face.normal, face.axis);
  for (BodyIndex body : {a, b})
    placeFace(m, body == a, transposeTimes(bodies.motion[body].orientation, face.centre - bodies.origin(body)),
              normalized(conjugate(bodies.motion[body].rotation) * frame));
  const MortarPose pose(m, bodies);
  MortarPose shut = pose;
  shut.displaced = shut.along1 = shut.along2 = {};
  mortar::keepForces(m, shut, pose);
  return m;
}

// Stresses at the edge of the face, as if it were elastic.
void findStresses(const Mortar& m, const MortarPose& pose, MortarState& s) {
  const double root3 = 3 * mortar::kKern;
  const double pressure = dot(s.force, pose.n) / m.area;
  const double bent =
      root3 / m.area *
      (std::fabs(dot(s.torque, pose.t2)) / m.gyration[0] + std::fabs(dot(s.torque, pose.t1)) / m.gyration[1]);
  const double g1 = m.gyration[0], g2 = m.gyration[1], polar = std::sqrt(g1 * g1 + g2 * g2);
  const Vec3 along = s.force - pose.n * dot(s.force, pose.n);
  s.tension = bent - pressure;
  s.shear = length(along) / m.area + root3 * std::fabs(dot(s.torque, pose.n)) / (m.area * polar);
  const double left = std::max(1e-3, mortar::strengthOf(m));
  const double shear = std::max(left * m.strength.cohesion + m.shared->friction * pressure, 1e-3 * m.strength.cohesion);
  s.utilisation = std::clamp(
      std::max({s.tension / (left * m.strength.tension), s.shear / shear, (pressure + bent) / m.shared->compression}),
      0.0, 1.0);
}

MortarState stateOf(const Mortar& m, std::uint64_t userData, const Registry& registry) {
  const BodySet& bodies = registry.bodies;
  const MortarPose pose(m, bodies);
  MortarState s;
  s.bodyA = registry.idOf(m.bodyA);
  s.bodyB = registry.idOf(m.bodyB);
  s.centre = pose.centre;
  s.normal = pose.n;
  s.area = m.area;
  s.along1 = pose.t1 * (3 * mortar::kKern * m.gyration[0]);
  s.along2 = pose.t2 * (3 * mortar::kKern * m.gyration[1]);
  s.force = toDouble(m.force);
  s.torque = toDouble(m.torque);
  s.damage = m.damage;
  s.tensionWork = double(m.tensionWork);
  s.shearWork = double(m.shearWork);
  s.crushingWork = double(m.crushingWork);
  s.mode = modeOf(m);
  s.broken = m.broken || m.crushed;
  if (!m.broken) findStresses(m, pose, s);
  auto isAwake = [&](BodyIndex body) { return bodies.data[body].activity == BodyActivity::awake; };
  s.awake = isAwake(m.bodyA) || isAwake(m.bodyB);
  s.userData = userData;
  return s;
}

//! not of the method: what mortar.h says
constexpr std::size_t kMostTakers = 4;

std::vector<LoadTaker> takersOf(const OpeningMemory& past, const MortarSet& set, const Registry& registry) {
  std::vector<LoadTaker> takers;
  for (std::uint32_t i = 0; i < past.count; i++) {
    const TieLoad& load = past.loads[i];
    if (!(load.after > (1 + kTrifle) * load.before)) continue;
    const MortarId mortar = load.mortar == kNoIndex ? MortarId{} : tieId<MortarId>(set, load.mortar, registry);
    takers.push_back({mortar, registry.idOf(load.bodyA), registry.idOf(load.bodyB), load.before, load.after});
  }
  std::stable_sort(takers.begin(), takers.end(),
                   [](const LoadTaker& a, const LoadTaker& b) { return a.after - a.before > b.after - b.before; });
  if (takers.size() > kMostTakers) takers.resize(kMostTakers);
  return takers;
}

MortarPast pastFrom(const OpeningMemory& memory, const MortarSet& set, const Registry& registry) {
  const Mortar& m = set.slots[memory.mortar];
  MortarPast past;
  past.mortar = tieId<MortarId>(set, memory.mortar, registry);
  past.bodyA = registry.idOf(m.bodyA);
  past.bodyB = registry.idOf(m.bodyB);
  past.crackTime = memory.crackTime;
  past.openTime = memory.openTime;
  past.breakTime = memory.breakTime;
  past.mode = modeOf(m);
  past.tensionShare = double(m.tensionWork) / mortar::pullEnergy(m);
  past.shearShare = double(m.shearWork) / mortar::shearEnergy(m);
  past.crushingShare = double(m.crushingWork) / mortar::crushEnergy(m);
  past.force = toDouble(memory.force);
  const bool broken = m.broken || m.crushed;
  past.settled = broken && !std::binary_search(set.watched.begin(), set.watched.end(), memory.mortar);
  if (broken) past.takers = takersOf(memory, set, registry);
  return past;
}

}  // namespace

Result<MortarId> World::createMortar(const MortarDef& def) {
  Impl& w = *impl_;
  if (Status open = w.openForChange("createMortar"); !open) return open.error();
  const auto ends = bodiesToTie(def, w.registry, [&](Checks& check) {
    checkOutline(check, def.outline);
    checkStrength(check, def.strength);
  });
  if (!ends) return ends.error();
  const Mortar mortar = mortarFrom(def, ends->first, ends->second, w.registry.bodies);
  const MortarStrength& s = def.strength;
  const SharedStrength shared{float(s.friction), float(s.compression), float(s.crushingEnergy), float(s.stiffness)};
  return tieId<MortarId>(w.ties.mortar, w.upkeep().glue(mortar, shared, def.userData), w.registry);
}

Status World::destroyMortar(MortarId id) {
  if (Status open = impl_->openForChange("destroyMortar"); !open) return open.error();
  Result<MortarIndex> mortar = findTie(impl_->ties.mortar, id, impl_->registry, "mortar");
  if (!mortar) return mortar.error();
  impl_->upkeep().unglue(*mortar);
  return {};
}

bool World::isValid(MortarId id) const { return findTie(impl_->ties.mortar, id, impl_->registry, "mortar").ok(); }

Result<MortarState> World::state(MortarId id) const {
  const Impl& w = *impl_;
  Result<MortarIndex> index = findTie(w.ties.mortar, id, w.registry, "mortar");
  if (!index) return index.error();
  return stateOf(w.ties.mortar.slots[*index], w.ties.mortar.userDataOf(*index), w.registry);
}

std::vector<MortarId> World::mortars() const {
  return tieIds<MortarId>(impl_->ties.mortar, impl_->registry, [](const Mortar&) { return true; });
}
std::vector<MortarId> World::mortars(BodyId id) const {
  return tieIds<MortarId>(impl_->ties.mortar, impl_->registry, id);
}

Result<MortarPast> World::past(MortarId id) const {
  const Impl& w = *impl_;
  Result<MortarIndex> index = findTie(w.ties.mortar, id, w.registry, "mortar");
  if (!index) return index.error();
  const OpeningMemory* memory = w.ties.mortar.pastOf(*index);
  if (!memory) return Error{ErrorCode::wrongState, "mortar: it has not cracked"};
  return pastFrom(*memory, w.ties.mortar, w.registry);
}

Result<FallStory> World::whyFell(BodyId id) const {
  const Impl& w = *impl_;
  const MortarSet& set = w.ties.mortar;
  Result<BodyIndex> body = w.registry.find(id);
  if (!body) return body.error();
  FallStory story;
  const std::vector<BodyId> all = carried();
  story.carried = std::find(all.begin(), all.end(), id) != all.end();
  std::vector<bool> moves(w.registry.bodies.slots());
  for (BodyIndex i = 0; i < moves.size(); i++)
    moves[i] = w.registry.bodies.alive(i) && w.registry.bodies.data[i].type == BodyType::dynamic;
  const Vec3 up = lengthSquared(w.def.gravity) > 0 ? normalized(-w.def.gravity) : Vec3{};
  const std::vector<MortarIndex> order = set.inOrder();
  std::vector<FallJoint> joints;
  for (MortarIndex mortar : order) {
    const Mortar& m = set.slots[mortar];
    FallJoint joint{m.bodyA, m.bodyB};
    if (const OpeningMemory* memory = m.broken || m.crushed ? set.pastOf(mortar) : nullptr) {
      joint.breakTime = memory->breakTime;
      joint.lift = dot(toDouble(memory->force), up);
      if (m.names(*body)) story.opened.push_back(pastFrom(*memory, set, w.registry));
    }
    joints.push_back(joint);
  }
  std::stable_sort(story.opened.begin(), story.opened.end(),
                   [](const MortarPast& a, const MortarPast& b) { return a.breakTime < b.breakTime; });
  const std::optional<std::uint32_t> first = FallFinder(joints, moves).first(*body);
  if (!first) return story;
  story.first = pastFrom(*set.pastOf(order[*first]), set, w.registry);
  story.own = set.slots[order[*first]].names(*body);
  return story;
}

std::vector<BodyId> World::carried() const {
  const Impl& w = *impl_;
  const BodySet& bodies = w.registry.bodies;
  UnionFind sets(bodies.slots() + 1, std::pmr::get_default_resource());
  const std::uint32_t ground = bodies.slots();
  auto placeOf = [&](BodyIndex body) { return bodies.data[body].type == BodyType::dynamic ? body : ground; };
  auto join = [&](const Link& link) {
    if (link.kind == LinkKind::contact && !w.ties.contacts.contacts[link.index].touching) return;
    sets.join(placeOf(link.bodyA), placeOf(link.bodyB));
  };
  w.ties.eachAwake(join);
  w.ties.eachAsleep(join);
  std::vector<BodyId> out;
  for (BodyId id : this->bodies())
    if (Result<BodyIndex> body = w.registry.find(id);
        body && bodies.data[*body].type == BodyType::dynamic && sets.find(*body) == sets.find(ground))
      out.push_back(id);
  return out;
}

}  // namespace brickfall
