// Two boxes at one instant, by the fifteen rows.
#include "geometry/obb_rows.h"

namespace brickfall {

const char* obbRowName(int row) {
  static constexpr const char* kNames[kObbRows] = {"A0",    "A1",    "A2",    "B0",    "B1",
                                                   "B2",    "A0xB0", "A0xB1", "A0xB2", "A1xB0",
                                                   "A1xB1", "A1xB2", "A2xB0", "A2xB1", "A2xB2"};
  return row >= 0 && row < kObbRows ? kNames[row] : "none";
}

template <class T> Vec3T<T> obbRowAxis(const ObbT<T>& a, const ObbT<T>& b, int row) {
  if (row < 0 || row >= kObbRows) return {};
  if (row < 3) return a.axes.row[row];
  if (row < kObbFaceRows) return b.axes.row[row - 3];
  return cross(a.axes.row[(row - 6) / 3], b.axes.row[(row - 6) % 3]);
}

// The rows of A need only their own cosines, so those of the others are not computed before they are asked for; the numbers
// are the same as in ObbRows, bit by bit.
template <class T> int firstSeparatingRow(const ObbT<T>& a, const ObbT<T>& b) {
  const Vec3T<T> d = b.centre - a.centre;
  T c[3][3], m[3][3];
  Vec3T<T> dA;
  for (int i = 0; i < 3; i++) {
    for (int j = 0; j < 3; j++) {
      c[i][j] = dot(a.axes.row[i], b.axes.row[j]);
      m[i][j] = std::fabs(c[i][j]);
    }
    dA[i] = dot(a.axes.row[i], d);
    T reach = a.halfExtents[i] + (b.halfExtents.x * m[i][0] + b.halfExtents.y * m[i][1] + b.halfExtents.z * m[i][2]);
    if (std::fabs(dA[i]) > reach) return i;
  }
  for (int j = 0; j < 3; j++) {
    T reach = b.halfExtents[j] + (a.halfExtents.x * m[0][j] + a.halfExtents.y * m[1][j] + a.halfExtents.z * m[2][j]);
    if (std::fabs(dot(b.axes.row[j], d)) > reach) return 3 + j;
  }
  for (int i0 = 0; i0 < 3; i0++) {
    const int i1 = (i0 + 1) % 3, i2 = (i0 + 2) % 3;
    for (int j0 = 0; j0 < 3; j0++) {
      const int j1 = (j0 + 1) % 3, j2 = (j0 + 2) % 3;
      T reach = (a.halfExtents[i1] * m[i2][j0] + a.halfExtents[i2] * m[i1][j0]) +
                (b.halfExtents[j1] * m[i0][j2] + b.halfExtents[j2] * m[i0][j1]);
      if (!(std::fabs(c[i1][j0] * dA[i2] - c[i2][j0] * dA[i1]) > reach)) continue;
      if (c[i1][j0] * c[i1][j0] + c[i2][j0] * c[i2][j0] > kParallelSquared<T>) return 6 + 3 * i0 + j0;
    }
  }
  return -1;
}

template <class T> bool overlaps(const ObbT<T>& a, const ObbT<T>& b) { return firstSeparatingRow(a, b) < 0; }

template <class T> ObbGapsT<T> rowGaps(const ObbT<T>& a, const ObbT<T>& b) {
  const ObbRows<T> rows(a, b);
  ObbGapsT<T> out;
  eachRow([&](auto row) {
    T along = rows.template along<row>(rows.dA, rows.dB);
    out.sigma[row] = along < 0 ? -1 : 1;
    if (!rows.template used<row>()) return;
    T apart = std::fabs(along), reach = rows.template reach<row>();
    out.used = std::uint16_t(out.used | 1 << row);
    if (apart > reach) out.separating = std::uint16_t(out.separating | 1 << row);
    out.gap[row] = row < kObbFaceRows ? apart - reach : (apart - reach) / std::sqrt(rows.template squared<row>());
  });
  return out;
}

namespace {

template <class T>
std::optional<ObbPenetrationT<T>> leastPenetration(const ObbT<T>& a, const ObbT<T>& b, const ObbGapsT<T>& gaps) {
  if (gaps.separating) return std::nullopt;
  T highest = gaps.gap[0];
  for (int row = 1; row < kObbRows; row++) {
    if (gaps.used >> row & 1 && gaps.gap[row] > highest) highest = gaps.gap[row];
  }
  ObbPenetrationT<T> out;
  const T size = pairSize(a, b);
  for (int row = 0; row < kObbRows && out.row < 0; row++) {
    if (gaps.used >> row & 1 && gaps.gap[row] >= highest - kTie<T> * size) out.row = row;
  }
  if (out.row < 0) return std::nullopt;  // only from numbers that are not finite
  out.depth = gaps.gap[out.row] < 0 ? -gaps.gap[out.row] : 0;
  Vec3T<T> axis = normalized(obbRowAxis(a, b, out.row));
  out.normal = axis * T(gaps.sigma[out.row]);
  out.signKnown = std::fabs(dot(axis, b.centre - a.centre)) > kTie<T> * size;
  return out;
}

}  // namespace

template <class T> std::optional<ObbPenetrationT<T>> leastPenetration(const ObbT<T>& a, const ObbT<T>& b) {
  return leastPenetration(a, b, rowGaps(a, b));
}

template <class T> Result<ObbPairT<T>> examine(const ObbT<T>& a, const ObbT<T>& b) {
  if (Status good = checkObb(a, "a"); !good) return good.error();
  if (Status good = checkObb(b, "b"); !good) return good.error();
  ObbPairT<T> out;
  out.gaps = rowGaps(a, b);
  for (int row = kObbRows - 1; row >= 0; row--) {
    if (out.gaps.separating >> row & 1) out.firstSeparating = row;
  }
  out.overlap = out.firstSeparating < 0;
  out.closest = distance(a, b);
  out.penetration = leastPenetration(a, b, out.gaps);
  return out;
}

#define BRICKFALL_OBB_PAIR(T)                                                                  \
  template Vec3T<T> obbRowAxis(const ObbT<T>&, const ObbT<T>&, int);                           \
  template int firstSeparatingRow(const ObbT<T>&, const ObbT<T>&);                             \
  template bool overlaps(const ObbT<T>&, const ObbT<T>&);                                      \
  template ObbGapsT<T> rowGaps(const ObbT<T>&, const ObbT<T>&);                                \
  template std::optional<ObbPenetrationT<T>> leastPenetration(const ObbT<T>&, const ObbT<T>&); \
  template Result<ObbPairT<T>> examine(const ObbT<T>&, const ObbT<T>&);
BRICKFALL_OBB_PAIR(float)
BRICKFALL_OBB_PAIR(double)
#undef BRICKFALL_OBB_PAIR

}  // namespace brickfall
