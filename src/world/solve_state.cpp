// Memory of a step is taken before the step begins, and kept. A scene that has run for a second takes nothing from the
// heap any more, whichever bodies meet, part, wake or fall asleep in it.
//
// Lists have room for as much as so many shapes are likely to need, and for a fourth more than they hold. The pool has
// more than a body of a wall under a hit needs (4 KiB with rebounds, and what a part that may be taken again had been),
// and half more than it ever gave out at once. This is address space, not memory: the system never gives pages that are
// not touched.
#include "world/solve_state.h"

#include <algorithm>

#include "base/keep_room.h"

namespace brickfall {

namespace {

//! not of the method: room
constexpr std::size_t kPoolPerBody = 24 * 1024;  // bytes
constexpr std::size_t kPoolPerBodyBeyond = 2 * 1024, kManyBodies = 10000;

std::size_t poolFor(std::size_t bodies) {
  return std::min(bodies, kManyBodies) * kPoolPerBody + std::max(bodies, kManyBodies) * kPoolPerBodyBeyond -
         kManyBodies * kPoolPerBodyBeyond;
}

}  // namespace

void SolveState::keepRoom(std::size_t dynamicBodies, std::size_t slots) {
  memory.reserve(std::max(poolFor(dynamicBodies), memory.peak() + memory.peak() / 2));
  keepRoomFor(context.free, slots);
  keepRoomFor(context.solved, slots);
}

}  // namespace brickfall
