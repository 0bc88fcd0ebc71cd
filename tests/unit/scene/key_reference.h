// The table of keys as documentation: what docs/scene-file.md and docs/scene.schema.json must say.
#pragma once
#include <string>
#include <vector>

namespace brickfall::scene {

// All tables of keys, "" (the top level) first.
std::vector<std::string> tablesOfKeys();
// A table of Markdown with a row for each key.
std::string keyMarkdown(const std::string& table);
// JSON Schema (draft 7) of a scene file.
std::string keySchema();

}  // namespace brickfall::scene
