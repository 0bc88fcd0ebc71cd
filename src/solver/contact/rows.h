// Contacts as rows of an island's solve.
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "brickfall/step_trace.h"
#include "solver/blows.h"
#include "solver/face/rows.h"
#include "solver/hierarchy.h"
#include "solver/renewals.h"
#include "solver/step_context.h"
#include "solver/tie_report.h"
#include "solver/tie_rows.h"

namespace brickfall {

struct Island;

// Facts of a contact at the start of a step that the records do not have: for rebounds, hits and the friction of new
// points.
struct ContactStart {
  float approach[4] = {};  // m/s, normal relative velocity; negative = closing
  float gap[4] = {};       // m
  float stopping[4] = {};  // N, stops the approach and carries the pair's weight; after an impact: its last force
  float taken[4] = {};     // N s, of an impact that will rebound, in this step
  float back[4] = {}, back1[4] = {},
        back2[4] = {};  // N, that a rebound gives in this step, beside the point's remembered force
  // m, of B against A, along the normal and the tangents, at each point: what the solve does not see of the way, by
  // arcs of what turns and by surfaces that run
  float arc[4] = {}, arc1[4] = {}, arc2[4] = {};
  float curves[4] = {};    // m/s: the normal speed that forces must give each point for a body alone to stay on its arc
  Vec3f run;               // m, of B against A: the way of surfaces that run in this step, along the face
  float friction = 0;      // coefficient
  float rolling = 0;       // coefficient, where a lane of the record resists rolling
  float held = 0;          // J, that springs held when the last step ended, and that lifts what lies on overlap let go
  std::uint32_t slid = 0;  // bit per point that pressed and slid in the last step
  std::uint32_t falling = 0;  // bit per point whose friction limit follows downwards only: after an impact
  std::int32_t points = 0;    // 0 .. 4
  Scale scale;                // of the pair

  Vec3f carried(int i) const { return {arc[i], arc1[i], arc2[i]}; }
};

// Rows in the order of their pairs.
struct ContactRows : FaceRows, TieRows<ContactRows, ContactSet, &Ties::contacts, &ContactSet::contacts> {
  explicit ContactRows(std::pmr::memory_resource* memory)
      : FaceRows(memory), TieRows(memory), starts(memory), slow(memory) {}
  std::pmr::vector<ContactStart> starts;  // by row
  std::pmr::vector<std::uint8_t> slow;    // by row, or none: bits of points that close too slowly for an impact
  float fastestApproach = 0;              // m/s, of any point at the start of the step

  // --- functions of every kind of row, in the order in which a step calls them; those of the list are in tie_rows.h. A
  // joint's answers to most are one line.
  static constexpr double kPoints = 4;    // visits that a row counts as; points at most
  static constexpr bool kLasts = false;   // its ties stay, and bodies swing on them
  static constexpr bool kYields = false;  // it breaks, and gives no impulse in no time
  static constexpr bool kFirm = false;    // the rounding of its bodies' ways is a force
  static constexpr std::size_t kRecordSize = sizeof(FaceRecord);
  static bool isThere(const Contact& c) { return c.count >= 1 && c.count <= 4; }
  template <class Number> void bind(Ties& ties, Number number) {
    TieRows::bind(ties, number);
    for (std::size_t k = 0; k < size(); k++) at(k, ties).fresh = true;
  }
  // How firmly the contact ties its two bodies: more than 0.
  float strength(std::size_t k, const StepContext& context) const;
  bool ties(std::size_t k, const StepContext& context) const { return carriesForce(k, context); }
  // Neither of its bodies can turn about any axis of its own against the other.
  bool turnsAsOne(std::size_t, const Ties&) const { return false; }
  // Its two bodies move as one.
  bool makesOne(std::size_t, const Ties&) const { return false; }
  bool carriesForce(std::size_t k, const StepContext& context) const { return at(k, *context.ties).touching; }
  // The contact carries force, and at one point at least it sticks.
  bool sticks(std::size_t k, const StepContext& context) const {
    return carriesForce(k, context) && at(k, *context.ties).points.stickingMask != 0;
  }
  // The contact sticks, and nothing rolls on it: it holds one body in its place on the other.
  bool pins(std::size_t k, const StepContext& context) const {
    return sticks(k, context) && !at(k, *context.ties).rolls;
  }
  // After the forces are stored: how they go on, if the velocities of the row's bodies change so in the step.
  RowCourse courseOf(std::size_t k, const EndChanges& change, const StepSpan& span, const StepContext& context) const;
  // How many steps more a point that slid takes until it stops, if its bodies go at `now` and change so in each.
  double slidesFor(std::size_t k, const EndChanges& now, const EndChanges& change, double dt,
                   const StepContext& context) const;
  // Every point that presses slides faster than what settles, if the bodies go at `now`.
  bool slips(std::size_t k, const EndChanges& now, double dt, const StepContext& context) const;
  // Moved by `back` over half of the step, no point that presses goes further against its partner than its force has
  // compressed it.
  bool keepsForces(std::size_t k, const EndChanges& back, double dt, const StepContext& context) const;
  // m: how deep a point begins the step in its partner.
  double depth(std::size_t k) const;
  // At the end of the step an open point is nearer to its partner than `nearer`, over half of the step, would move the
  // two towards each other.
  bool wouldMeet(std::size_t k, const EndChanges& nearer, const EndChanges& change, double dt) const;
  // Adds the friction of the last step on B, or on A, along a direction; `body`: how that goes against the other.
  void addFriction(std::size_t k, Vec3 along, bool onB, const VelocityChange& body, const StepContext& context,
                   FrictionAlong& sum) const;
  // What the ties hold on to is to be where the step ends: the contacts' anchors.
  void letGo(Ties& ties) const;
  // In the last step the contact carried force that was no impact's, and its bodies do not part.
  bool holds(std::size_t k, const StepContext& context) const;
  // N: the force from A on B in the last step, along the normal, and the friction that this allows.
  RowGrip grip(std::size_t k, const StepContext& context) const;
  // The contact carries force, or would at the present motion if one of its bodies went `way` (m) further.
  bool meetsWithin(std::size_t k, Vec3f way, const SolveMotion* motion, const StepContext& context) const;

  // J: the most that the contact gives in this step. Overlap that is let go and springs that soften hold more than
  // bodies gave to them: that is nobody's to have.
  double mostWork(std::size_t k) const { return std::min(FaceRows::mostWork(k), double(starts[k].held)); }

  void prepare(const Island& island, Ties& ties, const StepContext& context);
  // What a row keeps frozen in a solve follows the motion found: friction limits of points that carried nothing in the
  // last step, or an impact. While the solve goes on, the pair's own weight and approach cap them, since forces met on
  // its way are no measure; `over`: it has ended. Changes of less than `slack` of a limit are left. True if any did.
  bool boundsFollow(std::size_t k) const { return records[k].newPoints != 0; }
  bool renewBounds(std::size_t k, const SolveMotion* motion, float slack, bool over);
  // Something that nothing stops presses, so that a point bears many times what stops its pair: its friction limit is
  // that of the force found. `force` (N): of the row, as last read.
  bool holdJam(std::size_t k, const SolveMotion* motion, float force);
  // Before the step is prepared: what closes on a body that is marked exchanges the impulse of the two alone.
  void giveBlows(const Held& held, double dt, Ties& ties, BodySet& bodies, const StepContext& context,
                 Blows& blows) const;
  // After the first solve: impacts that are over give back their share, in a solve that goes on from there. True if any
  // does.
  bool renewFrozen(const Island& island, const StepContext& context, Renewal when) {
    return when == Renewal::first && startRebounds(island, context);
  }
  // After the contact's forces are stored: an impact goes on at one of its points that will rebound later.
  bool owes(std::size_t k, const StepContext& context) const;
  // J: work of the contact's rebounds in this step, on the way that was solved; 0 if there was none.
  double reboundWork(std::size_t k, const SolveMotion* motion) const;
  // Writes the forces at the final motion into the contacts. True if any changed by more than rounding. For an island
  // that does not rest this is not compared, and the result is true.
  bool store(Island& island, Ties& ties, StepContext& context);
  // Adds this share of the stored forces to the forces that are told of the step.
  void tellShare(Ties& ties, float share) const;
  // Gaps and drifts go on by the motion that was finally made.
  void advance(const Island& island, Ties& ties, const StepContext& context) const;
  // All that the contacts remember. restore puts it back, whatever a trial has made of it.
  struct Memory {
    explicit Memory(std::pmr::memory_resource* memory) : contacts(memory), geometry(memory) {}
    std::pmr::vector<Contact> contacts;          // by row
    std::pmr::vector<ContactGeometry> geometry;  // by row
    std::size_t struck = 0;                      // of ContactSet
    bool touchingChanged = false;                // of ContactSet
  };
  void remember(const Ties& ties, Memory& out) const;
  void restore(Ties& ties, const Memory& memory) const;

  // --- what the world asks of the rows of an island
  // Hashes: which tie it is; what it remembers; what the solve reads.
  void hashName(Mix& h, std::size_t k, const Ties& ties) const;
  void hashMemory(Mix& h, std::size_t k, const Ties& ties) const;
  void hashRecord(Mix& h, std::size_t k, const Ties& ties) const;
  void checkRanges(Findings& f) const;  // values that a snapshot may have
  // visit(contact): the manifolds that the rows stand on, for the narrow phase.
  template <class Visit> void eachManifold(Visit&& visit) const {
    for (ContactIndex contact : tieOf) visit(contact);
  }
  PointCount countPoints(const Ties& ties) const;
  // visit(contact): ties that pressed in the last step, as listeners are told.
  template <class Visit> void eachTouching(const Ties& ties, Visit&& visit) const {
    for (ContactIndex contact : tieOf) {
      const Contact& c = ties.contacts.contacts[contact];
      if (c.touching || c.struck) visit(c);
    }
  }
  // The solve failed: the ties remember nothing of it, nor of the steps before.
  void startAfresh(Ties& ties) const;
  // J: elastic energy that a tie of this kind holds (energy.h).
  static double elasticEnergy(ContactIndex contact, const StepContext& context);
  // After store(): adds the rows' work in the step, by the solved motion.
  void addWork(const Island& island, const StepContext& context, TieWork& sum) const;
  // Adds the impulses of fixed and kinematic bodies on the island, about the world's origin. Their work is that of the
  // motion of these bodies.
  void addSupport(const Island& island, const StepContext& context, BalanceChange& sum) const;
  // After store(): the impulses that stopped contacts which closed at `least` m/s or faster.
  void findHits(const Island& island, const StepContext& context, double least, std::pmr::vector<TieImpact>& out) const;

  // --- impacts at their moment (solver/impact.h)
  bool mayClose(const StepContext& context, double ahead) const;
  bool touchNothing(const StepContext& context) const;
  // Of prepared rows: open points carry nothing in the coming solve, and stay as fresh as they were. Not those that
  // close on the way without an impact: nothing else would stop them there.
  void leaveOut(Ties& ties, const StepContext& context);
  // Finds `slow` as well.
  double firstClosing(const Island& island, double dt, const StepContext& context);
  void forgetSlow() { slow.clear(); }
  // Prepared rows become those of an impact. Closed points may not close further, open points do not exist, and no
  // point has a memory.
  void startImpact(const Island& island, const StepContext& context, double blink);
  // The forces found become multipliers: the part of the approach that springs left, a thousandth, becomes a millionth.
  void keepImpactForces(const Island& island);
  // The impulse that stopped each contact; true if any gives a part of it back. The points that do then press at least
  // so hard.
  bool reboundImpact(const Island& island, const StepContext& context, std::pmr::vector<TieImpact>& impacts);
  // Points that were hit begin anew, and so do points that the impact parts. Not if it was not solved.
  void endImpact(const Island& island, Ties& ties, const StepContext& context, bool solved);

 private:
  bool isSlow(std::size_t k, int i) const { return k < slow.size() && (slow[k] >> i & 1); }
  bool startRebounds(const Island& island, const StepContext& context);
};

}  // namespace brickfall
