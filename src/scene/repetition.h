// `repeat` and `let` of a table: how often it comes, where, and with which numbers.
#pragma once
#include "scene/node_edit.h"
#include "scene/table_reader.h"

namespace brickfall::scene {

// One of a repetition: the numbers that it has, where it stands, what it is called.
struct Instance {
  Values values;
  Placement placement;
  std::string number;  // "3", of a grid "1/0/2"; empty: there is no repetition
  std::string words;   // "i = 3"
};

// Of a table, from its `repeat`; one where there is none, and none where it is wrong.
std::vector<Instance> instancesOf(ReadContext& context, const Node& table, const std::string& path);

// Takes `let` out of the table and puts its numbers into the texts. Each of them may use those before it.
void bindNames(ReadContext& context, Node& table, const std::string& path);

}  // namespace brickfall::scene
