// Proxies, pairs and queries; what the tree looks like is in tree_shape.cpp.
#include "broadphase/tree.h"

#include <algorithm>

#include "base/ascending.h"
#include "base/assert.h"

namespace brickfall {
namespace {

// A balanced tree of 2^31 leaves is 45 levels high, and a depth-first walk keeps one node a level.
constexpr int kStackSize = 64;
constexpr int kLeastRebuilt = 64;  // leaves: smaller trees are fine as they grew
// 1 / share of the leaves that have moved, beyond which the tree is built anew: to take a leaf out and in again costs about four
// times its part of that.
constexpr std::size_t kRebuildShare = 4;

}  // namespace

void BoxTree::markMoved(ProxyIndex leaf) {
  if (nodes_[leaf].moved) return;
  nodes_[leaf].moved = true;
  moved_.push_back(leaf);
}

ProxyIndex BoxTree::add(const Aabb& tight, double grow, std::uint32_t user) {
  ProxyIndex leaf = allocateNode();
  nodes_[leaf].box = grown(tight, grow);
  nodes_[leaf].user = user;
  rebuilt_ = false;
  insertLeaf(leaf);
  markMoved(leaf);
  count_++;
  auto keepRoom = [&](auto& list) {  // all may move in one step
    if (list.capacity() < std::size_t(count_)) list.reserve(nodes_.capacity());
  };
  keepRoom(moved_);
  keepRoom(leaves_);
  keepRoom(leaving_);
  return leaf;
}

void BoxTree::remove(ProxyIndex proxy) {
  BRICKFALL_ASSERT(proxy >= 0 && proxy < ProxyIndex(nodes_.size()) && nodes_[proxy].height == 0, "not a live proxy");
  rebuilt_ = false;
  removeLeaf(proxy);
  freeNode(proxy);
  count_--;
}

bool BoxTree::update(ProxyIndex proxy, const Aabb& tight, double grow) {
  BRICKFALL_ASSERT(proxy >= 0 && proxy < ProxyIndex(nodes_.size()) && nodes_[proxy].height == 0, "not a live proxy");
  Aabb fresh = grown(tight, grow);
  if (!mustMove(nodes_[proxy].box, tight, fresh)) return false;
  placeAgain(proxy, fresh);
  markMoved(proxy);
  return true;
}

void BoxTree::placeAgain(ProxyIndex leaf, const Aabb& box) {
  rebuilt_ = false;
  removeLeaf(leaf);
  nodes_[leaf].box = box;
  insertLeaf(leaf);
}

// Where so many move that newPairs() is to build the whole tree, no leaf is taken to a place of its own first: that costs more
// than all else of a step in which everything falls.
void BoxTree::updateAll(std::span<const BoundsUpdate> updates) {
  leaving_.clear();
  for (const BoundsUpdate& u : updates) {
    Aabb fresh = grown(u.tight, u.grow);
    if (!mustMove(nodes_[u.proxy].box, u.tight, fresh)) continue;
    leaving_.push_back({u.proxy, fresh});
    markMoved(u.proxy);
  }
  if (leaving_.empty()) return;
  if (!manyMoved()) {
    for (const auto& [leaf, box] : leaving_) placeAgain(leaf, box);
    return;
  }
  for (const auto& [leaf, box] : leaving_) nodes_[leaf].box = box;
  rebuild();
}

// So many that the tree is to be built anew. Also brings the list of what moved in order, each leaf once.
bool BoxTree::manyMoved() {
  makeAscending(moved_);
  return count_ >= kLeastRebuilt && kRebuildShare * moved_.size() > std::size_t(count_);
}

void BoxTree::newPairs(PairFilter wanted, Pairs& out) {
  out.clear();
  auto found = [&](const Node& first, const Node& second) {
    std::uint32_t a = std::min(first.user, second.user), b = std::max(first.user, second.user);
    if (wanted(a, b)) out.emplace_back(a, b);
  };
  if (manyMoved()) {
    if (!rebuilt_) rebuild();
    eachOverlap(found);
  } else {
    for (ProxyIndex leaf : moved_)
      if (nodes_[leaf].moved) eachOverlapOf(leaf, found);  // else it was removed since
  }
  for (ProxyIndex leaf : moved_) nodes_[leaf].moved = false;
  moved_.clear();
  std::sort(out.begin(), out.end());
}

template <class Found> void BoxTree::eachOverlapOf(ProxyIndex leaf, Found&& found) const {
  ProxyIndex stack[kStackSize];
  const Node& self = nodes_[leaf];
  int depth = 0;
  stack[depth++] = root_;
  while (depth > 0) {
    ProxyIndex index = stack[--depth];
    const Node& node = nodes_[index];
    if (!overlaps(node.box, self.box)) continue;
    if (node.height > 0) {
      stack[depth++] = node.child[0];
      stack[depth++] = node.child[1];
    } else if (index != leaf && !(node.moved && index < leaf)) {  // of two moved ones, the lower reports
      found(self, node);
    }
  }
}

// The tree against itself: branches that do not meet are parted once for all their leaves, a third of the time of asking for each
// leaf by itself.
template <class Found> void BoxTree::eachOverlap(Found&& found) const {
  // A branch against itself leaves two entries a level, two branches one for each level of either.
  std::pair<ProxyIndex, ProxyIndex> stack[4 * kStackSize];
  int depth = 0;
  stack[depth++] = {root_, root_};
  while (depth > 0) {
    auto [a, b] = stack[--depth];
    const Node &first = nodes_[a], &second = nodes_[b];
    if (a == b) {
      if (first.height == 0) continue;
      for (ProxyIndex child : first.child) stack[depth++] = {child, child};
      stack[depth++] = {first.child[0], first.child[1]};
    } else if (!overlaps(first.box, second.box)) {
      continue;
    } else if (first.height == 0 && second.height == 0) {
      if (first.moved || second.moved) found(first, second);
    } else if (first.height >= second.height) {
      for (ProxyIndex child : first.child) stack[depth++] = {child, b};
    } else {
      for (ProxyIndex child : second.child) stack[depth++] = {a, child};
    }
  }
}

void BoxTree::query(const Aabb& box, FunctionRef<bool(std::uint32_t)> visit) const {
  if (root_ == kNoProxy) return;
  ProxyIndex stack[kStackSize];
  int depth = 0;
  stack[depth++] = root_;
  while (depth > 0) {
    const Node& node = nodes_[stack[--depth]];
    if (!overlaps(node.box, box)) continue;
    if (node.height > 0) {
      stack[depth++] = node.child[0];
      stack[depth++] = node.child[1];
    } else if (!visit(node.user)) {
      return;
    }
  }
}

void BoxTree::queryRay(Vec3 origin, Vec3 direction, double maxDistance,
                       FunctionRef<double(std::uint32_t user, double limit)> visit) const {
  if (root_ == kNoProxy) return;
  struct Entry {
    ProxyIndex index;
    double distance;
  };
  Entry stack[kStackSize];
  int depth = 0;
  double limit = maxDistance;
  stack[depth++] = {root_, rayEntry(nodes_[root_].box, origin, direction, limit)};
  while (depth > 0) {
    Entry entry = stack[--depth];
    if (!(entry.distance <= limit)) continue;
    const Node& node = nodes_[entry.index];
    if (node.height == 0) {
      limit = std::min(limit, visit(node.user, limit));
      continue;
    }
    Entry first{node.child[0], rayEntry(nodes_[node.child[0]].box, origin, direction, limit)};
    Entry second{node.child[1], rayEntry(nodes_[node.child[1]].box, origin, direction, limit)};
    if (second.distance < first.distance) std::swap(first, second);  // the nearer is looked at first
    stack[depth++] = second;
    stack[depth++] = first;
  }
}

int BoxTree::height() const { return root_ == kNoProxy ? 0 : nodes_[root_].height; }

void BoxTree::validateNode(ProxyIndex index, std::vector<std::string>& faults, int& leaves, int& inner) const {
  const Node& node = nodes_[index];
  std::string name = "node " + std::to_string(index) + ": ";
  if (node.height == 0) {
    leaves++;
    if (node.child[0] != kNoProxy || node.child[1] != kNoProxy) faults.push_back(name + "a leaf has children");
    return;
  }
  inner++;
  if (inner > ProxyIndex(nodes_.size())) {
    faults.push_back(name + "the tree has a cycle");
    return;
  }
  for (ProxyIndex child : node.child) {
    if (child < 0 || child >= ProxyIndex(nodes_.size())) {
      faults.push_back(name + "a child is missing");
      return;
    }
    if (nodes_[child].parent != index) faults.push_back(name + "a child has another parent");
    if (!contains(node.box, nodes_[child].box)) faults.push_back(name + "a child sticks out");
  }
  const Node& first = nodes_[node.child[0]];
  const Node& second = nodes_[node.child[1]];
  if (node.height != 1 + std::max(first.height, second.height)) faults.push_back(name + "its height is wrong");
  if (std::abs(first.height - second.height) > 1) faults.push_back(name + "it is out of balance");
  Aabb both = merged(first.box, second.box);
  if (!(both.lower == node.box.lower && both.upper == node.box.upper)) faults.push_back(name + "its box is not tight");
  validateNode(node.child[0], faults, leaves, inner);
  validateNode(node.child[1], faults, leaves, inner);
}

std::vector<std::string> BoxTree::validate() const {
  std::vector<std::string> faults;
  int leaves = 0, inner = 0, unused = 0;
  if (root_ != kNoProxy) {
    if (nodes_[root_].parent != kNoProxy) faults.push_back("the root has a parent");
    validateNode(root_, faults, leaves, inner);
  }
  for (ProxyIndex i = free_; i != kNoProxy && unused <= int(nodes_.size()); i = nodes_[i].parent) {
    if (nodes_[i].height != -1) faults.push_back("node " + std::to_string(i) + ": in use and in the list of free ones");
    unused++;
  }
  if (leaves != count_)
    faults.push_back("found " + std::to_string(leaves) + " leaves, expected " + std::to_string(count_));
  if (leaves + inner + unused != int(nodes_.size())) faults.push_back("nodes are lost");
  return faults;
}

}  // namespace brickfall
