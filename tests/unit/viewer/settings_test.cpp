// Settings and materials by the panel's table.
#include "unit/viewer/viewer_support.h"
#include "viewer_core/settings_table.h"

namespace brickfall::viewer {
namespace {

std::size_t placeOf(const std::string& key) {
  for (std::size_t i = 0; i < settingRows().size(); i++)
    if (settingRows()[i].key == key) return i;
  ADD_FAILURE() << key;
  return 0;
}

// Both ends of its slider, through the table and through a running scene.
TEST(Settings, EveryRowCanBeSetAndIsShown) {
  TestSession t(kWall, false);
  ASSERT_EQ(t.frame()->settings.size(), settingRows().size());
  for (const SettingRow& row : settingRows()) {
    SceneDescription scene;
    EXPECT_LE(row.least, row.usualLeast) << row.key;
    EXPECT_LT(row.usualLeast, row.usualMost) << row.key;
    EXPECT_LE(row.usualMost, row.most) << row.key;
    EXPECT_FALSE(row.label.empty() || row.help.empty() || row.group.empty()) << row.key;
    for (double value : {row.usualLeast, row.usualMost}) {
      if (row.kind == SettingKind::whole && value > 8) value = 8;
      ASSERT_TRUE(setSetting(scene, row, value)) << row.key;
      EXPECT_EQ(settingOf(scene, row), value) << row.key;
      if (row.key == "maxBodies") value = 1e6;
      // Some have an order among them.
      if (row.key == "restingStiffness") value = std::max(value, 1000.0);
      if (row.key == "minCycles") value = 4;
      if (row.key == "maxCycles" || row.key == "maxCyclesSmall") value = 8;
      EXPECT_TRUE(t.does(ChangeSetting{std::string(row.key), value})) << row.key << ": " << t.result.message;
      EXPECT_EQ(t.frame()->settings[placeOf(std::string(row.key))], value) << row.key;
    }
    EXPECT_FALSE(setSetting(scene, row, row.most * 2 + 1));
    EXPECT_FALSE(setSetting(scene, row, std::nan("")));
    EXPECT_EQ(setSetting(scene, row, row.least + 0.5), row.kind == SettingKind::real && row.most > row.least + 0.5)
        << row.key;
    EXPECT_FALSE(t.does(ChangeSetting{std::string(row.key), std::nan("")})) << row.key;
    EXPECT_NE(t.result.message.find(row.key), std::string::npos) << t.result.message;
  }
  EXPECT_FALSE(t.does(ChangeSetting{"gravity", 1}));
  EXPECT_TRUE(t.does(Restart{})) << t.result.message;
}

TEST(Settings, LiveOnesActAtOnceOthersWaitForARestart) {
  TestSession t(kWall, true);
  t.pass(0.1);
  ASSERT_TRUE(t.does(ChangeSetting{"method", 1}));
  ASSERT_TRUE(t.does(ChangeSetting{"broadPhase", 1}));
  t.pass(0.1);
  EXPECT_EQ(t.frame()->status.settingsWait, 2u);
  EXPECT_FALSE(t.frame()->info->reportMethod);
  EXPECT_EQ(t.frame()->settings[placeOf("method")], 1);
  ASSERT_TRUE(t.does(ChangeSetting{"gravity.y", -3}));
  ASSERT_TRUE(t.does(Restart{}));
  EXPECT_TRUE(t.frame()->info->reportMethod);
  EXPECT_EQ(t.frame()->status.settingsWait, 0u);
  EXPECT_EQ(t.frame()->settings[placeOf("gravity.y")], -3);
  ASSERT_TRUE(t.does(Restart{true}));
}

TEST(Settings, WhatTheWorldRefusesIsSaidAndNotShown) {
  TestSession t(kWall, false);
  ASSERT_TRUE(t.does(ChangeSetting{"minCycles", 10}));
  EXPECT_FALSE(t.does(ChangeSetting{"maxCycles", 5}));
  EXPECT_NE(t.result.message.find("maxCycles"), std::string::npos) << t.result.message;
  EXPECT_EQ(t.frame()->settings[placeOf("maxCycles")], 10);
  EXPECT_EQ(t.frame()->settings[placeOf("minCycles")], 10);
}

TEST(Settings, MaterialsAreListedAndChange) {
  TestSession t(kWall, false);
  ASSERT_EQ(t.frame()->materials.size(), 2u);  // bricks, and the ground's
  const MaterialRow* brick = nullptr;
  for (const MaterialRow& row : t.frame()->materials)
    if (row.name == "brick") brick = &row;
  ASSERT_NE(brick, nullptr);
  EXPECT_EQ(brick->shapes, 22);
  const double mass = t.frame()->list->bodies[3].mass;
  ASSERT_TRUE(t.does(ChangeMaterial{"brick", 950, 0.4, 0})) << t.result.message;
  EXPECT_NEAR(t.frame()->list->bodies[3].mass, mass * 950 / 1900, 1e-9);
  EXPECT_EQ(t.frame()->list->bodies[3].serial, 4u);
  EXPECT_FALSE(t.does(ChangeMaterial{"brick", -1, 0.4, 0}));
  EXPECT_NE(t.result.message.find("density"), std::string::npos) << t.result.message;
  EXPECT_FALSE(t.does(ChangeMaterial{"cheese", 900, 0.4, 0}));
  ASSERT_TRUE(t.does(Restart{}));
  EXPECT_NEAR(t.frame()->list->bodies[3].mass, mass * 950 / 1900, 1e-9);
  ASSERT_TRUE(t.does(Restart{true}));
  EXPECT_NEAR(t.frame()->list->bodies[3].mass, mass, 1e-9);
}

}  // namespace
}  // namespace brickfall::viewer
