// Scenes in tests: parse a text that must be sound, or collect what is wrong with it.
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "brickfall/scene.h"

namespace brickfall {

inline std::string allOf(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) text += format(diagnostic) + "\n";
  return text;
}

inline SceneDescription sound(const std::string& text, const Overrides& overrides = {}) {
  SceneLoad load = parseScene(text, "test.toml", overrides);
  EXPECT_TRUE(load.scene.has_value()) << allOf(load.diagnostics);
  return load.scene.value_or(SceneDescription{});
}

// Diagnostics of a faulty text, one a line.
inline std::string faults(const std::string& text, const Overrides& overrides = {}) {
  SceneLoad load = parseScene(text, "test.toml", overrides);
  EXPECT_FALSE(load.scene.has_value());
  return allOf(load.diagnostics);
}

inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace brickfall
