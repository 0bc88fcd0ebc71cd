// The contact set of boxes of which several rows meet at once.
#pragma once
#include <span>

#include "brickfall/geometry/obb_motion.h"
#include "geometry/obb_rows.h"

namespace brickfall {

struct RowSide {
  int row, sigma;
};
// Tries the rows in turn; points are relative to A's centre, d is B's.
template <class T>
ObbContactSetT<T> contactOfRows(const ObbT<T>& a, const ObbT<T>& b, Vec3T<T> d, std::span<const RowSide> rows,
                                ObbLimitsT<T> limits);
// Points from A's centre to the world.
template <class T> void moveToWorld(ObbContactSetT<T>& contact, Vec3T<T> centreA);

}  // namespace brickfall
