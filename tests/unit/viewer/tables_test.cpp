// The tables that keys, help and docs/viewer.md are made of, and that the page says what they say.
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <sstream>

#include "viewer_core/commands.h"
#include "viewer_core/key_bindings.h"
#include "viewer_core/settings_table.h"

namespace brickfall::viewer {
namespace {

std::string page() {
  std::ifstream in(BRICKFALL_SOURCE_DIR "/docs/viewer.md");
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string shown(std::string_view key) { return "`" + std::string(key) + "`"; }

// What a key does once, with all its keys.
std::string keyTable() {
  std::ostringstream out;
  out << "| key | what | |\n|---|---|---|\n";
  std::set<Action> done;
  for (const KeyBinding& binding : keyBindings()) {
    if (!done.insert(binding.action).second) continue;
    std::string keys;
    for (const KeyBinding& other : keyBindings())
      if (other.action == binding.action) keys += (keys.empty() ? "" : ", ") + shown(other.key);
    out << "| " << keys << " | " << binding.help << (binding.held ? " (held)" : "") << " | " << binding.group << " |\n";
  }
  return out.str();
}

std::string mouseTable() {
  std::ostringstream out;
  out << "| mouse | what |\n|---|---|\n";
  for (const MouseBinding& binding : mouseBindings()) out << "| " << binding.button << " | " << binding.help << " |\n";
  return out.str();
}

std::string settingsTable() {
  std::ostringstream out;
  out << "| setting | what | acts |\n|---|---|---|\n";
  for (const SettingRow& row : settingRows())
    out << "| " << row.group << ": " << row.label << (row.unit.empty() ? "" : ", ") << row.unit << " | " << row.help
        << " | " << (row.live ? "at once" : "from the next start") << " |\n";
  return out.str();
}

// Prints what to paste.
void expectOnPage(const std::string& table) {
  EXPECT_NE(page().find(table), std::string::npos) << "docs/viewer.md should hold\n\n" << table;
}

TEST(Tables, EveryActionHasAKeyAndNoKeyTwo) {
  std::set<Action> actions;
  std::set<std::string_view> keys;
  for (const KeyBinding& binding : keyBindings()) {
    actions.insert(binding.action);
    EXPECT_TRUE(keys.insert(binding.key).second) << binding.key;
    EXPECT_FALSE(binding.help.empty() || binding.group.empty());
  }
  EXPECT_EQ(actions.size(), std::size_t(kActionCount));
  for (int i = 0; i < kActionCount; i++) EXPECT_EQ(bindingOf(Action(i)).action, Action(i));
}

TEST(Tables, KeysAreFoundByTheirNames) {
  EXPECT_EQ(actionFor("Space", false, false), Action::runOrPause);
  EXPECT_EQ(actionFor("z", true, false), Action::undo);
  EXPECT_EQ(actionFor("Z", false, false), Action::count);
  EXPECT_EQ(actionFor("R", false, false), Action::restart);
  EXPECT_EQ(actionFor("R", true, false), Action::record);
  EXPECT_EQ(actionFor("W", false, true), Action::forward);  // faster
  EXPECT_EQ(actionFor("R", false, true), Action::count);
  EXPECT_EQ(actionFor("", false, false), Action::count);
  EXPECT_EQ(actionFor("Spac", false, false), Action::count);
}

TEST(Tables, EveryCommandHasAName) {
  EXPECT_STREQ(nameOf(Open{}), "open");
  EXPECT_STREQ(nameOf(Rewind{}), "rewind");
  EXPECT_STREQ(nameOf(ShootBall{}), "shoot");
  EXPECT_STREQ(nameOf(ChangeMaterial{}), "set a material");
  EXPECT_STREQ(nameOf(StopRecording{}), "stop recording");
}

TEST(Tables, TheDocumentationHasThem) {
  expectOnPage(keyTable());
  expectOnPage(mouseTable());
  expectOnPage(settingsTable());
}

}  // namespace
}  // namespace brickfall::viewer
