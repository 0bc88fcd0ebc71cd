// Four float lanes, by the compilers' vector extensions (GCC, clang): SSE2 on plain x86-64, NEON on ARM, SIMD128 in
// WebAssembly, from one source. Only operations that IEEE 754 defines exactly, so every target gives the same bits; no
// reciprocal estimates, no fused multiply-add. Why not Highway: docs/decisions/0003-four-lanes.md.
#pragma once
#include <cmath>
#include <cstdint>
#include <cstring>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

#include "math/float3.h"

namespace brickfall::wide {

typedef float V __attribute__((vector_size(16)));
typedef std::int32_t M __attribute__((vector_size(16)));  // lanes all ones or all zeros

typedef float Stored __attribute__((vector_size(16), may_alias));

// Inlined always: a file that is compiled for more than plain x86-64 (solver/face/pairs_avx2.cpp) must not leave copies
// of them behind that others would be linked to.
#define BRICKFALL_LANES inline __attribute__((always_inline))

BRICKFALL_LANES V load(const float* aligned16) { return *reinterpret_cast<const Stored*>(aligned16); }
BRICKFALL_LANES V loadAnywhere(const float* from) {
  V v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
BRICKFALL_LANES void store(V v, float* aligned16) { *reinterpret_cast<Stored*>(aligned16) = v; }
BRICKFALL_LANES V set(float v) { return V{v, v, v, v}; }
template <class L> L all(float v);  // the same for whatever lanes L are (wide_pair.h)
template <> BRICKFALL_LANES V all<V>(float v) { return set(v); }
BRICKFALL_LANES V select(M mask, V yes, V no) { return V((mask & M(yes)) | (~mask & M(no))); }
BRICKFALL_LANES V keepIf(M mask, V yes) { return V(mask & M(yes)); }

// b where they are equal or not numbers.
BRICKFALL_LANES V max(V a, V b) {
#if defined(__SSE2__)
  return reinterpret_cast<V>(_mm_max_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
#else
  return select(a > b, a, b);
#endif
}

// Bit i = lane i.
BRICKFALL_LANES std::uint32_t bits(M mask) {
#if defined(__SSE2__)
  return std::uint32_t(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
  return std::uint32_t((mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8));
#endif
}
BRICKFALL_LANES bool any(M mask) { return bits(mask) != 0; }

BRICKFALL_LANES V sqrt(V v) {
#if defined(__SSE2__)
  return reinterpret_cast<V>(_mm_sqrt_ps(reinterpret_cast<__m128>(v)));
#else
  return V{std::sqrt(v[0]), std::sqrt(v[1]), std::sqrt(v[2]), std::sqrt(v[3])};
#endif
}

// (sum a, sum b, sum c, sum d), each as (v0 + v2) + (v1 + v3).
BRICKFALL_LANES V sums(V a, V b, V c, V d) {
  V x = __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
  V y = __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
  return __builtin_shufflevector(x, y, 0, 1, 4, 5) + __builtin_shufflevector(x, y, 2, 3, 6, 7);
}

// --- three-vectors in four lanes, the last one zero

BRICKFALL_LANES V load3(const Vec3f& v) { return V{v.x, v.y, v.z, 0}; }
// A three-vector that is followed by four readable bytes.
BRICKFALL_LANES V load3Padded(const Vec3f& v) {
  V all;
  std::memcpy(&all, &v, sizeof all);
  return V(M(all) & M{-1, -1, -1, 0});
}
BRICKFALL_LANES Vec3f store3(V v) { return {v[0], v[1], v[2]}; }
BRICKFALL_LANES V cross3(V a, V b) {
  V c = a * __builtin_shufflevector(b, b, 1, 2, 0, 3) - __builtin_shufflevector(a, a, 1, 2, 0, 3) * b;
  return __builtin_shufflevector(c, c, 1, 2, 0, 3);
}
template <int lane> BRICKFALL_LANES V spread(V v) { return __builtin_shufflevector(v, v, lane, lane, lane, lane); }

}  // namespace brickfall::wide
