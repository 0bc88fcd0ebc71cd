#include "scene/repetition.h"

#include <cmath>

#include "scene/expression.h"

namespace brickfall::scene {

namespace {

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

}  // namespace

std::vector<Instance> instancesOf(ReadContext& context, const Node& table, const std::string& path) {
  return Repetition(context, table, path).instances;
}

void bindNames(ReadContext& context, Node& table, const std::string& path) {
  Member* let = table.find("let");
  if (!let) return;
  const Node names = let->value;
  erase(table, "let");
  if (names.kind != NodeKind::table) {
    context.error(names, path + ".let", "found " + describe(names) + ", expected a table of numbers");
    return;
  }
  Values values;
  for (const Member& member : names.members) {
    const std::string where = path + ".let." + member.key;
    if (!isParameterName(member.key)) {
      context.error(member.value, where,
                    "found an unusable name, expected letters, digits and _, beginning with a letter");
      continue;
    }
    const Node& node = member.value;
    double value = node.number;
    if (node.kind == NodeKind::text) {
      const Evaluated result = evaluate(substituted(node.text, values), context.lookup(), context.random(where));
      if (!result.error.empty())
        context.error(node, where,
                      "found " + describe(node) + ": " + result.error + ", expected a number or an expression");
      value = result.value;
    } else if ((node.kind != NodeKind::integer && node.kind != NodeKind::number) || !std::isfinite(value)) {
      context.error(node, where, "found " + describe(node) + ", expected a finite number or an expression");
      value = 0;
    }
    values.push_back({member.key, value});
  }
  substitute(table, values);
}

}  // namespace brickfall::scene
