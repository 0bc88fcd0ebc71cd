// The ties between the bodies of an island, as the solve reads them: rows, a list for each kind of tie.
//
// A kind is a folder (contact/): its list with the functions that every kind has (contact/rows.h says what each is
// for), the record that the solve reads, its law, its preparing and storing, its energy. It joins the solve as a member
// of Rows, named in kinds(). Code that walks rows (cycles, direct solve, flight, hierarchies) never asks for their
// kind. The list of kinds is closed and known to the compiler: no virtual calls, and a row's arithmetic stays in its
// loop. How a kind lays out its records is its own affair. A row may be a lane of a pack of several, since nobody but
// the kind reads them: `rows.contacts` stands in contact/ alone (tools/rules/kinds.py).
//
// Rows are numbered through all kinds, in the order of the members; side 2 x row + end is one body's end of a row.
#pragma once
#include <array>
#include <tuple>
#include <utility>

#include "dynamics/ties.h"
#include "solver/contact/rows.h"
#include "solver/joint/rows.h"
#include "solver/mortar/rows.h"

namespace brickfall {

struct Rows {
  explicit Rows(std::pmr::memory_resource* memory) : contacts(memory), joints(memory), mortar(memory) {}
  ContactRows contacts;
  JointRows joints;
  MortarRows mortar;

  // In the order of LinkKind.
  auto kinds() { return std::tie(contacts, joints, mortar); }
  auto kinds() const { return std::tie(contacts, joints, mortar); }
  static constexpr std::size_t kKinds = kLinkKinds;

  // visit(kind) for each list.
  template <class Visit> void eachKind(Visit&& visit) {
    std::apply([&](auto&... kind) { (visit(kind), ...); }, kinds());
  }
  template <class Visit> void eachKind(Visit&& visit) const {
    std::apply([&](const auto&... kind) { (visit(kind), ...); }, kinds());
  }
  // visit(kind, index) for all rows in the order of their numbers.
  template <class Visit> void each(Visit&& visit) {
    eachKind([&](auto& kind) {
      for (std::size_t k = 0; k < kind.size(); k++) visit(kind, k);
    });
  }
  template <class Visit> void each(Visit&& visit) const {
    eachKind([&](const auto& kind) {
      for (std::size_t k = 0; k < kind.size(); k++) visit(kind, k);
    });
  }
  // visit(kind, index in it) for the row of this number.
  template <std::size_t i = 0, class Visit> void at(std::size_t row, Visit&& visit) {
    auto& kind = std::get<i>(kinds());
    if constexpr (i + 1 < kKinds)
      if (row >= kind.size()) return at<i + 1>(row - kind.size(), visit);
    visit(kind, std::uint32_t(row));
  }
  template <std::size_t i = 0, class Visit> void at(std::size_t row, Visit&& visit) const {
    const auto& kind = std::get<i>(kinds());
    if constexpr (i + 1 < kKinds)
      if (row >= kind.size()) return at<i + 1>(row - kind.size(), visit);
    visit(kind, row);
  }

  std::size_t size() const {
    std::size_t rows = 0;
    eachKind([&](const auto& kind) { rows += kind.size(); });
    return rows;
  }
  // There are ties that stay, and on which bodies swing; that break, and give no impulse in no time; so firm that the
  // rounding of ways is a force.
  bool anyLasting() const {
    return any([]<class Kind>(const Kind&) { return Kind::kLasts; });
  }
  bool anyYielding() const {
    return any([]<class Kind>(const Kind&) { return Kind::kYields; });
  }
  bool anyFirm() const {
    return any([]<class Kind>(const Kind&) { return Kind::kFirm; });
  }
  using Counts = std::array<std::size_t, kKinds>;  // rows by kind
  Counts counts() const {
    Counts counts{};
    std::size_t i = 0;
    eachKind([&](const auto& kind) { counts[i++] = kind.size(); });
    return counts;
  }
  template <std::size_t i = 0> void reserve(const Counts& counts) {
    std::get<i>(kinds()).reserve(counts[i]);
    if constexpr (i + 1 < kKinds) reserve<i + 1>(counts);
  }
  void add(const Link& link) {
    eachKind([&](auto& kind) {
      if (kind.kLink == link.kind) kind.add(link.index);
    });
  }
  // Row k of the link's kind is the link's row.
  bool names(const Link& link, std::size_t k) const {
    return any(
        [&](const auto& kind) { return kind.kLink == link.kind && k < kind.size() && kind.tieOf[k] == link.index; });
  }
  // J: elastic energy that a tie holds, of whatever kind.
  template <std::size_t i = 0> static double elasticEnergy(const Link& link, const StepContext& context) {
    using Kind = std::remove_cvref_t<decltype(std::get<i>(std::declval<Rows&>().kinds()))>;
    if constexpr (i + 1 < kKinds)
      if (std::size_t(link.kind) != i) return elasticEnergy<i + 1>(link, context);
    return Kind::elasticEnergy(link.index, context);
  }
  // Points of all rows, and how many there can be at most.
  PointCount countPoints(const Ties& ties) const {
    PointCount sum;
    eachKind([&](const auto& kind) {
      const PointCount of = kind.countPoints(ties);
      sum.all += of.all;
      sum.touching += of.touching;
    });
    return sum;
  }
  double mostPoints() const {
    double most = 0;
    eachKind([&](const auto& kind) { most += kind.kPoints * double(kind.size()); });
    return most;
  }
  // visit(contact): the manifolds that rows stand on.
  template <class Visit> void eachManifold(Visit&& visit) const {
    eachKind([&](const auto& kind) { kind.eachManifold(visit); });
  }
  // Bytes of a row by kind: builds with another memory layout do not read each other's snapshots.
  static constexpr std::uint32_t recordSize() {
    return []<class... Kinds>(const std::tuple<Kinds&...>*) {
      return (std::uint32_t(Kinds::kRecordSize) + ...);
    }(static_cast<decltype(std::declval<Rows&>().kinds())*>(nullptr));
  }
  // The memory of all ties, by kind; restore puts it back, whatever a trial has made of it (island_trial.h).
  using Memory = std::tuple<ContactRows::Memory, JointRows::Memory, MortarRows::Memory>;
  static Memory memoryFrom(std::pmr::memory_resource* from) {
    return [from]<std::size_t... i>(std::index_sequence<i...>) {
      return Memory{std::tuple_element_t<i, Memory>(from)...};
    }
    (std::make_index_sequence<kKinds>());
  }
  template <std::size_t i = 0> void remember(const Ties& ties, Memory& out) const {
    std::get<i>(kinds()).remember(ties, std::get<i>(out));
    if constexpr (i + 1 < kKinds) remember<i + 1>(ties, out);
  }
  template <std::size_t i = 0> void restore(Ties& ties, const Memory& memory) const {
    std::get<i>(kinds()).restore(ties, std::get<i>(memory));
    if constexpr (i + 1 < kKinds) restore<i + 1>(ties, memory);
  }
  // The ties are those of `old`.
  template <std::size_t i = 0> bool continues(const Rows& old, const StepContext& context) const {
    if (!std::get<i>(kinds()).continues(std::get<i>(old.kinds()), context)) return false;
    if constexpr (i + 1 < kKinds) return continues<i + 1>(old, context);
    return true;
  }

 private:
  template <class Wanted> bool any(Wanted&& wanted) const {
    bool any = false;
    eachKind([&](const auto& kind) { any = any || (kind.size() > 0 && wanted(kind)); });
    return any;
  }
};
static_assert(std::tuple_size_v<decltype(std::declval<Rows&>().kinds())> == kLinkKinds);

}  // namespace brickfall
