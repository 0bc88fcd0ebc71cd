// The parts of a World: its definition, six owners of its state, and its clock. Only the files of the API and the step
// see it whole. A stage, or any other action of a world, is a function of the owners that it names.
#pragma once
#include <optional>
#include <span>
#include <string>

#include "brickfall/world.h"
#include "dynamics/ties.h"
#include "world/activity.h"
#include "world/clock.h"
#include "world/diary.h"
#include "world/proximity.h"
#include "world/quarantine.h"
#include "world/registry.h"
#include "world/solve_state.h"
#include "world/upkeep.h"

namespace brickfall {

class Checks;
class HashItems;

Status checkWorld(const WorldDef& def);  // names the field that is out of range

struct World::Impl {
  WorldDef def;
  SolveState solve;  // first: the islands of `activity` lie in its memory
  Registry registry;
  Proximity proximity;
  Ties ties;
  Activity activity;
  Diary diary;
  Clock clock;
  mutable int visiting = 0;  // callbacks of forEachContact, forEachIsland, draw and the contact filter under way
  ContactFilter contactFilter;
  PreSolve preSolve;

  // step.cpp. A step is made of substeps. Each is one part, or several where something heavy hits: begin, all stages,
  // end.
  void keepRoom();  // for all memory that the step may need
  void runPart(double dt, bool last);
  void runSubstep(double dt, bool last);
  void beginPart(double dt);
  void runStages(Stage first, Stage end);
  void addCost();
  void endPart();

  Upkeep upkeep() { return {registry, activity, proximity, ties, diary}; }
  Quarantine quarantine() { return {registry, diary.report, upkeep()}; }
  // Checks of every call that changes something: not while stepping or from a callback, then a live body and sound
  // arguments.
  Status openForChange(const std::string& call) const;
  Result<BodyIndex> openForChange(BodyId id, const Error& bad) const;
  Result<JointIndex> openForChange(const std::string& call, JointId id) const;
  // Changes a joint if check(checks, its type) finds nothing wrong.
  template <class Check, class Change>
  Status changeJoint(const std::string& call, JointId id, Check&& check, Change&& change);
  template <class Change> Status changeBody(BodyId id, const Checks& check, Change&& change);
  Status push(BodyId id, Vec3 linear, Vec3 angular, Vec3* pointWorld, bool impulse);
  void loadsChanged();
  void askContactFilter();  // it was set, or came with a world that was read
  Status setVelocity(BodyId id, Vec3 velocity, Vec3 BodyMotion::*which, Vec3 BodyData::*last);
  Status rebuild();                        // for a world that was read: works out the rest; an error if it is no world
  void checkStructure(Findings& f) const;  // must hold before anything may be followed
  void checkLinks(Findings& f) const;      // follows links that were found sound

 private:
  struct StageRow;
  static std::span<const StageRow> stageRows();
  void traceStage(std::optional<Stage> stage, void (*hash)(const Impl&, HashItems&), void (*book)(Impl&));
};

// While the world shows itself to a callback, nothing may change it.
class Visit {
 public:
  explicit Visit(int& count) : count_(count) { count_++; }
  ~Visit() { count_--; }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;

 private:
  int& count_;
};

}  // namespace brickfall
