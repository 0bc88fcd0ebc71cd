// Rows of one kind of tie: their list, and what the rows of all kinds answer alike. `Rows` has `records` with bodyA and
// bodyB, `starts`, and isThere(tie). The ties are (ties.*kSet).*kList.
#pragma once
#include <algorithm>
#include <cstdint>
#include <memory_resource>
#include <utility>
#include <vector>

#include "dynamics/ties.h"
#include "solver/reaction.h"
#include "solver/renewals.h"
#include "solver/step_context.h"

namespace brickfall {

struct Holding;
struct Island;
struct SolveMotion;

template <class Rows, class Set, Set Ties::*kSet, auto kList> struct TieRows {
  explicit TieRows(std::pmr::memory_resource* memory) : tieOf(memory) {}
  static constexpr LinkKind kLink = Set::kLink;
  std::pmr::vector<std::uint32_t> tieOf;  // by row, ascending: the tie's index in the set
  using Tie = typename std::remove_reference_t<decltype(std::declval<Set&>().*kList)>::value_type;

  std::size_t size() const { return tieOf.size(); }
  void reserve(std::size_t rows) { tieOf.reserve(rows); }
  void add(std::uint32_t index) { tieOf.push_back(index); }
  const Tie& at(std::size_t k, const Ties& ties) const { return ((ties.*kSet).*kList)[tieOf[k]]; }
  Tie& at(std::size_t k, Ties& ties) const { return ((ties.*kSet).*kList)[tieOf[k]]; }

  // The same ties as in `old`; a slot that has gone to another tie is marked born.
  bool continues(const Rows& old, const StepContext& context) const {
    return tieOf == old.tieOf && std::none_of(tieOf.begin(), tieOf.end(), [&](std::uint32_t tie) {
             return ((context.ties->*kSet).*kList)[tie].born;
           });
  }
  // New rows: `number` gives a body's place in Island::motion.
  template <class Number> void bind(Ties& ties, Number number) {
    auto beAnew = [&]<class Of>(std::pmr::vector<Of>& list) { list.assign(size(), Of()); };
    beAnew(rows().records);
    beAnew(rows().starts);
    for (std::size_t k = 0; k < size(); k++) {
      Tie& tie = at(k, ties);
      rows().records[k].bodyA = number(tie.bodyA);
      rows().records[k].bodyB = number(tie.bodyB);
      tie.born = false;
    }
  }
  // What the solve reads of rows may go while their island rests, and comes again before they are prepared. Ends are
  // known then, too; kNoIndex: the tie is gone.
  void takeRoom(const Island&, const Ties&) {}
  void giveRoom() {}
  bool laidOut() const { return rows().records.size() == size(); }
  RowEnds endsIn(const Island&, const Ties&, std::size_t k) const { return rows().ends(k); }
  RowEnds ends(std::size_t k) const { return {rows().records[k].bodyA, rows().records[k].bodyB}; }
  Arms arms(std::size_t k) const {
    return {wide::load3Padded(rows().records[k].armA), wide::load3Padded(rows().records[k].armB)};
  }
  // The bodies that a row's tie names.
  std::pair<BodyIndex, BodyIndex> bodies(std::size_t k, const Ties& ties) const {
    return {at(k, ties).bodyA, at(k, ties).bodyB};
  }

  // Answers of most kinds; contact/rows.h says what is asked.
  void addHolding(std::size_t, Vec3, const Ties&, const BodySet&, Holding&) const {}
  bool renewFrozen(const Island&, const StepContext&, Renewal) { return false; }
  bool holdJam(std::size_t, const SolveMotion*, float) { return false; }
  double returnedWork(std::size_t) const { return 0; }
  template <class Visit> void eachHold(Visit&&) const {}

  // A snapshot of the rows, and of their number.
  void archive(WriteArchive& a) const { archiveOf(a, rows()); }
  void archive(ReadArchive& a) { archiveOf(a, rows()); }
  // What must hold before a row may be followed; all the rest (rows_report.h). `current`: no tie came or went since the
  // island was built.
  void checkStructure(Findings& f, const Island& island, const Ties& ties, const BodySet& bodies, bool current) const;
  void check(Findings& f, const Island& island, const Ties& ties, bool current) const;

 protected:
  Rows& rows() { return static_cast<Rows&>(*this); }
  const Rows& rows() const { return static_cast<const Rows&>(*this); }

 private:
  template <class Archive, class Of> static void archiveOf(Archive& a, Of& rows) {
    a.list(rows.tieOf);
    a.list(rows.records);
    a.list(rows.starts);
  }
};

}  // namespace brickfall
