// Hashes of each stage's output, to find the first place where two runs part. Output that depends on the history of the
// tree (candidate pairs without points, kept bounds) is left out: a restored world gives the same hashes.
#pragma once
#include <bit>
#include <type_traits>
#include <vector>

#include "brickfall/step_trace.h"
#include "world/activity.h"
#include "world/registry.h"

namespace brickfall {

// 64 bits at a time: base/hash.h goes byte by byte, too slow for all that a step writes. -0 counts as 0.
class Mix {
 public:
  template <class... Values> Mix& operator()(const Values&... values) {
    (add(values), ...);
    return *this;
  }
  template <class T> Mix& list(const T* values, int count) {
    for (int i = 0; i < count; i++) add(values[i]);
    return *this;
  }
  std::uint64_t value() const { return value_; }

 private:
  void word(std::uint64_t bits) {
    value_ = (value_ ^ bits) * 0x9e3779b97f4a7c15ull;
    value_ ^= value_ >> 29;
  }
  template <class T> void add(const T& v) {
    if constexpr (std::is_floating_point_v<T>)
      word(v == 0 ? 0 : std::bit_cast<std::uint64_t>(double(v)));
    else
      word(std::uint64_t(v));
  }
  template <class T> void add(const Vec3T<T>& v) { (*this)(v.x, v.y, v.z); }
  void add(const Quat& q) { (*this)(q.x, q.y, q.z, q.w); }
  void add(const Aabb& box) { (*this)(box.lower, box.upper); }
  std::uint64_t value_ = 0x243f6a8885a308d3ull;
};

void mix(Mix& h, const BodyMotion& m);
void mix(Mix& h, const SolvedMotion& s);
void mix(Mix& h, const FreeMotion& f);
void mix(Mix& h, const Contact& c);
void mix(Mix& h, const ContactGeometry& g, int count);
void mix(Mix& h, const ContactRecord& r, int count);

// The items of one stage, in the order in which they are added.
class HashItems {
 public:
  HashItems(const Registry& registry, bool keep) : registry_(registry), keep_(keep) {}

  void add(BodyId a, BodyId b, const Mix& item);
  StageHash take(int substep, std::optional<Stage> stage);

  // write(h, body)
  template <class List, class Write> void bodies(const List& list, Write write) {
    for (BodyIndex body : list) {
      Mix h;
      write(h, body);
      add(registry_.idOf(body), {}, h);
    }
  }
  // For pairs with points: write(h, contact, geometry).
  template <class Write> void pairs(const std::vector<CandidatePair>& list, const ContactSet& contacts, Write write) {
    for (const CandidatePair& pair : list) {
      if (pair.contact == kNoIndex) continue;
      Mix h;
      write(h, contacts.contacts[pair.contact], contacts.geometry[pair.contact]);
      add(registry_.idOf(pair.bodyA), registry_.idOf(pair.bodyB), h);
    }
  }
  // Facts of an island as a whole are hashed with its first body: write(h, island).
  template <class Write> void islands(const std::vector<IslandPointer>& list, Write write) {
    for (const IslandPointer& island : list) {
      Mix h;
      write(h, *island);
      add(registry_.idOf(island->key()), {}, h);
    }
  }
  // For the contacts of awake islands: write(h, island, k, contact).
  template <class Write> void records(const IslandSet& islands, const ContactSet& contacts, Write write) {
    for (const IslandPointer& island : islands.awake)
      for (std::size_t k = 0; k < island->rows.contacts.records.size(); k++) {
        const Contact& c = contacts.contacts[island->rows.contacts.contactOf[k]];
        Mix h;
        write(h, *island, k, c);
        add(registry_.idOf(c.bodyA), registry_.idOf(c.bodyB), h);
      }
  }
  // Motions that the solve found. Those of an island that is passed over are not read any more.
  void solved(const IslandSet& islands, const StepContext& context);
  void contacts(const IslandSet& islands, const ContactSet& contacts);  // of awake islands

 private:
  const Registry& registry_;
  bool keep_;
  Mix sum_;
  std::vector<ItemHash> items_;
};

// Hashes of a step's input: all bodies, and the memory of contacts and islands.
void hashGiven(const Registry& registry, const IslandSet& islands, const ContactSet& contacts, HashItems& out);

}  // namespace brickfall
