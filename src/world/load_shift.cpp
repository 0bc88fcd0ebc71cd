#include "world/load_shift.h"

#include <algorithm>

#include "solver/mortar/law.h"
#include "solver/scale.h"

namespace brickfall {

namespace {

// Times of a brick's own motion: in 0.1 s it falls by most of its height, and one that only shook is back in place. In
// half of that what sprang has swung, and what has lost its support has hardly moved.
//! s of a brick | too small: an opening that slows down for a step counts as two | too large: a second hit is the first
constexpr double kPause = 0.1;  // without damage, after which a joint opens anew
//! not of the method: follows from kPause
constexpr double kWatch = kPause / 2;  // after a break: what ties bear is a mean over it, over one step at least

// x the method's times: of the smaller one of the joint's bodies that move.
double timeScale(const Mortar& m, const StepContext& context) {
  double least = 0;
  for (BodyIndex body : {m.bodyA, m.bodyB}) {
    const BodyMass& mass = context.bodies->mass[body];
    if (mass.invMass > 0 && (least == 0 || mass.innerRadius < least)) least = mass.innerRadius;
  }
  return least > 0 ? scaleOf(least, judgingGravity(context.gravity)).time : 1;
}

struct LoadOf {
  BodyIndex body;
  TieLoad load;  // before, and after the step
};

// N: of mortar before the step. Either of its bodies is in the joint's island, or none is in any.
Vec3T<float> forceBefore(MortarIndex mortar, const Ties& ties, const Activity& activity) {
  const Mortar& m = ties.mortar.slots[mortar];
  for (BodyIndex body : {m.bodyA, m.bodyB}) {
    const std::uint32_t in = body < activity.islandOf.size() ? activity.islandOf[body] : kNoIndex;
    if (in < activity.islands.awake.size() && activity.islands.awake[in])
      return mortar::forceBefore(*activity.islands.awake[in], mortar, m);
  }
  return m.force;
}

// All ties of the bodies listed (ascending), by body; contacts of two bodies together.
std::vector<LoadOf> loadsOf(const std::vector<BodyIndex>& bodies, const Ties& ties, const Activity& activity) {
  std::vector<LoadOf> out;
  auto isListed = [&](BodyIndex body) { return std::binary_search(bodies.begin(), bodies.end(), body); };
  // Most ties are of none of these bodies: their forces are not asked for.
  auto add = [&](BodyIndex bodyA, BodyIndex bodyB, auto loadOf) {
    const bool a = isListed(bodyA), b = isListed(bodyB);
    if (!a && !b) return;
    const TieLoad load = loadOf();
    if (a) out.push_back({bodyA, load});
    if (b) out.push_back({bodyB, load});
  };
  ties.mortar.eachAwake([&](const Link& link) {
    const Mortar& m = ties.mortar.slots[link.index];
    add(m.bodyA, m.bodyB, [&] {
      return TieLoad{link.index, m.bodyA, m.bodyB, length(forceBefore(link.index, ties, activity)), length(m.force)};
    });
  });
  ties.contacts.eachAwake([&](const Link& link) {
    const Contact& c = ties.contacts.contacts[link.index];
    const BodyIndex bodyA = std::min(c.bodyA, c.bodyB), bodyB = std::max(c.bodyA, c.bodyB);
    add(bodyA, bodyB, [&] { return TieLoad{kNoIndex, bodyA, bodyB, c.earlierForce, forceOf(c)}; });
  });
  std::stable_sort(out.begin(), out.end(), [](const LoadOf& a, const LoadOf& b) { return a.body < b.body; });
  std::size_t kept = 0, start = 0;
  for (std::size_t i = 0; i < out.size(); i++) {
    if (kept > 0 && out[kept - 1].body != out[i].body) start = kept;
    const auto first = std::find_if(
        out.begin() + std::ptrdiff_t(start), out.begin() + std::ptrdiff_t(kept),
        [&](const LoadOf& other) { return other.load.mortar == kNoIndex && other.load.isSame(out[i].load); });
    if (first == out.begin() + std::ptrdiff_t(kept)) {
      out[kept++] = out[i];
    } else {
      first->load.before += out[i].load.before;
      first->load.after += out[i].load.after;
    }
  }
  out.resize(kept);
  return out;
}

float gainOf(const TieLoad& load) { return load.after - load.before; }

// In the place of the one that gains least, where there is no room.
void addLoad(OpeningMemory& past, const TieLoad& load) {
  if (past.count < kTieLoads) {
    past.loads[past.count++] = load;
    return;
  }
  TieLoad* const least = std::min_element(past.loads, past.loads + kTieLoads,
                                          [](const TieLoad& a, const TieLoad& b) { return gainOf(a) < gainOf(b); });
  if (gainOf(load) > gainOf(*least)) *least = load;
}

// visit(load) for the ties of both bodies of the joint but itself.
template <class Visit>
void eachBeside(MortarIndex mortar, const Mortar& m, const std::vector<LoadOf>& loads, Visit visit) {
  for (BodyIndex body : {m.bodyA, m.bodyB}) {
    auto at = std::partition_point(loads.begin(), loads.end(), [&](const LoadOf& l) { return l.body < body; });
    for (; at != loads.end() && at->body == body; ++at) {
      const bool again = body == m.bodyB && at->load.names(m.bodyA);  // a tie of the two
      if (at->load.mortar != mortar && !again) visit(at->load);
    }
  }
}

// Joints whose opening begins in this step get a memory of their own.
std::vector<MortarIndex> beginOpenings(double time, const StepContext& context, const Activity& activity, Ties& ties) {
  MortarSet& set = ties.mortar;
  std::vector<MortarIndex> begins;
  std::vector<OpeningMemory> fresh;
  set.eachAwake([&](const Link& link) {
    const Mortar& m = set.slots[link.index];
    if (!(m.damage > 0)) return;
    OpeningMemory* past = set.pastOf(link.index);
    if (past && !(m.damage > past->damage)) return;
    if (!past || time - past->grewTime > kPause * timeScale(m, context)) {
      OpeningMemory opening;
      opening.mortar = link.index;
      opening.crackTime = past ? past->crackTime : time;
      opening.openTime = time;
      opening.force = forceBefore(link.index, ties, activity);
      begins.push_back(link.index);
      if (!past) fresh.push_back(opening);
      if (past) *past = opening;
    }
    OpeningMemory& told = past ? *past : fresh.back();
    told.grewTime = time;
    told.damage = m.damage;
  });
  if (!fresh.empty()) set.addPasts(std::move(fresh));
  return begins;
}

}  // namespace

void noteOpenings(double time, const StepContext& context, const Activity& activity, Ties& ties) {
  MortarSet& set = ties.mortar;
  const std::vector<MortarIndex> begins = beginOpenings(time, context, activity, ties);
  if (begins.empty() && set.watched.empty()) return;
  std::vector<BodyIndex> bodies;
  auto addBodies = [&](const std::vector<MortarIndex>& list) {
    for (MortarIndex mortar : list)
      for (BodyIndex body : {set.slots[mortar].bodyA, set.slots[mortar].bodyB}) bodies.push_back(body);
  };
  addBodies(begins);
  addBodies(set.watched);
  makeAscending(bodies);
  const std::vector<LoadOf> loads = loadsOf(bodies, ties, activity);
  for (MortarIndex mortar : begins) {
    OpeningMemory& past = *set.pastOf(mortar);
    eachBeside(mortar, set.slots[mortar], loads, [&](TieLoad load) { addLoad(past, load); });
    for (std::uint32_t i = 0; i < past.count; i++) past.loads[i].after = 0;
  }
  for (MortarIndex mortar : set.watched) {
    OpeningMemory& past = *set.pastOf(mortar);
    const double share = time > past.breakTime ? std::min(1.0, context.dt / (time - past.breakTime)) : 1;
    eachBeside(mortar, set.slots[mortar], loads, [&](TieLoad load) {
      TieLoad* const end = past.loads + past.count;
      TieLoad* const known = std::find_if(past.loads, end, [&](const TieLoad& old) { return old.isSame(load); });
      // Of what breaks meanwhile, the mean until then stays.
      const auto mean = [&](float until) {
        return float(double(until) + (double(load.after) - double(until)) * share);
      };
      if (known != end) {
        known->after = mean(known->after);
      } else {
        load.before = 0;
        load.after = mean(0);
        addLoad(past, load);
      }
    });
  }
  // Slack for rounding.
  std::erase_if(set.watched, [&](MortarIndex mortar) {
    const double watch = kWatch * timeScale(set.slots[mortar], context);
    return time - set.pastOf(mortar)->breakTime > watch * 0.999;
  });
}

void noteBreak(MortarIndex mortar, double time, MortarSet& set) {
  OpeningMemory* const past = set.pastOf(mortar);
  if (!past) return;
  past->breakTime = time;
  insertAscending(set.watched, mortar);
}

}  // namespace brickfall
