// A TOML document as a plain tree with the place of everything in the file. The TOML library stays behind
// toml_document.cpp.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scene/placement.h"

namespace brickfall::scene {

enum class NodeKind : std::uint8_t { boolean, integer, number, text, date, array, table };

struct Member;

// Of a table that repeat, a group or a copy has made.
struct Expansion {
  Placement placement;
  std::string title;  // instead of its path, in messages: "wall[0] with i = 3"
};

struct Node {
  NodeKind kind = NodeKind::table;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;  // of an integer too
  std::string text;
  std::vector<Node> items;      // of an array
  std::vector<Member> members;  // of a table, in the order of the file
  int line = 0, column = 0;     // from 1; of a table: where it begins
  int source = 0;               // of ReadContext::sources; 0: the scene file itself
  bool fromOverride = false;    // given by --set, not by the file
  bool again = false;           // stands in the tree once more already: a mistake in it is told once
  std::shared_ptr<const Expansion> expansion;

  const Member* find(const std::string& key) const;
  Member* find(const std::string& key);
};

struct Member {
  std::string key;
  int line = 0, column = 0;  // of the key
  Node value;
};

inline const Member* Node::find(const std::string& key) const {
  for (const Member& member : members)
    if (member.key == key) return &member;
  return nullptr;
}
inline Member* Node::find(const std::string& key) {
  return const_cast<Member*>(static_cast<const Node*>(this)->find(key));
}

// What a value is, in words: "the text \"ten\"", "-3", "an array of 2".
std::string describe(const Node& node);
// Shortest text that reads back as the same number.
std::string numberText(double value);

}  // namespace brickfall::scene
