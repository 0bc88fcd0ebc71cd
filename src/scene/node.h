// A TOML document as a plain tree with the place of everything in the file. The TOML library stays behind
// toml_document.cpp.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace brickfall::scene {

enum class NodeKind : std::uint8_t { boolean, integer, number, text, date, array, table };

struct Member;

struct Node {
  NodeKind kind = NodeKind::table;
  bool boolean = false;
  std::int64_t integer = 0;
  double number = 0;  // of an integer too
  std::string text;
  std::vector<Node> items;      // of an array
  std::vector<Member> members;  // of a table, in the order of the file
  int line = 0, column = 0;     // from 1; of a table: where it begins
  bool fromOverride = false;    // given by --set, not by the file

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
