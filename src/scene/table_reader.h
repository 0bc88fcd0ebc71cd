// Reads the values of one table of a scene file by the table of keys, and notes every mistake with its place.
#pragma once
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "brickfall/scene.h"
#include "scene/expression.h"
#include "scene/keys.h"
#include "scene/node.h"

namespace brickfall::scene {

// What all readers of a file share.
struct ReadContext {
  std::string file;                  // the scene file
  std::vector<std::string> sources;  // files by Node::source: that one, and what it includes
  std::vector<Diagnostic> diagnostics;
  std::map<std::string, double> parameters;
  std::vector<std::string> materialNames, mortarNames;
  std::vector<BrickKind> brickKinds;
  bool syntaxErrors = false;  // lines were left out: a missing key may be one of them
  std::uint64_t seed = 1;     // of random()
  bool seedKnown = false;
  std::set<std::tuple<int, int, int, std::string>> told;  // source, line, column and key of mistakes

  void add(Severity severity, const Node& at, std::string path, std::string message);
  void error(const Node& at, std::string path, std::string message) {
    add(Severity::error, at, std::move(path), std::move(message));
  }
  ParameterLookup lookup() const;
  // Of one expression: always the same numbers for the seed and the path of the key.
  RandomSource random(const std::string& path) const;
};

bool isParameterName(const std::string& name);
// The world's seed, as far as random() needs it; then a file's [parameters] become numbers; each may use the others in any order.
void readParameters(ReadContext& context, const Node& root);

class TableReader {
 public:
  // Reports keys that the table does not have. `path` as a user writes it: "wall[0].opening[1]".
  TableReader(ReadContext& context, const Node& node, std::string table, std::string path);

  bool has(const char* key) const { return node_.find(key) != nullptr; }
  const Node* value(const char* key) const;
  const std::string& path() const { return path_; }
  const Node& node() const { return node_; }
  std::string pathOf(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  std::size_t mistakes() const { return context_->diagnostics.size(); }  // of the file so far
  // At the key's value, or at the table if the key is absent.
  void error(const std::string& key, std::string message);
  void warning(const std::string& key, std::string message);

  // Each leaves `out` as it is if the key is absent or wrong, and returns true if it was read.
  bool number(const char* key, double& out);
  bool integer(const char* key, int& out);
  bool integer(const char* key, std::uint64_t& out);
  bool boolean(const char* key, bool& out);
  bool text(const char* key, std::string& out);  // text, name
  bool material(const char* key, std::string& out);
  bool mortar(const char* key, std::string& out);  // mortarKind, and mortar where it is a name
  bool colour(const char* key, std::uint32_t& out);
  bool vector(const char* key, Vec3& out);  // vector, positive, counts; points and directions as placed
  // Turns about x, then y, then z in degrees; as placed.
  bool rotation(const char* key, Quat& out);
  bool gravity(const char* key, Vec3& out);
  bool brick(const char* key, BrickKind& out);  // without a name: a solid one of that size
  bool pair(const char* key, double& a, double& b);
  bool points(const char* key, std::vector<Vec3>& out);
  bool times(const char* key, std::vector<double>& out);
  bool planPoints(const char* key, std::vector<Vec3>& out);  // [[x, z], ...]
  bool numbers(const char* key, std::vector<int>& out);
  bool texts(const char* key, std::vector<std::string>& out);  // one text, or several
  template <class E> bool choice(const char* key, E& out) {
    int index = 0;
    if (!choiceIndex(key, index)) return false;
    out = E(index);
    return true;
  }
  // The tables of an array of tables, each with its reader.
  std::vector<TableReader> tables(const char* key);
  // The reader of a sub-table; of an empty one if it is absent.
  TableReader table(const char* key);

 private:
  const KeySpec& spec(const char* key) const;
  const Node* sought(const char* key);  // absent and required: reported
  bool choiceIndex(const char* key, int& out);
  bool numberOf(const Node& node, const std::string& path, const KeySpec& spec, bool whole, double& out);
  bool vectorOf(const Node& node, const std::string& path, const KeySpec& spec, bool whole, Vec3& out);
  bool oneOf(const char* key, const std::vector<std::string>& names, std::string& out);
  void wrong(const Node& node, const std::string& path, const KeySpec& spec, const std::string& hint = {});
  void reportUnknownKeys();
  std::string whatIsThere() const;
  std::string unknownTable(const std::string& name) const;
  Vec3 placed(const KeySpec& spec, Vec3 value) const;

  ReadContext* context_;
  const Node& node_;
  std::string table_;
  std::string path_;
  Placement placement_;  // of the table and of those around it
};

}  // namespace brickfall::scene
