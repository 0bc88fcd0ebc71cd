// Every setting of a run, as a table: the panel is made of it, and so is its page of docs/viewer.md.
#pragma once
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "brickfall/scene.h"

namespace brickfall::viewer {

enum class SettingKind : std::uint8_t { real, whole, onOff, choice };

struct SettingRow {
  std::string_view key;    // "gravity.y": as ChangeSetting names it
  std::string_view group;  // "World", "Time", "Solver", "Report"
  std::string_view label;  // "Gravity, up"
  std::string_view unit;   // "m/s2"; empty: a plain number
  SettingKind kind = SettingKind::real;
  double least = 0, most = 0;                 // what may be set
  double usualLeast = 0, usualMost = 0;       // between which a slider goes
  bool logarithmic = false;                   // a slider is better so
  bool live = true;                           // false: acts from the next Restart on
  std::span<const std::string_view> choices;  // of SettingKind::choice: value 0, 1 ...
  std::string_view help;                      // one sentence
};

// In the order in which the panel shows them, groups together.
std::span<const SettingRow> settingRows();
const SettingRow* findSetting(std::string_view key);  // null: unknown

// Values as numbers: onOff 0 or 1, choices by number.
double settingOf(const SceneDescription& scene, const SettingRow& row);
// False, and nothing changed, if the value is not one that the row allows.
bool setSetting(SceneDescription& scene, const SettingRow& row, double value);

}  // namespace brickfall::viewer
