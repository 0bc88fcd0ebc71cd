// Rows: their numbers through all kinds, their ends, how strongly they tie; and islands and hierarchies made of them.
#include "solver/rows.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrick;
using test::kBrickWeight;
using test::TestIsland;

TEST(Rows, AreNumberedThroughAllKindsInTheOrderOfTheirPairs) {
  TestIsland lab;
  std::vector<BodyIndex> pile = lab.pile(lab.ground(), 5);
  Rows& rows = lab.island().rows;
  EXPECT_EQ(rows.size(), 5u);
  std::size_t sum = 0;
  for (std::size_t count : rows.counts()) sum += count;
  EXPECT_EQ(sum, rows.size());
  std::vector<std::pair<const void*, std::size_t>> order;
  std::as_const(rows).each([&](const auto& kind, std::size_t k) { order.push_back({&kind, k}); });
  ASSERT_EQ(order.size(), rows.size());
  for (std::size_t row = 0; row < order.size(); row++)
    rows.at(row, [&](const auto& kind, std::size_t k) {
      EXPECT_EQ(order[row], (std::pair<const void*, std::size_t>{&kind, k})) << "row " << row;
    });
  for (std::size_t k = 0; k < 5; k++) {
    RowEnds ends = rows.contacts.ends(k);
    EXPECT_EQ(ends.a, k == 0 ? 5u : std::uint32_t(k - 1)) << "what is fixed comes after the island's own";
    EXPECT_EQ(ends.b, std::uint32_t(k));
  }
}

TEST(Rows, NameTheirLinks) {
  TestIsland lab;
  std::vector<BodyIndex> pile = lab.pile(lab.ground(), 4);
  Rows& rows = lab.island().rows;
  std::size_t k = 0;
  lab.ties().eachAwake([&](const Link& link) {
    EXPECT_TRUE(rows.names(link, k));
    EXPECT_FALSE(rows.names(link, k + 1)) << "another one, or none";
    k++;
  });
  EXPECT_EQ(k, rows.size());
  Rows copy(std::pmr::get_default_resource());
  copy.reserve(rows.counts());
  lab.ties().eachAwake([&](const Link& link) { copy.add(link); });
  EXPECT_EQ(copy.counts(), rows.counts());
  EXPECT_TRUE(copy.continues(rows, lab.context));
  lab.contact(2).born = true;
  EXPECT_FALSE(copy.continues(rows, lab.context)) << "another contact in the same slot";
  lab.contact(2).born = false;
  Rows shorter(std::pmr::get_default_resource());
  EXPECT_FALSE(shorter.continues(rows, lab.context));
}

TEST(Rows, TieByTheirPointsAndAHundredTimesByTheirLoad) {
  TestIsland lab;
  std::vector<BodyIndex> pile = lab.pile(lab.ground(), 2);
  const ContactRows& rows = lab.island().rows.contacts;
  EXPECT_EQ(rows.strength(0, lab.context), 4) << "carries nothing yet";
  lab.load(1, 3 * kBrickWeight, 1e6);
  EXPECT_NEAR(double(rows.strength(1, lab.context)), 4 + 100 * 3 * 2, 1e-3) << "two bricks: half of one is effective";
}

TEST(Rows, HoldWhatTheyPressOrWhatIsWithinReach) {
  TestIsland lab;
  BodyIndex under = lab.ground(), body = lab.brick({0, kBrick.y + 1e-3, 0});
  ContactIndex face = lab.touch(under, body);
  lab.prepare();
  const ContactRows& rows = lab.island().rows.contacts;
  SolveMotion* motion = lab.island().motion.data();
  for (float down : {0.0f, 0.5e-3f}) {
    motion[0] = {};
    motion[0].d.y = -down;
    float gap = 1e-3f - down;
    EXPECT_FALSE(rows.carriesForce(0, lab.context));
    EXPECT_FALSE(rows.meetsWithin(0, {0, 0.99f * gap, 0}, motion, lab.context));
    EXPECT_TRUE(rows.meetsWithin(0, {0, 1.01f * gap, 0}, motion, lab.context)) << "at the present motion";
    EXPECT_FALSE(rows.meetsWithin(0, {10 * gap, 0, 0}, motion, lab.context)) << "along it, not towards it";
  }
  lab.contact(face).touching = true;
  EXPECT_TRUE(rows.carriesForce(0, lab.context));
  EXPECT_TRUE(rows.meetsWithin(0, {}, motion, lab.context));
}

// --- island_builder.h

TEST(IslandBuilder, JoinsWhatHangsTogetherButNotThroughWhatIsFixed) {
  TestIsland lab;
  BodyIndex ground = lab.ground();
  std::vector<BodyIndex> left = lab.pile(ground, 3);
  BodyIndex lone = lab.brick({9, 9, 9});
  BodyIndex right = lab.brick({2, kBrick.y, 0});
  lab.touch(ground, right);
  lab.link();
  ASSERT_EQ(lab.islands.awake.size(), 2u);
  const Island &first = *lab.islands.awake[0], &second = *lab.islands.awake[1];
  EXPECT_EQ(std::vector<BodyIndex>(first.bodies.begin(), first.bodies.end()), left);
  EXPECT_EQ(first.rows.size(), 3u);
  EXPECT_EQ(second.key(), right);
  EXPECT_EQ(first.partners.front(), ground);
  EXPECT_EQ(second.partners.front(), ground);
  EXPECT_EQ(lab.islands.single, std::vector<BodyIndex>{lone});
  BodyIndex bridge = lab.brick({1, 3 * kBrick.y, 0}, 1, {1.2, kBrick.y, 0.05});
  lab.touch(left[0], bridge);
  lab.touch(right, bridge);
  lab.link();
  ASSERT_EQ(lab.islands.awake.size(), 1u);
  EXPECT_EQ(lab.islands.awake[0]->bodies.size(), 5u);
}

TEST(IslandBuilder, AnIslandOfTheSameTiesIsTheOldOne) {
  TestIsland lab;
  BodyIndex ground = lab.ground();
  lab.pile(ground, 3);
  BodyIndex other = lab.brick({2, kBrick.y, 0});
  ContactIndex face = lab.touch(ground, other);
  lab.link();
  const Island* pile = lab.islands.awake[0].get();
  const Island* single = lab.islands.awake[1].get();
  lab.islands.awake[0]->hierarchy.valid = true;
  lab.contacts.destroy(face);
  std::erase_if(lab.contacts.pairs, [&](const CandidatePair& pair) { return pair.contact == face; });
  EXPECT_EQ(lab.touch(ground, other), face) << "takes the same slot";
  lab.link();
  EXPECT_EQ(lab.islands.awake[0].get(), pile);
  EXPECT_TRUE(lab.islands.awake[0]->hierarchy.valid);
  EXPECT_NE(lab.islands.awake[1].get(), single) << "its contact is another one";
}

TEST(IslandBuilder, TheHierarchyIsBuiltWhenItIsOutOfDate) {
  TestIsland lab;
  lab.pile(lab.ground(), 12);
  Island& island = lab.island();
  updateHierarchy(island, lab.context);
  EXPECT_TRUE(island.hierarchy.valid);
  ASSERT_EQ(island.hierarchy.levels.front().clusters.size(), 12u);
  EXPECT_EQ(island.hierarchy.levels.back().clusters.size(), 1u);
  EXPECT_EQ(island.hierarchy.levels.front().sides.size(), 23u) << "both ends of eleven joints, one of the lowest";
  EXPECT_EQ(island.hierarchy.levels.back().sides.size(), 1u) << "of all of them only the ground is a boundary";
  EXPECT_EQ(island.hierarchy.levels.back().sides.front(), 1u) << "row 0, its end B";
  island.hierarchy.levels.front().clusters.front().mass = 123;  // a mark
  updateHierarchy(island, lab.context);
  EXPECT_EQ(island.hierarchy.levels.front().clusters.front().mass, 123) << "valid: not built anew";
  island.hierarchy.valid = false;
  updateHierarchy(island, lab.context);
  EXPECT_NE(island.hierarchy.levels.front().clusters.front().mass, 123);
}

}  // namespace
}  // namespace brickfall
