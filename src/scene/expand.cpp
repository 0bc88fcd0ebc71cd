// Each table with a `repeat` becomes as many tables; $i and what `let` names are put into their texts as numbers. Then groups
// give their tables to the top level, placed, and copies add theirs.
#include "scene/expand.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scene/nearest.h"

namespace brickfall::scene {

namespace {

constexpr std::size_t kMostNodes = 1'500'000;  // made by repetitions and copies
constexpr int kDeepestCopy = 8;

using Values = std::vector<std::pair<std::string, double>>;

bool isNameLetter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// The text with each $name of these as its number.
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

std::string indexNameOf(const Node& table) {
  const Member* repeat = table.find("repeat");
  if (!repeat) return {};
  const Member* index = repeat->value.kind == NodeKind::table ? repeat->value.find("index") : nullptr;
  return index && index->value.kind == NodeKind::text ? index->value.text : "i";
}

// A table inside with a repetition of its own hides a number of the same name, but not from its `repeat`.
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

// One of a repetition: the numbers that it has, where it stands, what it is called.
struct Instance {
  Values values;
  Placement placement;
  std::string number;  // "3", of a grid "1/0/2"; empty: there is no repetition
  std::string words;   // "i = 3"
};

class Repetition {
 public:
  Repetition(ReadContext& context, const Node& table, const std::string& path) : context_(context) {
    const Member* member = table.find("repeat");
    if (!member) {
      instances.push_back({});
      return;
    }
    Node short_;  // repeat = 5
    if (member->value.kind != NodeKind::table) {
      short_ = member->value;
      short_.items.clear();
      short_.kind = NodeKind::table;
      short_.members.push_back({"count", member->line, member->column, member->value});
    }
    TableReader reader(context, member->value.kind == NodeKind::table ? member->value : short_, "repeat",
                       path + ".repeat");
    read(reader);
  }
  std::vector<Instance> instances;

 private:
  void read(TableReader& reader) {
    const std::size_t before = context_.diagnostics.size();
    int count = 0;
    Vec3 grid{1, 1, 1}, step, about;
    double turn = 0;
    std::string index = "i";
    const bool counted = reader.integer("count", count), isGrid = reader.vector("grid", grid);
    reader.vector("step", step);
    const bool ring = reader.vector("about", about);
    const bool turns = reader.number("turn_degrees", turn);
    reader.text("index", index);
    if (reader.has("count") == reader.has("grid"))
      reader.error(reader.has("count") ? "grid" : "count",
                   reader.has("count") ? "found beside count, expected one of the two"
                                       : "not given, expected how many: count, or grid = [nx, ny, nz]");
    if (reader.has("turn_degrees") && !reader.has("about"))
      reader.error("turn_degrees", "found without about, expected the middle of a ring: about = [x, y, z]");
    if (reader.has("grid") && reader.has("about")) reader.error("about", "found beside grid, expected a ring's count");
    if (!isParameterName(index))
      reader.error("index", "found an unusable name, expected letters, digits and _, beginning with a letter");
    const double most = 100000;
    if (isGrid && !(grid.x * grid.y * grid.z <= most))
      reader.error("grid",
                   "found " + numberText(grid.x * grid.y * grid.z) + " in all, expected at most " + numberText(most));
    if (context_.diagnostics.size() != before || !(counted || isGrid)) return;
    if (ring && !turns && count > 0) turn = 360.0 / count;
    if (isGrid) return fillGrid(grid, step, index);
    for (int i = 0; i < count; i++) {
      Instance one;
      one.placement.yawDegrees = ring ? turn * i : 0;
      one.placement.position = step * double(i);
      if (ring) one.placement.position += about - turned(about, one.placement.yawDegrees);
      one.values = {{index, double(i)}, {index + "_count", double(count)}};
      one.number = std::to_string(i);
      one.words = index + " = " + one.number;
      instances.push_back(std::move(one));
    }
  }

  void fillGrid(Vec3 grid, Vec3 step, const std::string& index) {
    int number = 0;
    for (int y = 0; y < int(grid.y); y++)
      for (int z = 0; z < int(grid.z); z++)
        for (int x = 0; x < int(grid.x); x++) {
          Instance one;
          one.placement.position = {step.x * x, step.y * y, step.z * z};
          one.number = std::to_string(number);
          one.values = {{index, double(number++)},
                        {index + "_count", grid.x * grid.y * grid.z},
                        {index + "_x", double(x)},
                        {index + "_y", double(y)},
                        {index + "_z", double(z)}};
          one.words = index + " = " + one.number;
          instances.push_back(std::move(one));
        }
  }

  ReadContext& context_;
};

// Keys that name other tables.
bool isReference(const std::string& key) {
  for (const char* one : {"body_a", "body_b", "body", "of", "look_at", "tied_to"})
    if (key == one) return true;
  return false;
}

class Expander {
 public:
  Expander(ReadContext& context, Node& root) : context_(context), root_(root) {}

  void run() {
    for (Member& member : root_.members) {
      if (member.key == "group" || member.key == "copy" || !isTables(member.value)) continue;
      for (const Node& item : member.value.items)
        if (const std::string* name = nameOf(item)) originals_.emplace(*name, Original{member.key, item});
      expandArray(member.value, member.key, findKey("", member.key) != nullptr);
    }
    const Node groups = taken("group"), copies = taken("copy");
    for (std::size_t k = 0; k < groups.items.size(); k++) {
      const std::string* name = nameOf(groups.items[k]);
      if (name && !groups_.emplace(*name, groups.items[k]).second)
        context_.error(groups.items[k], "group[" + std::to_string(k) + "].name",
                       "found the name \"" + *name + "\" a second time, expected different names");
    }
    for (std::size_t k = 0; k < groups.items.size(); k++)
      addGroups(groups.items[k], "group[" + std::to_string(k) + "]", {}, 0);
    for (std::size_t k = 0; k < copies.items.size(); k++)
      addCopies(copies.items[k], "copy[" + std::to_string(k) + "]", 0);
  }

 private:
  struct Original {
    std::string table;
    Node node;
  };

  bool roomFor(const Node& node, const std::string& path, std::size_t times = 1) {
    nodes_ += sizeOf(node) * times;
    if (nodes_ <= kMostNodes) return true;
    if (!full_)
      context_.error(
          node, path,
          "the scene has more than " + std::to_string(kMostNodes) + " values with these repetitions, expected fewer");
    full_ = true;
    return false;
  }

  Node taken(const std::string& key) {
    Node out;
    if (Member* member = root_.find(key); member && isTables(member->value)) {
      out = std::move(member->value);
      erase(root_, key);
    }
    // Whatever else it is, the reader says so.
    std::erase_if(out.items, [](const Node& node) { return node.kind != NodeKind::table; });
    return out;
  }

  std::vector<Node> expanded(const Node& table, const std::string& path) {
    std::vector<Node> out;
    const bool plain = !table.find("repeat") && !table.find("let");
    if (full_) return out;
    Repetition repetition(context_, table, path);
    if (!plain && !roomFor(table, path, repetition.instances.size())) return out;
    for (std::size_t k = 0; k < repetition.instances.size() && !full_; k++) {
      const Instance& one = repetition.instances[k];
      Node made = table;
      if (k > 0) markAgain(made);
      erase(made, "repeat");
      substitute(made, one.values);
      const std::string title = one.words.empty() ? std::string() : path + " with " + one.words;
      bindNames(made, title.empty() ? path : title);
      const std::string* name = nameOf(table);
      if (!one.number.empty() && name && name->find('$') == std::string::npos) setName(made, *name + "/" + one.number);
      if (!one.number.empty()) place(made, one.placement, title);
      expandInside(made, title.empty() ? path : title);
      out.push_back(std::move(made));
    }
    return out;
  }

  // Numbers of `let`, each of which may use those before it.
  void bindNames(Node& table, const std::string& path) {
    Member* let = table.find("let");
    if (!let) return;
    const Node names = let->value;
    erase(table, "let");
    if (names.kind != NodeKind::table) {
      context_.error(names, path + ".let", "found " + describe(names) + ", expected a table of numbers");
      return;
    }
    Values values;
    for (const Member& member : names.members) {
      const std::string where = path + ".let." + member.key;
      if (!isParameterName(member.key)) {
        context_.error(member.value, where,
                       "found an unusable name, expected letters, digits and _, beginning with a letter");
        continue;
      }
      const Node& node = member.value;
      double value = node.number;
      if (node.kind == NodeKind::text) {
        const Evaluated result = evaluate(substituted(node.text, values), context_.lookup(), context_.random(where));
        if (!result.error.empty())
          context_.error(node, where,
                         "found " + describe(node) + ": " + result.error + ", expected a number or an expression");
        value = result.value;
      } else if ((node.kind != NodeKind::integer && node.kind != NodeKind::number) || !std::isfinite(value)) {
        context_.error(node, where, "found " + describe(node) + ", expected a finite number or an expression");
        value = 0;
      }
      values.push_back({member.key, value});
    }
    substitute(table, values);
  }

  void expandInside(Node& table, const std::string& path) {
    for (Member& member : table.members)
      if (isTables(member.value) && !(isGroup_ && member.key == "copy"))
        expandArray(member.value, path + "." + member.key, true);
  }

  void expandArray(Node& array, const std::string& path, bool known) {
    const bool anything = std::any_of(array.items.begin(), array.items.end(), [](const Node& item) {
      return item.find("repeat") || item.find("let") ||
             std::any_of(item.members.begin(), item.members.end(), [](const Member& m) { return isTables(m.value); });
    });
    if (!anything || !known) return;
    std::vector<Node> out;
    for (std::size_t k = 0; k < array.items.size(); k++) {
      Node& item = array.items[k];
      if (item.kind != NodeKind::table) {
        out.push_back(std::move(item));
        continue;
      }
      const bool repeated = item.find("repeat") || item.find("let");
      if (!repeated) {
        expandInside(item, path + "[" + std::to_string(k) + "]");
        out.push_back(std::move(item));
        continue;
      }
      for (Node& made : expanded(item, path + "[" + std::to_string(k) + "]")) out.push_back(std::move(made));
    }
    array.items = std::move(out);
  }

  void append(const std::string& table, Node&& node) {
    Member* member = root_.find(table);
    if (!member || member->value.kind != NodeKind::array) {
      if (member) return;  // its reader says that it is no array
      Member fresh;
      fresh.key = table;
      fresh.line = node.line;
      fresh.column = node.column;
      fresh.value.kind = NodeKind::array;
      fresh.value.line = node.line;
      fresh.value.column = node.column;
      root_.members.push_back(std::move(fresh));
      member = &root_.members.back();
    }
    member->value.items.push_back(std::move(node));
  }

  // All of a group's repetitions.
  void addGroups(const Node& group, const std::string& path, const Placement& around, int depth) {
    isGroup_ = true;
    std::vector<Node> made = expanded(group, path);
    isGroup_ = false;
    for (Node& one : made) {
      const std::string title = one.expansion && !one.expansion->title.empty() ? one.expansion->title : path;
      addGroup(one, title, around, depth);
    }
  }

  void addGroup(Node& group, const std::string& path, const Placement& around, int depth) {
    Placement inGroup = around;
    if (group.expansion) inGroup = around * group.expansion->placement;
    group.expansion.reset();
    TableReader reader(context_, group, "group", path);
    std::string name;
    Placement own;
    bool isTemplate = false;
    reader.text("name", name);
    reader.vector("position", own.position);
    reader.number("yaw_degrees", own.yawDegrees);
    reader.boolean("template", isTemplate);
    if (name.empty() || (isTemplate && depth == 0)) return;
    own = inGroup * own;
    std::set<std::string> names;
    for (const Member& member : group.members)
      if (member.value.kind == NodeKind::array)
        for (const Node& item : member.value.items)
          if (const std::string* inside = nameOf(item)) names.insert(*inside);
    std::vector<std::pair<Node, std::string>> copies;
    for (Member& member : group.members) {
      const KeySpec* spec = findKey("group", member.key);
      if (!spec || spec->kind != KeyKind::tables) continue;
      if (member.value.kind != NodeKind::array) {
        reader.error(member.key, "found " + describe(member.value) + ", expected " + expectation(*spec));
        continue;
      }
      for (std::size_t k = 0; k < member.value.items.size(); k++) {
        Node& item = member.value.items[k];
        const std::string itemPath = path + "." + member.key + "[" + std::to_string(k) + "]";
        if (item.kind != NodeKind::table) {
          context_.error(item, itemPath, "found " + describe(item) + ", expected " + expectation(*spec));
          continue;
        }
        if (!roomFor(item, path)) return;
        prefix(item, name, names);
        place(item, own, titleIn(path, item, itemPath));
        if (member.key == "copy") {
          copies.push_back({std::move(item), itemPath});
          continue;
        }
        if (const std::string* inside = nameOf(item)) originals_.emplace(*inside, Original{member.key, item});
        append(member.key, std::move(item));
      }
    }
    for (auto& [copy, where] : copies) addCopies(copy, where, depth + 1);
  }

  // "group[0] with i = 2.wall[1]"
  static std::string titleIn(const std::string& path, const Node& item, const std::string& itemPath) {
    const bool has = item.expansion && !item.expansion->title.empty();
    return has && item.expansion->title.starts_with(path) ? item.expansion->title : itemPath;
  }

  static void prefix(Node& table, const std::string& name, const std::set<std::string>& names) {
    const auto inside = [&](const std::string& text) {
      return names.count(text) > 0 || names.count(text.substr(0, text.find('/'))) > 0 ||
             std::any_of(names.begin(), names.end(),
                         [&](const std::string& one) { return text.starts_with(one + "/"); });
    };
    if (const std::string* own = nameOf(table)) setName(table, name + "/" + *own);
    for (Member& member : table.members) {
      if (!isReference(member.key)) continue;
      if (member.value.kind == NodeKind::text && inside(member.value.text))
        member.value.text = name + "/" + member.value.text;
      for (Node& item : member.value.items)
        if (item.kind == NodeKind::text && inside(item.text)) item.text = name + "/" + item.text;
    }
  }

  void addCopies(const Node& copy, const std::string& path, int depth) {
    if (depth > kDeepestCopy) {
      context_.error(copy, path,
                     "found copies of copies, more than " + std::to_string(kDeepestCopy) +
                         " deep, expected groups that do not copy themselves");
      return;
    }
    Placement around;
    Node plain = copy;
    if (copy.expansion) around = copy.expansion->placement;
    plain.expansion.reset();
    for (const Node& one : expandedCopies(plain, path)) {
      Placement here = around;
      Node made = one;
      if (one.expansion) here = around * one.expansion->placement;
      const std::string title = one.expansion && !one.expansion->title.empty() ? one.expansion->title : path;
      made.expansion.reset();
      addCopy(made, title, here, depth);
    }
  }

  // `let` of a copy goes to what is copied, so that it stays.
  std::vector<Node> expandedCopies(Node copy, const std::string& path) {
    std::optional<Member> let;
    if (const Member* member = copy.find("let")) let = *member;
    erase(copy, "let");
    std::vector<Node> out;
    Repetition repetition(context_, copy, path);
    erase(copy, "repeat");
    if (full_ || !roomFor(copy, path, repetition.instances.size())) return out;
    for (const Instance& one : repetition.instances) {
      Node made = copy;
      if (let) made.members.push_back(*let);
      if (!out.empty()) markAgain(made);
      substitute(made, one.values);
      const std::string* name = nameOf(copy);
      if (!one.number.empty() && name && name->find('$') == std::string::npos) setName(made, *name + "/" + one.number);
      if (!one.number.empty()) place(made, one.placement, path + " with " + one.words);
      out.push_back(std::move(made));
    }
    return out;
  }

  void addCopy(const Node& copy, const std::string& path, const Placement& around, int depth) {
    const Member* of = copy.find("of");
    if (!of || of->value.kind != NodeKind::text) {
      if (!of) context_.error(copy, path + ".of", "not given, expected the name of what is copied");
      if (of) context_.error(of->value, path + ".of", "found " + describe(of->value) + ", expected a name");
      return;
    }
    const std::string& name = of->value.text;
    const auto group = groups_.find(name);
    const auto table = originals_.find(name);
    if (group == groups_.end() && table == originals_.end()) {
      std::vector<std::string> known;
      for (const auto& [one, node] : groups_) known.push_back(one);
      for (const auto& [one, original] : originals_) known.push_back(one);
      context_.error(
          of->value, path + ".of",
          "found \"" + name + "\", expected the name of a group or of another table" + didYouMean(name, known));
      return;
    }
    Node made = group != groups_.end() ? group->second : table->second.node;
    if (!roomFor(made, path)) return;
    markAgain(made);
    const bool replaced = copy.find("position") || copy.find("yaw_degrees");
    Placement here = around;
    if (made.expansion && !replaced) here = around * made.expansion->placement;
    made.expansion.reset();
    setName(made, nameFor(name));
    overlay(made, copy);
    if (group != groups_.end()) return addGroups(made, path, here, depth + 1);
    made.line = copy.line, made.column = copy.column, made.again = false;
    for (Node& one : expanded(made, path)) {
      place(one, here, one.expansion ? one.expansion->title : path + " of \"" + name + "\"");
      append(table->second.table, std::move(one));
    }
  }

  std::string nameFor(const std::string& of) {
    const int number = ++copied_[of];
    return of + " copy" + (number > 1 ? " " + std::to_string(number) : "");
  }

  // The copy's own values count.
  static void overlay(Node& made, const Node& copy) {
    for (const Member& member : copy.members) {
      if (member.key == "of") continue;
      Member* there = made.find(member.key);
      if (!there) {
        made.members.push_back(member);
      } else if (member.key == "let" && there->value.kind == NodeKind::table && member.value.kind == NodeKind::table) {
        for (const Member& one : member.value.members) {
          Member* known = there->value.find(one.key);
          if (known)
            *known = one;
          else
            there->value.members.insert(there->value.members.begin(), one);
        }
      } else {
        *there = member;
      }
    }
  }

  ReadContext& context_;
  Node& root_;
  std::map<std::string, Original> originals_;
  std::map<std::string, Node> groups_;
  std::map<std::string, int> copied_;
  std::size_t nodes_ = 0;
  bool full_ = false, isGroup_ = false;
};

}  // namespace

void expandScene(ReadContext& context, Node& root) { Expander(context, root).run(); }

}  // namespace brickfall::scene
