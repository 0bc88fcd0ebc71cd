// Two boxes of trees, four lanes at a time: a box's axes lie by component, so that the nine dot products of two boxes' axes
// and the three of the vector between their centres are three rows of four lanes.
//
// All here is single precision and errs towards "they meet" and "they are near": `slack` (m) covers rounding.
#pragma once
#include "brickfall/geometry/mesh_tree.h"
#include "math/wide.h"

namespace brickfall {

using wide::V;

inline V absolute(V v) { return V(wide::M(v) & wide::M{0x7fffffff, 0x7fffffff, 0x7fffffff, 0x7fffffff}); }
inline V onlyLast(V v) { return V(wide::M(v) & wide::M{0, 0, 0, -1}); }
inline V withoutLast(V v) { return V(wide::M(v) & wide::M{-1, -1, -1, 0}); }

// A box seen from the frame of the other tree's boxes.
struct PlacedBox {
  V x, y, z;  // lane k: axis k; lane 3: centre
  V half;     // lane 3: zero
};

// From one tree's box coordinates to the other's.
struct BoxPose {
  V m[3][3];  // rotation, each spread over all lanes
  V t[3];     // translation, in lane 3

  BoxPose(const Mat3& turn, Vec3 position) {
    for (int i = 0; i < 3; i++) {
      for (int j = 0; j < 3; j++) m[i][j] = wide::set(float(turn.row[i][j]));
      t[i] = V{0, 0, 0, float(position[i])};
    }
  }
  PlacedBox operator()(const MeshTree::Node& node) const {
    V x = wide::load(node.x), y = wide::load(node.y), z = wide::load(node.z);
    return {m[0][0] * x + m[0][1] * y + m[0][2] * z + t[0], m[1][0] * x + m[1][1] * y + m[1][2] * z + t[1],
            m[2][0] * x + m[2][1] * y + m[2][2] * z + t[2], withoutLast(wide::load(node.half))};
  }
};

inline PlacedBox unmoved(const MeshTree::Node& node) {
  return {wide::load(node.x), wide::load(node.y), wide::load(node.z), withoutLast(wide::load(node.half))};
}

// c[i] lane j < 3: axis i of a on axis j of b; lane 3: axis i of a on the vector from a's centre to b's.
// reach of both along the three axes of each.
class BoxPair {
 public:
  BoxPair(const MeshTree::Node& a, const PlacedBox& b) : halfA_(withoutLast(wide::load(a.half))), halfB_(b.half) {
    V ax = wide::load(a.x), ay = wide::load(a.y), az = wide::load(a.z);
    V bx = b.x - onlyLast(ax), by = b.y - onlyLast(ay), bz = b.z - onlyLast(az);
    c_[0] = wide::spread<0>(ax) * bx + wide::spread<0>(ay) * by + wide::spread<0>(az) * bz;
    c_[1] = wide::spread<1>(ax) * bx + wide::spread<1>(ay) * by + wide::spread<1>(az) * bz;
    c_[2] = wide::spread<2>(ax) * bx + wide::spread<2>(ay) * by + wide::spread<2>(az) * bz;
    for (int i = 0; i < 3; i++) size_[i] = absolute(c_[i]) + wide::set(kParallel);
  }

  // How far apart the boxes are along the axes of a (lanes 0 .. 2), at least; negative: they overlap along it.
  V gapAlongA() const {
    V lo01 = __builtin_shufflevector(c_[0], c_[1], 0, 4, 1, 5),
      hi01 = __builtin_shufflevector(c_[0], c_[1], 2, 6, 3, 7);
    V t0 = __builtin_shufflevector(lo01, c_[2], 0, 1, 4, 4), t1 = __builtin_shufflevector(lo01, c_[2], 2, 3, 5, 5);
    V t2 = __builtin_shufflevector(hi01, c_[2], 0, 1, 6, 6), d = __builtin_shufflevector(hi01, c_[2], 2, 3, 7, 7);
    V reach = halfA_ + absolute(t0) * wide::spread<0>(halfB_) + absolute(t1) * wide::spread<1>(halfB_) +
              absolute(t2) * wide::spread<2>(halfB_);
    return absolute(d) - reach;
  }
  V gapAlongB() const {
    V d = c_[0] * wide::spread<3>(c_[0]) + c_[1] * wide::spread<3>(c_[1]) + c_[2] * wide::spread<3>(c_[2]);
    V reach = halfB_ + absolute(c_[0]) * wide::spread<0>(halfA_) + absolute(c_[1]) * wide::spread<1>(halfA_) +
              absolute(c_[2]) * wide::spread<2>(halfA_);
    return absolute(d) - reach;
  }

  // False only if one of the fifteen axes separates them by more than the slack.
  bool meet(float slack) const {
    V limit = wide::set(slack);
    if (wide::bits(gapAlongA() > limit) & 7) return false;
    if (wide::bits(gapAlongB() > limit) & 7) return false;
    V nextB = __builtin_shufflevector(halfB_, halfB_, 1, 2, 0, 3),
      lastB = __builtin_shufflevector(halfB_, halfB_, 2, 0, 1, 3);
    return !(crossed<0, 1, 2>(nextB, lastB, limit) || crossed<1, 2, 0>(nextB, lastB, limit) ||
             crossed<2, 0, 1>(nextB, lastB, limit));
  }

  // Square of a distance that is no larger than theirs (beyond slack).
  float nearestSquared() const {
    V zero = wide::set(0), a = wide::max(gapAlongA(), zero), b = wide::max(gapAlongB(), zero);
    a = a * a, b = b * b;
    float sumA = a[0] + a[1] + a[2], sumB = b[0] + b[1] + b[2];
    return sumA > sumB ? sumA : sumB;
  }

 private:
  static constexpr float kParallel = 1e-6f;

  // Axis i of a crossed with all axes of b.
  template <int i, int j, int k> bool crossed(V nextB, V lastB, V limit) const {
    V apart = absolute(c_[j] * wide::spread<3>(c_[k]) - c_[k] * wide::spread<3>(c_[j]));
    V next = __builtin_shufflevector(size_[i], size_[i], 1, 2, 0, 3),
      last = __builtin_shufflevector(size_[i], size_[i], 2, 0, 1, 3);
    V reach = wide::spread<j>(halfA_) * size_[k] + wide::spread<k>(halfA_) * size_[j] + nextB * last + lastB * next;
    return wide::bits(apart > reach + limit + limit) & 7;
  }

  V c_[3], size_[3], halfA_, halfB_;
};

}  // namespace brickfall
