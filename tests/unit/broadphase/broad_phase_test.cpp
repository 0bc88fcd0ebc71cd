// Every broad phase against brute force: random adds, moves and removals, walls in sorted order, infinite bounds; and that
// the tree keeps its shape.
#include "broadphase/broad_phase.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "broadphase/tree.h"
#include "math/random.h"

namespace brickfall {
namespace {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
const auto kAll = [](std::uint32_t, std::uint32_t) { return true; };

Aabb randomBox(Random& random, double world, double size) {
  Vec3 c{random.between(-world, world), random.between(-world, world), random.between(-world, world)};
  Vec3 h{random.between(0.1, 1) * size, random.between(0.1, 1) * size, random.between(0.1, 1) * size};
  return {c - h, c + h};
}

// What a broad phase should know, kept in the simplest way.
struct Model {
  std::unique_ptr<BroadPhase> tree;
  std::map<std::uint32_t, ProxyIndex> proxies;
  std::set<std::uint32_t> moved;

  Pairs expectedPairs() const {
    Pairs out;
    for (auto a = proxies.begin(); a != proxies.end(); ++a)
      for (auto b = std::next(a); b != proxies.end(); ++b)
        if ((moved.count(a->first) || moved.count(b->first)) && overlaps(tree->kept(a->second), tree->kept(b->second)))
          out.emplace_back(a->first, b->first);
    return out;
  }
};

int allowedHeight(int count) { return int(1.45 * std::log2(count + 2.0)) + 1; }

class EveryBroadPhase : public testing::TestWithParam<BroadPhaseMethod> {
 protected:
  std::unique_ptr<BroadPhase> made() const { return makeBroadPhase(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(All, EveryBroadPhase,
                         testing::Values(BroadPhaseMethod::tree, BroadPhaseMethod::sweepAndPrune,
                                         BroadPhaseMethod::boundingSpheres, BroadPhaseMethod::allPairs),
                         [](const auto& kind) { return std::string(broadPhaseName(kind.param)); });

TEST_P(EveryBroadPhase, RandomLifeAgreesWithBruteForce) {
  Random random(7);
  Model model;
  model.tree = made();
  std::uint32_t next = 0;
  size_t pairsSeen = 0;
  for (int round = 0; round < 300; round++) {
    for (int action = 0; action < 12; action++) {
      double dice = random.unit();
      if (model.proxies.empty() || dice < 0.4) {
        // Names grow while slots are reused, so the two differ.
        model.proxies[next] = model.tree->add(randomBox(random, 6, 0.8), 0.05, next);
        model.moved.insert(next++);
        continue;
      }
      auto it = std::next(model.proxies.begin(), random.below(std::uint32_t(model.proxies.size())));
      if (dice < 0.7) {
        Vec3 by{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
        by *= random.unit() < 0.5 ? 0.04 : 2.0;
        Aabb kept = model.tree->kept(it->second);
        Aabb tight = grown({kept.lower + by, kept.upper + by}, -0.05);
        bool inside = contains(kept, tight);
        bool reinserted = model.tree->update(it->second, tight, 0.05);
        EXPECT_EQ(reinserted, !inside);
        if (reinserted) model.moved.insert(it->first);
      } else {
        model.tree->remove(it->second);
        model.moved.erase(it->first);
        model.proxies.erase(it);
      }
    }
    ASSERT_EQ(model.tree->validate(), std::vector<std::string>{});
    ASSERT_EQ(model.tree->count(), int(model.proxies.size()));
    if (GetParam() == BroadPhaseMethod::tree) {
      EXPECT_LE(static_cast<BoxTree&>(*model.tree).height(), allowedHeight(model.tree->count()));
    }
    Pairs found;
    model.tree->newPairs(kAll, found);
    ASSERT_EQ(found, model.expectedPairs());
    pairsSeen += found.size();
    model.moved.clear();
    model.tree->newPairs(kAll, found);
    EXPECT_TRUE(found.empty());

    Aabb where = randomBox(random, 6, 2);
    std::set<std::uint32_t> visited, expected;
    model.tree->query(where, [&](std::uint32_t user) { return visited.insert(user).second; });
    for (auto [user, proxy] : model.proxies)
      if (overlaps(model.tree->kept(proxy), where)) expected.insert(user);
    EXPECT_EQ(visited, expected);
  }
  EXPECT_GT(pairsSeen, 300u);
}

// Most boxes move at once, some go, an endless one among them: the tree is built anew.
TEST_P(EveryBroadPhase, AllMoveAtOnce) {
  Random random(11);
  Model model;
  model.tree = made();
  model.proxies[0] = model.tree->add({{-1e30, -1e30, -1e30}, {1e30, -5, 1e30}}, 0.05, 0);
  for (std::uint32_t i = 1; i < 300; i++) model.proxies[i] = model.tree->add(randomBox(random, 6, 0.6), 0.05, i);
  for (const auto& [user, proxy] : model.proxies) model.moved.insert(user);
  std::size_t pairsSeen = 0;
  for (int round = 0; round < 12; round++) {
    Pairs found;
    model.tree->newPairs(kAll, found);
    ASSERT_EQ(found, model.expectedPairs());
    ASSERT_EQ(model.tree->validate(), std::vector<std::string>{});
    if (GetParam() == BroadPhaseMethod::tree) {
      EXPECT_LE(static_cast<BoxTree&>(*model.tree).height(), allowedHeight(model.tree->count()));
    }
    pairsSeen += found.size();
    model.moved.clear();
    for (const auto& [user, proxy] : model.proxies)
      if (user > 0 && model.tree->update(proxy, randomBox(random, 6, 0.6), 0.05)) model.moved.insert(user);
    EXPECT_GT(2 * model.moved.size(), model.proxies.size());
    auto gone = std::next(model.proxies.begin(), 1 + round);
    model.tree->remove(gone->second);
    model.moved.erase(gone->first);
    model.proxies.erase(gone);
  }
  EXPECT_GT(pairsSeen, 1000u);
}

// Told at once or one by one, few or most of them, with what goes and comes between: the same pairs and bounds kept, and in a
// tree the same answers in the same order.
TEST_P(EveryBroadPhase, ManyUpdatesAtOnceAreAsOneByOne) {
  Random random(5);
  std::unique_ptr<BroadPhase> single = made(), many = made();
  std::vector<ProxyIndex> proxies;
  std::vector<Aabb> tight;
  for (std::uint32_t i = 0; i < 200; i++) {
    tight.push_back(randomBox(random, 5, 0.5));
    proxies.push_back(single->add(tight[i], 0.05, i));
    ASSERT_EQ(many->add(tight[i], 0.05, i), proxies[i]);
  }
  auto asked = [](const BroadPhase& phase, const Aabb& where) {
    std::vector<std::uint32_t> out;
    phase.query(where, [&](std::uint32_t user) {
      out.push_back(user);
      return true;
    });
    return out;
  };
  int halfMoved = 0;
  std::size_t pairsSeen = 0;
  for (int round = 0; round < 60; round++) {
    const double share = round % 3 == 0 ? 0.9 : round % 3 == 1 ? 0.5 : 0.05;
    std::vector<BoundsUpdate> updates;
    int moved = 0;
    for (std::size_t i = 0; i < proxies.size(); i++) {
      if (random.unit() > share) continue;
      tight[i] = randomBox(random, 5, 0.5);
      updates.push_back({proxies[i], tight[i], 0.05});
      moved += single->update(proxies[i], tight[i], 0.05);
    }
    many->updateAll(updates);
    halfMoved += 2 * moved > int(proxies.size());
    if (round % 4 == 0)  // between the update and the search
      for (BroadPhase* phase : {single.get(), many.get()}) {
        phase->remove(proxies[std::size_t(round)]);
        ASSERT_EQ(phase->add(tight[std::size_t(round)], 0.05, std::uint32_t(round)), proxies[std::size_t(round)]);
      }
    Pairs expected, found;
    single->newPairs(kAll, expected);
    many->newPairs(kAll, found);
    ASSERT_EQ(found, expected) << round;
    pairsSeen += found.size();
    ASSERT_EQ(many->validate(), std::vector<std::string>{});
    Aabb where = randomBox(random, 5, 2);
    ASSERT_EQ(asked(*many, where), asked(*single, where)) << round;
    for (ProxyIndex proxy : proxies)
      ASSERT_TRUE(many->kept(proxy).lower == single->kept(proxy).lower &&
                  many->kept(proxy).upper == single->kept(proxy).upper);
  }
  EXPECT_GT(halfMoved, 15);
  EXPECT_LT(halfMoved, 45);
  EXPECT_GT(pairsSeen, 1000u);
}

TEST_P(EveryBroadPhase, StopsAQueryWhenAsked) {
  std::unique_ptr<BroadPhase> tree = made();
  for (std::uint32_t i = 0; i < 20; i++) tree->add({{0, 0, 0}, {1, 1, 1}}, 0, i);
  int calls = 0;
  tree->query({{0, 0, 0}, {1, 1, 1}}, [&](std::uint32_t) { return ++calls < 3; });
  EXPECT_EQ(calls, 3);
}

TEST(BoxTree, WallInSortedOrderStaysBalancedAndTight) {
  BoxTree tree;
  tree.add({{-1e30, -1e30, -1e30}, {1e30, 0, 1e30}}, 0.01, 0);  // the ground
  std::uint32_t user = 1;
  for (int course = 0; course < 40; course++)
    for (int i = 0; i < 25; i++, user++) {
      double x = 0.215 * i + (course % 2 ? 0.1075 : 0);
      tree.add({{x, 0.065 * course, 0}, {x + 0.215, 0.065 * (course + 1), 0.1}}, 0.002, user);
    }
  EXPECT_EQ(tree.validate(), std::vector<std::string>{});
  EXPECT_LE(tree.height(), allowedHeight(tree.count()));
  Pairs found;
  tree.newPairs(kAll, found);
  // Per brick: head joint, two or three bricks above (fewer at the ends), and the bottom course on the ground.
  EXPECT_GT(found.size(), 2800u);
  EXPECT_LT(found.size(), 4200u);
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
  EXPECT_EQ(std::adjacent_find(found.begin(), found.end()), found.end());
}

// A plane's bounds, boxes that only touch, and boxes far from the origin: where rounding could lose a pair.
TEST_P(EveryBroadPhase, LosesNoPairAtTheEdges) {
  for (Vec3 far : {Vec3{}, Vec3{1e6, -1e5, 1e7}}) {
    std::unique_ptr<BroadPhase> phase = made();
    phase->add({{-1e30, -1e30, -1e30}, {1e30, 1e30, 1e30}}, 0.01, 0);
    std::uint32_t user = 1;
    for (double x : {0.0, 1.0, 2.0})
      for (double y : {0.0, 1.0}) phase->add({far + Vec3{x, y, 0}, far + Vec3{x + 1, y + 1, 1e-3}}, 0, user++);
    Pairs found, expected;
    phase->newPairs(kAll, found);
    for (std::uint32_t i = 1; i < user; i++) expected.emplace_back(0, i);
    for (std::uint32_t i = 1; i < user; i++)
      for (std::uint32_t j = i + 1; j < user && j <= i + 3; j++)
        if ((j - 1) / 2 - (i - 1) / 2 <= 1) expected.emplace_back(i, j);
    std::sort(expected.begin(), expected.end());
    EXPECT_EQ(found, expected);
  }
}

TEST_P(EveryBroadPhase, FilterIsAsked) {
  std::unique_ptr<BroadPhase> tree = made();
  for (std::uint32_t i = 0; i < 4; i++) tree->add({{0, 0, 0}, {1, 1, 1}}, 0, i);
  Pairs found;
  tree->newPairs([](std::uint32_t a, std::uint32_t b) { return a == 0 && b == 3; }, found);
  EXPECT_EQ(found, (Pairs{{0, 3}}));
}

TEST_P(EveryBroadPhase, ReinsertsWhatShrankAlot) {
  std::unique_ptr<BroadPhase> tree = made();
  ProxyIndex p = tree->add({{-5, -5, -5}, {5, 5, 5}}, 0.1, 0);
  EXPECT_FALSE(tree->update(p, {{-2, -2, -2}, {2, 2, 2}}, 0.1));
  EXPECT_TRUE(tree->update(p, {{-1, -1, -1}, {1, 1, 1}}, 0.1));
  EXPECT_EQ(tree->kept(p).upper.x, 1.1);
}

TEST_P(EveryBroadPhase, RayMeetsTheNearestFirstAndStops) {
  Random random(3);
  std::unique_ptr<BroadPhase> tree = made();
  std::vector<Aabb> boxes;
  for (std::uint32_t i = 0; i < 400; i++) {
    boxes.push_back(randomBox(random, 10, 1));
    tree->add(boxes.back(), 0, i);
  }
  auto entry = [&](const Aabb& box, Vec3 o, Vec3 d, double limit) {
    double enter = 0, leave = limit;
    for (int k = 0; k < 3; k++) {
      double lo = (box.lower[k] - o[k]) / d[k], hi = (box.upper[k] - o[k]) / d[k];
      enter = std::max(enter, std::min(lo, hi));
      leave = std::min(leave, std::max(lo, hi));
    }
    return enter <= leave ? enter : 1e300;
  };
  int hits = 0;
  long visits = 0;
  for (int i = 0; i < 500; i++) {
    Vec3 o{random.between(-12, 12), random.between(-12, 12), random.between(-12, 12)};
    Vec3 d = normalized(Vec3{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
    double expected = 30, found = 30;
    for (const Aabb& box : boxes) expected = std::min(expected, entry(box, o, d, 30));
    tree->queryRay(o, d, 30, [&](std::uint32_t user, double limit) {
      visits++;
      found = std::min(limit, entry(boxes[user], o, d, limit));
      return found;
    });
    EXPECT_DOUBLE_EQ(found, expected);
    hits += expected < 30;
  }
  EXPECT_GT(hits, 100);
  if (GetParam() == BroadPhaseMethod::tree) {
    EXPECT_LT(visits, 500 * 12);  // of 400 boxes each
  }
  // Along an axis the other two directions are zero.
  std::unique_ptr<BroadPhase> one = made();
  one->add({{1, -1, -1}, {2, 1, 1}}, 0, 5);
  int met = 0;
  auto count = [&](std::uint32_t, double limit) { return met++, limit; };
  one->queryRay({0, 0.5, 0}, {1, 0, 0}, 10, count);
  EXPECT_EQ(met, 1);
  one->queryRay({0, 1.5, 0}, {1, 0, 0}, 10, count);
  EXPECT_EQ(met, 1);
  one->queryRay({0, 0.5, 0}, {1, 0, 0}, 0.5, count);
  EXPECT_EQ(met, 1);
}

}  // namespace
}  // namespace brickfall
