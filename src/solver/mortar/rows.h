// Mortar joints as rows of an island's solve: faces of four points that hold both ways, up to caps.
//
// A point is a spring from the place at which it carries nothing. Mortar is firm: 1e5 times mass / step^2 of a brick.
// Its springs are linear within the caps, which the solve finds as easily as soft ones.
//
// Softening is the concave part of the law, and stands outside the solve. Caps are frozen in it. After it each joint
// looks at what it took: its forces x the mean of the way that its bodies would have gone and of the way that they
// went. If that is more than what is left of its energy, its caps fall (S, law.h), and the solve goes on. So a joint
// takes no more than its fracture energy in a step of any length.
#pragma once
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <utility>
#include <vector>

#include "solver/face/rows.h"
#include "solver/lasting_rows.h"
#include "solver/mortar/law.h"
#include "solver/renewals.h"

namespace brickfall {

// Facts of a joint at the start of a step that the record does not have. By point, where there are four.
struct MortarStart {
  float heldN[4] = {}, held1[4] = {}, held2[4] = {};  // N: forces at the start
  float opens[4] = {}, goes1[4] = {}, goes2[4] = {};  // m: ways by the velocities at the start
  Vec3f arc;            // m: of B against A beyond its linear way, as the bodies turn at the start
  float longest = 0;    // m: of the arc, by the velocities at the start
  float stiffness = 0;  // N/m, of a point, firm as it is
  float pressure = 0;   // N, of a point: mean of the last step; below 0: pull
  float tougher = 1;    // x the fracture energy: what a blow crushes until the joint's force is reached
  float left = 1;       // S: share of the caps that is left
  float arm = 1;        // of the kern: how far out the points are; grows within a step (widen)
  float pull = 0, shear = 0, crush = 0;  // J, that this step takes of the fracture energy, by mode
  Vec3f before;                          // N: the joint's force before the last solve
};

static_assert(sizeof(MortarStart) <= 156);

struct MortarRows : FaceRows, LastingRows<MortarRows, MortarSet, &Ties::mortar> {
  explicit MortarRows(std::pmr::memory_resource* memory) : FaceRows(memory), LastingRows(memory), starts(memory) {}
  // By row, as `records`. Both are there while the island is solved or looked at, not while it rests: a joint at rest
  // is its slot and a few numbers in lists.
  std::pmr::vector<MortarStart> starts;

  // --- functions of every kind of row (contact/rows.h)
  static constexpr double kPoints = 4;
  static constexpr bool kLasts = false;
  static constexpr bool kYields = true;
  static constexpr bool kFirm = true;
  static constexpr std::size_t kRecordSize = sizeof(FaceRecord) + sizeof(MortarStart);
  template <class Number> void bind(Ties& ties, Number number) {
    for (std::size_t k = 0; k < size(); k++) {
      Mortar& m = at(k, ties);
      number(m.bodyA);  // partners get their numbers
      number(m.bodyB);
      m.born = false;
    }
  }
  bool laidOut() const { return records.size() == size() || records.empty(); }
  void takeRoom(const Island& island, const Ties& ties);
  void giveRoom();
  RowEnds endsIn(const Island& island, const Ties& ties, std::size_t k) const;
  Vec3 armOf(std::size_t k, bool ofB, const StepContext& context) const;
  float strength(std::size_t, const StepContext&) const { return 4e3f; }  // mortared bricks share clusters
  bool ties(std::size_t, const StepContext&) const { return true; }
  bool turnsAsOne(std::size_t k, const Ties& ties) const { return !at(k, ties).crushed; }
  bool makesOne(std::size_t, const Ties&) const { return true; }
  RowGrip grip(std::size_t k, const StepContext& context) const;
  // visit(ends, force): of each row the pull that it bears, N.
  template <class Visit> void eachHold(Visit&& visit) const {
    for (const FaceRecord& r : records) visit(RowEnds{r.bodyA, r.bodyB}, -float(kPoints) * r.leastN[0]);
  }

  void addHolding(std::size_t k, Vec3 along, const Ties& ties, const BodySet& bodies, Holding& out) const {
    mortar::addHolding(at(k, ties), bodies, along, out);
  }
  void prepare(Island& island, Ties& ties, const StepContext& context);
  bool boundsFollow(std::size_t) const { return false; }
  bool renewBounds(std::size_t, const SolveMotion*, float, bool) { return false; }
  bool renewFrozen(const Island& island, const StepContext& context, Renewal when);
  bool store(Island& island, Ties& ties, StepContext& context);
  void tellShare(Ties&, float) const {}
  // J: what its springs hold.
  double mostWork(std::size_t k) const;
  void advance(const Island& island, Ties& ties, const StepContext& context) const;

  // --- what the world asks of the rows of an island
  void hashRecord(Mix& h, std::size_t k, const Ties& ties) const;
  void checkRanges(Findings& f) const;
  void startAfresh(Ties&) const {}
  static double elasticEnergy(MortarIndex mortar, const StepContext& context);
  void addWork(const Island& island, const StepContext& context, TieWork& sum) const;

  // --- impacts at their moment (solver/impact.h). Mortar has a largest force: in no time it gives nothing.
  void startImpact(const Island& island, const StepContext& context, double blink);
  void keepImpactForces(const Island&) {}
  void endImpact(const Island&, Ties&, const StepContext&, bool) {}

 private:
  void writeFace(std::size_t k, const Mortar& m, const MortarPose& pose);
  void writeStart(std::size_t k, const Mortar& m, const MortarPose& pose, const Island& island, const BodySet& bodies);
  Vec3f arcBy(std::size_t k, Vec3 turnA, Vec3 turnB, const Island& island) const;
  bool renewArc(std::size_t k, const Mortar& m, const Island& island, const BodySet& bodies);
  void writeSprings(std::size_t k, const Mortar& m);
  void writeCaps(std::size_t k, const Mortar& m);
  void widen(std::size_t k, const Mortar& m);
  void takeCrushes(const Island& island, const Ties& ties);
};

}  // namespace brickfall
