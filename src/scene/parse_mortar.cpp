// [[mortar_kind]], [[mortar]], and the `mortar` of walls and arches.
#include <set>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

void readMortarNumbers(TableReader& reader, MortarKind& kind) {
  MortarStrength& strength = kind.strength;
  const std::size_t before = reader.mistakes();
  reader.number("tension", strength.tension);
  reader.number("cohesion", strength.cohesion);
  reader.number("friction", strength.friction);
  reader.number("tension_energy", strength.tensionEnergy);
  reader.number("shear_energy", strength.shearEnergy);
  reader.number("compression", strength.compression);
  reader.number("crushing_energy", strength.crushingEnergy);
  reader.number("stiffness", strength.stiffness);
  reader.number("density", kind.density);
  reader.number("head_filling", kind.headFilling);
  reader.number("scatter", kind.scatter);
  if (reader.mistakes() != before) return;
  if (!(strength.cohesion > strength.tension * strength.friction)) {
    const char* key = reader.has("cohesion") ? "cohesion" : reader.has("tension") ? "tension" : "friction";
    reader.error(key, "found a cohesion of " + numberText(strength.cohesion) +
                          " Pa, expected more than tension x friction = " +
                          numberText(strength.tension * strength.friction) + " Pa");
  }
}

// The kind of that name; it has been checked.
MortarKind kindNamed(const SceneBuild& build, const std::string& name) {
  for (const MortarKind& kind : build.mortarKinds)
    if (kind.name == name) return kind;
  return {};
}

// The numbers of a table upon those of the kind that it names.
MortarKind readKindAndNumbers(SceneBuild& build, TableReader& reader) {
  std::string name = "cement";
  reader.mortar("kind", name);
  MortarKind kind = kindNamed(build, name);
  readMortarNumbers(reader, kind);
  return kind;
}

// The report's system would leave it out without a word.
void refuseUnderReport(const SceneBuild& build, TableReader& reader, const char* key) {
  if (build.scene.method == SceneMethod::report)
    reader.error(key, "found mortar, expected none with world.method = \"report\": that system has no mortar");
}

}  // namespace

void readMortarKinds(SceneBuild& build, TableReader& top) {
  build.mortarKinds = predefinedMortars();
  std::set<std::string> own;
  for (TableReader& reader : top.tables("mortar_kind")) {
    std::string name;
    if (!reader.text("name", name)) continue;
    if (name == "none" || !own.insert(name).second) {
      reader.error("name", name == "none"
                               ? std::string("found \"none\", expected another name: it is that of no mortar")
                               : "found the name \"" + name + "\" a second time, expected different names");
      continue;
    }
    // A predefined kind is changed key by key; others begin as cement.
    MortarKind* target = nullptr;
    for (MortarKind& known : build.mortarKinds)
      if (known.name == name) target = &known;
    MortarKind kind = target ? *target : kindNamed(build, "cement");
    kind.name = name;
    readMortarNumbers(reader, kind);
    if (target)
      *target = kind;
    else
      build.mortarKinds.push_back(kind);
  }
  for (const MortarKind& kind : build.mortarKinds) build.context.mortarNames.push_back(kind.name);
}

std::optional<MortarKind> readOwnMortar(SceneBuild& build, TableReader& reader, bool& foot) {
  std::optional<MortarKind> kind;
  const Node* given = reader.value("mortar");
  if (given && given->kind == NodeKind::table) {
    TableReader own = reader.table("mortar");
    kind = readKindAndNumbers(build, own);
  } else if (std::string name = "none"; reader.mortar("mortar", name) && name != "none") {
    kind = kindNamed(build, name);
  }
  if (kind) refuseUnderReport(build, reader, "mortar");
  reader.boolean("foot", foot);
  if (foot && !kind) reader.error("foot", "found true without mortar, expected a kind of it in `mortar`");
  return kind;
}

void readMortars(SceneBuild& build, TableReader& top) {
  for (TableReader& reader : top.tables("mortar")) {
    SceneMortar mortar;
    mortar.place = placeOf(reader);
    refuseUnderReport(build, reader, "body_a");
    if (reader.has("body_a"))
      readJoined(build, reader, "body_a", mortar.bodyA);
    else
      reader.text("body_a", mortar.bodyA);  // says that it must be given
    if (reader.has("body_b")) readJoined(build, reader, "body_b", mortar.bodyB);
    if (!mortar.bodyB.empty() && mortar.bodyA == mortar.bodyB)
      reader.error("body_b", "found the same body as body_a, expected another");
    reader.number("gap", mortar.gap);
    mortar.kind = readKindAndNumbers(build, reader);
    build.scene.mortars.push_back(std::move(mortar));
  }
}

}  // namespace brickfall::scene
