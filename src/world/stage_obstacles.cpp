// Things that the contacts of a step can't see: they are found along the velocities before it, with normals and arms
// that stay as they are. A body that a hit throws somewhere else, or spins through most of a turn, or that a force
// accelerates from rest, could end the step behind something thin, or in it. So first what ends aside is fitted in
// (keep_out.h), and once more if any body was stopped. Between, the core of every fast body, a ball a fourth as thick
// as its shape, is swept along the way that the solve found, against the ways of the others. Where it would enter
// something, or run over the core of something smaller, the two go on together for the rest of the step. So debris that
// flies along together never stands still. Before a fixed thing the body stops; what a kinematic body runs into is
// taken along. What is long and turns is looked at in its own frame, where ways are arcs, in parts of 0.2 rad.
// Velocities stay, so that the next step finds the contact and does the rest.
#include <algorithm>
#include <cmath>

#include "solver/finish/motion.h"
#include "solver/free_motion.h"
#include "solver/union_find.h"
#include "world/activity.h"
#include "world/core_sweep.h"
#include "world/diary.h"
#include "world/keep_out.h"
#include "world/proximity.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

namespace {

bool exceeds(Vec3 way, double limit) { return lengthSquared(way) > limit * limit; }

struct Motion {
  Vec3 way, turn;  // m, rad: in this step
};

struct Obstruction {
  double share = 1;           // of the step: when a way ends
  double turnShare = 1;       // of the step: when the turn does
  BodyIndex body = kNoIndex;  // what ends it
  Vec3 carried;               // m: how far that takes along, from there, what does not get past it
};

// Bodies that hang together by ties that last. The solve has found where their ends meet: a part of their turns would
// tear them, and what they bend against is held by contacts.
class LastingGroups {
 public:
  LastingGroups(std::size_t slots, const IslandSet& islands, std::pmr::memory_resource* memory)
      : sets_(any(islands) ? slots : 0, memory), has_(any(islands) ? slots : 0, 0, memory) {
    if (has_.empty()) return;
    for (const IslandPointer& island : islands.awake)
      if (island->plan.endVelocities)
        island->rows.eachKind([&]<class Kind>(const Kind& kind) {
          if constexpr (Kind::kLasts)
            for (std::size_t k = 0; k < kind.size(); k++) join(*island, kind.ends(k));
        });
  }
  bool has(BodyIndex body) const { return body < has_.size() && has_[body]; }
  bool together(BodyIndex a, BodyIndex b) const { return has(a) && has(b) && sets_.find(a) == sets_.find(b); }

 private:
  static bool any(const IslandSet& islands) {
    return std::any_of(islands.awake.begin(), islands.awake.end(),
                       [](const IslandPointer& island) { return island->rows.anyLasting(); });
  }
  void join(const Island& island, RowEnds ends) {
    const std::size_t own = island.bodies.size();
    if (ends.a < own) has_[island.bodies[ends.a]] = 1;
    if (ends.b < own) has_[island.bodies[ends.b]] = 1;
    if (ends.a < own && ends.b < own) sets_.join(island.bodies[ends.a], island.bodies[ends.b]);
  }

  mutable UnionFind sets_;
  std::pmr::vector<char> has_;
};

// m, of each body: how deep it begins the step in another.
std::pmr::vector<double> depthsOf(std::size_t slots, const IslandSet& islands, std::pmr::memory_resource* memory) {
  std::pmr::vector<double> out(slots, 0, memory);
  for (const IslandPointer& island : islands.awake) {
    if (island->resting()) continue;
    island->rows.each([&](const auto& kind, std::size_t k) {
      const double depth = kind.depth(k);
      if (!(depth > 0)) return;
      const RowEnds ends = kind.ends(k);
      for (std::uint32_t end : {ends.a, ends.b})
        if (end < island->bodies.size()) out[island->bodies[end]] = std::max(out[island->bodies[end]], depth);
    });
  }
  return out;
}

struct Obstacles {
  const Registry& registry;
  const BodySet& bodies;
  const ShapeSet& shapes;
  const Proximity& proximity;
  const Activity& activity;
  const IslandSet& islands;
  StepContext& context;
  LastingGroups joined;
  std::pmr::vector<double> depths;

  bool changed = false, last = false;  // in this look along all ways; it is the last one
  bool stopped = false;                // in any look

  // Bodies that go the same way: a group that flies, or one body that is supported.
  struct Group {
    double mass = 0;
    Vec3 way, velocity;  // m in what is left of the step, m/s: of the centre of mass
    Vec3 pace;           // m: its way if all of the step were left
    bool flies = false;
  };
  bool moves(BodyIndex body) const;
  bool hangs(BodyIndex body) const { return !context.solved[body].flying && joined.has(body); }
  double leftOf(BodyIndex body) const;
  double shareLeft(BodyIndex body, double share) const;
  Vec3 framesWay(BodyIndex body) const;
  Group groupOf(BodyIndex body) const;
  bool goTogether(BodyIndex body, BodyIndex other) const;
  void divert(BodyIndex body, const Group& group, Vec3 way, double turnShare);
  void meet(BodyIndex body, const Obstruction& first);
  void stopAll(bool again);
  void takeBack(BodyIndex body);
  void stop(BodyIndex body);
  void hold(BodyIndex body, bool everything, double thickness);
  void obstruct(ShapeIndex shape, bool everything, double thickness, Obstruction& first) const;
  const Island* islandWith(BodyIndex body) const;
  Motion motionOf(BodyIndex body) const;
  std::span<const std::uint32_t> movesWith(const Island& island, BodyIndex body) const;
  void cut(BodyIndex body, double share, double turnShare, Vec3 carried = {});
  bool farHeavier(BodyIndex body, BodyIndex other) const;
  bool isThick(BodyIndex body) const;
};

const Island* Obstacles::islandWith(BodyIndex body) const {
  std::uint32_t n = activity.islandOf[body];
  return n == kNoIndex ? nullptr : islands.awake[n].get();
}

Motion Obstacles::motionOf(BodyIndex body) const {
  const BodyData& data = bodies.data[body];
  const BodyMotion& m = bodies.motion[body];
  if (data.type == BodyType::kinematic) return {m.linearVelocity * context.dt, m.angularVelocity * context.dt};
  if (data.type == BodyType::fixed || data.activity != BodyActivity::awake || context.solved[body].rest) return {};
  return {context.solved[body].d, context.solved[body].th};
}

// What moves with the body, as numbers in its island. Its group, if all of the island flies: its momenta must stay.
// Else the body alone: a group of a hundred bricks does not stop where one of them meets the ground.
std::span<const std::uint32_t> Obstacles::movesWith(const Island& island, BodyIndex body) const {
  const auto place = std::lower_bound(island.bodies.begin(), island.bodies.end(), body) - island.bodies.begin();
  const auto number = std::size_t(place);
  const std::span<const std::uint32_t> group = island.groups.bodies(island.groups.groupOf(number));
  if (context.solved[body].flying && !island.grounded()) return group;
  return group.subspan(std::size_t(std::lower_bound(group.begin(), group.end(), std::uint32_t(number)) - group.begin()),
                       1);
}

// Leaves the body a share of its way, then `carried`, and a share of its turn; it keeps its velocities. All of a group
// that flies goes the same share, and is carried alike: its step ends there, and its bodies stay as they are to each
// other. So does all that hangs together by joints, or they would be torn.
void Obstacles::cut(BodyIndex body, double share, double turnShare, Vec3 carried) {
  const Island* island = islandWith(body);
  const bool flies = context.solved[body].flying;
  if (!island) return shorten(body, share, turnShare, carried, flies, context);
  const std::span<const std::uint32_t> group = movesWith(*island, body);
  const bool joints = hangs(body);
  if (group.size() == 1 && !joints) return shorten(body, share, turnShare, carried, flies, context);
  share = std::min(share, turnShare);
  if (!joints) {
    for (std::uint32_t i : group) shorten(island->bodies[i], share, share, carried, true, context);
    return;
  }
  for (BodyIndex other : island->bodies)
    if (joined.together(other, body)) shorten(other, share, share, carried, false, context);
}

// What is far lighter is carried along and stops nothing: bricks pressed into a wrecking ball must not hold it in the
// air.
bool Obstacles::farHeavier(BodyIndex body, BodyIndex other) const {
  return bodies.mass[body].mass > kHeavier * bodies.mass[other].mass;
}

bool Obstacles::isThick(BodyIndex body) const {
  return bodies.mass[body].innerRadius > kCoreShare * bodies.mass[body].outerRadius;
}

// The share of the step that the body flew before it was solved.
void Obstacles::takeBack(BodyIndex body) {
  if (context.ahead[body].share > 0 && !context.solved[body].rest) takeBackAhead(body, context);
}

void Obstacles::stop(BodyIndex body) {
  const SolvedMotion& s = context.solved[body];
  if (s.rest || !isFinite(s.d)) return;
  double turn = length(visibleTurn(bodies.mass[body], bodies.motion[body].orientation, s.th));
  // What begins the step in something goes less far until it comes out on its other side.
  const double whole = bodies.mass[body].innerRadius * (turn < kLargestTurn && s.went == 1 ? 1 : 0.5);
  const double thickness = std::max(0.0, whole - depths[body]);
  // What it was left behind by its turn, and kinematic bodies, may run over it, however slow it is itself.
  bool everything = s.went < 1 || turnsFar(bodies, body, s.th);
  if (everything || !activity.moving.empty() || exceeds(s.d, thickness)) hold(body, everything, thickness);
}

void Obstacles::hold(BodyIndex body, bool everything, double thickness) {
  Obstruction first;
  for (ShapeIndex shape : bodies.shapes[body]) obstruct(shape, everything, thickness, first);
  if (first.share == 1) return;
  changed = true;
  if (bodies.data[first.body].type != BodyType::dynamic)
    cut(body, shareLeft(body, first.share), shareLeft(body, first.turnShare), first.carried);
  else
    meet(body, first);
}

bool Obstacles::moves(BodyIndex body) const {
  return bodies.data[body].activity == BodyActivity::awake && !context.solved[body].rest;
}

// Of the step, for the body's way: islands go through impacts, and bodies fly ahead, each on its own.
double Obstacles::leftOf(BodyIndex body) const { return std::max(1e-6, context.ahead[body].left); }

// Of that way, at a moment of the step.
double Obstacles::shareLeft(BodyIndex body, double share) const {
  const double left = leftOf(body);
  return share < 1 ? std::max(0.0, (share - (1 - left)) / left) : 1;
}

// m: the part of its way that only takes it out of the frame in which it flew ahead.
Vec3 Obstacles::framesWay(BodyIndex body) const {
  return context.ahead[body].frame * (context.ahead[body].share * context.dt);
}

Obstacles::Group Obstacles::groupOf(BodyIndex body) const {
  Group out;
  if (!moves(body)) return out;
  out.flies = context.solved[body].flying;
  auto add = [&](BodyIndex b) {
    const double m = bodies.mass[b].mass;
    out.mass += m;
    out.way += context.solved[b].d * m;
    out.pace += (context.solved[b].d - framesWay(b)) * (m / leftOf(b));
    out.velocity += context.solved[b].velocity * m;
  };
  if (const Island* island = islandWith(body))
    for (std::uint32_t i : movesWith(*island, body)) add(island->bodies[i]);
  else
    add(body);
  out.way = out.way * (1 / out.mass);
  out.pace = out.pace * (1 / out.mass);
  out.velocity = out.velocity * (1 / out.mass);
  return out;
}

bool Obstacles::goTogether(BodyIndex body, BodyIndex other) const {
  const Island* island = islandWith(body);
  if (!island || island != islandWith(other) || !context.solved[body].flying) return false;
  const auto group = movesWith(*island, body);
  return std::any_of(group.begin(), group.end(), [&](std::uint32_t i) { return island->bodies[i] == other; });
}

// Adds to the ways of the body's group, and leaves it a share of its turn about its centre of mass. Bodies are moved
// along their velocities against the group's, and the centre of mass stays: so does the angular momentum. What hangs by
// joints goes no other way, or they would be torn. What rests has no way, and its island no groups.
void Obstacles::divert(BodyIndex body, const Group& group, Vec3 way, double turnShare) {
  if (!moves(body)) return;
  if (hangs(body)) return turnShare < 1 ? cut(body, 1, turnShare) : void();
  const Island* island = islandWith(body);
  if (!island) return shorten(body, 1, turnShare, way, false, context);
  const std::span<const std::uint32_t> members = movesWith(*island, body);
  auto turned = [&](BodyIndex b) {
    const Vec3 against = context.solved[b].velocity - group.velocity, own = context.solved[b].d - group.way;
    const double size2 = lengthSquared(against);
    return size2 > 0 ? against * (dot(own, against) / size2 * (turnShare - 1)) : Vec3{};
  };
  Vec3 mean;
  if (members.size() > 1 && turnShare < 1)
    for (std::uint32_t i : members)
      mean += turned(island->bodies[i]) * (bodies.mass[island->bodies[i]].mass / group.mass);
  for (std::uint32_t i : members) {
    const BodyIndex b = island->bodies[i];
    const Vec3 own = members.size() > 1 && turnShare < 1 ? turned(b) - mean : Vec3{};
    shorten(b, 1, turnShare, way + own, false, context);
  }
}

// Two of one group are not held: contacts part what is thick, and for what is thin the group ends its turn. Else two
// that meet go on together for the rest of the step. What flies has the way of both masses: the shift is along the
// relative velocity, so neither the centre of mass nor a momentum changes. Else the faster follows the slower, and what
// is far lighter the heavier one; what hangs by joints follows nothing: it is followed, or its step ends.
void Obstacles::meet(BodyIndex body, const Obstruction& first) {
  // What of a group's pace lies along its velocity.
  auto endOf = [](const Group& g) {
    const double size2 = lengthSquared(g.velocity);
    return size2 > 0 ? g.velocity * (dot(g.pace, g.velocity) / size2) : Vec3{};
  };
  const double turnShare = shareLeft(body, first.turnShare);
  if (goTogether(body, first.body)) {
    const double share = std::min(shareLeft(body, first.share), turnShare);
    if (!isThick(body) || !isThick(first.body)) divert(body, groupOf(body), {}, share);
    return;
  }
  if (hangs(body) && (last || hangs(first.body) || !moves(first.body)))
    return cut(body, shareLeft(body, first.share), turnShare);
  const Group a = groupOf(body), b = groupOf(first.body);
  const double rest = 1 - first.share;
  const bool otherTurns = turnsFar(bodies, first.body, motionOf(first.body).turn);
  const double otherShare = otherTurns ? shareLeft(first.body, first.share) : 1;
  if (last) {  // nobody looks where a new way leads: each ends its own
    divert(body, a, endOf(a) * -rest, turnShare);
    return divert(first.body, b, endOf(b) * -rest, otherShare);
  }
  Vec3 toB = (b.pace - a.pace) * rest;  // what the body needs to go with the other
  double shareOfA = 1, shareOfB = 0;
  if (a.flies && b.flies) {
    const Vec3 relative = b.velocity - a.velocity;
    const double size2 = lengthSquared(relative);
    toB = size2 > 0 ? relative * (dot(toB, relative) / size2) : Vec3{};
    shareOfA = b.mass / (a.mass + b.mass);
    shareOfB = 1 - shareOfA;
  } else if (hangs(body) || (!hangs(first.body) && !farHeavier(first.body, body) &&
                             (farHeavier(body, first.body) || lengthSquared(a.pace) < lengthSquared(b.pace)))) {
    shareOfA = 0, shareOfB = 1;
  }
  divert(body, a, toB * shareOfA, turnShare);
  divert(first.body, b, toB * -shareOfB, otherShare);
}

void Obstacles::stopAll(bool again) {
  auto each = [&](void (Obstacles::*act)(BodyIndex)) {
    for (const IslandPointer& island : islands.awake)
      if (!island->resting())
        for (BodyIndex body : island->bodies) (this->*act)(body);
    for (BodyIndex body : islands.single) (this->*act)(body);
  };
  if (!again) each(&Obstacles::takeBack);
  context.overlap = 0;
  keepOut(activity, registry, proximity, context);
  changed = true;
  for (int look = 0; look < kMostLooks && changed; look++) {
    changed = false;
    last = look + 1 == kMostLooks;
    each(&Obstacles::stop);
    stopped = stopped || changed;
  }
  if (stopped) keepOut(activity, registry, proximity, context);
}

// The first thing on a body's way, for one shape of the body. `everything`: it may be the other that does the moving.
void Obstacles::obstruct(ShapeIndex shape, bool everything, double thickness, Obstruction& first) const {
  auto wayOf = [&](BodyIndex body) {
    const Motion m = motionOf(body);
    return sweepOf(bodies, body, m.way, m.turn);
  };
  // Its way from a moment of the step on, as it goes it in what is left of its own.
  auto wayFrom = [&](BodyIndex body, double from) {
    Sweep way = wayOf(body);
    const Vec3 real = way.way - framesWay(body);
    const double done = (from - 1 + leftOf(body)) / leftOf(body);
    way.start.position += framesWay(body) + real * done;
    way.way = real * (1 - done);
    way.turn *= 1 - done;
    return way;
  };
  const ShapeData& s = shapes.data[shape];
  const Sweep all = wayOf(s.body);
  // What is driven goes on meanwhile, unless the body flew ahead in its frame.
  auto drivenFrom = [&](BodyIndex body, double from) {
    const Sweep way = wayOf(body);
    return framesWay(s.body) == Vec3{} ? way.from(from) : way;
  };
  // A turn moves no core that is at the centre. Where the end of a body is pressed in, the turn gets it out.
  bool centred = length(s.middle) < 0.5 * kCoreShare * s.innerRadius;
  proximity.broadPhase->query(sweptBounds(s, all), [&](std::uint32_t other) {
    const ShapeData& o = shapes.data[other];
    if (o.body == s.body || !shapes.mayTouch(shape, other)) return true;
    if (!context.ties->mayCollide(s.body, o.body) || joined.together(s.body, o.body)) return true;
    BodyType type = bodies.data[o.body].type;
    const bool fly = context.solved[s.body].flying && type == BodyType::dynamic && context.solved[o.body].flying;
    if (type == BodyType::dynamic && !fly && farHeavier(s.body, o.body)) return true;
    const bool both = type == BodyType::dynamic && moves(o.body);  // from when both have a way to go
    const double from = 1 - (both ? std::min(leftOf(s.body), leftOf(o.body)) : leftOf(s.body));
    const Sweep own = both ? wayFrom(s.body, from) : all, way = both ? wayFrom(o.body, from) : drivenFrom(o.body, from);
    const Vec3 motion = own.way - way.way;
    const bool turns = own.turns || way.turns;
    if (!turns && !exceeds(everything || type == BodyType::kinematic ? motion : own.way, thickness)) return true;
    double share = coreWay(s, own, o, way);
    double turnShare = centred ? 1 : share;
    if (type == BodyType::dynamic && (turns || exceeds(motion, o.innerRadius))) {
      const double over = coreWay(o, way, s, own);
      share = std::min(share, over), turnShare = std::min(turnShare, over);
    }
    auto ofStep = [&](double part) { return part < 1 ? from + part * (1 - from) : 1; };
    if (own.turns) first.turnShare = std::min(first.turnShare, ofStep(turnShare));
    // Of two that are met at once the first by number: the order in which the tree finds them must not matter.
    const bool earlier =
        ofStep(share) < first.share || (share < 1 && ofStep(share) == first.share && o.body < first.body);
    if (!earlier) return true;
    first.share = ofStep(share), first.body = o.body;
    first.carried = way.carry(transformPoint(own.at(share), s.middle), share);
    return true;
  });
}

}  // namespace

void stopAtObstacles(const Registry& registry, const Activity& activity, const Proximity& proximity,
                     StepContext& context, bool again) {
  Obstacles{registry,
            registry.bodies,
            registry.shapes,
            proximity,
            activity,
            activity.islands,
            context,
            LastingGroups(registry.bodies.motion.size(), activity.islands, context.memory),
            depthsOf(registry.bodies.motion.size(), activity.islands, context.memory)}
      .stopAll(again);
}

void hashObstacles(const IslandSet& islands, const StepContext& context, HashItems& out) {
  out.solved(islands, context);
}

// Bodies will end elsewhere: that is an angular momentum about the world's origin.
void bookObstacles(const Registry& registry, const Activity& activity, const StepContext& context, Diary& diary) {
  bookSolved(diary.report.ledger->obstacles, registry.bodies, activity.awake, context, diary.ledgerState);
}

}  // namespace brickfall
