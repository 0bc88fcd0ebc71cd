// All joints of a world, by slot; a slot that is free is used again, with the next generation.
#pragma once
#include <algorithm>
#include <utility>
#include <vector>

#include "dynamics/joint.h"
#include "dynamics/link.h"

namespace brickfall {

class JointSet {
 public:
  JointIndex create(const Joint& joint);
  void destroy(JointIndex joint);
  bool has(JointIndex joint) const { return joint < joints.size() && joints[joint].alive; }
  bool any() const { return !awake_.empty() || !asleep_.empty(); }
  std::vector<JointIndex> inOrder() const;  // of creation

  // --- functions of every kind of tie (link.h)
  static constexpr LinkKind kLink = LinkKind::joint;
  template <class Visit> void eachAwake(Visit&& visit) const { eachLink(awake_, visit); }
  template <class Visit> void eachAsleep(Visit&& visit) const { eachLink(asleep_, visit); }
  bool anyAsleep() const { return !asleep_.empty(); }
  template <class Leaves> void sleepWhere(Leaves leaves) { move(awake_, asleep_, leaves); }
  template <class Wakes> void wakeWhere(Wakes wakes) { move(asleep_, awake_, wakes); }
  void dropOf(BodyIndex body);
  void displace(BodyIndex) {}  // a joint pulls its bodies together again, wherever they are put
  bool mayCollide(BodyIndex a, BodyIndex b) const {
    return apart_.empty() || !std::binary_search(apart_.begin(), apart_.end(), pairOf(a, b));
  }
  void renewConstants(BodyIndex body, const ShapeSet& shapes, const BodySet& bodies);
  void beginStep();
  void keepRoom(std::size_t) {}  // joints come between steps only
  void hash(Mix& h, JointIndex joint) const;
  void archive(WriteArchive& a) const;
  void archive(ReadArchive& a);
  void checkStructure(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const;
  void checkRanges(Findings& f) const;
  void check(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const;

  std::vector<Joint> joints;  // by JointIndex
  bool changed = false;       // joints came or went since the islands were built
  bool touchingChanged = false;

 private:
  using Pair = std::pair<BodyIndex, BodyIndex>;
  static Pair pairOf(BodyIndex a, BodyIndex b) { return {std::min(a, b), std::max(a, b)}; }
  template <class Archive, class Set> static void archiveAll(Archive& a, Set& set);
  template <class Visit> void eachLink(const std::vector<JointIndex>& list, Visit& visit) const {
    for (JointIndex joint : list)
      if (const Joint& j = joints[joint]; !j.idle) visit(Link{j.bodyA, j.bodyB, kLink, joint});
  }
  template <class Condition> void move(std::vector<JointIndex>& from, std::vector<JointIndex>& to, Condition leaves) {
    const std::size_t before = to.size();
    std::erase_if(from, [&](JointIndex joint) {
      const bool goes = leaves(joints[joint].bodyA, joints[joint].bodyB);
      if (goes) to.push_back(joint);
      return goes;
    });
    if (to.size() > before) std::sort(to.begin(), to.end());
  }
  void findApart();

  std::vector<JointIndex> awake_, asleep_;  // ascending
  std::vector<Pair> apart_;                 // bodies that may not collide, the lower first, sorted: by joint
  std::vector<JointIndex> free_;
  std::uint64_t nextOrder_ = 1;
};

}  // namespace brickfall
