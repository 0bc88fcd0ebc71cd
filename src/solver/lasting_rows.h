// Rows of ties that a program makes and that last (joints, mortar): their list, and what all of them answer alike. They
// never come to touch, so that they meet nothing and rebound from nothing. `Rows` has `records` with bodyA and bodyB,
// and `starts`.
#pragma once
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory_resource>
#include <utility>
#include <vector>

#include "brickfall/step_trace.h"
#include "dynamics/ties.h"
#include "solver/blows.h"
#include "solver/boundary.h"
#include "solver/step_context.h"
#include "solver/tie_report.h"

namespace brickfall {

struct Island;

template <class Rows, class Set, Set Ties::*kSet> struct LastingRows {
  explicit LastingRows(std::pmr::memory_resource* memory) : tieOf(memory) {}
  std::pmr::vector<std::uint32_t> tieOf;  // by row, ascending
  using Tie = typename decltype(Set::slots)::value_type;

  std::size_t size() const { return tieOf.size(); }
  void reserve(std::size_t rows) { tieOf.reserve(rows); }
  void add(std::uint32_t index) { tieOf.push_back(index); }
  std::uint32_t indexOf(std::size_t k) const { return tieOf[k]; }
  bool continues(const Rows& old, const StepContext& context) const {
    return tieOf == old.tieOf && std::none_of(tieOf.begin(), tieOf.end(),
                                              [&](std::uint32_t tie) { return (context.ties->*kSet).slots[tie].born; });
  }
  template <class Number> void bind(Ties& ties, Number number) {
    auto beAnew = [&]<class Of>(std::pmr::vector<Of>& list) { list.assign(size(), Of()); };
    beAnew(rows().records);
    beAnew(rows().starts);
    for (std::size_t k = 0; k < size(); k++) {
      Tie& tie = (ties.*kSet).slots[tieOf[k]];
      rows().records[k].bodyA = number(tie.bodyA);
      rows().records[k].bodyB = number(tie.bodyB);
      tie.born = false;
    }
  }
  const Tie& at(std::size_t k, const Ties& ties) const { return (ties.*kSet).slots[tieOf[k]]; }
  Tie& at(std::size_t k, Ties& ties) const { return (ties.*kSet).slots[tieOf[k]]; }

  bool wouldMeet(std::size_t, const EndChanges&, const EndChanges&, double) const { return false; }
  void addFriction(std::size_t, Vec3, bool, const StepContext&, FrictionAlong&) const {}
  void letGo(Ties&) const {}
  void giveBlows(const Held&, double, Ties&, BodySet&, const StepContext&, Blows&) const {}
  bool holdJam(std::size_t, const SolveMotion*, float) { return false; }
  bool owes(std::size_t, const StepContext&) const { return false; }
  double reboundWork(std::size_t, const SolveMotion*) const { return 0; }
  // What a trial of a step changes.
  struct Memory {
    explicit Memory(std::pmr::memory_resource* memory) : ties(memory) {}
    std::pmr::vector<Tie> ties;
  };
  void remember(const Ties& ties, Memory& out) const {
    for (std::uint32_t tie : tieOf) out.ties.push_back((ties.*kSet).slots[tie]);
  }
  void restore(Ties& ties, const Memory& memory) const {
    for (std::size_t k = 0; k < size(); k++) at(k, ties) = memory.ties[k];
  }

  bool mayClose(const StepContext&, double) const { return false; }
  bool touchNothing(const StepContext&) const { return size() == 0; }
  void leaveOut(Ties&, const StepContext&) {}
  double firstClosing(const Island&, double, const StepContext&) const {
    return std::numeric_limits<double>::infinity();
  }
  bool reboundImpact(const Island&, const StepContext&, std::pmr::vector<TieImpact>&) { return false; }

  std::pair<BodyIndex, BodyIndex> bodies(std::size_t k, const Ties& ties) const {
    return {at(k, ties).bodyA, at(k, ties).bodyB};
  }
  void archive(WriteArchive& a) const { archiveOf(a, rows()); }
  void archive(ReadArchive& a) { archiveOf(a, rows()); }
  void hashName(Mix& h, std::size_t k, const Ties& ties) const { h(at(k, ties).order); }
  void hashMemory(Mix& h, std::size_t k, const Ties& ties) const { (ties.*kSet).hash(h, tieOf[k]); }
  template <class Visit> void eachManifold(Visit&&) const {}
  template <class Visit> void eachTouching(const Ties&, Visit&&) const {}
  PointCount countPoints(const Ties&) const { return {}; }
  void findHits(const Island&, const StepContext&, double, std::pmr::vector<TieImpact>&) const {}
  // lasting_report.h
  void checkStructure(Findings& f, const Island& island, const Ties& ties, const BodySet& bodies, bool current) const;
  void check(Findings& f, const Island& island, const Ties& ties, bool current) const;
  void addSupport(const Island& island, const StepContext& context, BalanceChange& sum) const;

 private:
  Rows& rows() { return static_cast<Rows&>(*this); }
  const Rows& rows() const { return static_cast<const Rows&>(*this); }
  template <class Archive, class Of> static void archiveOf(Archive& a, Of& rows) {
    a.list(rows.tieOf);
    a.list(rows.records);
    a.list(rows.starts);
  }
};

}  // namespace brickfall
