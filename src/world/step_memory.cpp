// What a step needs is taken before it begins, and kept: a scene that has run for a second takes nothing from the heap any
// more, whatever meets, parts, wakes or falls asleep in it.
//
// Lists have room for as much as so many shapes are likely to need, and for a fourth more than they hold; the pool has
// more than a body of a wall under a hit needs (4 KiB with rebounds), and half more than it ever gave out at once. This is
// address space, not memory: what is never touched is never given by the system.
#include "base/keep_room.h"
#include "geometry/mesh_shape.h"
#include "world/world_impl.h"

namespace brickfall {

namespace {

//! not of the method: room
constexpr std::size_t kPoolPerBody = 12 * 1024;  // bytes
constexpr std::size_t kPoolPerBodyBeyond = 2 * 1024, kManyBodies = 10000;
constexpr std::size_t kTouchingPerBody = 4;
constexpr std::size_t kMeshScratch = 4096;  // faces near one shape, points on them

std::size_t poolFor(std::size_t bodies) {
  return std::min(bodies, kManyBodies) * kPoolPerBody + std::max(bodies, kManyBodies) * kPoolPerBodyBeyond -
         kManyBodies * kPoolPerBodyBeyond;
}

}  // namespace

void World::Impl::keepRoom() {
  std::size_t dynamic = std::size_t(dynamicBodies), touching = kTouchingPerBody * dynamic;
  contacts.keepRoom(shapes.slots());
  islands.keepRoom(dynamic);
  stepMemory.reserve(std::max(poolFor(dynamic), stepMemory.peak() + stepMemory.peak() / 2));
  foundPairs.reserve(contacts.pairs.capacity());
  newPairs.reserve(contacts.pairs.capacity());
  brickfall::keepRoom(newParts, touching);
  brickfall::keepRoom(meshScratch.faces, kMeshScratch);
  brickfall::keepRoom(meshScratch.points, kMeshScratch);
  keepMeshRoom();
  keepRoomFor(awake, dynamic);
  keepRoomFor(islandOf, bodies.slots());
  for (BodyPairs* list : {&touchingNow, &touchingBefore, &slept}) brickfall::keepRoom(*list, touching);
  for (Events* e : {&events, &pending}) {
    for (auto* list : {&e->begin, &e->end}) brickfall::keepRoom(*list, touching);
    for (auto* list : {&e->moved, &e->fellAsleep, &e->woke}) keepRoomFor(*list, bodies.slots());
    brickfall::keepRoom(e->hits, touching);
  }
  keepRoomFor(context.free, bodies.slots());
  keepRoomFor(context.solved, bodies.slots());
}

// What happened between the steps opens the events of the next one. Both keep their room.
void World::Impl::tellPending() {
  events.begin.clear();
  events.hits.clear();
  events.moved.clear();
  events.fellAsleep.clear();
  events.end.assign(pending.end.begin(), pending.end.end());
  events.woke.assign(pending.woke.begin(), pending.woke.end());
  pending.end.clear();
  pending.woke.clear();
}

}  // namespace brickfall
