// Twice four lanes, for two rows at a time: the two halves never mix, so that each row has the bits that it would have alone.
// Halves are any machine's: while one waits for a root or a division, the other goes on. Eight is one register with AVX2; only
// files that are compiled for that (and called where the machine has it) see it.
#pragma once
#include "math/wide.h"

namespace brickfall::wide {

struct Halves {
  V low, high;

  Halves() = default;
  BRICKFALL_LANES Halves(V l, V h) : low(l), high(h) {}
  struct Mask {
    M low, high;
    friend BRICKFALL_LANES Mask operator&(Mask a, Mask b) { return {a.low & b.low, a.high & b.high}; }
  };

  friend BRICKFALL_LANES Halves operator+(Halves a, Halves b) { return {a.low + b.low, a.high + b.high}; }
  friend BRICKFALL_LANES Halves operator-(Halves a, Halves b) { return {a.low - b.low, a.high - b.high}; }
  friend BRICKFALL_LANES Halves operator*(Halves a, Halves b) { return {a.low * b.low, a.high * b.high}; }
  friend BRICKFALL_LANES Halves operator/(Halves a, Halves b) { return {a.low / b.low, a.high / b.high}; }
  friend BRICKFALL_LANES Halves operator-(Halves a) { return {-a.low, -a.high}; }
  friend BRICKFALL_LANES Mask operator>(Halves a, Halves b) { return {a.low > b.low, a.high > b.high}; }

  friend BRICKFALL_LANES Halves select(Mask m, Halves yes, Halves no) {
    return {select(m.low, yes.low, no.low), select(m.high, yes.high, no.high)};
  }
  friend BRICKFALL_LANES Halves keepIf(Mask m, Halves yes) {
    return {keepIf(m.low, yes.low), keepIf(m.high, yes.high)};
  }
  friend BRICKFALL_LANES Halves max(Halves a, Halves b) { return {max(a.low, b.low), max(a.high, b.high)}; }
  friend BRICKFALL_LANES Halves sqrt(Halves a) { return {sqrt(a.low), sqrt(a.high)}; }
  friend BRICKFALL_LANES Halves sums(Halves a, Halves b, Halves c, Halves d) {
    return {sums(a.low, b.low, c.low, d.low), sums(a.high, b.high, c.high, d.high)};
  }
  friend BRICKFALL_LANES Halves cross3(Halves a, Halves b) { return {cross3(a.low, b.low), cross3(a.high, b.high)}; }
  template <int lane> friend BRICKFALL_LANES Halves spread(Halves a) {
    return {spread<lane>(a.low), spread<lane>(a.high)};
  }
  friend BRICKFALL_LANES V lowOf(Halves a) { return a.low; }
  friend BRICKFALL_LANES V highOf(Halves a) { return a.high; }
};
template <> BRICKFALL_LANES Halves all<Halves>(float v) { return {all<V>(v), all<V>(v)}; }

}  // namespace brickfall::wide

#if defined(__AVX2__)
#include <immintrin.h>

namespace brickfall::wide {

struct Eight {
  typedef float W __attribute__((vector_size(32)));
  typedef std::int32_t I __attribute__((vector_size(32)));
  W v;

  Eight() = default;
  BRICKFALL_LANES Eight(W w) : v(w) {}
  BRICKFALL_LANES Eight(V low, V high)
      : v(W(_mm256_insertf128_ps(_mm256_castps128_ps256(__m128(low)), __m128(high), 1))) {}
  struct Mask {
    I v;
    friend BRICKFALL_LANES Mask operator&(Mask a, Mask b) { return {a.v & b.v}; }
  };

  friend BRICKFALL_LANES Eight operator+(Eight a, Eight b) { return a.v + b.v; }
  friend BRICKFALL_LANES Eight operator-(Eight a, Eight b) { return a.v - b.v; }
  friend BRICKFALL_LANES Eight operator*(Eight a, Eight b) { return a.v * b.v; }
  friend BRICKFALL_LANES Eight operator/(Eight a, Eight b) { return a.v / b.v; }
  friend BRICKFALL_LANES Eight operator-(Eight a) { return -a.v; }
  friend BRICKFALL_LANES Mask operator>(Eight a, Eight b) { return {a.v > b.v}; }

  friend BRICKFALL_LANES Eight select(Mask m, Eight yes, Eight no) {
    return W(_mm256_blendv_ps(__m256(no.v), __m256(yes.v), __m256(m.v)));
  }
  friend BRICKFALL_LANES Eight keepIf(Mask m, Eight yes) { return W(m.v & I(yes.v)); }
  friend BRICKFALL_LANES Eight max(Eight a, Eight b) { return W(_mm256_max_ps(__m256(a.v), __m256(b.v))); }
  friend BRICKFALL_LANES Eight sqrt(Eight a) { return W(_mm256_sqrt_ps(__m256(a.v))); }
  friend BRICKFALL_LANES Eight sums(Eight a, Eight b, Eight c, Eight d) {
    W x = __builtin_shufflevector(a.v, b.v, 0, 8, 1, 9, 4, 12, 5, 13) +
          __builtin_shufflevector(a.v, b.v, 2, 10, 3, 11, 6, 14, 7, 15);
    W y = __builtin_shufflevector(c.v, d.v, 0, 8, 1, 9, 4, 12, 5, 13) +
          __builtin_shufflevector(c.v, d.v, 2, 10, 3, 11, 6, 14, 7, 15);
    return __builtin_shufflevector(x, y, 0, 1, 8, 9, 4, 5, 12, 13) +
           __builtin_shufflevector(x, y, 2, 3, 10, 11, 6, 7, 14, 15);
  }
  static BRICKFALL_LANES W turned(W a) { return __builtin_shufflevector(a, a, 1, 2, 0, 3, 5, 6, 4, 7); }
  friend BRICKFALL_LANES Eight cross3(Eight a, Eight b) { return turned(a.v * turned(b.v) - turned(a.v) * b.v); }
  template <int lane> friend BRICKFALL_LANES Eight spread(Eight a) {
    return __builtin_shufflevector(a.v, a.v, lane, lane, lane, lane, lane + 4, lane + 4, lane + 4, lane + 4);
  }
  friend BRICKFALL_LANES V lowOf(Eight a) { return V(_mm256_castps256_ps128(__m256(a.v))); }
  friend BRICKFALL_LANES V highOf(Eight a) { return V(_mm256_extractf128_ps(__m256(a.v), 1)); }
};
template <> BRICKFALL_LANES Eight all<Eight>(float v) { return Eight::W{v, v, v, v, v, v, v, v}; }

}  // namespace brickfall::wide
#endif
