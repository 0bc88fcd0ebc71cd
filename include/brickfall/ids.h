// Stable handles. A handle stays valid until its object is destroyed; a stale or null handle is found out in every build
// and answered with an error, never with undefined behaviour.
#pragma once
#include <compare>
#include <cstdint>

namespace brickfall {

// index counts from 1 (0 = none); generation tells a reused index from the object that had it before; world tells the
// worlds of one process apart.
struct BodyId {
  std::uint32_t index = 0;
  std::uint16_t generation = 0;
  std::uint16_t world = 0;
  explicit operator bool() const { return index != 0; }
  auto operator<=>(const BodyId&) const = default;
};

struct ShapeId {
  std::uint32_t index = 0;
  std::uint16_t generation = 0;
  std::uint16_t world = 0;
  explicit operator bool() const { return index != 0; }
  auto operator<=>(const ShapeId&) const = default;
};

struct JointId {
  std::uint32_t index = 0;
  std::uint16_t generation = 0;
  std::uint16_t world = 0;
  explicit operator bool() const { return index != 0; }
  auto operator<=>(const JointId&) const = default;
};

struct MortarId {
  std::uint32_t index = 0;
  std::uint16_t generation = 0;
  std::uint16_t world = 0;
  explicit operator bool() const { return index != 0; }
  auto operator<=>(const MortarId&) const = default;
};

}  // namespace brickfall
