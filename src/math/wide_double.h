// Four double lanes, as two pairs: SSE2 and NEON have two to a register. Only operations that IEEE 754 defines exactly, as in
// wide.h. Not one vector of four: where there are no such registers, its way into functions is not defined.
#pragma once
#include <cmath>
#include <cstdint>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace brickfall::wide {

struct D {
  typedef double Pair __attribute__((vector_size(16)));
  typedef std::int64_t Mask __attribute__((vector_size(16)));
  Pair low, high;

  D() = default;
  explicit D(double v) : low{v, v}, high{v, v} {}
  D(Pair l, Pair h) : low(l), high(h) {}
  double operator[](int lane) const { return lane < 2 ? low[lane] : high[lane - 2]; }
  void set(int lane, double v) { (lane < 2 ? low : high)[lane & 1] = v; }
};

inline D operator+(D a, D b) { return {a.low + b.low, a.high + b.high}; }
inline D operator-(D a, D b) { return {a.low - b.low, a.high - b.high}; }
inline D operator-(D a) { return {-a.low, -a.high}; }
inline D operator*(D a, D b) { return {a.low * b.low, a.high * b.high}; }
inline D operator/(D a, D b) { return {a.low / b.low, a.high / b.high}; }

inline D::Pair sqrt(D::Pair v) {
#if defined(__SSE2__)
  return reinterpret_cast<D::Pair>(_mm_sqrt_pd(reinterpret_cast<__m128d>(v)));
#else
  return D::Pair{std::sqrt(v[0]), std::sqrt(v[1])};
#endif
}
inline D sqrt(D v) { return {sqrt(v.low), sqrt(v.high)}; }
inline D abs(D v) {
  constexpr D::Mask kSize{INT64_MAX, INT64_MAX};
  return {D::Pair(D::Mask(v.low) & kSize), D::Pair(D::Mask(v.high) & kSize)};
}
// Lane by lane: `yes` where a < b.
inline D::Pair selectLess(D::Pair a, D::Pair b, D::Pair yes, D::Pair no) {
  D::Mask less = a < b;
  return D::Pair((less & D::Mask(yes)) | (~less & D::Mask(no)));
}
inline D selectLess(D a, D b, D yes, D no) {
  return {selectLess(a.low, b.low, yes.low, no.low), selectLess(a.high, b.high, yes.high, no.high)};
}

}  // namespace brickfall::wide
