// [[array]]: many bodies of one kind.
#include <algorithm>
#include <cmath>

#include "masonry/named_seed.h"
#include "math/random.h"
#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

enum class Arrangement { lattice, pyramid };

struct ArrayDef {
  Arrangement arrangement = Arrangement::lattice;
  Vec3 count{1, 1, 1};
  int base = 10;
  Vec3 spacing;
  double jitter = 0;
  ShapeDef shape;
  Aabb bounds;  // m, of the shape about the body's origin
  Vec3 sizeMin;
  bool randomSize = false;
  double yawDegrees = 0;
  Vec3 position;
  SceneBody model;

  Vec3 extent() const {
    if (shape.type == ShapeType::box) return shape.halfExtents * 2.0;
    return bounds.upper - bounds.lower;
  }

  std::int64_t bodies() const {
    if (arrangement == Arrangement::pyramid) return std::int64_t(base) * (base + 1) / 2;
    return std::int64_t(count.x) * std::int64_t(count.y) * std::int64_t(count.z);
  }
};

void readNumbers(SceneBuild& build, TableReader& reader, ArrayDef& def) {
  reader.choice("arrangement", def.arrangement);
  reader.vector("count", def.count);
  reader.integer("base", def.base);
  reader.number("jitter", def.jitter);
  def.shape = readShape(build, reader);
  if (def.shape.type != ShapeType::mesh || def.shape.mesh) def.bounds = bounds(def.shape, {});
  def.randomSize = reader.vector("size_min", def.sizeMin);
  def.spacing = def.extent();
  reader.vector("spacing", def.spacing);
  reader.vector("position", def.position);
  reader.number("yaw_degrees", def.yawDegrees);
  reader.choice("type", def.model.def.type);
  reader.material("material", def.model.material);
  readColour(reader, def.model);
  readMotion(reader, def.model.def);
}

void checkTogether(TableReader& reader, const ArrayDef& def) {
  for (int i = 0; def.randomSize && i < 3; i++)
    if (!(def.sizeMin[i] <= def.extent()[i])) {
      reader.error("size_min", "found " + numberText(def.sizeMin[i]) +
                                   ", expected at most size = " + numberText(def.extent()[i]) + " m on each axis");
      break;
    }
  const char* other = def.arrangement == Arrangement::pyramid ? "count" : "base";
  if (reader.has(other))
    reader.error(other, std::string("found beside arrangement \"") +
                            (def.arrangement == Arrangement::pyramid ? "pyramid" : "lattice") +
                            "\", expected it only with the other arrangement");
  if (def.shape.type != ShapeType::box && reader.has("size_min"))
    reader.error("size_min", "found with another shape than \"box\", expected it only with boxes");
  if (def.shape.type == ShapeType::mesh && def.model.def.type == BodyType::dynamic)
    reader.error(reader.has("type") ? "type" : "shape",
                 "found dynamic bodies of meshes, expected type \"fixed\" or \"kinematic\"");
  if (def.model.def.type == BodyType::fixed &&
      (def.model.def.linearVelocity != Vec3{} || def.model.def.angularVelocity != Vec3{}))
    reader.error("type", "found \"fixed\" with a velocity, expected \"kinematic\" or \"dynamic\"");
  double reach = 0;
  for (int i = 0; i < 3; i++) {
    double rows = def.arrangement == Arrangement::pyramid ? (i == 2 ? 1 : def.base) : def.count[i];
    reach = std::max(reach, std::fabs(def.position[i]) + rows * def.spacing[i] + def.extent()[i] + def.jitter);
  }
  if (!(reach <= limits::kLargestCoordinate))
    reader.error("spacing", "the array reaches " + numberText(reach) + " m from the origin, expected at most " +
                                numberText(limits::kLargestCoordinate) + " m");
}

class ArrayBuilder {
 public:
  ArrayBuilder(const ArrayDef& def, SceneBuild& build)
      : def_(def), build_(build), random_(masonry::namedSeed(build.scene.seed, def.model.name)) {}

  void run() {
    Vec3 s = def_.spacing;
    const bool middle = def_.shape.type != ShapeType::hull && def_.shape.type != ShapeType::mesh;
    double bottom = def_.position.y + (middle ? 0.5 * def_.extent().y : -def_.bounds.lower.y);
    if (def_.arrangement == Arrangement::pyramid) {
      for (int row = 0; row < def_.base; row++)
        for (int i = 0; i < def_.base - row; i++)
          add({def_.position.x + s.x * (i + 0.5 * row - 0.5 * (def_.base - 1)), bottom + s.y * row, def_.position.z});
      return;
    }
    int nx = int(def_.count.x), ny = int(def_.count.y), nz = int(def_.count.z);
    for (int y = 0; y < ny; y++)
      for (int z = 0; z < nz; z++)
        for (int x = 0; x < nx; x++)
          add({def_.position.x + s.x * (x - 0.5 * (nx - 1)), bottom + s.y * y,
               def_.position.z + s.z * (z - 0.5 * (nz - 1))});
  }

 private:
  void add(Vec3 centre) {
    SceneBody body = def_.model;
    body.name += "/" + std::to_string(next_++);
    ShapeDef shape = def_.shape;
    for (int i = 0; def_.randomSize && i < 3; i++)
      shape.halfExtents[i] = 0.5 * random_.between(def_.sizeMin[i], 2 * def_.shape.halfExtents[i]);
    for (int i = 0; def_.jitter > 0 && i < 3; i++) centre[i] += random_.between(-def_.jitter, def_.jitter);
    body.def.position = centre;
    if (def_.yawDegrees != 0) {
      body.def.position = def_.position + turned(centre - def_.position, def_.yawDegrees);
      body.def.rotation = rotationFromDegrees({0, def_.yawDegrees, 0});
    }
    body.def.shapes.push_back(shape);
    build_.scene.bodies.push_back(std::move(body));
  }

  const ArrayDef& def_;
  SceneBuild& build_;
  Random random_;
  std::size_t next_ = 0;
};

}  // namespace

void readArrays(SceneBuild& build, TableReader& top) {
  std::size_t index = 0;
  for (TableReader& reader : top.tables("array")) {
    ArrayDef def;
    def.model.name = build.nameOf(reader, "array", index++);
    def.model.material = "brick";
    std::size_t before = build.context.diagnostics.size();
    readNumbers(build, reader, def);
    if (build.context.diagnostics.size() == before) checkTogether(reader, def);
    def.model.place = placeOf(reader);
    if (build.context.diagnostics.size() == before) {
      SceneBody one = def.model;
      one.def.shapes = {def.shape};
      build.checkBuildable(reader, one);
    }
    bool sound = build.context.diagnostics.size() == before;
    if (sound && build.roomFor(reader, def.arrangement == Arrangement::pyramid ? "base" : "count", def.bodies()))
      ArrayBuilder(def, build).run();
  }
}

}  // namespace brickfall::scene
