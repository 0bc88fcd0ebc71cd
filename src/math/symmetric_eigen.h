// Eigenvalues and axes of a symmetric 3 x 3 matrix: principal axes of inertia and of point sets.
#pragma once
#include "brickfall/math.h"

namespace brickfall {

struct SymmetricEigen {
  Vec3 values;
  Mat3 axes;  // rows: unit eigenvectors, right-handed; row i belongs to values[i]
};

// Jacobi's method: cyclic rotations, each of which makes one off-diagonal element zero (Golub and Van Loan, 8.5). Only
// the matrix's symmetric part is looked at; it must be finite. Order of the values: unspecified, but a diagonal matrix
// keeps its own and gets axes of exactly 0 and 1. Same bits on every platform.
SymmetricEigen symmetricEigen(const Mat3& matrix);

}  // namespace brickfall
