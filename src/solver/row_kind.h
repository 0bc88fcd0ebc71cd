// The functions that every kind of row has, in the order in which a step calls them. The compiler asks them of each
// kind that Rows lists, and names one that is missing. What each is for in detail is said where contacts have it
// (contact/rows.h): a joint's answers to most are one line.
#pragma once
#include <concepts>
#include <memory_resource>
#include <utility>
#include <vector>

#include "brickfall/step_trace.h"
#include "dynamics/ties.h"
#include "solver/blows.h"
#include "solver/boundary.h"
#include "solver/reaction.h"
#include "solver/renewals.h"
#include "solver/step_context.h"
#include "solver/tie_report.h"

namespace brickfall {

struct Island;

// Anything that can be called so: for the concepts below.
struct AnyNumber {
  std::uint32_t operator()(BodyIndex) const { return 0; }
};
struct AnyVisit {
  template <class... Of> void operator()(const Of&...) const {}
};

// A list of rows, made of the links of an island.
template <class Kind>
concept ListsRows = requires(Kind& kind, const Kind& seen, std::size_t k, std::uint32_t index, Ties& ties,
                             const Ties& ofAll, const Island& island, const StepContext& context) {
  { Kind::kPoints } -> std::convertible_to<double>;           // visits that a row counts as; its points at most
  { Kind::kLasts } -> std::convertible_to<bool>;              // its ties stay, and bodies swing on them
  { Kind::kYields } -> std::convertible_to<bool>;             // it breaks, and gives no impulse in no time
  { Kind::kFirm } -> std::convertible_to<bool>;               // the rounding of its bodies' ways is a force
  { Kind::kRecordSize } -> std::convertible_to<std::size_t>;  // bytes of what the solve reads of a row
  { seen.size() } -> std::same_as<std::size_t>;
  kind.reserve(k);
  kind.add(index);  // a link's
  { seen.indexOf(k) } -> std::same_as<std::uint32_t>;
  { seen.continues(seen, context) } -> std::same_as<bool>;  // the same ties as in an old list
  kind.bind(ties, AnyNumber{});                             // once for each list: its bodies' numbers in the island
  // What the solve reads of rows may go while their island rests, and comes again before they are prepared. Ends that
  // are known then, too; kNoIndex: the tie is gone.
  kind.takeRoom(island, ofAll);
  kind.giveRoom();
  { seen.endsIn(island, ofAll, k) } -> std::same_as<RowEnds>;
  { seen.ends(k) } -> std::same_as<RowEnds>;
  { seen.bodies(k, ofAll) } -> std::same_as<std::pair<BodyIndex, BodyIndex>>;
  { seen.strength(k, context) } -> std::same_as<float>;  // how firmly it ties its bodies, for the hierarchy
};

// What walks over the rows of an island ask of a row, whatever its kind.
template <class Kind>
concept HoldsBodies = requires(const Kind& seen, std::size_t k, Vec3 direction, Vec3f way, bool onB, double dt,
                               const EndChanges& change, const StepSpan& span, const SolveMotion* motion,
                               const StepContext& context, FrictionAlong& friction, Ties& ties) {
  // Its bodies are one group in this step: they fly, slide and rest together. A contact ties while it carries force, a
  // joint always.
  { seen.ties(k, context) } -> std::same_as<bool>;
  { seen.carriesForce(k, context) } -> std::same_as<bool>;
  { seen.sticks(k, context) } -> std::same_as<bool>;  // ... and lets its bodies slide nowhere
  { seen.pins(k, context) } -> std::same_as<bool>;    // ... and lets them roll on each other nowhere
  { seen.holds(k, context) } -> std::same_as<bool>;   // ... that is no impact's, and they do not part
  { seen.grip(k, context) } -> std::same_as<RowGrip>;
  { seen.normal(k) } -> std::same_as<Vec3>;
  { seen.courseOf(k, change, span, context) } -> std::same_as<RowCourse>;
  { seen.wouldMeet(k, change, change, dt) } -> std::same_as<bool>;
  { seen.meetsWithin(k, way, motion, context) } -> std::same_as<bool>;
  seen.addFriction(k, direction, onB, context, friction);
  seen.letGo(ties);
};

// The step: prepare, then the solve, then store. `prepare` comes after the masses and free motions of the island's
// bodies are set (solver/prepare.h), and may add to them.
template <class Kind>
concept GoesThroughAStep = requires(Kind& kind, const Kind& seen, std::size_t k, std::size_t count, Island& island,
                                    const Island& solved, Ties& ties, StepContext& context, const StepContext& given,
                                    const SolveMotion* motion, float share, bool exact, Reading* readings,
                                    const Boundary& boundary, BoundarySums& sums, Renewal when, double dt,
                                    BodySet& bodies, const Held& held, Vec3 along, Holding& holding, Blows& blows) {
  seen.addHolding(k, along, ties, bodies, holding);      // along a direction, of what yields
  seen.giveBlows(held, dt, ties, bodies, given, blows);  // before anything is prepared (blows.h); dt 0: none
  kind.prepare(island, ties, given);
  // In the solve: force at the present motion, of one row, of many, of a cluster's boundary, with stiffness.
  { seen.arms(k) } -> std::same_as<Arms>;
  seen.read(k, count, motion, readings);
  seen.sumBoundary(boundary, sums);
  seen.eachResistance(AnyVisit{});  // to rolling: bodies on which it acts are solved as finely
  seen.eachHold(AnyVisit{});        // pull that rows bear whose forces follow from places alone: solved less finely
  { seen.react(k, motion) } -> std::same_as<Reaction>;
  { seen.reactStiff(k, motion, exact) } -> std::same_as<StiffReaction>;
  // Between its cycles, or its Newton steps (direct_solve.cpp): what a row keeps frozen may follow the motion found.
  // Each returns whether the row's force has changed.
  { seen.boundsFollow(k) } -> std::same_as<bool>;                 // asked once: whether the next three are called
  { kind.renewBounds(k, motion, share) } -> std::same_as<bool>;   // after each cycle
  { kind.settleBounds(k, motion, share) } -> std::same_as<bool>;  // after a direct solve has ended, up to three times
  { kind.holdJam(k, motion, share) } -> std::same_as<bool>;       // every few cycles, of what is jammed
  // After the solve, as often as it goes on, or within its cycles: what was frozen in it is set anew. True: the solve
  // goes on from there.
  { kind.renewFrozen(solved, given, when) } -> std::same_as<bool>;
  // After it.
  { kind.store(island, ties, context) } -> std::same_as<bool>;
  seen.tellShare(ties, share);
  { seen.owes(k, given) } -> std::same_as<bool>;
  { seen.reboundWork(k, motion) } -> std::same_as<double>;
  { seen.mostWork(k) } -> std::same_as<double>;  // J: the most that it can give to bodies while partners are at rest
  { seen.returnedWork(k) } -> std::same_as<double>;  // J: by what holds places
  seen.advance(solved, ties, given);
};

// Impacts at their moment (solver/impact.h), and the trials of an island's step that they need.
template <class Kind>
concept MeetsImpacts = requires(Kind& kind, const Kind& seen, double number, bool fine, const Island& island,
                                Ties& ties, const Ties& ofAll, const StepContext& context,
                                std::pmr::vector<TieImpact>& impacts, typename Kind::Memory& memory) {
  { seen.mayClose(context, number) } -> std::same_as<bool>;
  { seen.touchNothing(context) } -> std::same_as<bool>;  // false where anything is tied: it does not fly freely
  { seen.firstClosing(island, number, context) } -> std::same_as<double>;
  kind.leaveOut(ties, context);
  kind.startImpact(island, context, number);  // no time passes: a tie that holds, holds velocities, not places
  kind.keepImpactForces(island);
  { kind.reboundImpact(island, context, impacts) } -> std::same_as<bool>;
  kind.endImpact(island, ties, context, fine);
  seen.remember(ofAll, memory);
  seen.restore(ties, memory);
};

// What the world asks, to tell of a step and to keep its state.
template <class Kind>
concept IsReported = requires(Kind& kind, const Kind& seen, std::size_t k, std::uint32_t index, double least,
                              bool current, const Island& island, Ties& ties, const Ties& ofAll, const BodySet& bodies,
                              const StepContext& context, Mix& hash, WriteArchive& out, ReadArchive& in,
                              Findings& findings, TieWork& work, BalanceChange& support,
                              std::pmr::vector<TieImpact>& impacts) {
  seen.archive(out);
  kind.archive(in);
  seen.hashName(hash, k, ofAll);
  seen.hashMemory(hash, k, ofAll);
  seen.hashRecord(hash, k, ofAll);
  seen.checkStructure(findings, island, ofAll, bodies, current);
  seen.checkRanges(findings);
  seen.check(findings, island, ofAll, current);
  seen.eachManifold(AnyVisit{});
  seen.eachTouching(ofAll, AnyVisit{});
  { seen.countPoints(ofAll) } -> std::same_as<PointCount>;
  seen.findHits(island, context, least, impacts);
  seen.addWork(island, context, work);
  seen.addSupport(island, context, support);
  { Kind::elasticEnergy(index, context) } -> std::same_as<double>;
  seen.startAfresh(ties);
};

template <class Kind>
concept RowKind =
    ListsRows<Kind> && HoldsBodies<Kind> && GoesThroughAStep<Kind> && MeetsImpacts<Kind> && IsReported<Kind>;

}  // namespace brickfall
