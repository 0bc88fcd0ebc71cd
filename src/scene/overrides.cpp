// Paths are "world.time_step", "wall[0].courses", "ball[0].velocity[2]"; the index may be left out where an array has
// one entry. A name alone is that of a parameter, if the file has it. "ball[+]" is a table that is added; a table that is set to
// none is taken out.
#include "scene/overrides.h"

#include <charconv>
#include <optional>

#include "scene/nearest.h"
#include "scene/toml_document.h"

namespace brickfall::scene {

namespace {

struct Segment {
  std::string name;
  std::vector<std::size_t> indices;
  bool added = false;  // [+]
};

// Nothing if the path is malformed.
std::optional<std::vector<Segment>> splitPath(const std::string& path) {
  std::vector<Segment> segments;
  std::size_t at = 0;
  while (true) {
    std::size_t end = std::min(path.find_first_of(".[", at), path.size());
    Segment segment;
    segment.name = path.substr(at, end - at);
    if (segment.name.empty() || segment.name.find(']') != std::string::npos) return std::nullopt;
    while (end < path.size() && path[end] == '[') {
      if (path.compare(end, 3, "[+]") == 0) {
        if (segment.added || !segment.indices.empty()) return std::nullopt;
        segment.added = true;
        end += 3;
        continue;
      }
      std::size_t index = 0;
      auto result = std::from_chars(path.data() + end + 1, path.data() + path.size(), index);
      std::size_t close = std::size_t(result.ptr - path.data());
      if (result.ec != std::errc() || close >= path.size() || path[close] != ']') return std::nullopt;
      segment.indices.push_back(index);
      end = close + 1;
    }
    segments.push_back(std::move(segment));
    if (end == path.size()) return segments;
    if (path[end] != '.') return std::nullopt;
    at = end + 1;
  }
}

void markOverride(Node& node) {
  node.fromOverride = true;
  node.line = node.column = 0;
  for (Node& item : node.items) markOverride(item);
  for (Member& member : node.members) {
    member.line = member.column = 0;
    markOverride(member.value);
  }
}

// A TOML value; anything else is taken as a text, so that a shell needs no double quotes.
Node valueOf(const std::string& text) {
  TomlDocument document = readToml("v = " + text + "\n", "--set");
  Node node;
  if (document.usable && document.errors.empty() && document.root.members.size() == 1) {
    node = document.root.members[0].value;
  } else {
    node.kind = NodeKind::text;
    node.text = text;
  }
  markOverride(node);
  return node;
}

class Override {
 public:
  Override(ReadContext& context, Node& root, const std::string& key) : context_(context), root_(root), key_(key) {}

  void apply(const std::string& value) {
    auto path = splitPath(key_);
    if (!path) return fail("found a malformed path, expected one such as \"world.seconds\" or \"wall[0].courses\"");
    if (value.empty()) return fail("found no value, expected one such as \"" + key_ + "=1\"");
    std::vector<Segment> segments = *path;
    const Member* parameters = root_.find("parameters");
    bool isParameter = segments.size() == 1 && parameters && parameters->value.find(segments[0].name) &&
                       !findKey("", segments[0].name);
    if (isParameter) segments.insert(segments.begin(), Segment{"parameters", {}});
    if (segments[0].name == "include") return fail("found a file to include, expected it in the scene file itself");
    if (value == "none" && removes(segments)) return remove(segments);
    if (Node* target = navigate(segments)) *target = valueOf(value);
  }

 private:
  void fail(std::string message) {
    Node at;
    at.fromOverride = true;
    context_.error(at, key_, std::move(message));
  }

  // True if it names a table, or all tables of a kind. ("none" is a value of `mortar`.)
  static bool removes(const std::vector<Segment>& segments) {
    std::string table;
    const KeySpec* spec = nullptr;
    for (const Segment& segment : segments) {
      spec = findKey(table, segment.name);
      if (!spec || segment.added) return false;
      table += (table.empty() ? "" : ".") + segment.name;
    }
    return spec->kind == KeyKind::table || spec->kind == KeyKind::tables || spec->kind == KeyKind::parameters;
  }

  // All of a kind, unless an index says which.
  void remove(const std::vector<Segment>& segments) {
    const Segment& last = segments.back();
    std::vector<Segment> around(segments.begin(), segments.end() - 1);
    Node* owner = around.empty() ? &root_ : navigate(around, true);
    if (!owner) return;
    Member* member = owner->find(last.name);
    if (!member) return fail("the scene has no \"" + last.name + "\", expected a path to what it has");
    if (last.indices.empty()) {
      std::erase_if(owner->members, [&](const Member& one) { return one.key == last.name; });
      return;
    }
    Node& array = member->value;
    if (Node* one = index(array, last, false); one && last.indices.size() == 1)
      array.items.erase(array.items.begin() + long(last.indices[0]));
  }

  Node* navigate(const std::vector<Segment>& segments, bool toTable = false) {
    Node* node = &root_;
    std::string table;
    for (std::size_t i = 0; i < segments.size(); i++) {
      bool last = i + 1 == segments.size() && !toTable;
      bool inParameters = table == "parameters";
      const KeySpec* spec = inParameters ? nullptr : findKey(table, segments[i].name);
      if (inParameters ? !node->find(segments[i].name) : !spec) return unknown(*node, table, segments[i].name);
      Member* member = node->find(segments[i].name);
      if (!member) member = create(*node, segments[i], spec);
      node = member ? index(member->value, segments[i], spec && spec->kind == KeyKind::tables && !last) : nullptr;
      if (!node) return nullptr;
      if (last) return node;
      if (node->kind != NodeKind::table) {
        fail("found " + describe(*node) + " at \"" + segments[i].name + "\", expected a table");
        return nullptr;
      }
      table += (table.empty() ? "" : ".") + segments[i].name;
    }
    return node;  // toTable
  }

  // The array gets one more table.
  Node* add(Node& array) {
    if (array.kind != NodeKind::array) {
      fail("found [+] of " + describe(array) + ", expected an array of tables");
      return nullptr;
    }
    Node fresh;
    markOverride(fresh);
    array.items.push_back(std::move(fresh));
    return &array.items.back();
  }

  Member* create(Node& node, const Segment& segment, const KeySpec* spec) {
    const bool first = spec && spec->kind == KeyKind::tables && segment.added;
    if (!first && (!spec || spec->kind == KeyKind::tables || !segment.indices.empty() || segment.added)) {
      fail("the scene has no \"" + segment.name + "\", expected a path to what it has" +
           (spec && spec->kind == KeyKind::tables ? ", or " + segment.name + "[+] to add one" : ""));
      return nullptr;
    }
    Member member;
    member.key = segment.name;
    if (first) member.value.kind = NodeKind::array;
    markOverride(member.value);
    node.members.push_back(std::move(member));
    return &node.members.back();
  }

  Node* index(Node& value, const Segment& segment, bool mayBeLeftOut) {
    if (segment.added) return add(value);
    Node* node = &value;
    std::vector<std::size_t> indices = segment.indices;
    if (indices.empty() && mayBeLeftOut && node->kind == NodeKind::array) {
      if (node->items.empty()) {
        fail("the scene has no \"" + segment.name + "\", expected a path to what it has");
        return nullptr;
      }
      if (node->items.size() > 1) {
        fail("the scene has " + std::to_string(node->items.size()) + " of \"" + segment.name +
             "\", expected an index: " + segment.name + "[0] .. " + segment.name + "[" +
             std::to_string(node->items.size() - 1) + "]");
        return nullptr;
      }
      indices.push_back(0);
    }
    for (std::size_t i : indices) {
      if (node->kind != NodeKind::array || i >= node->items.size()) {
        bool array = node->kind == NodeKind::array && !node->items.empty();
        std::string last = array ? std::to_string(node->items.size() - 1) : std::string();
        fail("found index [" + std::to_string(i) + "] of \"" + segment.name + "\", expected " +
             (array ? "[0] .. [" + last + "]" : "no index: it is " + describe(*node)));
        return nullptr;
      }
      node = &node->items[i];
    }
    return node;
  }

  Node* unknown(const Node& node, const std::string& table, const std::string& name) {
    std::vector<std::string> known = table == "parameters" ? std::vector<std::string>{} : keysOf(table);
    if (table == "parameters")
      for (const Member& member : node.members) known.push_back(member.key);
    if (const Member* parameters = table.empty() ? node.find("parameters") : nullptr)
      for (const Member& member : parameters->value.members) known.push_back(member.key);
    std::string hint = didYouMean(name, known);
    std::string owner = hint.empty() ? ownerOfKey(name) : std::string();
    if (!owner.empty()) hint = " (\"" + name + "\" is a key of " + owner + ")";
    std::string what = table == "parameters" ? "parameter" : "key";
    fail("found an unknown " + what + " \"" + name + "\", expected a " + what + " of " + tableTitle(table) + hint);
    return nullptr;
  }

  ReadContext& context_;
  Node& root_;
  const std::string& key_;
};

}  // namespace

void applyOverride(ReadContext& context, Node& root, const std::string& key, const std::string& value) {
  Override(context, root, key).apply(value);
}

}  // namespace brickfall::scene
