// Two trees at once. Pairs of boxes that may hold something go on a stack; the larger box of a pair is opened first, since
// that makes the boxes small soonest. Its depth is bounded by the heights of both trees.
#include <algorithm>

#include "brickfall/geometry/mesh_tree.h"
#include "mesh/box_pair.h"

namespace brickfall {

namespace {

constexpr int kStack =
    640;  // heights are below 130 each (build_tree.cpp), and a distance search keeps two entries a level
constexpr double kSlack = 2e-6;  // of the size of both trees and their distance: rounding of a box pair

struct NodePair {
  std::int32_t a, b;
  float bound = 0;
};

float sizeOf(const MeshTree::Node& n) { return n.half[0] + n.half[1] + n.half[2]; }

// What both traversals keep: the trees, the pose between their boxes, and the last box and triangle of b that were placed.
class PairWalk {
 public:
  PairWalk(const MeshTree& a, const MeshTree& b, const Transform& bInA, MeshQueryCost* cost)
      : a_(a),
        b_(b),
        turn_(toMatrix(bInA.rotation)),
        position_(bInA.position),
        between_(turn_ * b.middle() + bInA.position - a.middle()),
        pose_(turn_, between_),
        cost_(cost) {
    slack_ = float(kSlack * (a.radius() + b.radius() + length(between_)));
  }

  bool apart() const { return length(between_) > (a_.radius() + b_.radius()) * (1 + 1e-9) + 1e-300; }
  float slack() const { return slack_; }
  const MeshTree::Node& nodeA(std::int32_t i) const { return a_.nodes()[std::size_t(i)]; }
  const MeshTree::Node& nodeB(std::int32_t i) const { return b_.nodes()[std::size_t(i)]; }
  // Which box of the pair to open; both leaves: neither.
  bool bothLeaves(NodePair p) const { return nodeA(p.a).child < 0 && nodeB(p.b).child < 0; }
  bool openA(NodePair p) const {
    const MeshTree::Node &na = nodeA(p.a), &nb = nodeB(p.b);
    return nb.child < 0 || (na.child >= 0 && sizeOf(na) > sizeOf(nb));
  }
  BoxPair pair(std::int32_t a, std::int32_t b) {
    if (b != placedBox_) box_ = pose_(nodeB(b)), placedBox_ = b;
    if (cost_) cost_->boxTests++;
    return BoxPair(nodeA(a), box_);
  }
  const Triangle& triangleA(NodePair p) const { return a_.leafTriangles()[std::size_t(~nodeA(p.a).child)]; }
  const Triangle& triangleB(NodePair p) {
    std::int32_t leaf = ~nodeB(p.b).child;
    if (leaf != placedLeaf_) {
      const Triangle& t = b_.leafTriangles()[std::size_t(leaf)];
      for (int k = 0; k < 3; k++) triangle_.corner[k] = turn_ * t.corner[k] + position_;
      placedLeaf_ = leaf;
    }
    if (cost_) cost_->triangleTests++;
    return triangle_;
  }
  FacePair faces(NodePair p) const {
    return {a_.leafFaces()[std::size_t(~nodeA(p.a).child)], b_.leafFaces()[std::size_t(~nodeB(p.b).child)]};
  }

 private:
  const MeshTree& a_;
  const MeshTree& b_;
  Mat3 turn_;
  Vec3 position_, between_;
  BoxPose pose_;
  float slack_ = 0;
  PlacedBox box_{};
  Triangle triangle_;
  std::int32_t placedBox_ = -1, placedLeaf_ = -1;
  MeshQueryCost* cost_;
};

// Calls found(faces) for each pair of faces that meet, until it returns false.
template <class Found> void forEachOverlap(PairWalk& walk, Found found) {
  if (walk.apart() || !walk.pair(0, 0).meet(walk.slack())) return;
  NodePair stack[kStack];
  int count = 0;
  stack[count++] = {0, 0};
  while (count > 0) {
    NodePair p = stack[--count];
    if (walk.bothLeaves(p)) {
      if (trianglesOverlap(walk.triangleA(p), walk.triangleB(p)) && !found(walk.faces(p))) return;
      continue;
    }
    bool openA = walk.openA(p);
    std::int32_t child = openA ? walk.nodeA(p.a).child : walk.nodeB(p.b).child;
    for (std::int32_t c = child + 1; c >= child; c--) {
      NodePair next = openA ? NodePair{c, p.b} : NodePair{p.a, c};
      if (walk.pair(next.a, next.b).meet(walk.slack())) stack[count++] = next;
    }
  }
}

}  // namespace

std::vector<FacePair> overlappingFaces(const MeshTree& a, const MeshTree& b, const Transform& bInA,
                                       MeshQueryCost* cost) {
  std::vector<FacePair> out;
  PairWalk walk(a, b, bInA, cost);
  forEachOverlap(walk, [&](FacePair pair) {
    out.push_back(pair);
    return true;
  });
  std::sort(out.begin(), out.end());
  return out;
}

std::optional<FacePair> firstOverlap(const MeshTree& a, const MeshTree& b, const Transform& bInA, MeshQueryCost* cost) {
  std::optional<FacePair> out;
  PairWalk walk(a, b, bInA, cost);
  forEachOverlap(walk, [&](FacePair pair) {
    out = pair;
    return false;
  });
  return out;
}

// Depth first, the nearer box first; what is not nearer than the best found so far is passed over.
MeshDistance meshDistance(const MeshTree& a, const MeshTree& b, const Transform& bInA, MeshQueryCost* cost) {
  PairWalk walk(a, b, bInA, cost);
  MeshDistance best;
  best.distance = 1e300;
  float limit = 1e38f;  // square of a distance beyond which a box can't hold anything nearer
  NodePair stack[kStack];
  int count = 0;
  stack[count++] = {0, 0, 0};
  while (count > 0) {
    NodePair p = stack[--count];
    if (p.bound > limit) continue;
    if (walk.bothLeaves(p)) {
      TriangleDistance d = triangleDistance(walk.triangleA(p), walk.triangleB(p));
      if (!(d.distance < best.distance)) continue;
      best = {d.distance, d.onA, d.onB, walk.faces(p)};
      if (d.distance == 0) break;
      float reach = float(d.distance) * (1 + 1e-6f) + walk.slack();
      limit = reach * reach * (1 + 1e-6f);
      continue;
    }
    bool openA = walk.openA(p);
    std::int32_t child = openA ? walk.nodeA(p.a).child : walk.nodeB(p.b).child;
    NodePair next[2];
    for (int k = 0; k < 2; k++) {
      next[k] = openA ? NodePair{child + k, p.b} : NodePair{p.a, child + k};
      next[k].bound = walk.pair(next[k].a, next[k].b).nearestSquared();
    }
    bool firstNearer = next[0].bound <= next[1].bound;
    if (next[firstNearer].bound <= limit) stack[count++] = next[firstNearer];
    if (next[!firstNearer].bound <= limit) stack[count++] = next[!firstNearer];
  }
  return best;
}

}  // namespace brickfall
