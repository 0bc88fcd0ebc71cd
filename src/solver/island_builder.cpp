#include "solver/island_builder.h"

#include <algorithm>
#include <new>
#include <utility>

#include "base/keep_room.h"
#include "solver/union_find.h"

namespace brickfall {

namespace {

// Partners, and the rows' body numbers.
void numberBodies(Island& island, const BodySet& bodies, Ties& ties, std::pmr::vector<std::uint32_t>& localOf) {
  for (std::size_t i = 0; i < island.bodies.size(); i++) localOf[island.bodies[i]] = std::uint32_t(i);
  island.partners.clear();
  auto number = [&](BodyIndex body) {
    if (bodies.data[body].type == BodyType::dynamic) return localOf[body];
    auto place = std::find(island.partners.begin(), island.partners.end(), body);
    std::size_t at = std::size_t(place - island.partners.begin());
    if (place == island.partners.end()) island.partners.push_back(body);
    return std::uint32_t(island.bodies.size() + at);
  };
  island.rows.eachKind([&](auto& kind) { kind.bind(ties, number); });
}

}  // namespace

IslandPointer makeIsland(std::pmr::memory_resource* memory) {
  return IslandPointer(new (memory->allocate(sizeof(Island), alignof(Island))) Island(memory));
}

void IslandDeleter::operator()(Island* island) const {
  std::pmr::memory_resource* memory = island->memory;
  island->~Island();
  memory->deallocate(island, sizeof(Island), alignof(Island));
}

void IslandSet::keepRoom(std::size_t dynamicBodies) {
  for (auto* list : {&awake, &asleep, &scratch}) keepRoomFor(*list, dynamicBodies);
  keepRoomFor(single, dynamicBodies);
}

void buildIslands(IslandSet& islands, Ties& ties, const StepContext& context,
                  const std::vector<BodyIndex>& awakeBodies) {
  const BodySet& bodies = *context.bodies;
  const Ties& links = ties;
  auto dynamic = [&](BodyIndex body) { return bodies.data[body].type == BodyType::dynamic; };
  std::pmr::memory_resource* memory = context.memory;
  UnionFind join(bodies.slots(), memory);
  std::pmr::vector<char> tied(bodies.slots(), 0, memory);
  links.eachAwake([&](const Link& link) {
    bool a = dynamic(link.bodyA), b = dynamic(link.bodyB);
    if (a) tied[link.bodyA] = 1;
    if (b) tied[link.bodyB] = 1;
    if (a && b) join.join(link.bodyA, link.bodyB);
  });

  struct Size {
    std::size_t bodies = 0;
    Rows::Counts rows{};
  };
  std::vector<IslandPointer>& fresh = islands.scratch;
  fresh.clear();
  std::pmr::vector<std::uint32_t> islandOf(bodies.slots(), kNoIndex, memory);
  std::pmr::vector<Size> sizes(memory);
  islands.single.clear();
  for (BodyIndex body : awakeBodies) {
    if (!tied[body]) {
      islands.single.push_back(body);
      continue;
    }
    std::uint32_t root = join.find(body);
    if (islandOf[root] == kNoIndex) {
      islandOf[root] = std::uint32_t(sizes.size());
      sizes.emplace_back();
    }
    islandOf[body] = islandOf[root];
    sizes[islandOf[body]].bodies++;
  }
  auto islandOfLink = [&](const Link& link) { return islandOf[dynamic(link.bodyA) ? link.bodyA : link.bodyB]; };
  links.eachAwake([&](const Link& link) { sizes[islandOfLink(link)].rows[std::size_t(link.kind)]++; });
  for (const Size& size : sizes) {
    fresh.push_back(makeIsland(memory));
    fresh.back()->bodies.reserve(size.bodies);
    fresh.back()->rows.reserve(size.rows);
  }
  for (BodyIndex body : awakeBodies)
    if (tied[body]) fresh[islandOf[body]]->bodies.push_back(body);
  links.eachAwake([&](const Link& link) { fresh[islandOfLink(link)]->rows.add(link); });

  std::pmr::vector<std::uint32_t> localOf(bodies.slots(), kNoIndex, memory);
  std::size_t old = 0;
  for (IslandPointer& island : fresh) {
    while (old < islands.awake.size() && (!islands.awake[old] || islands.awake[old]->key() < island->key())) old++;
    bool keep = old < islands.awake.size() && islands.awake[old] && islands.awake[old]->bodies == island->bodies &&
                island->rows.continues(islands.awake[old]->rows, context);
    if (keep)
      island = std::move(islands.awake[old++]);
    else
      numberBodies(*island, bodies, ties, localOf);
  }
  islands.awake.swap(fresh);
  fresh.clear();
}

void updateHierarchy(Island& island, const StepContext& context) {
  if (island.hierarchy.valid) return;
  std::uint32_t bodies = std::uint32_t(island.bodies.size());
  std::pmr::vector<ClusterLink> links(island.memory);
  links.reserve(island.rows.size());
  auto own = [&](std::uint32_t body) { return body < bodies ? body : kNoIndex; };
  std::as_const(island.rows).each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    links.push_back({own(ends.a), own(ends.b), kind.strength(k, context)});
  });
  island.hierarchy.build(bodies, links);
  island.hierarchy.valid = true;
}

}  // namespace brickfall
