// The one translation unit that sees toml++, without exceptions. Some faulty texts ("[$", for one) trip asserts of
// toml++ 3.3 that guard nothing: with them off, it reports those texts like others. NDEBUG would turn them into assumptions.
#undef NDEBUG
#define TOML_ASSERT(expr) static_cast<void>(0)
#define TOML_EXCEPTIONS 0
#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#include <toml++/toml.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "scene/toml_depth.h"
#include "scene/toml_document.h"

namespace brickfall::scene {

namespace {

constexpr int kMaxSyntaxErrors = 20;

void place(Node& node, const toml::source_region& source) {
  node.line = int(source.begin.line);
  node.column = int(source.begin.column);
}

Node convert(const toml::node& from);

void convertTable(Node& to, const toml::table& from) {
  for (auto&& [key, value] : from) {
    Member member;
    member.key = std::string(key.str());
    member.line = int(key.source().begin.line);
    member.column = int(key.source().begin.column);
    member.value = convert(value);
    to.members.push_back(std::move(member));
  }
  auto before = [](const Member& a, const Member& b) {
    return a.line != b.line ? a.line < b.line : a.column < b.column;
  };
  std::stable_sort(to.members.begin(), to.members.end(), before);
}

Node convert(const toml::node& from) {
  Node to;
  place(to, from.source());
  if (auto* table = from.as_table()) {
    to.kind = NodeKind::table;
    convertTable(to, *table);
  } else if (auto* array = from.as_array()) {
    to.kind = NodeKind::array;
    for (const toml::node& item : *array) to.items.push_back(convert(item));
    if (to.line == 0 && !to.items.empty()) to.line = to.items[0].line, to.column = to.items[0].column;
  } else if (auto* text = from.as_string()) {
    to.kind = NodeKind::text;
    to.text = text->get();
  } else if (auto* integer = from.as_integer()) {
    to.kind = NodeKind::integer;
    to.integer = integer->get();
    to.number = double(to.integer);
  } else if (auto* number = from.as_floating_point()) {
    to.kind = NodeKind::number;
    to.number = number->get();
  } else if (auto* boolean = from.as_boolean()) {
    to.kind = NodeKind::boolean;
    to.boolean = boolean->get();
  } else {
    to.kind = NodeKind::date;
  }
  return to;
}

// On one line, and cut between characters of UTF-8.
std::string shortened(const std::string& text) {
  std::size_t length = std::min<std::size_t>(text.size(), 40);
  while (length < text.size() && length > 0 && (text[length] & 0xC0) == 0x80) length--;
  std::string out = text.substr(0, length);
  for (char& c : out)
    if (std::uint8_t(c) < 0x20) c = ' ';
  return length < text.size() ? out + "..." : out;
}

// Blanks line `line` (from 1) if it is a plain "key = value"; anything else may carry structure that must not be lost.
bool blankLine(std::string& text, int line) {
  std::size_t from = 0;
  for (int i = 1; i < line; i++) {
    from = text.find('\n', from);
    if (from == std::string::npos) return false;
    from++;
  }
  std::size_t to = std::min(text.find('\n', from), text.size());
  std::string_view content = std::string_view(text).substr(from, to - from);
  std::size_t equals = content.find('=');
  std::string_view key = content.substr(0, std::min(equals, content.size()));
  bool plain = equals != std::string_view::npos && key.find_first_of("[]{}#\"'") == std::string_view::npos;
  if (!plain) return false;
  std::fill(text.begin() + long(from), text.begin() + long(to), ' ');
  return true;
}

}  // namespace

TomlDocument readToml(std::string_view text, const std::string& fileName) {
  TomlDocument document;
  std::string rest(text);
  if (int line = lineOfTooManyDots(text)) {
    std::string most = std::to_string(kMaxDottedKeys);
    document.errors.push_back({Severity::error, fileName, line, 1, "",
                               "found keys nested too deeply, expected at most " + most + " dots in keys"});
    document.usable = false;
    return document;
  }
  int lastLine = 0;
  for (int attempt = 0;; attempt++) {
    toml::parse_result result = toml::parse(std::string_view(rest));
    if (result) {
      convertTable(document.root, result.table());
      document.root.line = document.root.column = 1;
      return document;
    }
    toml::source_position at = result.error().source().begin;
    int line = int(at.line);
    if (line <= lastLine || attempt >= kMaxSyntaxErrors) break;
    std::string what(result.error().description());
    document.errors.push_back({Severity::error, fileName, line, int(at.column), "", "not TOML: " + what});
    lastLine = line;
    if (!blankLine(rest, line)) break;
  }
  document.usable = false;
  return document;
}

std::string numberText(double value) {
  char buffer[40];
  double size = std::fabs(value);
  bool plain = value == 0 || (size >= 1e-5 && size < 1e12);
  auto end = plain ? std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed)
                   : std::to_chars(buffer, buffer + sizeof buffer, value);
  return std::string(buffer, end.ptr);
}

std::string describe(const Node& node) {
  switch (node.kind) {
    case NodeKind::boolean:
      return node.boolean ? "true" : "false";
    case NodeKind::integer:
      return std::to_string(node.integer);
    case NodeKind::number:
      return numberText(node.number);
    case NodeKind::text:
      return "the text \"" + shortened(node.text) + "\"";
    case NodeKind::date:
      return "a date or time";
    case NodeKind::array:
      return "an array of " + std::to_string(node.items.size());
    case NodeKind::table:
      break;
  }
  return "a table";
}

}  // namespace brickfall::scene
