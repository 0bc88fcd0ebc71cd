// A hash of values of all kinds, for comparing two runs of a world.
#pragma once
#include <bit>
#include <cstdint>
#include <type_traits>

#include "brickfall/math.h"

namespace brickfall {

// 64 bits at a time: base/hash.h goes byte by byte, too slow for all that a
// step writes. -0 counts as 0.
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

}  // namespace brickfall
