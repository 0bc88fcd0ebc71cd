// Contacts as rows of an island's solve.
#pragma once
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "dynamics/contact_set.h"
#include "solver/contact/kernel.h"
#include "solver/contact/pairs.h"
#include "solver/contact/record.h"
#include "solver/hierarchy.h"
#include "solver/step_context.h"

namespace brickfall {

struct Island;

// What the start of a step says of a contact, and the records don't hold: for rebounds, hits and the friction of new points.
struct ContactStart {
  float approach[4] = {};  // m/s, normal relative velocity; negative = closing
  float gap[4] = {};       // m
  float stopping[4] = {};  // N, stops the approach and carries the pair's weight; after an impact: its last force
  float taken[4] = {};     // N s, of an impact that will rebound, in this step
  float back[4] = {}, back1[4] = {},
        back2[4] = {};        // N, that a rebound gives in this step, beside what the point remembers
  Vec3f bend;                 // m, of B against A: what a turning partner's arc adds to the ways along its tangent
  float friction = 0;         // coefficient
  std::uint32_t falling = 0;  // bit per point whose friction limit follows downwards only: after an impact
  std::int32_t points = 0;    // 0 .. 4
  Scale scale;                // of the pair
};

// What stopped a contact.
struct ContactImpact {
  std::uint32_t row = 0;
  double speed = 0;    // m/s, fastest approach of its points
  double impulse = 0;  // N s; after an impact at its moment: rebound left out
};

struct ContactRows {
  explicit ContactRows(std::pmr::memory_resource* memory) : contactOf(memory), records(memory), starts(memory) {}
  std::pmr::vector<ContactIndex> contactOf;  // by row, in pair order
  std::pmr::vector<ContactRecord> records;   // by row
  std::pmr::vector<ContactStart> starts;     // by row
  float fastestApproach = 0;                 // m/s, of any point at the start of the step

  // --- what every kind of row has (rows.h)
  static constexpr double kPoints = 4;  // visits that a row counts as
  std::size_t size() const { return contactOf.size(); }
  void reserve(std::size_t rows) { contactOf.reserve(rows); }
  void add(std::uint32_t index) { contactOf.push_back(index); }
  std::uint32_t indexOf(std::size_t k) const { return contactOf[k]; }  // in the set of its kind

  // The same contacts as in `old`, none of them another that took its slot.
  bool continues(const ContactRows& old, const StepContext& context) const;
  // New rows: `number` gives a body's place in Island::motion.
  template <class Number> void bind(Ties ties, Number number) {
    records.assign(size(), {});
    starts.assign(size(), {});
    for (std::size_t k = 0; k < size(); k++) {
      Contact& c = ties.contacts.contacts[contactOf[k]];
      records[k].bodyA = number(c.bodyA);
      records[k].bodyB = number(c.bodyB);
      c.fresh = true;
      c.born = false;
    }
  }
  RowEnds ends(std::size_t k) const { return {records[k].bodyA, records[k].bodyB}; }
  // How firmly it ties its two bodies: more than 0.
  float strength(std::size_t k, const StepContext& context) const;
  bool carriesForce(std::size_t k, const StepContext& context) const {
    return context.contacts->contacts[contactOf[k]].touching;
  }
  // It carries force, and friction holds it at one point at least.
  bool sticks(std::size_t k, const StepContext& context) const {
    return carriesForce(k, context) && context.contacts->contacts[contactOf[k]].points.stickingMask != 0;
  }
  // In the last step it carried force that was no impact's, and its bodies do not part.
  bool holds(std::size_t k, const StepContext& context) const;
  // N: the force from A on B in the last step, along the normal, and the friction that this allows.
  RowGrip grip(std::size_t k, const StepContext& context) const;
  // It carries force, or would at the present motion if one of its bodies went by `way` (m) besides.
  bool meetsWithin(std::size_t k, Vec3f way, const SolveMotion* motion, const StepContext& context) const;

  void prepare(const Island& island, Ties ties, const StepContext& context);
  // Bounds that follow the solve: friction of points that carried nothing in the last step, or an impact. While it goes on,
  // by no more than the pair's own weight and approach: what forces find on their way there is no measure.
  // Changes of less than `slack` of a bound are left. True if any changed.
  bool boundsFollow(std::size_t k) const { return records[k].newPoints != 0; }
  bool renewBounds(std::size_t k, const SolveMotion* motion, float slack = 0) {
    return records[k].newPoints && renewNewPoints(k, motion, slack, false);
  }
  // When it has come to an end: by what the points were found to carry.
  bool settleBounds(std::size_t k, const SolveMotion* motion, float slack) {
    return records[k].newPoints && renewNewPoints(k, motion, slack, true);
  }
  // Where the solve has followed long enough: what has opened since holds nothing more. True if any bound changed.
  bool dropBounds(std::size_t k, const SolveMotion* motion);
  // After a solve: impacts that are over give back their share of what they took, in a solve that goes on from there. True if
  // any does.
  bool startRebounds(const Island& island, const StepContext& context);
  // After its forces are stored: an impact goes on at one of its points that will rebound later.
  bool owes(std::size_t k, const StepContext& context) const;
  // J: work that its rebounds did in this step, on the way that was solved; 0 if there was none.
  double reboundWork(std::size_t k, const SolveMotion* motion) const;
  // Forces at the final motion into the contacts. True if any changed by more than rounding; of an island that does not rest
  // that is not looked for, and true.
  bool store(Island& island, Ties ties, StepContext& context);
  // What the last step's forces are told as besides what they are: this share of them.
  void tellShare(Ties ties, float share) const;
  // Gaps and drifts go on by the motion that was finally made.
  void advance(const Island& island, Ties ties) const;
  // All that the contacts remember; and that again, whatever a trial has made of it.
  struct Memory {
    explicit Memory(std::pmr::memory_resource* memory) : contacts(memory), geometry(memory) {}
    std::pmr::vector<Contact> contacts;          // by row
    std::pmr::vector<ContactGeometry> geometry;  // by row
    std::size_t struck = 0;                      // of ContactSet
    bool touchingChanged = false;                // of ContactSet
  };
  void remember(Ties ties, Memory& out) const;
  void restore(Ties ties, const Memory& memory) const;

  // After store(): what stopped contacts that came on at `least` m/s or faster.
  void findHits(const Island& island, const StepContext& context, double least,
                std::pmr::vector<ContactImpact>& out) const;

  // --- impacts at their moment (solver/impact.h)
  bool mayClose(const StepContext& context, double ahead) const;
  bool touchNothing(const StepContext& context) const;
  void leaveOut(Ties ties, const StepContext& context);
  double firstClosing(const Island& island, double dt, const StepContext& context) const;
  // Prepared rows become those of an impact: closed points may not close further, open ones do not exist, and of none
  // is anything remembered.
  void startImpact(const Island& island, const StepContext& context, double blink);
  // The forces found become multipliers: what springs left of the approach, a thousandth of it, becomes a millionth.
  void keepImpactForces(const Island& island);
  // What stopped each contact; true if any gives a part of it back. Those points then press at least as hard as that.
  bool reboundImpact(const Island& island, const StepContext& context, std::pmr::vector<ContactImpact>& impacts);
  // Points that were hit begin anew, and so do those that the impact parts. Not if it was not solved.
  void endImpact(const Island& island, Ties ties, const StepContext& context, bool solved);

  Arms arms(std::size_t k) const { return {wide::load3Padded(records[k].armA), wide::load3Padded(records[k].armB)}; }
  // Of `count` rows from k on.
  void read(std::size_t k, std::size_t count, const SolveMotion* motion, Reading* out) const {
    readContacts(records.data() + k, count, motion, out);
  }
  // Of a cluster's boundary, rows of this kind.
  void sumBoundary(const Boundary& boundary, BoundarySums& sums) const { sumContacts(boundary, records.data(), sums); }
  Reaction react(std::size_t k, const SolveMotion* motion) const {
    const ContactRecord& r = records[k];
    auto frame = kernel::frame(r);
    auto w = kernel::wrench(r, frame, kernel::pointForces(r, kernel::pointMotion(r, frame, motion)));
    return {w.force, w.torque, frame.armA, frame.armB};
  }
  // Exact: open points are searched for, not counted as closed when they are near.
  StiffReaction reactStiff(std::size_t k, const SolveMotion* motion, bool exact) const {
    const ContactRecord& r = records[k];
    auto frame = kernel::frame(r);
    auto f = kernel::pointForces(r, kernel::pointMotion(r, frame, motion));
    auto w = kernel::wrench(r, frame, f);
    return {{w.force, w.torque, frame.armA, frame.armB}, kernel::stiffness(r, frame, f, exact)};
  }

 private:
  bool renewNewPoints(std::size_t k, const SolveMotion* motion, float slack, bool over);
};

}  // namespace brickfall
