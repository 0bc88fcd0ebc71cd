#include "solver/island_builder.h"

#include <algorithm>
#include <cmath>
#include <new>

#include "base/keep_room.h"

namespace brickfall {

namespace {

class UnionFind {
 public:
  UnionFind(std::size_t count, std::pmr::memory_resource* memory) : parent_(count, memory) {
    for (std::size_t i = 0; i < count; i++) parent_[i] = std::uint32_t(i);
  }
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  // The lower index becomes the root: a root is the lowest body of its island.
  void join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::pmr::vector<std::uint32_t> parent_;
};

// A contact's slot may have gone to another contact since: those are marked born.
bool sameMembers(const Island& old, const Island& fresh, const ContactSet& set) {
  if (old.bodies != fresh.bodies || old.contacts != fresh.contacts) return false;
  return std::none_of(fresh.contacts.begin(), fresh.contacts.end(),
                      [&](ContactIndex c) { return set.contacts[c].born; });
}

// Partners and the records' body numbers.
void numberBodies(Island& island, const StepContext& context, std::pmr::vector<std::uint32_t>& localOf) {
  const BodySet& bodies = *context.bodies;
  for (std::size_t i = 0; i < island.bodies.size(); i++) localOf[island.bodies[i]] = std::uint32_t(i);
  island.records.assign(island.contacts.size(), {});
  island.starts.assign(island.contacts.size(), {});
  island.partners.clear();
  auto number = [&](BodyIndex body) {
    if (bodies.data[body].type == BodyType::dynamic) return localOf[body];
    auto place = std::find(island.partners.begin(), island.partners.end(), body);
    std::size_t at = std::size_t(place - island.partners.begin());
    if (place == island.partners.end()) island.partners.push_back(body);
    return std::uint32_t(island.bodies.size() + at);
  };
  for (std::size_t k = 0; k < island.contacts.size(); k++) {
    const Contact& c = context.contacts->contacts[island.contacts[k]];
    ContactRecord& r = island.records[k];
    r.contact = island.contacts[k];
    r.bodyA = number(c.bodyA);
    r.bodyB = number(c.bodyB);
    context.contacts->contacts[island.contacts[k]].fresh = true;
    context.contacts->contacts[island.contacts[k]].born = false;
  }
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

void buildIslands(IslandSet& islands, const StepContext& context, const std::vector<BodyIndex>& awakeBodies) {
  const BodySet& bodies = *context.bodies;
  const ContactSet& set = *context.contacts;
  auto dynamic = [&](BodyIndex body) { return bodies.data[body].type == BodyType::dynamic; };
  std::pmr::memory_resource* memory = context.memory;
  UnionFind join(bodies.slots(), memory);
  std::pmr::vector<char> hasContact(bodies.slots(), 0, memory);
  for (const CandidatePair& pair : set.pairs) {
    if (pair.contact == kNoIndex) continue;
    const Contact& c = set.contacts[pair.contact];
    bool a = dynamic(c.bodyA), b = dynamic(c.bodyB);
    if (a) hasContact[c.bodyA] = 1;
    if (b) hasContact[c.bodyB] = 1;
    if (a && b) join.join(c.bodyA, c.bodyB);
  }

  struct Size {
    std::size_t bodies = 0, contacts = 0;
  };
  std::vector<IslandPointer>& fresh = islands.scratch;
  fresh.clear();
  std::pmr::vector<std::uint32_t> islandOf(bodies.slots(), kNoIndex, memory);
  std::pmr::vector<Size> sizes(memory);
  islands.single.clear();
  for (BodyIndex body : awakeBodies) {
    if (!hasContact[body]) {
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
  auto eachContact = [&](auto use) {
    for (const CandidatePair& pair : set.pairs) {
      if (pair.contact == kNoIndex) continue;
      const Contact& c = set.contacts[pair.contact];
      use(islandOf[dynamic(c.bodyA) ? c.bodyA : c.bodyB], pair.contact);
    }
  };
  eachContact([&](std::uint32_t island, ContactIndex) { sizes[island].contacts++; });
  for (const Size& size : sizes) {
    fresh.push_back(makeIsland(memory));
    fresh.back()->bodies.reserve(size.bodies);
    fresh.back()->contacts.reserve(size.contacts);
  }
  for (BodyIndex body : awakeBodies)
    if (hasContact[body]) fresh[islandOf[body]]->bodies.push_back(body);
  eachContact([&](std::uint32_t island, ContactIndex contact) { fresh[island]->contacts.push_back(contact); });

  std::pmr::vector<std::uint32_t> localOf(bodies.slots(), kNoIndex, memory);
  std::size_t old = 0;
  for (IslandPointer& island : fresh) {
    while (old < islands.awake.size() && (!islands.awake[old] || islands.awake[old]->key() < island->key())) old++;
    bool keep = old < islands.awake.size() && islands.awake[old] && sameMembers(*islands.awake[old], *island, set);
    if (keep)
      island = std::move(islands.awake[old++]);
    else
      numberBodies(*island, context, localOf);
  }
  islands.awake.swap(fresh);
  fresh.clear();
}

std::pmr::vector<ClusterLink> clusterLinks(const Island& island, const ContactSet& contacts) {
  std::pmr::vector<ClusterLink> links(island.records.size(), island.memory);
  std::uint32_t bodies = std::uint32_t(island.bodies.size());
  for (std::size_t k = 0; k < links.size(); k++) {
    const ContactRecord& r = island.records[k];
    const Contact& c = contacts.contacts[island.contacts[k]];
    ClusterLink& link = links[k];
    link.bodyA = r.bodyA < bodies ? r.bodyA : ClusterLink::kNoBody;
    link.bodyB = r.bodyB < bodies ? r.bodyB : ClusterLink::kNoBody;
    link.weak = c.weak;
    // Each point counts 1, and 100 per effective weight that it carries.
    for (int i = 0; i < c.count; i++)
      link.strength += 1 + 100 * std::fabs(c.points.heldN[i]) / (c.effectiveMass * float(kReferenceGravity));
  }
  return links;
}

void updateHierarchies(Island& island, const ContactSet& contacts) {
  if (island.byStrength.valid && island.byMechanism.valid) return;
  std::pmr::vector<ClusterLink> links = clusterLinks(island, contacts);
  std::uint32_t bodies = std::uint32_t(island.bodies.size());
  if (!island.byStrength.valid) island.byStrength.build(bodies, links, false);
  island.byMechanism.build(bodies, links, true);
  island.byStrength.valid = island.byMechanism.valid = true;
}

}  // namespace brickfall
