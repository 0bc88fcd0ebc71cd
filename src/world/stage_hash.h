// Hashes of each stage's output, to find the first place where two runs part. Output that depends on the history of the
// tree (candidate pairs without points, kept bounds) is left out: a restored world gives the same hashes.
#pragma once
#include <utility>
#include <vector>

#include "base/mix.h"
#include "brickfall/step_trace.h"
#include "world/activity.h"
#include "world/registry.h"

namespace brickfall {

void mix(Mix& h, const BodyMotion& m);
void mix(Mix& h, const SolvedMotion& s);
void mix(Mix& h, const FreeMotion& f);

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
  // A visit of links: all that each of them remembers.
  auto links(const Ties& ties) {
    return [this, &ties](const Link& link) {
      Mix h;
      ties.hash(h, link);
      add(registry_.idOf(link.bodyA), registry_.idOf(link.bodyB), h);
    };
  }
  // Facts of an island as a whole are hashed with its first body: write(h, island).
  template <class Write> void islands(const std::vector<IslandPointer>& list, Write write) {
    for (const IslandPointer& island : list) {
      Mix h;
      write(h, *island);
      add(registry_.idOf(island->key()), {}, h);
    }
  }
  // For the rows of awake islands: write(h, island, kind, k).
  template <class Write> void rows(const IslandSet& islands, const Ties& ties, Write write) {
    for (const IslandPointer& island : islands.awake)
      island->rows.each([&](const auto& kind, std::size_t k) {
        const auto [a, b] = kind.bodies(k, ties);
        Mix h;
        write(h, std::as_const(*island), kind, k);
        add(registry_.idOf(a), registry_.idOf(b), h);
      });
  }
  // Motions that the solve found. Those of an island that is passed over are not read any more.
  void solved(const IslandSet& islands, const StepContext& context);
  void memories(const IslandSet& islands, const Ties& ties);  // of ties of awake islands

 private:
  const Registry& registry_;
  bool keep_;
  Mix sum_;
  std::vector<ItemHash> items_;
};

// Hashes of a step's input: all bodies, and the memory of contacts and islands.
void hashGiven(const Registry& registry, const IslandSet& islands, const Ties& ties, HashItems& out);

}  // namespace brickfall
