// Four float lanes, by the compilers' vector extensions (GCC, clang): SSE2 on plain x86-64, NEON on ARM, SIMD128 in
// WebAssembly, from one source. Only operations that IEEE 754 defines exactly, so every target gives the same bits; no
// reciprocal estimates, no fused multiply-add. Why not Highway yet: docs/decisions/0003-four-lanes.md.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace brickfall::wide {

typedef float V __attribute__((vector_size(16)));
typedef std::int32_t M __attribute__((vector_size(16)));  // lanes all ones or all zeros

typedef float Stored __attribute__((vector_size(16), may_alias));

inline V load(const float* aligned16) { return *reinterpret_cast<const Stored*>(aligned16); }
inline void store(V v, float* aligned16) { *reinterpret_cast<Stored*>(aligned16) = v; }
inline V set(float v) { return V{v, v, v, v}; }
inline V select(M mask, V yes, V no) { return V((mask & M(yes)) | (~mask & M(no))); }
inline V keepIf(M mask, V yes) { return V(mask & M(yes)); }
inline V max(V a, V b) { return select(a > b, a, b); }
inline V min(V a, V b) { return select(a < b, a, b); }

// Bit i = lane i.
inline std::uint32_t bits(M mask) {
#if defined(__SSE2__)
  return std::uint32_t(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  return std::uint32_t((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
inline bool any(M mask) { return bits(mask) != 0; }

inline V sqrt(V v) {
#if defined(__SSE2__)
  return reinterpret_cast<V>(_mm_sqrt_ps(reinterpret_cast<__m128>(v)));
#else
  return V{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

// (sum a, sum b, sum c, sum d), each as (v0 + v2) + (v1 + v3).
inline V sums(V a, V b, V c, V d) {
  V x = V{a[0], b[0], a[1], b[1]} + V{a[2], b[2], a[3], b[3]};
  V y = V{c[0], d[0], c[1], d[1]} + V{c[2], d[2], c[3], d[3]};
  return V{x[0], x[1], y[0], y[1]} + V{x[2], x[3], y[2], y[3]};
}

}  // namespace brickfall::wide
