// [[array]]: many bodies of one kind.
#include <algorithm>
#include <cmath>

#include "masonry/named_seed.h"
#include "math/random.h"
#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

enum class Arrangement { lattice, pyramid };
enum class ArrayShape { box, sphere, cylinder };  // as the keys list them
constexpr const char* kArrayShapes[] = {"box", "sphere", "cylinder"};

struct ArrayDef {
  Arrangement arrangement = Arrangement::lattice;
  Vec3 count{1, 1, 1};
  int base = 10;
  Vec3 spacing;
  double jitter = 0;
  ArrayShape form = ArrayShape::box;
  Vec3 size{1, 1, 1}, sizeMin;
  bool randomSize = false;
  double radius = 0.5, height = 1;
  Vec3 position;
  SceneBody model;

  ShapeDef shape(Vec3 lengths) const {
    ShapeDef out;
    out.type = form == ArrayShape::sphere     ? ShapeType::sphere
               : form == ArrayShape::cylinder ? ShapeType::cylinder
                                              : ShapeType::box;
    out.radius = radius;
    out.halfHeight = 0.5 * height;
    out.halfExtents = lengths * 0.5;
    return out;
  }

  Vec3 extent() const {
    if (form == ArrayShape::box) return size;
    return {2 * radius, form == ArrayShape::sphere ? 2 * radius : height, 2 * radius};
  }

  std::int64_t bodies() const {
    if (arrangement == Arrangement::pyramid) return std::int64_t(base) * (base + 1) / 2;
    return std::int64_t(count.x) * std::int64_t(count.y) * std::int64_t(count.z);
  }
};

void readNumbers(TableReader& reader, ArrayDef& def) {
  reader.choice("arrangement", def.arrangement);
  reader.vector("count", def.count);
  reader.integer("base", def.base);
  reader.number("jitter", def.jitter);
  reader.choice("shape", def.form);
  reader.vector("size", def.size);
  reader.number("radius", def.radius);
  reader.number("height", def.height);
  def.randomSize = reader.vector("size_min", def.sizeMin);
  def.spacing = def.extent();
  reader.vector("spacing", def.spacing);
  reader.vector("position", def.position);
  reader.material("material", def.model.material);
  readMotion(reader, def.model.def);
}

void checkTogether(TableReader& reader, const ArrayDef& def) {
  for (int i = 0; def.randomSize && i < 3; i++)
    if (!(def.sizeMin[i] <= def.size[i])) {
      reader.error("size_min", "found " + numberText(def.sizeMin[i]) +
                                   ", expected at most size = " + numberText(def.size[i]) + " m on each axis");
      break;
    }
  const char* other = def.arrangement == Arrangement::pyramid ? "count" : "base";
  if (reader.has(other))
    reader.error(other, std::string("found beside arrangement \"") +
                            (def.arrangement == Arrangement::pyramid ? "pyramid" : "lattice") +
                            "\", expected it only with the other arrangement");
  for (const char* key : {"size", "size_min"})
    if (def.form != ArrayShape::box && reader.has(key))
      reader.error(key, "found with shape \"" + std::string(kArrayShapes[int(def.form)]) + "\", expected radius");
  double reach = 0;
  for (int i = 0; i < 3; i++) {
    double rows = def.arrangement == Arrangement::pyramid ? (i == 2 ? 1 : def.base) : def.count[i];
    reach = std::max(reach, std::fabs(def.position[i]) + rows * def.spacing[i] + def.size[i] + def.jitter);
  }
  if (!(reach <= limits::kLargestCoordinate))
    reader.error("spacing", "the array reaches " + numberText(reach) + " m from the origin, expected at most " +
                                numberText(limits::kLargestCoordinate) + " m");
  if (def.form == ArrayShape::box && reader.has("radius"))
    reader.error("radius", "found with shape \"box\", expected size");
  if (def.form != ArrayShape::cylinder && reader.has("height"))
    reader.error("height", "found with another shape than \"cylinder\"");
}

class ArrayBuilder {
 public:
  ArrayBuilder(const ArrayDef& def, SceneBuild& build)
      : def_(def), build_(build), random_(masonry::namedSeed(build.scene.seed, def.model.name)) {}

  void run() {
    Vec3 s = def_.spacing;
    double bottom = def_.position.y + 0.5 * def_.extent().y;
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
    ShapeDef shape = def_.shape(def_.size);
    for (int i = 0; def_.randomSize && i < 3; i++)
      shape.halfExtents[i] = 0.5 * random_.between(def_.sizeMin[i], def_.size[i]);
    for (int i = 0; def_.jitter > 0 && i < 3; i++) centre[i] += random_.between(-def_.jitter, def_.jitter);
    body.def.position = centre;
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
    readNumbers(reader, def);
    if (build.context.diagnostics.size() == before) checkTogether(reader, def);
    def.model.place = placeOf(reader);
    if (build.context.diagnostics.size() == before) {
      SceneBody one = def.model;
      one.def.shapes = {def.shape(def.size)};
      build.checkBuildable(reader, one);
    }
    bool sound = build.context.diagnostics.size() == before;
    if (sound && build.roomFor(reader, def.arrangement == Arrangement::pyramid ? "base" : "count", def.bodies()))
      ArrayBuilder(def, build).run();
  }
}

}  // namespace brickfall::scene
