// Text to tree.
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "brickfall/scene.h"
#include "scene/node.h"

namespace brickfall::scene {

struct TomlDocument {
  Node root;
  std::vector<Diagnostic> errors;  // of syntax
  bool usable = true;              // false: the errors leave nothing to check further
};

// After a syntax error the faulty line is left out and reading goes on, so that one run finds them all.
TomlDocument readToml(std::string_view text, const std::string& fileName);

}  // namespace brickfall::scene
