// Four pairs of boxes at a time, one in each lane. The same operations in the same order as firstSeparatingRow, so that the
// verdict is the same to the bit. Boxes lie one after the other in memory, 15 floats each, and are transposed on the way in.
#include "geometry/obb_rows.h"
#include "math/wide.h"

namespace brickfall {

namespace {

using wide::M;
using wide::V;

static_assert(sizeof(ObbF) == 15 * sizeof(float));

struct Lanes {
  V centre[3], axes[3][3], half[3];
};

V loadAny(const float* p) {
  V v;
  std::memcpy(&v, p, sizeof v);
  return v;
}

// Rows of four lanes to columns.
void transpose4(const V in[4], V out[4]) {
  V x = __builtin_shufflevector(in[0], in[1], 0, 4, 1, 5), y = __builtin_shufflevector(in[0], in[1], 2, 6, 3, 7);
  V z = __builtin_shufflevector(in[2], in[3], 0, 4, 1, 5), w = __builtin_shufflevector(in[2], in[3], 2, 6, 3, 7);
  out[0] = __builtin_shufflevector(x, z, 0, 1, 4, 5), out[1] = __builtin_shufflevector(x, z, 2, 3, 6, 7);
  out[2] = __builtin_shufflevector(y, w, 0, 1, 4, 5), out[3] = __builtin_shufflevector(y, w, 2, 3, 6, 7);
}

Lanes gather(const ObbF* box) {
  V field[16];
  for (int block = 0; block < 4; block++) {
    // The last block starts one float early, so as not to read past the box: its first lane is the block's before.
    int from = block < 3 ? 4 * block : 11;
    V rows[4], columns[4];
    for (int k = 0; k < 4; k++) rows[k] = loadAny(reinterpret_cast<const float*>(box + k) + from);
    transpose4(rows, columns);
    for (int k = 0; k < 4; k++) field[from + k] = columns[k];
  }
  return {{field[0], field[1], field[2]},
          {{field[3], field[4], field[5]}, {field[6], field[7], field[8]}, {field[9], field[10], field[11]}},
          {field[12], field[13], field[14]}};
}

V absolute(V v) { return V(M(v) & M{0x7fffffff, 0x7fffffff, 0x7fffffff, 0x7fffffff}); }
V dot3(const V a[3], const V b[3]) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// Lanes all ones where the boxes are apart.
M separated(const Lanes& a, const Lanes& b) {
  const V d[3] = {b.centre[0] - a.centre[0], b.centre[1] - a.centre[1], b.centre[2] - a.centre[2]};
  V c[3][3], m[3][3], dA[3];
  M apart = {};
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) c[i][j] = dot3(a.axes[i], b.axes[j]), m[i][j] = absolute(c[i][j]);
    dA[i] = dot3(a.axes[i], d);
    V reach = a.half[i] + (b.half[0] * m[i][0] + b.half[1] * m[i][1] + b.half[2] * m[i][2]);
    apart |= absolute(dA[i]) > reach;
  }
  for (int j = 0; j < 3; j++) {
    V reach = b.half[j] + (a.half[0] * m[0][j] + a.half[1] * m[1][j] + a.half[2] * m[2][j]);
    apart |= absolute(dot3(b.axes[j], d)) > reach;
  }
  if (wide::bits(apart) == 15) return apart;
  const V parallel = wide::set(kParallelSquared<float>);
  for (int i0 = 0; i0 < 3; i0++) {
    const int i1 = (i0 + 1) % 3, i2 = (i0 + 2) % 3;
    for (int j0 = 0; j0 < 3; j0++) {
      const int j1 = (j0 + 1) % 3, j2 = (j0 + 2) % 3;
      V reach = (a.half[i1] * m[i2][j0] + a.half[i2] * m[i1][j0]) + (b.half[j1] * m[i0][j2] + b.half[j2] * m[i0][j1]);
      M beyond = absolute(c[i1][j0] * dA[i2] - c[i2][j0] * dA[i1]) > reach;
      apart |= beyond & (c[i1][j0] * c[i1][j0] + c[i2][j0] * c[i2][j0] > parallel);
    }
  }
  return apart;
}

}  // namespace

void overlaps(std::span<const ObbF> a, std::span<const ObbF> b, std::span<std::uint8_t> out) {
  std::size_t count = out.size();
  if (a.size() < count) count = a.size();
  if (b.size() < count) count = b.size();
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    std::uint32_t apart = wide::bits(separated(gather(&a[k]), gather(&b[k])));
    for (std::size_t lane = 0; lane < 4; lane++) out[k + lane] = std::uint8_t(~apart >> lane & 1);
  }
  for (; k < count; k++) out[k] = overlaps(a[k], b[k]);
}

}  // namespace brickfall
