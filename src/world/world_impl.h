// What a World consists of, and the stages of its step. One file per stage; data flows one way through them.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "base/pool.h"
#include "brickfall/world.h"
#include "broadphase/broad_phase.h"
#include "dynamics/body_set.h"
#include "dynamics/contact_set.h"
#include "dynamics/shape_set.h"
#include "narrowphase/mesh_collide.h"
#include "parallel/worker_pool.h"
#include "solver/island_builder.h"
#include "solver/step_context.h"
#include "world/ledger.h"

namespace brickfall {

Status checkWorld(const WorldDef& def);  // names the field that is out of range

bool isSane(const BodyMotion& motion);  // finite, and not lost in space

struct World::Impl {
  WorldDef def;
  std::uint16_t worldNumber = 0;  // in ids
  Pool stepMemory;                // of islands and of what a stage needs for itself; outlives both
  BodySet bodies;
  ShapeSet shapes;
  ContactSet contacts;
  std::unique_ptr<BroadPhase> broadPhase;  // never null in a world
  IslandSet islands;
  std::vector<BodyIndex> awake;         // dynamic bodies that are not asleep, ascending
  std::vector<BodyIndex> moving;        // kinematic bodies with a velocity, ascending
  std::vector<std::uint32_t> islandOf;  // by body: index in islands.awake, kNoIndex = none
  bool membershipChanged = true;        // awake bodies or their contacts changed: islands must be built
  double time = 0;                      // s
  double lastDt = 0;                    // s
  std::uint64_t stepCount = 0;
  bool stepping = false;
  mutable int visiting = 0;  // callbacks of forEachContact and draw under way
  int substep = 0;           // of the call to step() under way, from 0
  bool lastSubstep = true;   // of it
  double callDt = 0;         // s, of the whole call
  std::vector<BodyIndex> pendingQuarantine;
  std::vector<BodyIndex> pushed;  // bodies with a force or torque for the next step
  std::size_t sleptNow = 0;       // islands that fell asleep in this step: the last ones in islands.asleep
  int dynamicBodies = 0;
  std::vector<BodyIndex> unsettled;  // fixed or kinematic bodies that count as moved until the next step is over
  struct BodyPair {
    BodyIndex first, second;
    auto operator<=>(const BodyPair&) const = default;
  };
  using BodyPairs = std::vector<BodyPair>;
  BodyPairs touchingNow, touchingBefore;  // bodies of awake islands that press on each other, sorted
  BodyPairs slept;                        // of those that fell asleep in this step
  StepContext context;
  StepReport report;
  TraceOptions traceOptions;
  LedgerState ledgerState;
  Events events;
  Events pending;  // what happened between steps: told by the next
  std::unique_ptr<WorkerPool> pool;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> foundPairs;  // scratch
  std::vector<CandidatePair> newPairs;                              // scratch
  MeshScratch meshScratch;
  std::vector<CandidatePair> newParts;  // scratch: of pairs with a mesh

  // --- stages, in their order
  void findPairs();
  void updateContacts();
  void buildIslands();
  void prepare();
  void checkRest();
  void solve();
  void store();
  void restitute();
  void integrate();
  void updateSleep();
  void collectEvents();

  void updateMeshPair(std::size_t begin, std::size_t end, std::size_t& kept);
  void makeContact(CandidatePair& pair, const Manifold& m, const Transform& relative);

  // --- shared by stages and the API
  Result<BodyIndex> find(BodyId id) const;
  Result<ShapeIndex> find(ShapeId id) const;
  Status openForChange(const std::string& call) const;
  Result<BodyIndex> openForChange(BodyId id, const Error& bad) const;
  Status push(BodyId id, Vec3 linear, Vec3 angular, Vec3* pointWorld, bool impulse);
  Status setVelocity(BodyId id, Vec3 velocity, Vec3 BodyMotion::*which, Vec3 BodyData::*last);
  void renewProxies(BodyIndex body);
  void relist(BodyIndex body);
  BodyId idOf(BodyIndex body) const;
  ShapeId idOfShape(ShapeIndex shape) const;
  void addProxy(ShapeIndex shape);
  void addProxy(ShapeIndex shape, const Aabb& swept);
  Status rebuild();  // of a world that was read: what follows from the rest; an error if it is none
  Status rebuildGeometry(ShapeData& shape);
  std::vector<std::string> validateStructure() const;
  std::vector<std::string> validateLinks() const;  // follows what validateStructure found sound
  class LinkChecks;
  void updateSwept(ShapeIndex shape, double dt);
  double marginOf(ShapeIndex shape) const;
  double slackOf(ShapeIndex shape) const;
  void removeContactsOf(BodyIndex body);
  void forgetIslandsOf(BodyIndex body);
  Events& heard() { return stepping ? events : pending; }
  BodyPair byCreation(BodyPair pair) const;
  void appendTouching(const Island& island, BodyPairs& out) const;
  void activatePairsOf(BodyIndex body);
  void keepBounds(BodyIndex body);
  bool moves(BodyIndex body) const;
  bool farHeavier(BodyIndex body, BodyIndex other) const;
  void stopAtObstacles(BodyIndex body);
  void stopAtObstacles();
  struct Obstruction {
    double share = 1;           // of a way: where it ends
    double turnShare = 1;       // of the turn
    BodyIndex body = kNoIndex;  // what ends it
    Vec3 carried;               // m: how far that takes along, from there, what does not get past it
  };
  void obstruct(ShapeIndex shape, bool everything, double thickness, const Island* without, Obstruction& first) const;
  bool catchUp(const Island& island);
  struct Motion {
    Vec3 way, turn;  // m, rad: in this step
  };
  Motion motionOf(BodyIndex body) const;
  void shorten(BodyIndex body, double share, double turnShare, Vec3 carried = {});
  bool turnsFar(BodyIndex body, Vec3 turn) const;
  void quarantineAbsurd();
  bool solvedWell(const Island& island) const;
  void salvage(Island& island);
  void finishBody(BodyIndex body);
  void updateMass(BodyIndex body, Vec3 origin);
  void step(double dt);
  void keepRoom();  // takes what memory the step may need
  void tellPending();
  void beginStep(double dt);
  void endStep();
  void disturb(BodyIndex body);  // its state was changed from outside: wake it, nothing about it is settled
  void wakeIsland(std::size_t asleepIndex);
  void wakeIslandOf(BodyIndex asleepBody);
  void wakeByNewContacts();
  void wakeTouching(BodyIndex body);  // sleeping islands in contact with the body
  void wakeAll();
  void quarantine(BodyIndex body);
  void isolate(BodyIndex body);
  // --- on request only: what a stage wrote (none: what the step was given), and what that did to momentum and energy
  void traceStage(std::optional<Stage> stage);
  void hashStage(std::optional<Stage> stage);
  void bookStage(std::optional<Stage> stage);
  void bookStart();
  void bookContacts();
  void bookFreeMotion();
  void bookSolve();
  void bookPoses();
  BalanceChange jointsNow() const;
  double elasticNow() const;
  Balance balanceNow() const;
  void countPoints(Island& island) const;
  void collectHits(const Island& island);
  void collectTouching();
  void addHit(const Island& island, std::size_t contact, double speed, double impulse);
  void countAsMoved(BodyIndex body);  // a fixed or kinematic body that was made, moved or changed
  void enlist(BodyIndex body);        // into awake or moving, by type
  void delist(BodyIndex body);
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

// Times a stage into the report.
class StageTimer {
 public:
  StageTimer(StepReport& report, Stage stage);
  ~StageTimer();

 private:
  StepReport& report_;
  Stage stage_;
  std::int64_t start_;
};
std::int64_t nowNanoseconds();

}  // namespace brickfall
