#include "scene/node_edit.h"

#include <algorithm>

namespace brickfall::scene {

namespace {

bool isNameLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

std::string indexNameOf(const Node& table) {
  const Member* repeat = table.find("repeat");
  if (!repeat) return {};
  const Member* index = repeat->value.kind == NodeKind::table ? repeat->value.find("index") : nullptr;
  return index && index->value.kind == NodeKind::text ? index->value.text : "i";
}

}  // namespace

std::string substituted(const std::string& text, const Values& values) {
  std::string out;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t dollar = std::min(text.find('$', at), text.size());
    out.append(text, at, dollar - at);
    if (dollar == text.size()) break;
    std::size_t end = dollar + 1;
    while (end < text.size() && isNameLetter(text[end])) end++;
    const std::string name = text.substr(dollar + 1, end - dollar - 1);
    const auto found = std::find_if(values.rbegin(), values.rend(), [&](const auto& one) { return one.first == name; });
    out += found == values.rend() ? text.substr(dollar, end - dollar) : numberText(found->second);
    at = end;
  }
  return out;
}

void substitute(Node& node, const Values& values) {
  if (values.empty()) return;
  if (node.kind == NodeKind::text && node.text.find('$') != std::string::npos)
    node.text = substituted(node.text, values);
  for (Node& item : node.items) substitute(item, values);
  const std::string hidden = node.kind == NodeKind::table ? indexNameOf(node) : std::string();
  Values inner = values;
  if (!hidden.empty())
    std::erase_if(inner, [&](const auto& one) { return one.first == hidden || one.first.starts_with(hidden + "_"); });
  for (Member& member : node.members) substitute(member.value, member.key == "repeat" ? values : inner);
}

std::size_t sizeOf(const Node& node) {
  std::size_t size = 1;
  for (const Node& item : node.items) size += sizeOf(item);
  for (const Member& member : node.members) size += sizeOf(member.value);
  return size;
}

void markAgain(Node& node) {
  node.again = true;
  for (Node& item : node.items) markAgain(item);
  for (Member& member : node.members) markAgain(member.value);
}

void erase(Node& table, const std::string& key) {
  std::erase_if(table.members, [&](const Member& member) { return member.key == key; });
}

const std::string* nameOf(const Node& table) {
  const Member* name = table.find("name");
  return name && name->value.kind == NodeKind::text ? &name->value.text : nullptr;
}

void setName(Node& table, const std::string& name) {
  Member* member = table.find("name");
  if (!member) {
    table.members.push_back({"name", table.line, table.column, {}});
    member = &table.members.back();
    member->value.line = table.line;
    member->value.column = table.column;
    member->value.source = table.source;
    member->value.again = table.again;
  }
  member->value.kind = NodeKind::text;
  member->value.text = name;
}

void place(Node& table, const Placement& placement, const std::string& title) {
  Expansion expansion;
  if (table.expansion) expansion = *table.expansion;
  expansion.placement = placement * expansion.placement;
  if (!title.empty()) expansion.title = title;
  table.expansion = std::make_shared<const Expansion>(std::move(expansion));
}

bool isTables(const Node& node) {
  return node.kind == NodeKind::array &&
         std::any_of(node.items.begin(), node.items.end(), [](const Node& n) { return n.kind == NodeKind::table; });
}

}  // namespace brickfall::scene
