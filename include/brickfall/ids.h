// Stable handles. A handle stays valid until its object is destroyed; a stale or null handle is found out in every build
// and answered with an error, never with undefined behaviour.
#pragma once
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

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

namespace detail {
// Every bit of an id decides; neighbours lie apart.
template <class Id> struct HashOfId {
  std::size_t operator()(const Id& id) const noexcept {
    std::uint64_t bits = (std::uint64_t(id.index) << 32) | (std::uint64_t(id.generation) << 16) | id.world;
    bits = (bits ^ (bits >> 31)) * 0x9e3779b97f4a7c15u;
    return std::size_t(bits ^ (bits >> 29));
  }
};
}  // namespace detail

}  // namespace brickfall

// Ids as keys of unordered containers.
template <> struct std::hash<brickfall::BodyId> : brickfall::detail::HashOfId<brickfall::BodyId> {};
template <> struct std::hash<brickfall::ShapeId> : brickfall::detail::HashOfId<brickfall::ShapeId> {};
template <> struct std::hash<brickfall::JointId> : brickfall::detail::HashOfId<brickfall::JointId> {};
template <> struct std::hash<brickfall::MortarId> : brickfall::detail::HashOfId<brickfall::MortarId> {};
