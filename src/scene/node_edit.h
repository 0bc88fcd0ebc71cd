// Changes to tables that a scene file made: names as numbers, copies, places.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "scene/node.h"
#include "scene/placement.h"

namespace brickfall::scene {

// Numbers by name, the later of two of one name counts.
using Values = std::vector<std::pair<std::string, double>>;

// The text with each $name of these as its number.
std::string substituted(const std::string& text, const Values& values);
// All texts in it. A table inside with a repetition of its own hides a number of the same name, but not from its `repeat`.
void substitute(Node& node, const Values& values);

std::size_t sizeOf(const Node& node);  // values in it, itself as well
void markAgain(Node& node);            // it was made from lines that another was made from: messages come once
void erase(Node& table, const std::string& key);
const std::string* nameOf(const Node& table);  // null: none
void setName(Node& table, const std::string& name);
// Puts it elsewhere, around what is there; messages call it `title` from now on, unless that is empty.
void place(Node& table, const Placement& placement, const std::string& title);
bool isTables(const Node& node);

}  // namespace brickfall::scene
