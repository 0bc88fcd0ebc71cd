// What the contacts of a step can't see: they are found along the velocities before it, with normals and arms that stay
// as they are. A body that a hit throws somewhere else, or spins through most of a turn, or that a force accelerates
// from rest, could end the step behind something thin. So the core of every fast body, a ball a fourth as thick as its
// shape, is swept along the way that the solve found, against the ways of the others, and the body stops for this step
// where its core would enter something, or where it would run over the core of something smaller. Of two that both
// move, both stop; what a kinematic body runs into is taken along. What is long and turns is looked at in its own
// frame, where ways are arcs, in parts of 0.1 rad. A body that contacts would spin too far in one step first has its
// turn cut, as far as frozen arms are true, and its way alike. Velocities stay: the next step finds the contact and
// does the rest.
#include <algorithm>
#include <cmath>

#include "solver/finish/motion.h"
#include "solver/finish/plastic_hit.h"
#include "solver/free_motion.h"
#include "world/activity.h"
#include "world/core_sweep.h"
#include "world/diary.h"
#include "world/proximity.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

namespace {

//! times the mass | too small: a body goes on through what is only a little lighter
//! | too large: bricks pressed into a wrecking ball hold it in the air
constexpr double kFarHeavier = 30;  // times the mass
//! of a way | too small: bricks that hit each other deep hold each other there
//! | too large: cores pass that have not met
constexpr double kHeld = 1e-3;
//! - | too small: what turns freely ends beyond what it met | too large: cost
constexpr int kLooks = 4;  // along a free turn: a part of it is not on the arc that all of it makes
//! of the outer radius | too small: thin plates are crept through | too large: with kHeld
constexpr double kThick = 0.2;
//! rad | too small: heavy bodies that spin are held up by what they hit
//! | too large: they turn on through what they hit
constexpr double kLargestStuckTurn = 0.3;
bool exceeds(Vec3 way, double limit) { return lengthSquared(way) > limit * limit; }

struct Motion {
  Vec3 way, turn;  // m, rad: in this step
};

struct Obstruction {
  double share = 1;           // of a way: where it ends
  double turnShare = 1;       // of the turn
  BodyIndex body = kNoIndex;  // what ends it
  Vec3 carried;               // m: how far that takes along, from there, what does not get past it
};

// A body that something far heavier has run over, after a share of the heavy one's way.
struct Stuck {
  BodyIndex body, heavy;
  double share;
  double went;  // of the body's own way, until then
};

struct Obstacles {
  const BodySet& bodies;
  const ShapeSet& shapes;
  const BroadPhase& broadPhase;
  const Activity& activity;
  const IslandSet& islands;
  StepContext& context;
  std::pmr::vector<Stuck> stuck;

  void stopAll();
  void cutTurn(BodyIndex body);
  void takeBack(BodyIndex body);
  void stop(BodyIndex body);
  bool hold(BodyIndex body, bool everything, double thickness);
  void obstruct(ShapeIndex shape, bool everything, double thickness, Obstruction& first) const;
  const Island* islandWith(BodyIndex body) const;
  Motion motionOf(BodyIndex body) const;
  std::span<const std::uint32_t> movesWith(const Island& island, BodyIndex body) const;
  Vec3 commonWay(const Island& island, std::span<const std::uint32_t> group) const;
  void cut(BodyIndex body, double share, double turnShare, Vec3 carried = {});
  bool farHeavier(BodyIndex body, BodyIndex other) const;
  bool fliesAlone(BodyIndex body) const;
  bool driven(BodyIndex body, BodyIndex other) const;
  void stick(BodyIndex body, const Obstruction& first);
  void hitAll();
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

// The body's group, as numbers in its island: of one that flies, all of it; of one that is supported, the body alone.
std::span<const std::uint32_t> Obstacles::movesWith(const Island& island, BodyIndex body) const {
  const auto place = std::lower_bound(island.bodies.begin(), island.bodies.end(), body) - island.bodies.begin();
  const auto number = std::size_t(place);
  const std::span<const std::uint32_t> group = island.groups.bodies(island.groups.groupOf(number));
  if (context.solved[body].flying) return group;
  return group.subspan(std::size_t(std::lower_bound(group.begin(), group.end(), std::uint32_t(number)) - group.begin()),
                       1);
}

// Leaves the body a share of its way, then `carried`, and a share of its turn; it keeps its velocities. All of a group
// that flies goes the same share: its step ends there, and neither its linear nor its angular momentum changes.
void Obstacles::cut(BodyIndex body, double share, double turnShare, Vec3 carried) {
  const Island* island = islandWith(body);
  const bool flies = context.solved[body].flying;
  if (!island) return shorten(body, share, turnShare, carried, flies, context);
  const std::span<const std::uint32_t> group = movesWith(*island, body);
  if (group.size() == 1) return shorten(body, share, turnShare, carried, flies, context);
  share = std::min(share, turnShare);
  for (std::uint32_t i : group) shorten(island->bodies[i], share, share, {}, true, context);
}

// What is far lighter is carried along and stops nothing: bricks pressed into a wrecking ball must not hold it in the
// air.
bool Obstacles::farHeavier(BodyIndex body, BodyIndex other) const {
  return bodies.mass[body].mass > kFarHeavier * bodies.mass[other].mass;
}

bool Obstacles::fliesAlone(BodyIndex body) const {
  const Island* island = islandWith(body);
  return context.solved[body].flying && (!island || movesWith(*island, body).size() == 1);
}

// Something far heavier presses the two into each other, and flies with them: as a group they would stop it.
bool Obstacles::driven(BodyIndex body, BodyIndex other) const {
  const Island* island = islandWith(body);
  if (!island || island != islandWith(other) || !context.solved[body].flying) return false;
  const std::span<const std::uint32_t> group = movesWith(*island, body);
  auto isIn = [&](auto&& test) {
    return std::any_of(group.begin(), group.end(), [&](std::uint32_t i) { return test(island->bodies[i]); });
  };
  return isIn([&](BodyIndex i) { return i == other; }) && isIn([&](BodyIndex i) { return farHeavier(i, body); });
}

// Something far heavier that flies has run over a body that flies alone. Both end there if the heavy one turns: its
// surface goes along an arc then, but what it hits goes straight on.
void Obstacles::stick(BodyIndex body, const Obstruction& first) {
  const SolvedMotion& heavy = context.solved[first.body];
  const Vec3 spin = spinAtEnd(first.body, heavy.angularMomentum, context);
  const double turn = length(
      visibleTurn(bodies.mass[first.body], bodies.motion[first.body].orientation, spin * context.free[first.body].dt));
  cut(body, first.share, first.turnShare);
  if (turn * (1 - first.share) > kLargestStuckTurn) cut(first.body, first.share, first.share);
  stuck.push_back({body, first.body, first.share, context.solved[body].went});
}

// The hits that no contact has seen, when no way is cut any more. What is hit goes on with the place where it was met;
// the impulse of that acts on both, so the momenta of the two stay as they are.
void Obstacles::hitAll() {
  std::stable_sort(stuck.begin(), stuck.end(), [](const Stuck& a, const Stuck& b) { return a.share < b.share; });
  for (const Stuck& s : stuck) {
    const bool goesOn =
        context.solved[s.heavy].went == 1 && context.ahead[s.heavy] == 0 && context.solved[s.body].went == s.went;
    hitPlastically(s.body, s.heavy, goesOn ? 1 - s.share : 0, context);
  }
}

// Contacts see what is in it: a thin plate may be crept through from one step to the next.
bool Obstacles::isThick(BodyIndex body) const {
  return bodies.mass[body].innerRadius > kThick * bodies.mass[body].outerRadius;
}

// m: of the centre of mass of a group that flies; of what supports it, else.
Vec3 Obstacles::commonWay(const Island& island, std::span<const std::uint32_t> group) const {
  const std::uint32_t number = island.groups.groupOf(group.front());
  if (!island.groups.flies(number))
    return bodies.motion[island.partners[island.groups.partner(number) - island.bodies.size()]].linearVelocity *
           context.dt;
  Vec3 moment;
  double mass = 0;
  for (std::uint32_t i : group) {
    const double m = bodies.mass[island.bodies[i]].mass;
    moment += context.solved[island.bodies[i]].d * m;
    mass += m;
  }
  return moment * (1 / mass);
}

// Cuts the turn of a body in contact to the angle for which frozen arms are true, and its way alike, against the
// common way of its group.
void Obstacles::cutTurn(BodyIndex body) {
  const SolvedMotion& s = context.solved[body];
  const Island* island = islandWith(body);
  if (!island || s.rest || s.freeTurn || !isFinite(s.d)) return;
  const double turn = length(visibleTurn(bodies.mass[body], bodies.motion[body].orientation, s.th));
  if (!(turn > kLargestTurn)) return;
  const double share = kLargestTurn / turn;
  const std::span<const std::uint32_t> group = movesWith(*island, body);
  const Vec3 common = commonWay(*island, group);
  for (std::uint32_t i : group) shorten(island->bodies[i], share, share, common * (1 - share), false, context);
}

// The share of the step that the body flew before it was solved.
void Obstacles::takeBack(BodyIndex body) {
  if (context.ahead[body] > 0 && !context.solved[body].rest) takeBackAhead(body, context);
}

void Obstacles::stop(BodyIndex body) {
  const SolvedMotion& s = context.solved[body];
  if (s.rest || !isFinite(s.d)) return;
  double turn = length(visibleTurn(bodies.mass[body], bodies.motion[body].orientation, s.th));
  double thickness = bodies.mass[body].innerRadius * (turn < kLargestTurn && s.went == 1 ? 1 : 0.5);
  // What it was left behind by its turn, and kinematic bodies, may run over it, however slow it is itself.
  bool everything = s.went < 1 || turnsFar(bodies, body, s.th);
  if (!(everything || !activity.moving.empty() || exceeds(s.d, thickness))) return;
  for (int look = 0; look < kLooks && hold(body, everything, thickness); look++) {
  }
}

// True if it was held on a free turn: then it ends elsewhere than where it was looked for.
bool Obstacles::hold(BodyIndex body, bool everything, double thickness) {
  Obstruction first;
  for (ShapeIndex shape : bodies.shapes[body]) obstruct(shape, everything, thickness, first);
  if (first.share == 1) return false;
  const bool elsewhere = context.solved[body].freeTurn && first.turnShare < 1;
  const bool dynamic = bodies.data[first.body].type == BodyType::dynamic;
  if (dynamic && farHeavier(first.body, body) && context.solved[first.body].flying && fliesAlone(body)) {
    stick(body, first);
    return false;
  }
  if (!dynamic || farHeavier(first.body, body)) {
    cut(body, first.share, first.turnShare, first.carried);
    return false;
  }
  cut(body, first.share, first.turnShare);
  Motion other = motionOf(first.body);
  bool turns = turnsFar(bodies, first.body, other.turn);
  if (turns || exceeds(other.way, thickness)) cut(first.body, first.share, turns ? first.share : 1);
  return elsewhere;
}

// All turns are cut before anything is looked for: a body is held against the ways that others will go.
void Obstacles::stopAll() {
  auto each = [&](void (Obstacles::*act)(BodyIndex)) {
    for (const IslandPointer& island : islands.awake)
      if (!island->resting())
        for (BodyIndex body : island->bodies) (this->*act)(body);
    for (BodyIndex body : islands.single) (this->*act)(body);
  };
  each(&Obstacles::cutTurn);
  each(&Obstacles::takeBack);
  each(&Obstacles::stop);
  hitAll();
}

// The first thing on a body's way, for one shape of the body. `everything`: it may be the other that does the moving.
void Obstacles::obstruct(ShapeIndex shape, bool everything, double thickness, Obstruction& first) const {
  auto wayOf = [&](BodyIndex body) {
    Motion m = motionOf(body);
    return sweepOf(bodies, body, m.way, m.turn);
  };
  const ShapeData& s = shapes.data[shape];
  Sweep own = wayOf(s.body);
  Vec3 d = own.way;
  // A turn moves no core that is at the centre. Where the end of a body is pressed in, the turn gets it out.
  bool centred = length(s.middle) < 0.5 * kCoreShare * s.innerRadius;
  broadPhase.query(sweptBounds(s, own), [&](std::uint32_t other) {
    const ShapeData& o = shapes.data[other];
    if (o.body == s.body || !filtersAllow(s.def.filter, o.def.filter)) return true;
    BodyType type = bodies.data[o.body].type;
    if (type == BodyType::dynamic && farHeavier(s.body, o.body)) return true;
    Sweep way = wayOf(o.body);
    Vec3 motion = d - way.way;
    bool turns = own.turns || way.turns;
    if (!turns && !exceeds(everything || type == BodyType::kinematic ? motion : d, thickness)) return true;
    double share = coreWay(s, own, o, way);
    double turnShare = centred ? 1 : share;
    if (type == BodyType::dynamic && (turns || exceeds(motion, o.innerRadius))) {
      double over = coreWay(o, way, s, own);
      share = std::min(share, over), turnShare = std::min(turnShare, over);
    }
    // Bricks that have pressed into each other would stay so for ever: their contacts part them.
    if (type == BodyType::dynamic && isThick(s.body) && isThick(o.body) &&
        (share < kHeld || (share < 1 && driven(s.body, o.body))))
      return true;
    if (own.turns) first.turnShare = std::min(first.turnShare, turnShare);
    if (!(share < first.share)) return true;
    first.share = share, first.body = o.body;
    first.carried = way.carry(transformPoint(own.at(share), s.middle), share);
    return true;
  });
}

}  // namespace

void stopAtObstacles(const Registry& registry, const Activity& activity, const Proximity& proximity,
                     StepContext& context) {
  Obstacles{registry.bodies,
            registry.shapes,
            *proximity.broadPhase,
            activity,
            activity.islands,
            context,
            std::pmr::vector<Stuck>(context.memory)}
      .stopAll();
}

void hashObstacles(const IslandSet& islands, const StepContext& context, HashItems& out) {
  out.solved(islands, context);
}

// Bodies will end elsewhere: that is an angular momentum about the world's origin.
void bookObstacles(const Registry& registry, const Activity& activity, const StepContext& context, Diary& diary) {
  bookSolved(diary.report.ledger->obstacles, registry.bodies, activity.awake, context, diary.ledgerState);
}

}  // namespace brickfall
