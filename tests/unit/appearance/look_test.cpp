// Which material looks like what, and how bricks differ.
#include "appearance/look.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace brickfall::appearance {
namespace {

TEST(Look, KindsComeFromNamesAndElseFromRoles) {
  EXPECT_EQ(kindOf("brick", BodyRole::brick), Kind::brick);
  EXPECT_EQ(kindOf("Old Brick 2", BodyRole::body), Kind::brick);
  EXPECT_EQ(kindOf("concrete", BodyRole::brick), Kind::concrete) << "a lintel";
  EXPECT_EQ(kindOf("sandstone", BodyRole::brick), Kind::stone);
  EXPECT_EQ(kindOf("wood", BodyRole::body), Kind::wood);
  EXPECT_EQ(kindOf("steel", BodyRole::ball), Kind::steel);
  EXPECT_EQ(kindOf("rubber", BodyRole::ball), Kind::rubber);
  EXPECT_EQ(kindOf("earth", BodyRole::body), Kind::ground);
  EXPECT_EQ(kindOf("brick", BodyRole::ground), Kind::ground);
  EXPECT_EQ(kindOf("", BodyRole::brick), Kind::brick);
  EXPECT_EQ(kindOf("", BodyRole::ball), Kind::steel);
  EXPECT_EQ(kindOf("", BodyRole::body), Kind::plain);
  EXPECT_EQ(kindOf("unobtainium", BodyRole::ball), Kind::plain);
}

TEST(Look, ShapesOfABodyMayDiffer) {
  TakeBody body;
  body.material = "wood";
  body.shapes.resize(2);
  EXPECT_EQ(lookOf(body, 1, 7).kind, Kind::wood);
  body.shapeMaterials = {"wood", "steel"};
  EXPECT_EQ(lookOf(body, 0, 7).kind, Kind::wood);
  EXPECT_EQ(lookOf(body, 1, 7).kind, Kind::steel);
  EXPECT_EQ(lookOf(body, 1, 7).metalness, 1);
}

TEST(Look, BricksDifferFromOneToTheNextAndStayThemselves) {
  std::set<float> reds;
  float mean = 0;
  const LookQuery first{"brick", BodyRole::brick, 0xB5543A, 0};
  const Rgb plain = linearFromHex(0xB5543A);
  for (std::uint32_t k = 0; k < 400; k++) {
    LookQuery query = first;
    query.bodyNumber = k;
    const Look look = lookOf(query), again = lookOf(query);
    EXPECT_EQ(look.colour, again.colour);
    EXPECT_EQ(look.seed, again.seed);
    EXPECT_GT(brightness(look.colour), 0.4f * brightness(plain));
    EXPECT_LT(brightness(look.colour), 1.4f * brightness(plain));
    reds.insert(look.colour.x);
    mean += brightness(look.colour) / 400;
  }
  EXPECT_GT(reds.size(), 390u);
  EXPECT_NEAR(mean / brightness(plain), 0.95f, 0.05f) << "the wall as a whole keeps its colour";
}

TEST(Look, GroundThatIsCalledBrickIsNoRedPlain) {
  const Look ground = lookOf({"brick", BodyRole::ground, 0xB5543A, 0});
  EXPECT_LT(std::max({ground.colour.x, ground.colour.y, ground.colour.z}),
            1.3f * std::min({ground.colour.x, ground.colour.y, ground.colour.z}));
  const Rgb earth = lookOf({"earth", BodyRole::ground, 0x6B7A4B, 0}).colour;
  EXPECT_NEAR(earth.x / earth.y, linearFromHex(0x6B7A4B).x / linearFromHex(0x6B7A4B).y, 1e-4f);
}

TEST(Colour, SrgbThereAndBack) {
  for (int v = 0; v <= 255; v++) EXPECT_EQ(toByte(srgbFromLinear(linearFromSrgb(float(v) / 255))), v);
  EXPECT_NEAR(linearFromHex(0xFF8000).y, 0.2158605f, 1e-5f);
}

}  // namespace
}  // namespace brickfall::appearance
