// Small worlds whose snapshots hold, between them, everything that a snapshot can hold. Without GoogleTest, for fuzz
// targets too.
#pragma once
#include <cstddef>
#include <vector>

#include "brickfall/world.h"

namespace brickfall::test {

// Ground and one box above it.
World smallWorld();
// Awake and asleep, on rails and switched off, every shape, compounds, joints of a collapse, quarantine, slots used again, changes not stepped yet.
std::vector<World> worldsOfEachKind();
std::vector<std::vector<std::byte>> snapshotsOfEachKind();

}  // namespace brickfall::test
