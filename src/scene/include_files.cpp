#include "scene/include_files.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scene/toml_document.h"

namespace brickfall::scene {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostFiles = 100;
constexpr std::uintmax_t kMostBytes = 16u << 20;  // of all of them

void setSource(Node& node, int source) {
  node.source = source;
  for (Node& item : node.items) setSource(item, source);
  for (Member& member : node.members) setSource(member.value, source);
}

// Values of `over` count; of arrays of tables `under` has the first.
void merge(Node& under, Node&& over) {
  for (Member& member : over.members) {
    Member* known = under.find(member.key);
    if (!known) {
      under.members.push_back(std::move(member));
    } else if (known->value.kind == NodeKind::table && member.value.kind == NodeKind::table) {
      merge(known->value, std::move(member.value));
    } else if (known->value.kind == NodeKind::array && member.value.kind == NodeKind::array &&
               !known->value.items.empty() && known->value.items[0].kind == NodeKind::table) {
      for (Node& item : member.value.items) known->value.items.push_back(std::move(item));
    } else {
      *known = std::move(member);
    }
  }
}

class Includer {
 public:
  explicit Includer(ReadContext& context) : context_(context) {}

  void run(Node& root, const std::string& file) {
    const Member* member = root.find("include");
    if (!member) return;
    const Node wanted = member->value;
    std::erase_if(root.members, [](const Member& one) { return one.key == "include"; });
    std::vector<const Node*> names;
    if (wanted.kind == NodeKind::text) names.push_back(&wanted);
    for (const Node& item : wanted.items) names.push_back(&item);
    if (wanted.kind != NodeKind::text && wanted.kind != NodeKind::array)
      context_.error(wanted, "include",
                     "found " + describe(wanted) + ", expected the name of a scene file, or several");
    active_.push_back(fs::weakly_canonical(file, ignored_).string());
    Node under;
    for (const Node* name : names) {
      if (name->kind != NodeKind::text)
        context_.error(*name, "include", "found " + describe(*name) + ", expected the name of a scene file");
      else
        read(under, *name, file);
    }
    active_.pop_back();
    under.line = root.line, under.column = root.column, under.source = root.source;
    merge(under, std::move(root));
    root = std::move(under);
  }

 private:
  void read(Node& under, const Node& name, const std::string& from) {
    const std::string path = (fs::path(from).parent_path() / name.text).string();
    const auto refuse = [&](const std::string& why) {
      context_.error(name, "include", "found \"" + path + "\": " + why + ", expected a scene file");
    };
    const std::string canonical = fs::weakly_canonical(path, ignored_).string();
    if (std::count(active_.begin(), active_.end(), canonical) > 0) return refuse("it includes itself");
    if (!fs::is_regular_file(path, ignored_)) return refuse("there is no such file");
    if (context_.sources.size() >= kMostFiles) return refuse("it is one of more than " + std::to_string(kMostFiles));
    bytes_ += fs::file_size(path, ignored_);
    if (!(bytes_ <= kMostBytes)) return refuse("all included files together have over 16 MiB");
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
    if (!file.is_open() || file.bad()) return refuse("it cannot be read");
    TomlDocument document = readToml(text.str(), path);
    context_.diagnostics.insert(context_.diagnostics.end(), document.errors.begin(), document.errors.end());
    context_.syntaxErrors = context_.syntaxErrors || !document.errors.empty();
    if (!document.usable) return;
    setSource(document.root, int(context_.sources.size()));
    context_.sources.push_back(path);
    run(document.root, path);
    merge(under, std::move(document.root));
  }

  ReadContext& context_;
  std::vector<std::string> active_;
  std::uintmax_t bytes_ = 0;
  std::error_code ignored_;
};

}  // namespace

void mergeIncludes(ReadContext& context, Node& root) { Includer(context).run(root, context.file); }

}  // namespace brickfall::scene
