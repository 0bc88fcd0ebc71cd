// "found ..., expected ... (did you mean ...?)" for every value of a table.
#include "scene/table_reader.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "masonry/named_seed.h"
#include "math/random.h"
#include "scene/nearest.h"

namespace brickfall::scene {

namespace {

const Node kEmptyTable;

constexpr int kMostUnknownKeys = 200;  // told of one table: each costs a search for the nearest
constexpr std::size_t kMostParameters = 1000;

bool isTableKind(KeyKind kind) {
  return kind == KeyKind::tables || kind == KeyKind::table || kind == KeyKind::parameters;
}

bool isNumber(const Node& node) { return node.kind == NodeKind::integer || node.kind == NodeKind::number; }

// Evaluates parameters as they are needed by each other.
class ParameterReader {
 public:
  ParameterReader(ReadContext& context, const Node& table) : context_(context), table_(table) {}

  // A seed that needs a random number has none: it stays 1.
  void readSeed(const Node& root) {
    const Member* world = root.find("world");
    const Member* seed = world && world->value.kind == NodeKind::table ? world->value.find("seed") : nullptr;
    double value = 1;
    if (seed && isNumber(seed->value)) value = seed->value.number;
    if (seed && seed->value.kind == NodeKind::text) {
      auto lookup = [this](const std::string& name, std::string& error) { return valueOf(name, error); };
      const Evaluated result = evaluate(seed->value.text, lookup);
      if (result.error.empty()) value = result.value;
    }
    if (value >= 0 && value <= 9007199254740992.0) context_.seed = std::uint64_t(value);
    context_.seedKnown = true;
  }

  void run() {
    for (const Member& member : table_.members) {
      if (!isParameterName(member.key)) {
        context_.error(member.value, "parameters." + member.key,
                       "found an unusable name, expected letters, digits and _, beginning with a letter");
        continue;
      }
      std::string ignored;
      valueOf(member.key, ignored);
    }
  }

 private:
  std::optional<double> valueOf(const std::string& name, std::string& error) {
    if (auto known = context_.parameters.find(name); known != context_.parameters.end()) return known->second;
    const Member* member = table_.find(name);
    if (!member) {
      std::vector<std::string> names;
      for (const Member& other : table_.members) names.push_back(other.key);
      error = "unknown parameter \"$" + name + "\"" + didYouMean(name, names);
      return std::nullopt;
    }
    if (std::count(active_.begin(), active_.end(), name) > 0) {
      error = "parameter \"$" + name + "\" depends on itself";
      return std::nullopt;
    }
    if (std::count(failed_.begin(), failed_.end(), name) > 0) {
      error = "parameter \"$" + name + "\" has no value";
      return std::nullopt;
    }
    active_.push_back(name);
    std::optional<double> value = compute(*member);
    active_.pop_back();
    if (value) {
      context_.parameters[name] = *value;
    } else {
      failed_.push_back(name);
      error = "parameter \"$" + name + "\" has no value";
    }
    return value;
  }

  std::optional<double> compute(const Member& member) {
    const Node& node = member.value;
    std::string path = "parameters." + member.key;
    if (isNumber(node) && std::isfinite(node.number)) return node.number;
    if (node.kind != NodeKind::text) {
      context_.error(node, path, "found " + describe(node) + ", expected a finite number or an expression");
      return std::nullopt;
    }
    auto lookup = [this](const std::string& name, std::string& error) { return valueOf(name, error); };
    Evaluated result = evaluate(node.text, lookup, context_.random(path));
    if (result.error.empty()) return result.value;
    context_.error(node, path,
                   "found " + describe(node) + ": " + result.error + ", expected a number or an expression");
    return std::nullopt;
  }

  ReadContext& context_;
  const Node& table_;
  std::vector<std::string> active_, failed_;
};

}  // namespace

bool isParameterName(const std::string& name) {
  if (name.empty() || name.size() > 64 || (name[0] >= '0' && name[0] <= '9')) return false;
  return std::all_of(name.begin(), name.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
  });
}

void ReadContext::add(Severity severity, const Node& at, std::string path, std::string message) {
  const std::string key = path.substr(path.find_last_of('.') + 1);
  const bool fresh = told.emplace(at.source, at.line, at.column, key).second;
  if (at.again && !fresh) return;
  const bool included = at.source > 0 && std::size_t(at.source) < sources.size();
  Diagnostic diagnostic;
  diagnostic.severity = severity;
  diagnostic.file = at.fromOverride ? "--set" : included ? sources[std::size_t(at.source)] : file;
  diagnostic.line = at.fromOverride ? 0 : at.line;
  diagnostic.column = at.fromOverride ? 0 : at.column;
  diagnostic.key = std::move(path);
  diagnostic.message = std::move(message);
  diagnostics.push_back(std::move(diagnostic));
}

ParameterLookup ReadContext::lookup() const {
  return [this](const std::string& name, std::string& error) -> std::optional<double> {
    if (auto found = parameters.find(name); found != parameters.end()) return found->second;
    std::vector<std::string> names;
    for (const auto& [known, value] : parameters) names.push_back(known);
    error = "unknown parameter \"$" + name + "\"" + didYouMean(name, names);
    return std::nullopt;
  };
}

RandomSource ReadContext::random(const std::string& path) const {
  auto numbers = std::make_shared<Random>(masonry::namedSeed(seed, path + " random"));
  return [numbers, known = seedKnown && path != "world.seed"](std::string& error) -> std::optional<double> {
    if (known) return numbers->unit();
    error = "random needs the seed of [world], which needs this";
    return std::nullopt;
  };
}

void readParameters(ReadContext& context, const Node& root) {
  const Member* member = root.find("parameters");
  if (!member) ParameterReader(context, kEmptyTable).readSeed(root);
  if (!member) return;
  if (member->value.kind != NodeKind::table) {
    context.error(member->value, "parameters", "found " + describe(member->value) + ", expected a table of numbers");
    return;
  }
  std::size_t count = member->value.members.size();
  if (count > kMostParameters) {
    context.error(member->value, "parameters",
                  "found " + std::to_string(count) + ", expected at most " + std::to_string(kMostParameters));
    return;
  }
  ParameterReader(context, member->value).readSeed(root);
  ParameterReader(context, member->value).run();
}

TableReader::TableReader(ReadContext& context, const Node& node, std::string table, std::string path)
    : context_(&context), node_(node), table_(std::move(table)), path_(std::move(path)) {
  if (node.expansion) {
    if (!node.expansion->title.empty()) path_ = node.expansion->title;
    placement_ = node.expansion->placement;
  }
  reportUnknownKeys();
}

void TableReader::reportUnknownKeys() {
  int reported = 0;
  for (const Member& member : node_.members) {
    if (findKey(table_, member.key)) continue;
    if (++reported > kMostUnknownKeys) return;
    std::string hint = didYouMean(member.key, keysOf(table_));
    std::string owner = hint.empty() ? ownerOfKey(member.key) : std::string();
    if (!owner.empty()) hint = " (\"" + member.key + "\" is a key of " + owner + ")";
    Node at;
    at.line = member.line;
    at.column = member.column;
    at.source = member.value.source;
    at.again = member.value.again;
    at.fromOverride = member.value.fromOverride && member.line == 0;
    const bool isTable =
        member.value.kind == NodeKind::table || (member.value.kind == NodeKind::array && !member.value.items.empty() &&
                                                 member.value.items[0].kind == NodeKind::table);
    context_->error(at, pathOf(member.key),
                    isTable && table_.empty() ? unknownTable(member.key)
                                              : "found an unknown key, expected " + whatIsThere() + hint);
  }
}

// A key of this table; of the few that no table has, their names.
std::string TableReader::whatIsThere() const {
  if (!table_.empty()) return "a key of " + tableTitle(table_);
  std::string list;
  for (const KeySpec& spec : keySpecs())
    if (!*spec.table && !isTableKind(spec.kind)) list += (list.empty() ? "" : ", ") + std::string(spec.key);
  return list + " or a table";
}

// The tables that there are, and the nearest of them: by its letters, or by the thing that was meant.
std::string TableReader::unknownTable(const std::string& name) const {
  std::vector<std::string> tables;
  std::string list;
  for (const KeySpec& spec : keySpecs()) {
    if (*spec.table || !isTableKind(spec.kind)) continue;
    tables.push_back(spec.key);
    list += (list.empty() ? "" : ", ") + tableTitle(spec.key);
  }
  const std::string best = meantTable(name).empty() ? nearest(name, tables) : meantTable(name);
  return "found an unknown table, expected one of: " + list +
         (best.empty() ? "" : " (did you mean " + tableTitle(best) + "?)");
}

const KeySpec& TableReader::spec(const char* key) const { return *findKey(table_, key); }

const Node* TableReader::value(const char* key) const {
  const Member* member = node_.find(key);
  return member ? &member->value : nullptr;
}

const Node* TableReader::sought(const char* key) {
  const Node* found = value(key);
  if (!found && !*spec(key).fallback && !context_->syntaxErrors)
    context_->error(node_, pathOf(key), "not given, expected " + expectation(spec(key)));
  return found;
}

void TableReader::error(const std::string& key, std::string message) {
  const Node* at = value(key.c_str());
  context_->error(at ? *at : node_, key.empty() ? path_ : pathOf(key), std::move(message));
}

void TableReader::warning(const std::string& key, std::string message) {
  const Node* at = value(key.c_str());
  context_->add(Severity::warning, at ? *at : node_, key.empty() ? path_ : pathOf(key), std::move(message));
}

void TableReader::wrong(const Node& node, const std::string& path, const KeySpec& spec, const std::string& hint) {
  context_->error(node, path, "found " + describe(node) + ", expected " + expectation(spec) + hint);
}

namespace {

// "5 m/s", "45\u00b0": a number with something behind it that no expression has.
bool hasUnit(const std::string& text) {
  std::size_t digits = text.find_first_not_of("+-.0123456789eE");
  std::size_t at = text.find_first_not_of(' ', digits == 0 ? std::string::npos : digits);
  if (at == std::string::npos || text.find('$') != std::string::npos || text.find('(') != std::string::npos)
    return false;
  unsigned char c = static_cast<unsigned char>(text[at]);
  return c >= 0x80 || c == '%' || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

}  // namespace

bool TableReader::numberOf(const Node& node, const std::string& path, const KeySpec& spec, bool whole, double& out) {
  double value = node.number;
  std::string found = describe(node);
  if (node.kind == NodeKind::text && looksLikeExpression(node.text)) {
    Evaluated result = evaluate(node.text, context_->lookup(), context_->random(path));
    if (!result.error.empty()) {
      std::string why = hasUnit(node.text) ? "a number is written without its unit" : result.error;
      context_->error(node, path, "found " + found + ": " + why + ", expected " + expectation(spec));
      return false;
    }
    value = result.value;
    found += " = " + numberText(value);
    if (whole && std::fabs(value - std::floor(value + 0.5)) <= 1e-9) value = std::floor(value + 0.5);
  } else if (!isNumber(node)) {
    wrong(node, path, spec);
    return false;
  }
  constexpr std::int64_t kExact = std::int64_t(1) << 53;  // beyond, a double is not the number that was written
  bool exact = node.kind != NodeKind::integer || (node.integer >= -kExact && node.integer <= kExact);
  bool fits = exact && value >= spec.minimum && value <= spec.maximum && (!whole || value == std::floor(value));
  if (!fits) {
    context_->error(node, path, "found " + found + ", expected " + expectation(spec));
    return false;
  }
  out = value;
  return true;
}

bool TableReader::vectorOf(const Node& node, const std::string& path, const KeySpec& spec, bool whole, Vec3& out) {
  if (node.kind != NodeKind::array || node.items.size() != 3) {
    std::string hint;
    for (const char* named : {"aim_at", "look_at"})  // beside `target`
      if (node.kind == NodeKind::text && std::string_view(spec.key) == "target" && findKey(spec.table, named))
        hint = std::string("; a name goes into ") + named;
    wrong(node, path, spec, hint);
    return false;
  }
  Vec3 value;
  bool sound = true;
  KeySpec element = spec;
  element.kind = whole ? KeyKind::integer : KeyKind::number;
  for (int i = 0; i < 3; i++)
    if (!numberOf(node.items[std::size_t(i)], path + "[" + std::to_string(i) + "]", element, whole, value[i]))
      sound = false;
  if (sound) out = value;
  return sound;
}

bool TableReader::number(const char* key, double& out) {
  const Node* node = sought(key);
  const bool read = node && numberOf(*node, pathOf(key), spec(key), false, out);
  if ((read || !node) && placement_.yawDegrees != 0 && frameOf(spec(key)) == Frame::yaw) out += placement_.yawDegrees;
  return read;
}

bool TableReader::integer(const char* key, int& out) {
  double value = 0;
  const Node* node = sought(key);
  if (!node || !numberOf(*node, pathOf(key), spec(key), true, value)) return false;
  out = int(value);
  return true;
}

bool TableReader::integer(const char* key, std::uint64_t& out) {
  double value = 0;
  const Node* node = sought(key);
  if (!node || !numberOf(*node, pathOf(key), spec(key), true, value)) return false;
  out = std::uint64_t(value);
  return true;
}

bool TableReader::boolean(const char* key, bool& out) {
  const Node* node = sought(key);
  if (!node) return false;
  if (node->kind != NodeKind::boolean) {
    wrong(*node, pathOf(key), spec(key));
    return false;
  }
  out = node->boolean;
  return true;
}

bool TableReader::text(const char* key, std::string& out) {
  const Node* node = sought(key);
  if (!node) return false;
  bool name = spec(key).kind == KeyKind::name;
  bool sound = node->kind == NodeKind::text &&
               (name ? !node->text.empty() && node->text.size() <= 64 : double(node->text.size()) <= spec(key).maximum);
  if (!sound) {
    wrong(*node, pathOf(key), spec(key));
    return false;
  }
  out = node->text;
  return true;
}

bool TableReader::oneOf(const char* key, const std::vector<std::string>& names, std::string& out) {
  const Node* node = sought(key);
  if (!node) return false;
  if (node->kind != NodeKind::text) {
    wrong(*node, pathOf(key), spec(key));
    return false;
  }
  if (std::find(names.begin(), names.end(), node->text) == names.end()) {
    wrong(*node, pathOf(key), spec(key), didYouMean(node->text, names));
    return false;
  }
  out = node->text;
  return true;
}

bool TableReader::material(const char* key, std::string& out) { return oneOf(key, context_->materialNames, out); }

bool TableReader::mortar(const char* key, std::string& out) {
  std::vector<std::string> names = context_->mortarNames;
  if (spec(key).kind == KeyKind::mortar) names.push_back("none");
  return oneOf(key, names, out);
}

bool TableReader::colour(const char* key, std::uint32_t& out) {
  const Node* node = sought(key);
  if (!node) return false;
  const std::string& text = node->text;
  std::uint32_t value = 0;
  bool sound = node->kind == NodeKind::text && text.size() == 7 && text[0] == '#';
  for (std::size_t i = 1; sound && i < 7; i++) {
    char c = text[i];
    int digit = c >= '0' && c <= '9'   ? c - '0'
                : c >= 'a' && c <= 'f' ? c - 'a' + 10
                : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                       : -1;
    sound = digit >= 0;
    value = value * 16 + std::uint32_t(digit);
  }
  if (!sound) {
    wrong(*node, pathOf(key), spec(key));
    return false;
  }
  out = value;
  return true;
}

Vec3 TableReader::placed(const KeySpec& spec, Vec3 value) const {
  const Frame frame = frameOf(spec);
  if (frame == Frame::none || !placement_.moves()) return value;
  return frame == Frame::point ? placedPoint(placement_, value) : placedDirection(placement_, value);
}

bool TableReader::vector(const char* key, Vec3& out) {
  const Node* node = sought(key);
  const KeySpec& of = spec(key);
  const bool read = node && vectorOf(*node, pathOf(key), of, of.kind == KeyKind::counts, out);
  const bool hasDefault = *of.fallback && std::string_view(of.fallback) != "-";
  if (read || (!node && hasDefault)) out = placed(of, out);  // the default, too, is in the frame of the table
  return read;
}

bool TableReader::rotation(const char* key, Quat& out) {
  Vec3 degrees;
  const bool read = vector(key, degrees);
  const bool absent = !has(key) && std::string_view(spec(key).fallback) != "-";
  if (!read && !absent) return false;
  out = rotationFromDegrees(degrees);
  if (placement_.yawDegrees != 0) out = normalized(rotationFromDegrees({0, placement_.yawDegrees, 0}) * out);
  return read;
}

bool TableReader::gravity(const char* key, Vec3& out) {
  const Node* node = sought(key);
  if (!node) return false;
  if (node->kind == NodeKind::array) return vectorOf(*node, pathOf(key), spec(key), false, out);
  double down = 0;
  if (!numberOf(*node, pathOf(key), spec(key), false, down)) return false;
  out = {0, down == 0 ? 0 : -down, 0};
  return true;
}

bool TableReader::brick(const char* key, BrickKind& out) {
  const Node* node = sought(key);
  if (!node) return false;
  if (node->kind == NodeKind::array) {
    BrickKind solid;
    if (!vectorOf(*node, pathOf(key), spec(key), false, solid.format.size)) return false;
    out = solid;
    return true;
  }
  std::vector<std::string> names;
  for (const BrickKind& kind : context_->brickKinds) {
    names.push_back(kind.name);
    if (node->kind != NodeKind::text || node->text != kind.name) continue;
    out = kind;
    return true;
  }
  wrong(*node, pathOf(key), spec(key), node->kind == NodeKind::text ? didYouMean(node->text, names) : "");
  return false;
}

bool TableReader::pair(const char* key, double& a, double& b) {
  const Node* node = sought(key);
  if (!node) return false;
  if (node->kind != NodeKind::array || node->items.size() != 2) {
    wrong(*node, pathOf(key), spec(key));
    return false;
  }
  KeySpec element = spec(key);
  const bool whole = element.kind == KeyKind::wholePair;
  element.kind = whole ? KeyKind::integer : KeyKind::number;
  double values[2] = {a, b};
  for (std::size_t i = 0; i < 2; i++)
    if (!numberOf(node->items[i], pathOf(key) + "[" + std::to_string(i) + "]", element, whole, values[i])) return false;
  a = values[0], b = values[1];
  return true;
}

bool TableReader::points(const char* key, std::vector<Vec3>& out) {
  const Node* node = sought(key);
  if (!node) return false;
  if (node->kind != NodeKind::array || node->items.size() < 4 || node->items.size() > 64) {
    wrong(*node, pathOf(key), spec(key));
    return false;
  }
  std::vector<Vec3> points(node->items.size());
  bool sound = true;
  for (std::size_t i = 0; i < points.size(); i++) {
    const Node& item = node->items[i];
    if (item.kind == NodeKind::array && item.items.size() == 3) continue;
    context_->error(item, pathOf(key) + "[" + std::to_string(i) + "]",
                    "found " + describe(item) + ", expected a point [x, y, z] of three numbers");
    return false;
  }
  for (std::size_t i = 0; i < points.size(); i++)
    if (!vectorOf(node->items[i], pathOf(key) + "[" + std::to_string(i) + "]", spec(key), false, points[i]))
      sound = false;
  if (sound) out = points;
  return sound;
}

bool TableReader::times(const char* key, std::vector<double>& out) {
  const Node* node = sought(key);
  if (!node) return false;
  if (node->kind != NodeKind::array || node->items.empty() || node->items.size() > 1000) {
    wrong(*node, pathOf(key), spec(key));
    return false;
  }
  std::vector<double> times;
  KeySpec element = spec(key);
  element.kind = KeyKind::number;
  for (std::size_t i = 0; i < node->items.size(); i++) {
    const std::string path = pathOf(key) + "[" + std::to_string(i) + "]";
    double time = 0;
    if (!numberOf(node->items[i], path, element, false, time)) return false;
    if (!times.empty() && !(time > times.back())) {
      context_->error(
          node->items[i], path,
          "found " + numberText(time) + " after " + numberText(times.back()) + ", expected times that ascend");
      return false;
    }
    times.push_back(time);
  }
  out = std::move(times);
  return true;
}

bool TableReader::planPoints(const char* key, std::vector<Vec3>& out) {
  const Node* node = sought(key);
  if (!node) return false;
  if (node->kind != NodeKind::array || node->items.size() < 2 || node->items.size() > 1000) {
    wrong(*node, pathOf(key), spec(key));
    return false;
  }
  std::vector<Vec3> points;
  KeySpec element = spec(key);
  element.kind = KeyKind::number;
  for (std::size_t i = 0; i < node->items.size(); i++) {
    const Node& item = node->items[i];
    const std::string path = pathOf(key) + "[" + std::to_string(i) + "]";
    if (item.kind != NodeKind::array || item.items.size() != 2) {
      context_->error(item, path, "found " + describe(item) + ", expected a point [x, z] of two numbers");
      return false;
    }
    double x = 0, z = 0;
    if (!numberOf(item.items[0], path + "[0]", element, false, x) ||
        !numberOf(item.items[1], path + "[1]", element, false, z))
      return false;
    points.push_back({x, 0, z});
  }
  out = std::move(points);
  return true;
}

bool TableReader::numbers(const char* key, std::vector<int>& out) {
  const Node* node = sought(key);
  if (!node) return false;
  std::vector<int> found;
  if (node->kind != NodeKind::array || node->items.size() > 1000) {
    wrong(*node, pathOf(key), spec(key));
    return false;
  }
  KeySpec element = spec(key);
  element.kind = KeyKind::integer;
  for (std::size_t i = 0; i < node->items.size(); i++) {
    double value = 0;
    if (!numberOf(node->items[i], pathOf(key) + "[" + std::to_string(i) + "]", element, true, value)) return false;
    if (!found.empty() && !(value > found.back())) {
      wrong(*node, pathOf(key), spec(key));
      return false;
    }
    found.push_back(int(value));
  }
  out = std::move(found);
  return true;
}

bool TableReader::texts(const char* key, std::vector<std::string>& out) {
  const Node* node = sought(key);
  if (!node) return false;
  std::vector<std::string> found;
  const bool one = node->kind == NodeKind::text;
  bool sound = one || (node->kind == NodeKind::array && node->items.size() <= 100);
  if (one) found.push_back(node->text);
  for (std::size_t i = 0; sound && i < node->items.size(); i++) {
    sound = node->items[i].kind == NodeKind::text;
    found.push_back(node->items[i].text);
  }
  if (!sound) wrong(*node, pathOf(key), spec(key));
  if (sound) out = std::move(found);
  return sound;
}

bool TableReader::choiceIndex(const char* key, int& out) {
  const Node* node = sought(key);
  if (!node) return false;
  std::vector<std::string> choices = choicesOf(spec(key));
  auto found = std::find(choices.begin(), choices.end(), node->text);
  if (node->kind != NodeKind::text || found == choices.end()) {
    wrong(*node, pathOf(key), spec(key), node->kind == NodeKind::text ? didYouMean(node->text, choices) : "");
    return false;
  }
  out = int(found - choices.begin());
  return true;
}

std::vector<TableReader> TableReader::tables(const char* key) {
  std::vector<TableReader> readers;
  const Node* node = value(key);
  if (!node) return readers;
  std::string full = table_.empty() ? key : table_ + "." + key;
  if (node->kind != NodeKind::array) {
    wrong(*node, pathOf(key), spec(key));
    return readers;
  }
  for (std::size_t i = 0; i < node->items.size(); i++) {
    std::string path = pathOf(key) + "[" + std::to_string(i) + "]";
    if (node->items[i].kind == NodeKind::table)
      readers.emplace_back(*context_, node->items[i], full, path);
    else
      wrong(node->items[i], path, spec(key));
  }
  if (full != "body.part")  // its places are in the body's own frame
    for (TableReader& reader : readers) reader.placement_ = placement_ * reader.placement_;
  return readers;
}

TableReader TableReader::table(const char* key) {
  const Node* node = value(key);
  if (node && node->kind != NodeKind::table) {
    wrong(*node, pathOf(key), spec(key));
    node = nullptr;
  }
  return TableReader(*context_, node ? *node : kEmptyTable, table_.empty() ? key : table_ + "." + key, pathOf(key));
}

}  // namespace brickfall::scene
