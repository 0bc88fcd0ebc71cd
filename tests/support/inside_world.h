// The world's insides, for tests: an explicit instantiation may name what is private.
#pragma once
#include "world/world_impl.h"

namespace brickfall::test {

namespace {
auto insideOfWorld();
template <auto member> struct Opener {
  friend auto insideOfWorld() { return member; }
};
template struct Opener<&World::impl_>;

auto& inside(World& world) { return *(world.*insideOfWorld()); }
}  // namespace

}  // namespace brickfall::test
