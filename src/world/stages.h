// The stages of a step, each in a file of its name. A stage takes as const what it reads, and by reference what it
// changes. docs/step.md has the same as a table. The step itself, the list of stages in their order, is step.cpp.
//
// Beside each stage stand the functions that report on request: a hash of its output, and its change of momentum and
// energy.
#pragma once
#include "brickfall/step_report.h"
#include "brickfall/world.h"
#include "world/clock.h"

namespace brickfall {

class Activity;
class ContactSet;
class Diary;
class HashItems;
class Proximity;
class Quarantine;
class Registry;
class Upkeep;
struct IslandSet;
struct SolveState;
struct StepContext;

void findPairs(const Registry&, const Activity&, double dt, Proximity&);
void hashPairs(const Registry&, const Activity&, const Proximity&, HashItems&);

void updateContacts(const Registry&, const Activity&, const StepContext&, Proximity&, StepReport&, Upkeep&);
void hashContacts(const ContactSet&, HashItems&);

void renewIslands(const Registry&, const StepContext&, Activity&, ContactSet&);
void hashIslands(const ContactSet&, const IslandSet&, HashItems&);
void bookIslands(const Registry&, const ContactSet&, const StepContext&, Diary&);

void meetImpacts(const WorldDef&, Registry&, IslandSet&, Proximity&, StepContext&, StepReport&, Events&);
void hashImpacts(const Registry&, const IslandSet&, const ContactSet&, HashItems&);
void bookImpacts(const Registry&, const ContactSet&, const StepContext&, Diary&);

void prepare(Registry&, IslandSet&, ContactSet&, StepContext&);
void hashPrepare(const Registry&, const IslandSet&, const ContactSet&, const StepContext&, HashItems&);
void bookPrepare(const Registry&, const Activity&, const ContactSet&, const StepContext&, Diary&);

void checkRest(IslandSet&, StepContext&);
void hashRest(const IslandSet&, HashItems&);

void solveIslands(IslandSet&, SolveState&);
void hashSolve(const Registry&, const IslandSet&, HashItems&);

void storeSolution(const WorldDef&, const Registry&, IslandSet&, ContactSet&, StepContext&, Events&);
void hashStore(const IslandSet&, const ContactSet&, const StepContext&, HashItems&);
void bookStore(const Registry&, const Activity&, const ContactSet&, const StepContext&, Diary&);

void stopAtObstacles(const Registry&, const Activity&, const Proximity&, StepContext&);
void hashObstacles(const IslandSet&, const StepContext&, HashItems&);
void bookObstacles(const Registry&, const Activity&, const StepContext&, Diary&);

void balanceIslands(const IslandSet&, StepContext&);
void hashBalance(const IslandSet&, const StepContext&, HashItems&);
void bookBalance(const Registry&, const Activity&, const StepContext&, Diary&);

void integrate(const Clock&, const StepContext&, Registry&, Activity&, Proximity&, Quarantine&);
void hashIntegrate(const Registry&, const Activity&, const ContactSet&, HashItems&);
void bookIntegrate(const Registry&, const Activity&, const ContactSet&, const StepContext&, Diary&);

void fallAsleep(const WorldDef&, double dt, Registry&, Activity&, ContactSet&, Diary&);
void hashSleep(const Registry&, const IslandSet&, HashItems&);

void collectEvents(const Registry&, Activity&, ContactSet&, Diary&);
void hashEvents(const Events&, HashItems&);

}  // namespace brickfall
