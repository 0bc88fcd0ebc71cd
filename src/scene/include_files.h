// `include`: the tables of other files, before those of the file itself.
#pragma once
#include "scene/table_reader.h"

namespace brickfall::scene {

// Their arrays of tables come first; of other tables and values those of the file that includes count. Everything keeps its file
// and line. Whatever cannot be read is an error at the key.
void mergeIncludes(ReadContext& context, Node& root);

}  // namespace brickfall::scene
