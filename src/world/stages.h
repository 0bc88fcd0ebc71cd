// The stages of a step, each in a file of its name. A stage takes as const what it reads, and by reference what it
// changes; an upkeep is such references. docs/step.md has the same as a table. The step itself, the list of stages in
// their order, is step.cpp.
//
// Beside each stage stand the functions that report on request: a hash of its output, and its change of momentum and
// energy.
#pragma once
#include "brickfall/step_report.h"
#include "brickfall/world.h"
#include "world/clock.h"

namespace brickfall {

class Activity;
class Diary;
class HashItems;
class Proximity;
class Quarantine;
class Registry;
class Ties;
class Upkeep;
struct IslandSet;
struct SolveState;
struct StepContext;

using PreSolveCall = World::PreSolve;

void findPairs(const Registry&, const Activity&, const StepContext&, Proximity&, Ties&);
void hashPairs(const Registry&, const Activity&, const Proximity&, HashItems&);

void updateContacts(const PreSolveCall&, Registry&, const Activity&, const StepContext&, Proximity&, Ties&, StepReport&,
                    Upkeep);
void hashContacts(const Ties&, HashItems&);

void renewIslands(const Registry&, const StepContext&, Activity&, Ties&);
void hashIslands(const Ties&, const IslandSet&, HashItems&);
void bookIslands(const Registry&, const StepContext&, Diary&);

void meetImpacts(const WorldDef&, Registry&, IslandSet&, Proximity&, Ties&, StepContext&, StepReport&, Events&);
void hashImpacts(const Registry&, const IslandSet&, const Ties&, HashItems&);
void bookImpacts(const Registry&, const StepContext&, Diary&);

void prepare(Registry&, IslandSet&, Ties&, StepContext&);
void hashPrepare(const Registry&, const IslandSet&, const Ties&, const StepContext&, HashItems&);
void bookPrepare(const Registry&, const Activity&, const StepContext&, Diary&);

void checkRest(IslandSet&, StepContext&);
void hashRest(const IslandSet&, HashItems&);

void solveIslands(IslandSet&, SolveState&);
void hashSolve(const Registry&, const IslandSet&, HashItems&);

void storeSolution(const WorldDef&, const Registry&, IslandSet&, Ties&, StepContext&, Events&);
void hashStore(const IslandSet&, const Ties&, const StepContext&, HashItems&);
void bookStore(const Registry&, const Activity&, const StepContext&, Diary&);

// `again`: ways are whole, none is without the share that was flown ahead.
void stopAtObstacles(const Registry&, const Activity&, const Proximity&, StepContext&, bool again = false);
void hashObstacles(const IslandSet&, const StepContext&, HashItems&);
void bookObstacles(const Registry&, const Activity&, const StepContext&, Diary&);

void balanceIslands(const Registry&, const Activity&, const Proximity&, Ties&, StepContext&);
void hashBalance(const IslandSet&, const StepContext&, HashItems&);
void bookBalance(const Registry&, const Activity&, const StepContext&, Diary&);

void integrate(const Clock&, const StepContext&, Registry&, Activity&, Proximity&, Ties&, Quarantine);
void hashIntegrate(const Registry&, const Activity&, const Ties&, HashItems&);
void bookIntegrate(const Registry&, const Activity&, const StepContext&, Diary&);

void breakTies(const Registry&, const Clock&, const StepContext&, const Activity&, Ties&, Diary&, Upkeep);
void hashBreaking(const Ties&, HashItems&);

void fallAsleep(const WorldDef&, double dt, Registry&, Activity&, Ties&, Diary&);
void hashSleep(const Registry&, const IslandSet&, HashItems&);

void collectEvents(const Registry&, Activity&, Ties&, Diary&);
void hashEvents(const Events&, HashItems&);

}  // namespace brickfall
