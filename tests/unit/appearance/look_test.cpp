// Which material looks like what, and how bricks differ.
#include "appearance/look.h"
#include "appearance/light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

TEST(Look, AShapeHasTheColourThatItsSceneGaveItsMaterial) {
  TakeBody body;
  body.material = "bumper";
  body.shapes.resize(2);
  body.shapeMaterials = {"bumper", "wheel"};
  const float pale = lookOf(body, 1, 7).colour.x;  // of a material whose colour nobody knows
  body.shapeColours = {body.colour, 0x222426};
  EXPECT_LT(lookOf(body, 1, 7).colour.x, 0.2f * pale);
  EXPECT_EQ(lookOf(body, 0, 7).colour, lookOf({"bumper", body.role, body.colour, 7}).colour);
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

// Half of what it sees is sky, so from many directions of it the same comes out.
TEST(Light, WithoutRaysASurfaceIsLitAsWithThem) {
  const Vec3f sun = sunOver({1, 2, 3});
  EXPECT_NEAR(length(sun), 1, 1e-6f);
  for (Vec3f normal : {Vec3f{0, 1, 0}, Vec3f{0, -1, 0}, Vec3f{1, 0, 0}, Vec3f{-0.6f, 0, -0.8f}, Vec3f{0.6f, 0.8f, 0}}) {
    Rgb sum;
    float weight = 0;
    constexpr int kCount = 4000;
    for (int k = 0; k < kCount; k++) {  // a spiral from pole to pole: evenly
      const float up = 1 - 2 * (float(k) + 0.5f) / kCount, flat = std::sqrt(1 - up * up), turn = float(k) * 2.3999632f;
      const Vec3f towards{flat * std::cos(turn), up, flat * std::sin(turn)};
      const float share = std::max(dot(normal, towards), 0.0f);
      sum += skyLight(towards, sun) * share;
      weight += share;
    }
    const Rgb seen = sum * (1 / weight), fit = ambientLight(normal, sun);
    for (int k = 0; k < 3; k++) EXPECT_NEAR(fit[k] / seen[k], 1, 0.08f) << normal.x << ' ' << normal.y << ' ' << k;
  }
}

TEST(Light, SunStandsOverTheLeftShoulder) {
  const Vec3f sun = sunOver({0, 5, 2});  // of who looks along -z
  EXPECT_NEAR(std::asin(sun.y) * 57.29578f, 42, 0.01f);
  EXPECT_NEAR(std::atan2(-sun.x, sun.z) * 57.29578f, 40, 0.01f);
  EXPECT_EQ(sunOver({0, 1, 0}), sunOver({0, 0, 1})) << "from straight above";
}

TEST(Light, JointsAreSeenFromAfarOnly) {
  EXPECT_EQ(edgeShade(0, 0.0005f), 1);
  EXPECT_LT(edgeShade(0, 0.004f), 0.75f);
  EXPECT_EQ(edgeShade(0.03f, 0.004f), 1);
  EXPECT_GT(edgeShade(0, 0.1f), 0.95f) << "finer than a pixel";
}

TEST(Light, AFloorHasAJointEveryMetreThatFadesFarOff) {
  const Vec3f fine{0.001f, 0, 0.001f}, flat{0.4f, 0, 0.001f};
  EXPECT_LT(floorShade({3, 0, 0.4f}, fine), 0.85f);
  EXPECT_EQ(floorShade({3.5f, 0, 0.4f}, fine), 1);
  EXPECT_LT(floorShade({0.5f, 0, -2}, fine), 0.85f);
  EXPECT_EQ(floorShade({3, 0, 0.4f}, flat), 1);
  EXPECT_LT(floorShade({0.5f, 0, -2}, flat), 0.85f) << "seen flat, only joints across the view fade";
}

}  // namespace
}  // namespace brickfall::appearance
