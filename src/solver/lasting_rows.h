// Rows of ties that a program makes and that last (joints, mortar), and what both answer alike. They never come to
// touch, so that they meet nothing and rebound from nothing.
#pragma once
#include <limits>

#include "brickfall/step_trace.h"
#include "solver/blows.h"
#include "solver/tie_report.h"
#include "solver/tie_rows.h"

namespace brickfall {

template <class Rows, class Set, Set Ties::*kSet> struct LastingRows : TieRows<Rows, Set, kSet, &Set::slots> {
  using TieRows<Rows, Set, kSet, &Set::slots>::TieRows;
  using Tie = typename decltype(Set::slots)::value_type;

  static bool isThere(const Tie& tie) { return tie.alive && !tie.gone(); }
  // They do all of that while they tie.
  bool carriesForce(std::size_t k, const StepContext& context) const { return this->rows().ties(k, context); }
  bool sticks(std::size_t k, const StepContext& context) const { return this->rows().ties(k, context); }
  double depth(std::size_t) const { return 0; }
  bool slips(std::size_t, const EndChanges&, double, const StepContext&) const { return false; }
  bool pins(std::size_t k, const StepContext& context) const { return this->rows().ties(k, context); }
  bool holds(std::size_t k, const StepContext& context) const { return this->rows().ties(k, context); }
  // The solve makes their motions of second order by itself.
  RowCourse courseOf(std::size_t k, const EndChanges&, const StepSpan&, const StepContext& context) const {
    return this->rows().ties(k, context) ? RowCourse::changes : RowCourse::idle;
  }
  bool meetsWithin(std::size_t k, Vec3f, const SolveMotion*, const StepContext& context) const {
    return this->rows().ties(k, context);
  }

  double slidesFor(std::size_t, const EndChanges&, const EndChanges&, double, const StepContext&) const {
    return std::numeric_limits<double>::infinity();
  }
  bool keepsForces(std::size_t, const EndChanges&, double, const StepContext&) const { return false; }
  bool wouldMeet(std::size_t, const EndChanges&, const EndChanges&, double) const { return false; }
  void addFriction(std::size_t, Vec3, bool, const VelocityChange&, const StepContext&, FrictionAlong&) const {}
  void letGo(Ties&) const {}
  void giveBlows(const Held&, double, Ties&, BodySet&, const StepContext&, Blows&) const {}
  bool owes(std::size_t, const StepContext&) const { return false; }
  double reboundWork(std::size_t, const SolveMotion*) const { return 0; }
  // What a trial of a step changes.
  struct Memory {
    explicit Memory(std::pmr::memory_resource* memory) : ties(memory) {}
    std::pmr::vector<Tie> ties;
  };
  void remember(const Ties& ties, Memory& out) const {
    for (std::size_t k = 0; k < this->size(); k++) out.ties.push_back(this->at(k, ties));
  }
  void restore(Ties& ties, const Memory& memory) const {
    for (std::size_t k = 0; k < this->size(); k++) this->at(k, ties) = memory.ties[k];
  }

  bool mayClose(const StepContext&, double) const { return false; }
  bool touchNothing(const StepContext&) const { return this->size() == 0; }
  void leaveOut(Ties&, const StepContext&) {}
  double firstClosing(const Island&, double, const StepContext&) const {
    return std::numeric_limits<double>::infinity();
  }
  void forgetSlow() {}
  bool reboundImpact(const Island&, const StepContext&, std::pmr::vector<TieImpact>&) { return false; }

  void hashName(Mix& h, std::size_t k, const Ties& ties) const { h(this->at(k, ties).order); }
  void hashMemory(Mix& h, std::size_t k, const Ties& ties) const { (ties.*kSet).hash(h, this->tieOf[k]); }
  template <class Visit> void eachManifold(Visit&&) const {}
  template <class Visit> void eachTouching(const Ties&, Visit&&) const {}
  PointCount countPoints(const Ties&) const { return {}; }
  void findHits(const Island&, const StepContext&, double, std::pmr::vector<TieImpact>&) const {}
  void addSupport(const Island& island, const StepContext& context, BalanceChange& sum) const;  // rows_report.h
};

}  // namespace brickfall
