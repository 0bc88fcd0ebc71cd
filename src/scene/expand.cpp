// Each table with a `repeat` becomes as many tables; $i and what `let` names are put into their texts as numbers. Then groups
// give their tables to the top level, placed, and copies add theirs.
#include "scene/expand.h"

#include <algorithm>
#include <map>
#include <set>

#include "scene/nearest.h"
#include "scene/repetition.h"

namespace brickfall::scene {

namespace {

constexpr std::size_t kMostNodes = 1'500'000;  // made by repetitions and copies
constexpr int kDeepestCopy = 8;

// Keys that name other tables.
bool isReference(const std::string& key) {
  for (const char* one : {"body_a", "body_b", "body", "of", "look_at", "aim_at", "tied_to"})
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
    const std::vector<Instance> instances = instancesOf(context_, table, path);
    if (!plain && !roomFor(table, path, instances.size())) return out;
    for (std::size_t k = 0; k < instances.size() && !full_; k++) {
      const Instance& one = instances[k];
      Node made = table;
      if (k > 0) markAgain(made);
      erase(made, "repeat");
      substitute(made, one.values);
      const std::string title = one.words.empty() ? std::string() : path + " with " + one.words;
      bindNames(context_, made, title.empty() ? path : title);
      const std::string* name = nameOf(table);
      if (!one.number.empty() && name && name->find('$') == std::string::npos) setName(made, *name + "/" + one.number);
      if (!one.number.empty()) place(made, one.placement, title);
      expandInside(made, title.empty() ? path : title);
      out.push_back(std::move(made));
    }
    return out;
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
    const std::vector<Instance> instances = instancesOf(context_, copy, path);
    erase(copy, "repeat");
    if (full_ || !roomFor(copy, path, instances.size())) return out;
    for (const Instance& one : instances) {
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
