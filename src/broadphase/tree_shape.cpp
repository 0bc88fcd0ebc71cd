// The tree of the broad phase: where a leaf goes, and how the tree keeps its shape.
//
// A leaf is put where it adds least surface (the surface-area heuristic, as a descent to the cheaper child). Two
// things then happen on the way back to the root. Balance is a promise: as in an AVL tree, the heights of two
// siblings differ by one at most, so a query needs a stack of known size and no order of insertion (bricks come
// sorted) can make it slow. Boxes have no order among themselves, so one kind of rotation is enough for everything:
// swap a child with a nephew. Surface is a wish: a swap that shrinks a box is made if it leaves the height as it is.
//
// Leaves that come in random order from all over a large space make balance and surface pull against each other: branches
// end up overlapping. So when many leaves are new or have moved, the whole tree is built anew from above.
#include <algorithm>

#include "base/assert.h"
#include "broadphase/tree.h"

namespace brickfall {
namespace {

constexpr double kFar = 1e8;  // m: beyond lie only the middles of endless bounds

double halfSurface(const Aabb& box) {
  Vec3 d = box.upper - box.lower;
  return d.x * d.y + d.y * d.z + d.z * d.x;
}

}  // namespace

ProxyIndex BoxTree::allocateNode() {
  ProxyIndex index = free_;
  if (index == kNoProxy) {
    index = ProxyIndex(nodes_.size());
    nodes_.emplace_back();
  } else {
    free_ = nodes_[index].parent;
    nodes_[index] = Node{};
  }
  return index;
}

void BoxTree::freeNode(ProxyIndex index) {
  nodes_[index] = Node{};
  nodes_[index].height = -1;
  nodes_[index].parent = free_;
  free_ = index;
}

// Descends to the cheaper child: the cost of a place is the surface of the new parent there plus what every ancestor
// grows by. Goes down to a leaf or the parent of two (a leaf beside anything higher would break the balance), so a
// big box can end up deep in the tree: that costs every query of its ancestors a look, some log n of them.
ProxyIndex BoxTree::findSibling(const Aabb& box) const {
  ProxyIndex index = root_;
  while (nodes_[index].height > 0) {
    const Node& node = nodes_[index];
    double together = halfSurface(merged(node.box, box));
    double inherited = together - halfSurface(node.box);
    double cost[2];
    for (int k = 0; k < 2; k++) {
      const Node& child = nodes_[node.child[k]];
      cost[k] = halfSurface(merged(child.box, box)) + inherited;
      if (child.height > 0) cost[k] -= halfSurface(child.box);
    }
    if (node.height == 1 && together < cost[0] && together < cost[1]) break;
    index = node.child[cost[1] < cost[0] ? 1 : 0];
  }
  return index;
}

void BoxTree::insertLeaf(ProxyIndex leaf) {
  if (root_ == kNoProxy) {
    root_ = leaf;
    nodes_[leaf].parent = kNoProxy;
    return;
  }
  ProxyIndex sibling = findSibling(nodes_[leaf].box);
  ProxyIndex parent = allocateNode();
  ProxyIndex above = nodes_[sibling].parent;
  nodes_[parent].parent = above;
  nodes_[parent].child[0] = sibling;
  nodes_[parent].child[1] = leaf;
  nodes_[sibling].parent = parent;
  nodes_[leaf].parent = parent;
  if (above == kNoProxy)
    root_ = parent;
  else
    nodes_[above].child[nodes_[above].child[0] == sibling ? 0 : 1] = parent;
  refitUpwards(parent);
}

void BoxTree::removeLeaf(ProxyIndex leaf) {
  ProxyIndex parent = nodes_[leaf].parent;
  nodes_[leaf].parent = kNoProxy;
  if (parent == kNoProxy) {
    root_ = kNoProxy;
    return;
  }
  ProxyIndex sibling = nodes_[parent].child[nodes_[parent].child[0] == leaf ? 1 : 0];
  ProxyIndex above = nodes_[parent].parent;
  nodes_[sibling].parent = above;
  if (above == kNoProxy)
    root_ = sibling;
  else
    nodes_[above].child[nodes_[above].child[0] == parent ? 0 : 1] = sibling;
  freeNode(parent);
  refitUpwards(above);
}

void BoxTree::refitUpwards(ProxyIndex index) {
  for (; index != kNoProxy; index = nodes_[index].parent) {
    restoreBalance(index);
    refit(index);
    improve(index);
  }
}

void BoxTree::refit(ProxyIndex index) {
  Node& node = nodes_[index];
  const Node& first = nodes_[node.child[0]];
  const Node& second = nodes_[node.child[1]];
  node.box = merged(first.box, second.box);
  node.height = 1 + (first.height > second.height ? first.height : second.height);
}

// Child `side` of `index` and child `nephew` of the other child change places.
void BoxTree::swapWithNephew(ProxyIndex index, int side, int nephew) {
  ProxyIndex child = nodes_[index].child[side], other = nodes_[index].child[1 - side];
  ProxyIndex raised = nodes_[other].child[nephew];
  nodes_[index].child[side] = raised;
  nodes_[raised].parent = index;
  nodes_[other].child[nephew] = child;
  nodes_[child].parent = other;
  refit(other);
}

// One insertion or removal changes a height by one at most, so the children differ by two at most: raising the taller
// nephew (of two equal ones, the one that leaves the smaller box) makes them differ by at most one again.
void BoxTree::restoreBalance(ProxyIndex index) {
  const Node& node = nodes_[index];
  int difference = nodes_[node.child[1]].height - nodes_[node.child[0]].height;
  BRICKFALL_ASSERT(difference >= -2 && difference <= 2, "one change unbalances by two levels at most");
  if (difference >= -1 && difference <= 1) return;
  int low = difference > 0 ? 0 : 1;
  const Node& tall = nodes_[node.child[1 - low]];
  const Node& n0 = nodes_[tall.child[0]];
  const Node& n1 = nodes_[tall.child[1]];
  int nephew = n0.height > n1.height ? 0 : 1;
  if (n0.height == n1.height) {
    const Aabb& sinking = nodes_[node.child[low]].box;
    nephew = halfSurface(merged(sinking, n1.box)) <= halfSurface(merged(sinking, n0.box)) ? 0 : 1;
  }
  swapWithNephew(index, low, nephew);
}

void BoxTree::improve(ProxyIndex index) {
  const Node& node = nodes_[index];
  if (node.height < 2) return;
  double bestGain = 0;
  int bestSide = -1, bestNephew = 0;
  for (int side = 0; side < 2; side++) {
    const Node& child = nodes_[node.child[side]];
    const Node& other = nodes_[node.child[1 - side]];
    if (other.height == 0) continue;
    double surface = halfSurface(other.box);
    for (int nephew = 0; nephew < 2; nephew++) {
      const Node& raised = nodes_[other.child[nephew]];
      const Node& stays = nodes_[other.child[1 - nephew]];
      int difference = child.height - stays.height;
      if (difference < -1 || difference > 1) continue;
      int otherHeight = 1 + (child.height > stays.height ? child.height : stays.height);
      difference = otherHeight - raised.height;
      if (difference < -1 || difference > 1) continue;
      if (1 + (otherHeight > raised.height ? otherHeight : raised.height) != node.height) continue;
      double gain = surface - halfSurface(merged(child.box, stays.box));
      if (gain > bestGain) {
        bestGain = gain;
        bestSide = side;
        bestNephew = nephew;
      }
    }
  }
  if (bestSide >= 0) swapWithNephew(index, bestSide, bestNephew);
}

void BoxTree::rebuild() {
  leaves_.clear();
  for (ProxyIndex i = 0; i < ProxyIndex(nodes_.size()); i++) {
    if (nodes_[i].height == 0) {
      Vec3 middle2 = nodes_[i].box.lower + nodes_[i].box.upper;
      leaves_.push_back({middle2, i, !(length(middle2 * 0.5) < kFar)});
    }
    if (nodes_[i].height > 0) freeNode(i);
  }
  rebuilt_ = true;
  root_ = leaves_.empty() ? kNoProxy : build(0, leaves_.size());
  if (root_ != kNoProxy) nodes_[root_].parent = kNoProxy;
}

// Of some leaves: halved by number, so that it is in balance, along the axis on which their middles lie furthest apart.
ProxyIndex BoxTree::build(std::size_t from, std::size_t to) {
  if (to - from == 1) return leaves_[from].index;
  Vec3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (std::size_t i = from; i < to; i++) {
    if (leaves_[i].endless) continue;
    Vec3 middle = leaves_[i].middle2 * 0.5;
    low = min(low, middle);
    high = max(high, middle);
  }
  Vec3 spread = high - low;
  int axis = spread.y > spread.x ? 1 : 0;
  if (spread.z > spread[axis]) axis = 2;
  std::size_t half = from + (to - from) / 2;
  auto at = [&](std::size_t i) { return leaves_.begin() + std::ptrdiff_t(i); };
  std::nth_element(at(from), at(half), at(to), [axis](const BuildLeaf& a, const BuildLeaf& b) {
    double ofA = a.middle2[axis], ofB = b.middle2[axis];
    return ofA != ofB ? ofA < ofB : a.index < b.index;
  });
  ProxyIndex children[2] = {build(from, half), build(half, to)}, parent = allocateNode();
  for (int k = 0; k < 2; k++) {
    nodes_[parent].child[k] = children[k];
    nodes_[children[k]].parent = parent;
  }
  refit(parent);
  return parent;
}

}  // namespace brickfall
