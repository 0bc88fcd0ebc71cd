// --set key.path=value: changes the tree of a scene file before anything is checked.
#pragma once
#include <string>

#include "scene/node.h"
#include "scene/table_reader.h"

namespace brickfall::scene {

// Reports what it can't apply; the rest of the checks then see the value like one of the file.
void applyOverride(ReadContext& context, Node& root, const std::string& key, const std::string& value);

}  // namespace brickfall::scene
