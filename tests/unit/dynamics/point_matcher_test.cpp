// Which old point of a contact a new one goes on with, and whose place it keeps.
#include "dynamics/point_matcher.h"

#include <gtest/gtest.h>

namespace brickfall {
namespace {

struct Points {
  Contact contact;
  ContactGeometry geometry;

  Points(std::initializer_list<Vec3> at, std::initializer_list<std::uint32_t> features, Vec3 normal = {0, 1, 0}) {
    geometry.normal = normal;
    geometry.tangent1 = {normal.y, normal.x, 0};
    for (Vec3 p : at) {
      geometry.anchorA[contact.count] = p;
      geometry.anchorB[contact.count++] = p;
    }
    std::copy(features.begin(), features.end(), contact.points.feature);
  }
};
PointMatcher match(const Points& old, const Points& now) {
  return PointMatcher(old.contact, old.geometry, now.contact, now.geometry, 0.02);
}

// A prism that rolls from one short face to the next: the corner that it stood on is one of the new face, too. The one that comes
// down is told first; the corner is not its.
TEST(PointMatcher, TheNearestComeFirst) {
  Points old({{0, 0, 0}, {-0.019, 0, 0}}, {1, 2}), now({{0.019, 0, 0}, {0.0005, 0, 0}}, {3, 1});
  PointMatcher matcher = match(old, now);
  EXPECT_EQ(matcher.from(0), -1);
  EXPECT_EQ(matcher.from(1), 0);
  EXPECT_TRUE(matcher.keepsAnchors(1));
}

TEST(PointMatcher, WhatIsOnlyNearGoesOnButNotInPlace) {
  Points old({{0, 0, 0}}, {1}), other({{0.019, 0, 0}}, {3}), beside({{0.0009, 0, 0}}, {3}), same({{0.019, 0, 0}}, {1});
  EXPECT_EQ(match(old, other).from(0), 0);
  EXPECT_FALSE(match(old, other).keepsAnchors(0)) << "it would leave its own corner without support";
  EXPECT_TRUE(match(old, beside).keepsAnchors(0)) << "one place, whatever it is called";
  EXPECT_TRUE(match(old, same).keepsAnchors(0)) << "one corner";
}

TEST(PointMatcher, TheSameFeatureCountsAsTwiceAsNear) {
  Points old({{0, 0, 0}, {0.01, 0, 0}}, {1, 2}), now({{0.006, 0, 0}}, {1});
  EXPECT_EQ(match(old, now).from(0), 0);
  now.contact.points.feature[0] = 3;
  EXPECT_EQ(match(old, now).from(0), 1);
}

TEST(PointMatcher, NothingFromFarOrFromAnotherFace) {
  Points old({{0, 0, 0}}, {1}), far({{0.021, 0, 0}}, {3}), turned({{0, 0, 0}}, {1}, {1, 0, 0});
  EXPECT_EQ(match(old, far).from(0), -1);
  EXPECT_EQ(match(old, turned).from(0), -1);
  far.contact.rolls = true;
  EXPECT_EQ(match(old, far).from(0), 0) << "what rolls has one point, wherever it is";
  EXPECT_FALSE(match(old, far).keepsAnchors(0));
}

// A slider's corner keeps its place on the slider and leaves it on what it slides over, whichever of them is A.
TEST(PointMatcher, WhatSlidesGoesOnFromEitherSide) {
  for (bool sliderIsA : {true, false}) {
    Points old({{0, 0, 0}, {0.2, 0, 0}}, {1, 2}), now({{0, 0, 0}, {0.2, 0, 0}}, {1, 2});
    for (int i = 0; i < 2; i++) (sliderIsA ? now.geometry.anchorB : now.geometry.anchorA)[i].x += 0.1;
    PointMatcher matcher = match(old, now);
    EXPECT_EQ(matcher.from(0), 0) << sliderIsA;
    EXPECT_EQ(matcher.from(1), 1) << sliderIsA;
  }
}

TEST(PointMatcher, EachOldPointServesOnce) {
  Points old({{0, 0, 0}}, {1}), now({{0.001, 0, 0}, {0.0005, 0, 0}}, {2, 3});
  PointMatcher matcher = match(old, now);
  EXPECT_EQ(matcher.from(0), -1);
  EXPECT_EQ(matcher.from(1), 0);
}

}  // namespace
}  // namespace brickfall
