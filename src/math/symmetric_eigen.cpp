#include "math/symmetric_eigen.h"

namespace brickfall {

namespace {

// Turns rows p and q of the axes so that element (p, q) of a becomes zero.
void rotateAway(Mat3& a, Mat3& axes, int p, int q) {
  double off = a.row[p][q];
  if (off == 0) return;
  double theta = (a.row[q][q] - a.row[p][p]) / (2 * off);
  double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));  // the smaller of two roots
  if (!std::isfinite(theta)) t = 0;  // too small to count: the division overflowed
  double c = 1 / std::sqrt(t * t + 1), s = t * c;
  int r = 3 - p - q;
  double pr = a.row[p][r], qr = a.row[q][r];
  a.row[p][p] -= t * off;
  a.row[q][q] += t * off;
  a.row[p][q] = a.row[q][p] = 0;
  a.row[p][r] = a.row[r][p] = c * pr - s * qr;
  a.row[q][r] = a.row[r][q] = s * pr + c * qr;
  Vec3 u = axes.row[p], v = axes.row[q];
  axes.row[p] = u * c - v * s;
  axes.row[q] = u * s + v * c;
}

}  // namespace

SymmetricEigen symmetricEigen(const Mat3& matrix) {
  Mat3 a = (matrix + transpose(matrix)) * 0.5;
  SymmetricEigen out;
  for (int sweep = 0; sweep < 20; sweep++) {
    if (a.row[0][1] == 0 && a.row[0][2] == 0 && a.row[1][2] == 0) break;
    rotateAway(a, out.axes, 0, 1);
    rotateAway(a, out.axes, 0, 2);
    rotateAway(a, out.axes, 1, 2);
  }
  out.values = {a.row[0].x, a.row[1].y, a.row[2].z};
  // Rounding adds up over some rotations: square the frame up again.
  out.axes.row[0] = normalized(out.axes.row[0]);
  out.axes.row[1] = normalized(out.axes.row[1] - out.axes.row[0] * dot(out.axes.row[0], out.axes.row[1]));
  out.axes.row[2] = cross(out.axes.row[0], out.axes.row[1]);
  return out;
}

}  // namespace brickfall
