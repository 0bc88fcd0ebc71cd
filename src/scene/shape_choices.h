// The shapes that a scene file can name (a plane is only the ground's), for its key `shape` and for who reads it.
#pragma once
#include <iterator>
#include <string_view>

#include "brickfall/shapes.h"

namespace brickfall::scene {

struct ShapeChoice {
  ShapeType type;
  std::string_view name;
};

constexpr ShapeChoice kShapes[] = {{ShapeType::box, "box"},         {ShapeType::sphere, "sphere"},
                                   {ShapeType::capsule, "capsule"}, {ShapeType::hull, "hull"},
                                   {ShapeType::mesh, "mesh"},       {ShapeType::cylinder, "cylinder"},
                                   {ShapeType::cone, "cone"}};
static_assert(std::size(kShapes) == kShapeTypeCount - 1, "a new shape needs a name in scene files");

// The same as a KeySpec has it.
constexpr const char* kShapeChoices = "box|sphere|capsule|hull|mesh|cylinder|cone";

constexpr bool sameChoices(std::string_view text) {
  for (const ShapeChoice& shape : kShapes) {
    if (text.substr(0, shape.name.size()) != shape.name) return false;
    text.remove_prefix(shape.name.size());
    if (text.empty()) return &shape == std::end(kShapes) - 1;
    if (text[0] != '|') return false;
    text.remove_prefix(1);
  }
  return false;
}
static_assert(sameChoices(kShapeChoices), "kShapeChoices are the names of kShapes, in their order");

}  // namespace brickfall::scene
