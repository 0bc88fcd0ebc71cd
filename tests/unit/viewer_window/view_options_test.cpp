#include "viewer_window/view_options.h"

#include <gtest/gtest.h>

#include <set>

namespace brickfall::viewer {
namespace {

FrameBody body(Activity activity) {
  FrameBody out;
  out.activity = activity;
  return out;
}

TEST(ViewOptions, withoutAViewBodiesKeepTheirLook) {
  FrameBody struck = body(Activity::awake);
  struck.touching = true;
  struck.sinceHit = 0;
  struck.island = 3;
  EXPECT_EQ(tintOf({}, struck, {}).strength, 0);
  EXPECT_EQ(tintOf({}, body(Activity::asleep), {}).strength, 0);
}

TEST(ViewOptions, collidingBodiesAreRedAndFade) {
  ViewOptions options;
  options.collisions = true;
  FrameBody struck = body(Activity::awake);
  struck.sinceHit = 0;
  const BodyTint now = tintOf({}, struck, options);
  EXPECT_EQ(now.strength, 1);
  EXPECT_GT(now.colour >> 16, 3 * (now.colour >> 8 & 255));
  struck.sinceHit = 0.3f;
  const BodyTint later = tintOf({}, struck, options);
  EXPECT_LT(later.strength, now.strength);
  EXPECT_GT(later.strength, 0);
  struck.sinceHit = 10;
  EXPECT_EQ(tintOf({}, struck, options).strength, 0);
  struck.touching = true;
  EXPECT_GT(tintOf({}, struck, options).strength, 0);
  struck.activity = Activity::fixed;
  EXPECT_EQ(tintOf({}, struck, options).strength, 0);
}

TEST(ViewOptions, aHitIsSeenBeforeIslandsAndSleep) {
  ViewOptions options;
  options.collisions = options.islands = options.asleep = true;
  FrameBody some = body(Activity::awake);
  some.island = 2;
  EXPECT_EQ(tintOf({}, some, options).colour, islandColour(2));
  some.sinceHit = 0;
  EXPECT_NE(tintOf({}, some, options).colour, islandColour(2));
  const BodyTint asleep = tintOf({}, body(Activity::asleep), options), held = tintOf({}, body(Activity::held), options);
  EXPECT_GT(asleep.strength, 0);
  EXPECT_GT(held.strength, 0);
  EXPECT_NE(asleep.colour, held.colour);
  EXPECT_GT(tintOf({}, body(Activity::quarantined), {}).strength, 0);  // always shown: something went wrong
}

TEST(ViewOptions, islandsHaveColoursOfTheirOwn) {
  std::set<std::uint32_t> seen;
  for (int i = 0; i < 200; i++) {
    EXPECT_LE(islandColour(i), 0xFFFFFFu);
    seen.insert(islandColour(i));
  }
  EXPECT_GT(seen.size(), 190u);
}

TEST(ViewOptions, onlyWhatIsShownIsGathered) {
  EXPECT_EQ(ViewOptions{}.needs(false), FrameNeeds{});
  ViewOptions options;
  options.contacts = options.bounds = true;
  const FrameNeeds needs = options.needs(true);
  EXPECT_TRUE(needs.contacts && needs.bounds && needs.plots);
  EXPECT_FALSE(needs.islands || needs.collisions);
}

}  // namespace
}  // namespace brickfall::viewer
