// Moved by its velocity at the end of the step, a sliding body goes v dt / 2 too short in all: 4 % of a slide from 2
// m/s at 1/60 s. A wall that rocks loses half a step of its weight's work whenever it begins to turn, and again as it
// lands: 11 % of its first swing, and 40 % of the second. Sliding friction does not depend on the place, nor does the
// weight of what moves as one body: so the mean of old and new velocity feeds in no energy.
#include "solver/finish/finish.h"

#include <algorithm>

#include "solver/chunks.h"
#include "solver/finish/motion.h"
#include "solver/rigid_sum.h"
#include "solver/support.h"
#include "solver/union_find.h"

namespace brickfall {

namespace {

// Groups of one kind, each named by its lowest body.
class RigidGroups {
 public:
  RigidGroups(const Island& island, StepContext& context) : island_(island), context_(context) {}

  // Each finds the groups of a kind. False if there are none.
  bool findFlights();
  bool findOnSmoothGround();
  bool findChunks();
  bool findSlides(const RigidGroups& chunks);

  // Momentum is kept in any direction in which nothing holds a group: in flight all of it, on smooth ground along that.
  void keepMomenta();
  // Flights go the mean of their velocities under outside forces, unless anything is nearer than that.
  void fall();
  // All others go the mean of their velocities, as far as what they press on or are about to meet lets them.
  void goMean();

  // The group of the body is moved.
  bool moves(std::uint32_t body) const { return !of_.empty() && of_[body] != kNoIndex && !stays_[of_[body]]; }

 private:
  void begin() {
    of_.assign(count_ + island_.partners.size(), kNoIndex);
    stays_.assign(count_, 0);
    normals_.assign(count_, Vec3{});
  }
  void stay(RowEnds ends) {
    for (std::uint32_t body : {ends.a, ends.b})
      if (moves(body)) stays_[of_[body]] = 1;
  }
  // The body's group lies on ground, and stays if that is not flat.
  void liesOn(std::uint32_t body, Vec3 normal, bool stays) {
    const std::uint32_t group = of_[body];
    if (group == kNoIndex) return;
    if (normals_[group] == Vec3{}) normals_[group] = normal;
    stays_[group] = stays_[group] || stays || !(length(cross(normals_[group], normal)) <= kShapesRound);
  }
  // Groups that lie on nothing stay. False if all do.
  bool anyLies() {
    bool any = false;
    for (std::uint32_t i = 0; i < count_; i++) {
      if (of_[i] == i) stays_[i] = stays_[i] || normals_[i] == Vec3{};
      any = any || moves(i);
    }
    return any;
  }
  std::pmr::vector<RigidSum> sums() const { return {count_, RigidSum(island_.origin), island_.memory}; }
  void findChanges();
  void judgeRows();
  // How a correction would move the bodies back.
  EndChanges takenBack(RowEnds ends) const {
    auto of = [this](std::uint32_t body) {
      if (!moves(body)) return VelocityChange{};
      const RigidMotion& change = changes_[of_[body]];
      return VelocityChange{change.at(context_.bodies->motion[island_.bodies[body]].position), change.spin};
    };
    return {of(ends.a), of(ends.b)};
  }

  const Island& island_;
  StepContext& context_;
  std::uint32_t count_ = std::uint32_t(island_.bodies.size());
  std::pmr::vector<std::uint32_t> of_{island_.memory};  // bodies and partners: the group; kNoIndex: in none
  // By group:
  std::pmr::vector<char> stays_{island_.memory};           // it is not moved
  std::pmr::vector<Vec3> normals_{island_.memory};         // of the ground along which it goes; zero: any way
  std::pmr::vector<RigidMotion> changes_{island_.memory};  // of its velocities
  std::pmr::vector<Vec3> turns_{island_.memory};           // rad, in this step
};

// One that locks hold in another way would support the others.
bool fallsAlike(const Island& island, std::span<const std::uint32_t> group) {
  if (island.locks.empty()) return true;
  const unsigned first = island.locks[group.front()] & kAllWays;
  return std::all_of(group.begin(), group.end(),
                     [&](std::uint32_t i) { return (island.locks[i] & kAllWays) == first; });
}

bool RigidGroups::findFlights() {
  for (std::size_t g = 0; g < island_.groups.count(); g++) {
    if (!island_.groups.flies(g)) continue;
    const std::span<const std::uint32_t> group = island_.groups.bodies(g);
    if (!fallsAlike(island_, group)) continue;
    if (of_.empty()) begin();
    for (std::uint32_t i : group) of_[i] = group.front();
  }
  return !of_.empty();
}

// Bodies that press on each other, and on smooth flat ground alone.
bool RigidGroups::findOnSmoothGround() {
  begin();
  for (std::uint32_t i = 0; i < count_; i++) of_[i] = island_.groups.pieceOf(i);
  island_.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if ((ends.a < count_ && ends.b < count_) || !kind.ties(k, context_)) return;
    const RowGrip grip = kind.grip(k, context_);
    const bool smooth = grip.friction == 0 && grip.force != Vec3{} && !kind.sticks(k, context_);
    liesOn(std::min(ends.a, ends.b), kind.normal(k), !smooth);
  });
  return anyLies();
}

// Chunks that mortar joins to nothing fixed.
bool RigidGroups::findChunks() {
  begin();
  const std::pmr::vector<std::uint32_t> chunks = chunksOf(island_, *context_.ties);
  std::copy(chunks.begin(), chunks.end(), of_.begin());
  island_.rows.each([&](const auto& kind, std::size_t k) {
    if (!kind.makesOne(k, *context_.ties)) return;
    const RowEnds ends = kind.ends(k);
    if (ends.a >= count_ || ends.b >= count_) stay(ends);
  });
  for (std::uint32_t i = 0; i < count_; i++)
    if (moves(i)) return true;
  return false;
}

// Bodies that press on each other. A body that sticks to something fixed, directly or through a chain of sticking
// contacts, is in no group: it counts as ground. So does what was moved as a chunk. What slides on a group, on a face
// that lies as the ground does, is a group of its own: its velocity changes otherwise. A group stays if a point that
// presses on the ground lands, leaves or sticks.
bool RigidGroups::findSlides(const RigidGroups& chunks) {
  std::pmr::vector<char> held(island_.memory);
  findSupported(island_, held, [&](const auto& kind, std::size_t k) { return kind.sticks(k, context_); });
  for (std::uint32_t i = 0; i < count_; i++) held[i] = held[i] || chunks.moves(i);
  if (std::find(held.begin(), held.end(), 0) == held.end()) return false;
  Vec3 ground;
  island_.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if (ground == Vec3{} && held[ends.a] != held[ends.b] && kind.carriesForce(k, context_)) ground = kind.normal(k);
  });
  auto now = [&](std::uint32_t body) {
    const SolvedMotion& s = context_.solved[island_.bodies[body]];
    return VelocityChange{s.velocity, context_.bodies->worldInvInertia(island_.bodies[body]) * s.angularMomentum};
  };
  UnionFind sets(count_, island_.memory);
  island_.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    if (held[ends.a] || held[ends.b] || !kind.ties(k, context_)) return;
    const bool lies = length(cross(ground, kind.normal(k))) <= kShapesRound;
    if (!lies || !kind.slips(k, {now(ends.a), now(ends.b)}, island_.dt, context_)) sets.join(ends.a, ends.b);
  });
  begin();
  for (std::uint32_t i = 0; i < count_; i++)
    if (!held[i]) of_[i] = sets.find(i);
  island_.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    if (of_[ends.a] == of_[ends.b] || !kind.carriesForce(k, context_)) return;
    const RowCourse course = kind.courseOf(k, changesOf(ends, island_, context_), {island_.dt}, context_);
    for (std::uint32_t body : {ends.a, ends.b}) liesOn(body, kind.normal(k), course == RowCourse::changes);
  });
  return anyLies();
}

// The part that the solve missed. Bodies of an island that goes along arcs end at other arms than they started.
void RigidGroups::keepMomenta() {
  const BodySet& bodies = *context_.bodies;
  const bool turns = island_.rigid.turns();
  const double h = island_.dt;
  std::pmr::vector<RigidSum> missing = sums(), free = sums(), solved = sums();
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!moves(i)) continue;
    const BodyIndex body = island_.bodies[i];
    const FreeMotion& f = context_.free[body];
    const SolvedMotion& s = context_.solved[body];
    const std::uint32_t group = of_[i];
    const double m = bodies.mass[body].mass;
    const Vec3 at = bodies.motion[body].position;
    if (group == i) missing[i] = free[i] = solved[i] = RigidSum(at);
    const Mat3 inertia = bodies.worldInertia(body);
    const Vec3 way = f.d + f.late * h, spin = f.angularMomentum + inertia * f.lateSpin;
    if (turns) {
      free[group].add(m, at, inertia, way * m, spin * h);
      solved[group].add(m, at + s.d, inertia, s.velocity * (m * h), s.angularMomentum * h);
    } else {
      missing[group].add(m, at, inertia, (way - s.d) * m, (spin - s.angularMomentum) * h);
    }
  }
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!moves(i)) continue;
    const BodyIndex body = island_.bodies[i];
    const std::uint32_t group = of_[i];
    const RigidSum &before = free[group], &after = solved[group];
    RigidMotion all = turns
                          ? RigidMotion{after.centre(), before.velocity() - after.velocity(),
                                        inverse(after.inertia()) * (before.angularMomentum() - after.angularMomentum())}
                          : missing[group].motion();
    const Vec3 normal = normals_[group];
    const bool lies = normal != Vec3{};
    if (lies) all = {all.centre, all.move - normal * dot(normal, all.move), {}};
    const Vec3 at = bodies.motion[body].position, way = all.at(turns ? at + context_.solved[body].d : at);
    // Ways along arcs are what they should be, but for the floats in which the solve found them: a centre of mass that
    // these put aside would change the angular momentum.
    if (!turns)
      shift(body, way, all.spin, context_);
    else if (!lies)
      shift(body, before.centre() + before.velocity() - after.centre(), {}, context_);
    accelerate(body, way * (1 / h), bodies.worldInertia(body) * all.spin * (1 / h), context_);
  }
}

// m: half of the way that outside forces add to the way of a group. Near is what a chain of ties leads to something
// fixed or kinematic, where a tie counts if it carries force, or if its gap is less than that.
void RigidGroups::fall() {
  const Vec3f fall = toFloat(context_.gravity * (-0.5 * island_.dt * island_.dt));
  std::pmr::vector<char> near(island_.memory);
  findSupported(island_, near, [&](const auto& kind, std::size_t k) {
    return kind.meetsWithin(k, fall, island_.motion.data(), context_);
  });
  std::pmr::vector<std::pair<Vec3, double>> falls(count_, {Vec3{}, 0.0}, island_.memory);
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!moves(i)) continue;
    const double m = context_.bodies->mass[island_.bodies[i]].mass;
    const FreeMotion& free = context_.free[island_.bodies[i]];
    falls[of_[i]].first += (free.d + (free.late - free.startVelocity) * island_.dt) * m;
    falls[of_[i]].second += m;
  }
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!moves(i) || near[i]) continue;
    const auto [sum, mass] = falls[of_[i]];
    shift(island_.bodies[i], sum * (-0.5 / mass), {}, context_);
  }
}

// How the velocity of each group changes, as that of a rigid body.
void RigidGroups::findChanges() {
  const BodySet& bodies = *context_.bodies;
  std::pmr::vector<RigidSum> changes = sums(), ways = sums();
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!moves(i)) continue;
    const BodyIndex body = island_.bodies[i];
    const double m = bodies.mass[body].mass;
    const Mat3 inertia = bodies.worldInertia(body);
    const VelocityChange change = changeOf(body, context_);
    const SolvedMotion& s = context_.solved[body];
    const Vec3 at = bodies.motion[body].position;
    changes[of_[i]].add(m, at, inertia, change.move * m, inertia * change.turn);
    ways[of_[i]].add(m, at, inertia, s.d * m, inertia * s.th);
  }
  changes_.resize(count_);
  turns_.resize(count_);
  for (std::uint32_t i = 0; i < count_; i++) {
    if (of_[i] != i || stays_[i]) continue;
    const RigidSum& sum = changes[i];
    const Vec3 n = normals_[i], v = sum.velocity();
    changes_[i] = n == Vec3{} ? sum.motion()
                              : RigidMotion{sum.centre(), v - n * dot(n, v),
                                            n * (dot(n, sum.angularMomentum()) / dot(n, sum.inertia() * n))};
    turns_[i] = ways[i].spin();
  }
}

// A group is not moved where that would press on what it touches as no force of the solve does, or leave it: what
// begins anew in each step is work for the next. Nor towards a body that one of its open points is about to meet.
void RigidGroups::judgeRows() {
  island_.rows.each([&](const auto& kind, std::size_t k) {
    const RowEnds ends = kind.ends(k);
    if (of_[ends.a] == of_[ends.b] || (!moves(ends.a) && !moves(ends.b))) return;
    const EndChanges back = takenBack(ends);
    const bool along = normals_[of_[moves(ends.a) ? ends.a : ends.b]] != Vec3{};
    const bool keeps = kind.carriesForce(k, context_)
                           ? along || kind.keepsForces(k, back, island_.dt, context_)
                           : !kind.wouldMeet(k, back, changesOf(ends, island_, context_), island_.dt);
    if (!keeps) stay(ends);
  });
}

// Those that go any way go arcs and all: mortar feels a micron.
void RigidGroups::goMean() {
  findChanges();
  judgeRows();
  const double half = -0.5 * island_.dt;
  for (std::uint32_t i = 0; i < count_; i++) {
    if (!moves(i)) continue;
    const RigidMotion& change = changes_[of_[i]];
    const Vec3 went = turns_[of_[i]], back = change.spin * half;
    const Vec3 at = context_.bodies->motion[island_.bodies[i]].position, arm = at - change.centre;
    auto turned = [&](Vec3 by) { return rotate(quatFromRotationVector(by), arm); };
    const bool along = normals_[of_[i]] != Vec3{};
    const Vec3 way = along ? change.at(at) * half : change.move * half + turned(went + back) - turned(went);
    shift(island_.bodies[i], way, back, context_);
  }
}

// Nothing goes along ground that turns; one body only along ground that moves.
bool maySlide(const Island& island, const BodySet& bodies) {
  if (island.bodies.size() == 1 && !island.facts.partnersGo) return false;
  return std::all_of(island.partners.begin(), island.partners.end(),
                     [&](BodyIndex partner) { return bodies.motion[partner].angularVelocity == Vec3{}; });
}

}  // namespace

void finishGroups(const Island& island, StepContext& context) {
  const IslandFacts& facts = island.facts;
  const bool free = !facts.locked, goes = island.grounded() && !(facts.fastest <= context.settings.restSpeed);
  RigidGroups flights(island, context), onSmooth(island, context), chunks(island, context), slides(island, context);
  if (flights.findFlights()) {
    if (free) flights.keepMomenta();
    flights.fall();
  }
  if (free && island.grounded() && island.bodies.size() > 1 && onSmooth.findOnSmoothGround()) onSmooth.keepMomenta();
  if (free && goes && facts.mortared && !facts.jointed && !facts.partnersMove && chunks.findChunks()) chunks.goMean();
  if (goes && maySlide(island, *context.bodies) && slides.findSlides(chunks)) slides.goMean();
}

}  // namespace brickfall
