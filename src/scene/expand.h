// The one place where `repeat`, `let`, [[group]] and [[copy]] become plain tables: readers never see them. What is made keeps the
// lines of what it was made from, and a title that says which one it is.
#pragma once
#include "scene/table_reader.h"

namespace brickfall::scene {

// After the parameters are read.
void expandScene(ReadContext& context, Node& root);

}  // namespace brickfall::scene
