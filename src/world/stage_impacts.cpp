// Impacts of small islands, each at its moment: a step over an impact is right to first order in its length only. An island in
// which a point closes in this step goes on to there, its open points left out; it is collided anew, its velocities change, and
// so on; what is left of the step is its step for the stages that follow. A body alone that turns fast in contact goes on in
// parts, too, since arms are frozen in each: a top would fall over. Left whole are large islands, what moves far beyond its own
// size, and what something kinematic moves.
#include <algorithm>
#include <cmath>
#include <limits>

#include "narrowphase/mesh_collide.h"
#include "solver/cycles.h"
#include "solver/finish/balance.h"
#include "solver/finish/flight.h"
#include "solver/finish/group_slide.h"
#include "solver/finish/lone_body.h"
#include "solver/finish/motion.h"
#include "solver/free_motion.h"
#include "solver/impact.h"
#include "solver/island_builder.h"
#include "solver/prepare.h"
#include "solver/store.h"
#include "world/activity.h"
#include "world/core_sweep.h"
#include "world/diary.h"
#include "world/hits.h"
#include "world/move_body.h"
#include "world/narrow_phase.h"
#include "world/stage_hash.h"
#include "world/stages.h"

namespace brickfall {

namespace {

//! - | too small: impacts of larger islands are first order in the time step | too large: cost, impacts that are not solved well
constexpr std::size_t kMostBodies = 5;
//! - | too small: quick series of impacts end first order | too large: cost
constexpr int kMostImpacts = 8;  // of an island in a step
//! of the step | too small: what is left after an impact is too short for floats | too large: impacts are met early
constexpr double kBlink = 1e-3;
//! - | too small: fast bodies are left whole | too large: contacts found from so far say little about what is met
constexpr double kFarWay = 2, kFarWayAlone = 4;  // outer radii, in a step; of a body that touches fixed things only
//! rad | too small: what falls fast without a spin rebounds late | too large: as kFarWay
constexpr double kNoTurn = 0.01;  // visible, in a step, of a body alone: then any way may be parted
//! rad | too small: cost of what tumbles | too large: tops precess too slowly, then fall
constexpr double kMostTurn = 0.2;  // visible, of a body in contact, in a part
//! - | too small: the fastest tops fall | too large: cost
constexpr int kMostTurnParts = 24;  // of a step
//! of what is left of a step | too small: what accelerates towards an impact is held up before it | too large: cost
constexpr double kAhead = 1.3;
//! not of the method: a mark
constexpr double kNever = std::numeric_limits<double>::infinity();

class ImpactWalk {
 public:
  ImpactWalk(const WorldDef& def, Registry& registry, Proximity& proximity, StepContext& context, StepReport& report,
             Events& events)
      : def_(def),
        registry_(registry),
        bodies_(registry.bodies),
        proximity_(proximity),
        ties_{proximity.contacts},
        context_(context),
        report_(report),
        events_(events) {}

  void run(Island& island);

 private:
  struct Memory {
    explicit Memory(std::pmr::memory_resource* memory) : motions(memory), contacts(memory), geometry(memory) {}
    std::pmr::vector<BodyMotion> motions;
    std::pmr::vector<Contact> contacts;
    std::pmr::vector<ContactGeometry> geometry;
  };

  bool mayBeParted(const Island& island) const;
  bool foundExactly(const Island& island) const;
  bool touchesDriven(const Island& island) const;
  Vec3 turnOf(BodyIndex body) const;
  bool mayMeet(const Island& island) const;
  bool touchesNothing(const Island& island) const;
  bool onMesh(const Island& island) const;
  double longestPart(const Island& island) const;
  double nextImpact(Island& island, double left);
  void solve(Island& island, double dt, bool toImpact, SolveStatistics& statistics);
  bool goTo(Island& island, double dt, bool toImpact);
  bool runsThrough(const Island& island, double dt) const;
  bool impact(Island& island);
  Memory remember(const Island& island) const;
  void restore(const Island& island, const Memory& memory);

  const WorldDef& def_;
  Registry& registry_;
  BodySet& bodies_;
  Proximity& proximity_;
  Ties ties_;
  StepContext& context_;
  StepReport& report_;
  Events& events_;
};

bool ImpactWalk::mayBeParted(const Island& island) const {
  if (island.bodies.size() > kMostBodies) return false;
  const BodyIndex first = island.bodies[0];
  const bool alone = island.bodies.size() == 1;
  if (alone && length(turnOf(first)) < kNoTurn && foundExactly(island)) return !touchesDriven(island);
  const double far = alone ? kFarWayAlone : kFarWay;
  for (BodyIndex body : island.bodies) {
    double way = length(bodies_.motion[body].linearVelocity) * context_.dt;
    if (!(way <= far * bodies_.mass[body].outerRadius)) return false;
  }
  return !touchesDriven(island);
}

// Its contacts are true from afar: what moves without a turn cannot get past them unseen.
bool ImpactWalk::foundExactly(const Island& island) const {
  auto round = [](ShapeType type) { return type == ShapeType::sphere || type == ShapeType::capsule; };
  return std::all_of(
      island.rows.contacts.contactOf.begin(), island.rows.contacts.contactOf.end(), [&](ContactIndex contact) {
        const Contact& c = ties_.contacts.contacts[contact];
        ShapeType a = registry_.shapes.data[c.shapeA].geometry.type, b = registry_.shapes.data[c.shapeB].geometry.type;
        if (a == ShapeType::plane || b == ShapeType::plane) return true;
        return (round(a) && (round(b) || b == ShapeType::box)) || (round(b) && a == ShapeType::box);
      });
}

bool ImpactWalk::touchesDriven(const Island& island) const {
  return std::any_of(island.partners.begin(), island.partners.end(),
                     [&](BodyIndex body) { return bodies_.isDriven(body); });
}

// rad, visible, in a step at the present spin.
Vec3 ImpactWalk::turnOf(BodyIndex body) const {
  const BodyMotion& m = bodies_.motion[body];
  return visibleTurn(bodies_.mass[body], m.orientation, m.angularVelocity) * context_.dt;
}

// Without a solve: an open point may be reached.
bool ImpactWalk::mayMeet(const Island& island) const {
  const double fall = length(context_.gravity) * context_.dt * context_.dt;
  for (ContactIndex contact : island.rows.contacts.contactOf) {
    const Contact& c = ties_.contacts.contacts[contact];
    const BodyMotion &a = bodies_.motion[c.bodyA], &b = bodies_.motion[c.bodyB];
    double most = length(b.linearVelocity - a.linearVelocity) +
                  length(a.angularVelocity) * bodies_.mass[c.bodyA].outerRadius +
                  length(b.angularVelocity) * bodies_.mass[c.bodyB].outerRadius;
    for (int i = 0; i < c.count; i++)
      if (c.points.forceN[i] == 0 && double(c.points.gap[i]) < kAhead * (most * context_.dt + fall)) return true;
  }
  return false;
}

bool ImpactWalk::touchesNothing(const Island& island) const {
  for (ContactIndex contact : island.rows.contacts.contactOf) {
    const Contact& c = ties_.contacts.contacts[contact];
    if (c.touching) return false;
    for (int i = 0; i < c.count; i++)
      if (!isOpen(c, i, context_)) return false;
  }
  return true;
}

// In the hollows of a mesh contacts come and go with each part: what spins there would sink deeper in parts than as a whole.
bool ImpactWalk::onMesh(const Island& island) const {
  return std::any_of(
      island.rows.contacts.contactOf.begin(), island.rows.contacts.contactOf.end(), [&](ContactIndex contact) {
        const Contact& c = ties_.contacts.contacts[contact];
        return isMeshPair(registry_.shapes.data[c.shapeA].geometry, registry_.shapes.data[c.shapeB].geometry);
      });
}

// s: nothing in contact turns visibly by more than kMostTurn.
double ImpactWalk::longestPart(const Island& island) const {
  if (island.bodies.size() > 1 || touchesNothing(island) || onMesh(island)) return context_.dt;
  double speed = length(turnOf(island.bodies[0])) / context_.dt;
  return std::max(context_.dt / kMostTurnParts, kMostTurn / std::max(speed, 1e-9));
}

ImpactWalk::Memory ImpactWalk::remember(const Island& island) const {
  Memory out(island.memory);
  for (BodyIndex body : island.bodies) out.motions.push_back(bodies_.motion[body]);
  for (ContactIndex contact : island.rows.contacts.contactOf) {
    out.contacts.push_back(ties_.contacts.contacts[contact]);
    out.geometry.push_back(ties_.contacts.geometry[contact]);
  }
  return out;
}
void ImpactWalk::restore(const Island& island, const Memory& memory) {
  for (std::size_t i = 0; i < island.bodies.size(); i++) bodies_.motion[island.bodies[i]] = memory.motions[i];
  for (std::size_t k = 0; k < memory.contacts.size(); k++) {
    ties_.contacts.contacts[island.rows.contacts.contactOf[k]] = memory.contacts[k];
    ties_.contacts.geometry[island.rows.contacts.contactOf[k]] = memory.geometry[k];
  }
}

// StepContext::solved of its bodies: `dt` s further; to an impact: as if its open points were not there.
void ImpactWalk::solve(Island& island, double dt, bool toImpact, SolveStatistics& statistics) {
  bool flies = toImpact && touchesNothing(island);
  island.dt = dt;
  island.toImpact = toImpact;
  island.ending = IslandEnding::unsolved;
  island.facts = findFacts(island, context_);
  island.plan = planFor(island.facts, context_.settings, dt);
  predictFreeMotions(context_, bodies_, island.bodies, dt, def_.airDensity, !flies);
  prepareBodies(island, context_);
  prepareRows(island, ties_, context_);
  if (toImpact) leaveOut(island, ties_, context_);
  if (flies) {
    for (BodyIndex body : island.bodies) storeFreeBody(body, dt, context_);
  } else {
    updateHierarchy(island, context_);
    runCycles(island, context_, statistics);
    correctMomentum(island, context_);
    storeRows(island, ties_, context_);
    tellMean(island, ties_, context_.dt, true);
    storeMotion(island, context_);
    correctFlight(island, context_);
    correctLoneBody(island, ties_, context_);
    correctGroupSlides(island, context_);
    if (solvedWell(island, context_)) balance(island, context_);
  }
  island.toImpact = false;
}

// When, in s from now, the next point closes; none: infinity. Leaves the island as it is.
double ImpactWalk::nextImpact(Island& island, double left) {
  Memory before = remember(island);
  SolveStatistics tried;  // of a motion that nothing makes: its cost counts, what it left over does not
  solve(island, left, true, tried);
  restore(island, before);
  context_.statistics.cycles += tried.cycles;
  context_.statistics.solveSides += tried.solveSides;
  context_.statistics.lightVisits += tried.lightVisits;
  return firstClosing(island, context_);
}

// False if it can't, and then it stays where it is.
bool ImpactWalk::goTo(Island& island, double dt, bool toImpact) {
  Memory before = remember(island);
  solve(island, dt, toImpact, context_.statistics);
  bool fine = solvedWell(island, context_) && !runsThrough(island, dt);
  if (fine) advanceRows(island, ties_, context_);
  for (BodyIndex body : island.bodies) fine = fine && moveBody(body, bodies_, context_);
  if (!fine) {
    restore(island, before);
    return false;
  }
  NarrowPhase narrow(registry_, context_.dt, proximity_);
  for (ContactIndex contact : island.rows.contacts.contactOf) narrow.renew(contact);
  report_.manifoldsComputed += narrow.computed();
  return true;
}

// Contacts of what is still far, or turns, may lie: on the way that the solve found for `dt` s the core of a body would pass
// into something.
bool ImpactWalk::runsThrough(const Island& island, double dt) const {
  auto wayOf = [&](BodyIndex body) {
    if (std::binary_search(island.bodies.begin(), island.bodies.end(), body))
      return sweepOf(bodies_, body, context_.solved[body].d, context_.solved[body].th);
    const BodyMotion& m = bodies_.motion[body];
    return sweepOf(bodies_, body, m.linearVelocity * dt, m.angularVelocity * dt);
  };
  auto isDynamic = [&](BodyIndex body) { return bodies_.data[body].type == BodyType::dynamic; };
  auto meets = [&](ShapeIndex shape, const Sweep& own) {
    const ShapeData& s = registry_.shapes.data[shape];
    bool met = false;
    proximity_.broadPhase->query(sweptBounds(s, own), [&](std::uint32_t other) {
      const ShapeData& o = registry_.shapes.data[other];
      if (o.body == s.body || !filtersAllow(s.def.filter, o.def.filter)) return true;
      Sweep of = wayOf(o.body);
      met = coreWay(s, own, o, of) < 1 || (isDynamic(o.body) && coreWay(o, of, s, own) < 1);
      return !met;
    });
    return met;
  };
  for (BodyIndex body : island.bodies) {
    Sweep own = wayOf(body);
    if (!own.turns && length(own.way) < kCoreShare * bodies_.mass[body].innerRadius) continue;
    for (ShapeIndex shape : bodies_.shapes[body])
      if (meets(shape, own)) return true;
  }
  return false;
}

bool ImpactWalk::impact(Island& island) {
  std::pmr::vector<ContactImpact> impacts(island.memory);
  island.dt = context_.dt;
  updateHierarchy(island, context_);
  if (!solveImpact(island, ties_, bodies_, context_, kBlink * context_.dt, context_.statistics, impacts)) return false;
  for (BodyIndex body : island.bodies) bodies_.data[body].lag = 0;
  const ContactRows& rows = island.rows.contacts;
  for (const ContactImpact& hit : impacts) {
    ties_.contacts.strike(rows.contactOf[hit.row]);
    tellHit(def_, registry_, ties_.contacts.contacts[rows.contactOf[hit.row]], rows.records[hit.row], hit.speed,
            hit.impulse, events_.hits);
  }
  report_.impacts++;
  return true;
}

void ImpactWalk::run(Island& island) {
  if (!mayBeParted(island)) return;
  double left = context_.dt;
  const double blink = kBlink * context_.dt;
  for (int parts = 0, impacts = 0; parts < kMostTurnParts + kMostImpacts && impacts < kMostImpacts && left > blink;
       parts++) {
    double part = std::min(left, longestPart(island));
    double next = mayMeet(island) ? nextImpact(island, part) : kNever;
    bool ahead = next <= kAhead * part;  // what comes a little later is not to be held up before it
    if (!ahead && part == left) break;
    double way = std::min({part, next, left - blink});
    if (way > blink) {
      if (!goTo(island, way, ahead)) break;
      left -= way;
    }
    if (!(next <= part)) continue;
    if (!impact(island)) break;
    impacts++;
  }
  island.dt = left;
}

}  // namespace

void meetImpacts(const WorldDef& def, Registry& registry, IslandSet& islands, Proximity& proximity,
                 StepContext& context, StepReport& report, Events& events) {
  context.free.resize(registry.bodies.slots());
  context.solved.resize(registry.bodies.slots());
  proximity.contacts.endStrikes();
  ImpactWalk walk(def, registry, proximity, context, report, events);
  for (IslandPointer& island : islands.awake) {
    island->dt = context.dt;
    if (!island->settled()) walk.run(*island);
  }
}

void hashImpacts(const Registry& registry, const IslandSet& islands, const ContactSet& contacts, HashItems& out) {
  for (const IslandPointer& island : islands.awake) {
    if (island->settled()) continue;
    out.bodies(island->bodies, [&](Mix& h, BodyIndex body) { mix(h, registry.bodies.motion[body]); });
  }
  out.contacts(islands, contacts);
}

// Places and contacts changed, too: what is booked is all of it.
void bookImpacts(const Registry& registry, const ContactSet& contacts, const StepContext& context, Diary& diary) {
  Balance now = balanceNow(registry.bodies, contacts, context);
  diary.ledgerState.bookElastic(diary.report.ledger->impacts, now.elastic);
  diary.ledgerState.book(diary.report.ledger->impacts, now);
}

}  // namespace brickfall
