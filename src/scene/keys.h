// Every key that a scene file may have: ONE table from which the parser checks, the nearest key is found, and the
// documentation and the JSON schema are checked.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace brickfall::scene {

enum class KeyKind : std::uint8_t {
  number,
  integer,
  boolean,
  text,
  name,        // text of 1 .. 64 characters
  choice,      // one of KeySpec::choices
  material,    // name of a material
  mortarKind,  // name of a kind of mortar
  mortar,      // the same or "none", or a table of numbers
  colour,      // "#RRGGBB"
  vector,      // [x, y, z]
  positive,    // [x, y, z], each in the range, as sizes are
  counts,      // [nx, ny, nz], whole numbers
  gravity,     // a number (downwards) or [x, y, z]
  brick,       // name of a kind of brick, or [length, height, width]
  pair,        // [a, b], each in the range
  wholePair,   // [a, b], whole numbers
  points,      // [[x, y, z], ...]
  times,       // [t, ...], ascending
  numbers,     // [a, ...], whole and ascending
  planPoints,  // [[x, z], ...]
  texts,       // a text, or several: ["a", "b"]
  repeat,      // how often, or a table of KeySpec::table "repeat"
  parameters,  // a table of numbers with names of the user's choice
  table,       // [name]
  tables,      // [[name]]
};

struct KeySpec {
  const char* table;  // "" = top level, "wall", "wall.opening"
  const char* key;
  KeyKind kind;
  const char* unit;  // "" = none
  double minimum, maximum;
  const char* fallback;  // the default as it reads in a file; "" = must be given; "-" = none
  const char* choices;   // "a|b|c"
  const char* meaning;
};

// How a value changes where its table is placed by a group, a copy or a repetition.
enum class Frame : std::uint8_t { none, point, direction, yaw };
Frame frameOf(const KeySpec& spec);

const std::vector<KeySpec>& keySpecs();
const KeySpec* findKey(std::string_view table, std::string_view key);
std::vector<std::string> keysOf(std::string_view table);
// "[[wall]]", "[world]", "the top level"
std::string tableTitle(std::string_view table);
// The table for a thing of another name ("sphere", "column"); empty if none is known.
std::string meantTable(std::string_view thing);
// The title of a table that has this key, empty if none does.
std::string ownerOfKey(std::string_view key);
std::vector<std::string> choicesOf(const KeySpec& spec);
// "a whole number 1 .. 10000", "three numbers [x, y, z], each -100000 .. 100000 m"
std::string expectation(const KeySpec& spec);

}  // namespace brickfall::scene
