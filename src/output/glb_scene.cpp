// A take as a glTF 2.0 binary: one node per body, named as the body, so that every brick can be picked and restyled where
// the file goes. Equal shapes share their vertices, equal shapes of one colour their mesh.
#include <algorithm>
#include <cmath>
#include <map>

#include "brickfall/geometry/shape_mesh.h"
#include "output/glb_animation.h"
#include "output/glb_builder.h"
#include "output/glb_grain.h"
#include "output/role_name.h"
#include "output/take_poses.h"

namespace brickfall {
namespace {

using nlohmann::json;

// Screens' sRGB to the linear light that glTF wants.
double linear(std::uint32_t byte) {
  double c = double(byte) / 255;
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

constexpr std::uint32_t kMortar = 0xA9A69F;
constexpr int kGrainsPerMetre = 4;  // pictures of the grain
constexpr const char* kGrainy[] = {"brick", "concrete", "mortar", "stone"};
constexpr int kTones = 8;             // of a brick's colour: no two bricks of a wall look quite alike
constexpr double kToneSpread = 0.14;  // of the light that the lightest and the darkest differ from the mean
// As in all pictures (sunFrom in apps/appearance/light.glsl): to the left of where the first camera looks from.
constexpr double kSunElevation = 0.7330383, kSunAside = 0.6981317;  // rad: 42 and 40 degrees
constexpr double kSunLux = 2050;                                    // 3 W/m2 in Blender

// Bricks by their number, so that neighbours differ; everything else has the one tone.
int toneOf(const TakeBody& body, std::size_t number) {
  if (body.role != BodyRole::brick) return -1;
  const auto mixed = std::uint32_t(number + 1) * 2654435761u;
  return int(mixed >> 13 & (kTones - 1));
}

// "wall" of "wall/3/7": bricks of a wall hang on a node of its name. Empty: the body stands by itself.
std::string groupOf(const std::string& name) {
  const std::size_t slash = name.find('/');
  return slash == std::string::npos ? std::string() : name.substr(0, slash);
}

// Of a body of which the take has one colour, mortar has its own.
std::uint32_t colourOf(const TakeBody& body, std::size_t shape) {
  if (shape < body.shapeColours.size()) return body.shapeColours[shape];
  const bool mortar = shape < body.shapeMaterials.size() && body.shapeMaterials[shape] == "mortar";
  return mortar && body.material != "mortar" ? kMortar : body.colour;
}

// Each once, the body's own first.
std::vector<std::uint32_t> coloursOf(const TakeBody& body) {
  std::vector<std::uint32_t> out{body.colour};
  for (std::size_t k = 0; k < body.shapes.size(); k++)
    if (std::find(out.begin(), out.end(), colourOf(body, k)) == out.end()) out.push_back(colourOf(body, k));
  return out;
}

// By which a glTF material is called: that of the first shape of a colour.
std::string materialOf(const TakeBody& body, std::uint32_t colour) {
  for (std::size_t k = 0; k < body.shapeMaterials.size(); k++)
    if (colour != body.colour && colourOf(body, k) == colour) return body.shapeMaterials[k];
  return body.material;
}

// What of a body has this colour. A shape that encloses nothing is not drawn.
ShapeMesh meshOf(const TakeBody& body, std::uint32_t colour) {
  ShapeMesh mesh;
  for (std::size_t k = 0; k < body.shapes.size(); k++) {
    if (colourOf(body, k) != colour) continue;
    if (Result<ShapeMesh> part = makeShapeMesh(body.shapes[k])) append(mesh, *part, body.shapes[k].local);
  }
  return mesh;
}

// What is fired, cast or laid, by the words of its material.
bool isGrainy(const TakeBody& body, const std::string& name) {
  if (body.role == BodyRole::brick) return true;
  return std::any_of(std::begin(kGrainy), std::end(kGrainy),
                     [&](const char* word) { return name.find(word) != std::string::npos; });
}

// The geometry as bytes, to find equal ones.
std::string keyOf(const ShapeMesh& mesh) {
  std::string key;
  auto add = [&](const auto& list) {
    key.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
  };
  add(mesh.positions);
  add(mesh.uvs);
  add(mesh.indices);
  return key;
}

class SceneWriter {
 public:
  SceneWriter(const TakeReader& take, const TakePoses& poses)
      : header_(take.header()), bodies_(take.bodies()), poses_(poses) {
    for (double time : poses.times) times_.push_back(time - poses.times[0]);
  }

  void addBodies();
  void addCameras();
  void addGroups();  // after all nodes that animations name by their place
  void addSun();
  bool addAnimation(const Progress& progress);  // false: cancelled
  void finish();
  GlbBuilder& builder() { return glb_; }

 private:
  int material(const TakeBody& body, std::uint32_t colour, int tone);
  const json& geometry(const std::string& key, const ShapeMesh& mesh);
  int mesh(const TakeBody& body, int tone);  // -1 = nothing to draw
  int timesOf(const std::vector<std::uint32_t>& keys);
  void addMotion(json& animation, std::size_t body);
  void addLife(json& animation, std::size_t body);
  void addChannel(json& animation, std::size_t node, const char* path, int input, int output,
                  const char* interpolation = "LINEAR");

  const TakeHeader& header_;
  const std::vector<TakeBody>& bodies_;
  const TakePoses& poses_;
  std::vector<double> times_;  // from 0
  GlbBuilder glb_;
  json nodes_ = json::array(), scene_ = json::array();
  std::map<std::string, int> materials_;          // by name
  std::map<std::string, std::uint32_t> colours_;  // of the first material of a name
  std::map<std::string, json> geometries_;
  std::map<std::string, int> meshes_;
  std::map<std::vector<std::uint32_t>, int> inputs_;
  int grain_ = -1;  // the texture's place; there is one if anything has it
};

int SceneWriter::material(const TakeBody& body, std::uint32_t colour, int tone) {
  const bool ball = body.role == BodyRole::ball, other = colour != body.colour;
  std::string name = materialOf(body, colour);
  if (name.empty()) name = roleName(body.role);
  if (const auto first = colours_.try_emplace(name, colour).first; first->second != colour) {
    char suffix[16];
    std::snprintf(suffix, sizeof suffix, " #%06X", unsigned(colour & 0xFFFFFF));
    name += suffix;
  }
  if (ball && name != "ball") name += " ball";
  const bool toned = tone >= 0 && !other;
  if (toned) name += " " + std::to_string(tone + 1);
  auto [at, added] = materials_.try_emplace(name, 0);
  if (!added) return at->second;
  const bool grainy = !ball && isGrainy(body, name);
  const double light = (toned ? 1 + kToneSpread * (2.0 * tone / (kTones - 1) - 1) : 1) / (grainy ? kGrainMean : 1);
  const auto share = [&](int shift) { return std::min(1.0, light * linear(colour >> shift & 255)); };
  json pbr = {{"baseColorFactor", {share(16), share(8), share(0), 1.0}},
              {"metallicFactor", ball ? 0.8 : 0.0},
              {"roughnessFactor", ball ? 0.35 : 0.9}};
  if (grainy && grain_ < 0) {
    grain_ = glb_.addTexture(grainPicture());
    glb_.add("extensionsUsed", "KHR_texture_transform");
  }
  if (grainy)
    pbr["baseColorTexture"] = {
        {"index", grain_},
        {"extensions", {{"KHR_texture_transform", {{"scale", {kGrainsPerMetre, kGrainsPerMetre}}}}}}};
  return at->second = glb_.add("materials", {{"name", name}, {"pbrMetallicRoughness", pbr}});
}

const json& SceneWriter::geometry(const std::string& key, const ShapeMesh& mesh) {
  auto [geometry, added] = geometries_.try_emplace(key);
  if (!added) return geometry->second;
  auto flat = [](const auto& list) {
    std::vector<float> out;
    for (const auto& item : list) out.insert(out.end(), item.begin(), item.end());
    return out;
  };
  geometry->second = {{"attributes",
                       {{"POSITION", glb_.addFloats(flat(mesh.positions), 3, GlbBuilder::kVertices, true)},
                        {"NORMAL", glb_.addFloats(flat(mesh.normals), 3, GlbBuilder::kVertices, false)},
                        {"TEXCOORD_0", glb_.addFloats(flat(mesh.uvs), 2, GlbBuilder::kVertices, false)}}},
                      {"indices", glb_.addIndices(mesh.indices)}};
  return geometry->second;
}

// One primitive for each colour.
int SceneWriter::mesh(const TakeBody& body, int tone) {
  std::vector<std::pair<std::uint32_t, ShapeMesh>> parts;
  std::string whole;
  for (std::uint32_t colour : coloursOf(body)) {
    ShapeMesh part = meshOf(body, colour);
    if (part.indices.empty()) continue;
    whole += keyOf(part) + ":" + std::to_string(material(body, colour, tone)) + ";";
    parts.push_back({colour, std::move(part)});
  }
  if (parts.empty()) return -1;
  auto [known, added] = meshes_.try_emplace(whole, 0);
  if (!added) return known->second;
  json primitives = json::array();
  for (const auto& [colour, part] : parts) {
    json primitive = geometry(keyOf(part), part);
    primitive["material"] = material(body, colour, tone);
    primitives.push_back(std::move(primitive));
  }
  std::string name = std::string(roleName(body.role)) + " mesh " + std::to_string(meshes_.size() - 1);
  return known->second = glb_.add("meshes", {{"name", name}, {"primitives", std::move(primitives)}});
}

json toJson(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }
json toJson(Quat q) { return {float(q.x), float(q.y), float(q.z), float(q.w)}; }

void SceneWriter::addBodies() {
  for (std::size_t k = 0; k < bodies_.size(); k++) {
    const TakeBody& body = bodies_[k];
    const Transform& pose = poses_.pose(k, 0);
    json node = {{"name", body.name},
                 {"translation", toJson(pose.position)},
                 {"rotation", toJson(pose.rotation)},
                 {"extras", {{"mass", body.mass}, {"role", roleName(body.role)}}}};
    if (int place = mesh(body, toneOf(body, k)); place >= 0) node["mesh"] = place;
    if (poses_.lives[k].birth > 0) node["scale"] = {0, 0, 0};  // see addLife
    if (groupOf(body.name).empty()) scene_.push_back(nodes_.size());
    nodes_.push_back(std::move(node));
  }
}

void SceneWriter::addGroups() {
  std::map<std::string, std::size_t> places;
  for (std::size_t k = 0; k < bodies_.size(); k++) {
    const std::string group = groupOf(bodies_[k].name);
    if (group.empty()) continue;
    const auto [at, added] = places.try_emplace(group, nodes_.size());
    if (added) {
      scene_.push_back(nodes_.size());
      nodes_.push_back({{"name", group}, {"children", json::array()}});
    }
    nodes_[at->second]["children"].push_back(k);
  }
}

// The rotation that takes the axes x, y, z to these: trace form, its largest part first.
Quat rotationTo(Vec3 right, Vec3 up, Vec3 back) {
  double m[4] = {1 + right.x - up.y - back.z, 1 - right.x + up.y - back.z, 1 - right.x - up.y + back.z,
                 1 + right.x + up.y + back.z};
  Quat candidates[4] = {{m[0], up.x + right.y, back.x + right.z, up.z - back.y},
                        {up.x + right.y, m[1], back.y + up.z, back.x - right.z},
                        {back.x + right.z, back.y + up.z, m[2], right.y - up.x},
                        {up.z - back.y, back.x - right.z, right.y - up.x, m[3]}};
  return normalized(candidates[std::max_element(m, m + 4) - m]);
}

// Of something that looks along its own -z, back towards `back`.
Quat lookingFrom(Vec3 back) {
  Vec3 right = cross(Vec3{0, 1, 0}, back);
  right = lengthSquared(right) > 1e-12 ? normalized(right) : Vec3{1, 0, 0};
  return rotationTo(right, cross(back, right), back);
}

// A light from where the page has its sun: to the left behind the first camera.
void SceneWriter::addSun() {
  Vec3 from{1, 0, 1};
  if (!header_.cameras.empty()) {
    const Vec3 back = header_.cameras[0].position - header_.cameras[0].target;
    if (back.x != 0 || back.z != 0) from = {back.x, 0, back.z};
  }
  const Vec3 aside = rotate(quatFromAxisAngle({0, 1, 0}, -kSunAside), normalized(from));
  const Vec3 sun = aside * std::cos(kSunElevation) + Vec3{0, std::sin(kSunElevation), 0};
  json& root = glb_.root();
  glb_.add("extensionsUsed", "KHR_lights_punctual");
  root["extensions"]["KHR_lights_punctual"]["lights"] =
      json::array({{{"type", "directional"}, {"name", "sun"}, {"color", {1.0, 0.95, 0.88}}, {"intensity", kSunLux}}});
  scene_.push_back(nodes_.size());
  nodes_.push_back({{"name", "sun"},
                    {"rotation", toJson(lookingFrom(sun))},
                    {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
}

void SceneWriter::addCameras() {
  for (const Camera& camera : header_.cameras) {
    Vec3 back = normalized(camera.position - camera.target);  // a glTF camera looks along -z
    if (lengthSquared(back) == 0) back = {0, 0, 1};
    const Quat rotation = lookingFrom(back);
    json lens = {{"type", "perspective"},
                 {"name", camera.name},
                 {"perspective", {{"yfov", camera.fieldOfViewDegrees * 3.14159265358979 / 180}, {"znear", 0.02}}}};
    scene_.push_back(nodes_.size());
    nodes_.push_back({{"name", "camera " + camera.name},
                      {"camera", glb_.add("cameras", std::move(lens))},
                      {"translation", toJson(camera.position)},
                      {"rotation", toJson(rotation)}});
  }
}

int SceneWriter::timesOf(const std::vector<std::uint32_t>& keys) {
  auto [at, added] = inputs_.try_emplace(keys, 0);
  if (added) {
    std::vector<float> seconds;
    for (std::uint32_t f : keys) seconds.push_back(float(times_[f]));
    at->second = glb_.addFloats(seconds, 1, GlbBuilder::kOther, true);
  }
  return at->second;
}

void SceneWriter::addChannel(json& animation, std::size_t node, const char* path, int input, int output,
                             const char* interpolation) {
  animation["channels"].push_back(
      {{"sampler", animation["samplers"].size()}, {"target", {{"node", node}, {"path", path}}}});
  animation["samplers"].push_back({{"input", input}, {"output", output}, {"interpolation", interpolation}});
}

// Keys of the frames in which the body is there.
void SceneWriter::addMotion(json& animation, std::size_t body) {
  std::span<const Transform> poses = poses_.posesOf(body);
  const TakeLife life = poses_.lives[body];
  std::span<const double> times = std::span(times_).subspan(life.birth, poses.size());
  const auto inTake = [&](std::vector<std::uint32_t> keys) {
    for (std::uint32_t& f : keys) f += std::uint32_t(life.birth);
    return keys;
  };
  if (std::vector<std::uint32_t> keys = keysOfPositions(poses, times); keys.size() > 1) {
    std::vector<float> values;
    for (std::uint32_t f : keys) {
      for (int axis = 0; axis < 3; axis++) values.push_back(float(poses[f].position[axis]));
    }
    int output = glb_.addFloats(values, 3, GlbBuilder::kOther, false);
    addChannel(animation, body, "translation", timesOf(inTake(keys)), output);
  }
  if (std::vector<std::uint32_t> keys = keysOfRotations(poses, times); keys.size() > 1) {
    std::vector<float> values;
    Quat last = poses[0].rotation;
    for (std::uint32_t f : keys) {
      Quat q = poses[f].rotation;
      // Never to the far side of the sphere: players that blend component by component would swing round.
      if (q.x * last.x + q.y * last.y + q.z * last.z + q.w * last.w < 0) q = {-q.x, -q.y, -q.z, -q.w};
      values.insert(values.end(), {float(q.x), float(q.y), float(q.z), float(q.w)});
      last = q;
    }
    int output = glb_.addFloats(values, 4, GlbBuilder::kOther, false);
    addChannel(animation, body, "rotation", timesOf(inTake(keys)), output);
  }
}

// A body that is not there has size 0: the one way that every player knows.
void SceneWriter::addLife(json& animation, std::size_t body) {
  const TakeLife life = poses_.lives[body];
  std::vector<std::uint32_t> keys{0};
  std::vector<float> values(3, life.birth > 0 ? 0.0f : 1.0f);
  if (life.birth > 0) {
    keys.push_back(std::uint32_t(life.birth));
    values.insert(values.end(), {1, 1, 1});
  }
  if (life.end < poses_.frames) {
    keys.push_back(std::uint32_t(life.end));
    values.insert(values.end(), {0, 0, 0});
  }
  if (keys.size() == 1) return;
  addChannel(animation, body, "scale", timesOf(keys), glb_.addFloats(values, 3, GlbBuilder::kOther, false), "STEP");
}

bool SceneWriter::addAnimation(const Progress& progress) {
  json animation = {{"name", header_.scene.empty() ? "take" : header_.scene},
                    {"channels", json::array()},
                    {"samplers", json::array()}};
  for (std::size_t k = 0; k < bodies_.size(); k++) {
    if (progress && k % 64 == 0 && !progress(0.5 + 0.45 * double(k) / double(bodies_.size()))) return false;
    addMotion(animation, k);
    addLife(animation, k);
  }
  if (!animation["channels"].empty()) glb_.add("animations", std::move(animation));
  return true;
}

void SceneWriter::finish() {
  json& root = glb_.root();
  root["asset"]["extras"] = {{"title", header_.title},
                             {"scene", header_.scene},
                             {"engineVersion", header_.engineVersion},
                             {"seed", std::to_string(header_.seed)},
                             {"framesPerSecond", header_.framesPerSecond}};
  if (!nodes_.empty()) root["nodes"] = std::move(nodes_);
  json scene = {{"name", header_.scene.empty() ? "take" : header_.scene}};
  if (!scene_.empty()) scene["nodes"] = std::move(scene_);
  root["scenes"] = json::array({std::move(scene)});
  root["scene"] = 0;
}

}  // namespace

Status writeGlb(const TakeReader& take, const std::string& path, const Progress& progress) {
  if (take.frameCount() == 0 || take.bodies().empty()) {
    return Error{ErrorCode::invalidArgument, path + ": the take has no frames or no bodies"};
  }
  Result<TakePoses> poses = readPoses(take, path, progress, 0.5);
  if (!poses) return poses.error();
  for (std::size_t f = 1; f < poses->frames; f++) {
    if (!(float(poses->times[f] - poses->times[0]) > float(poses->times[f - 1] - poses->times[0]))) {
      return Error{ErrorCode::badFormat,
                   path + ": the time of frame " + std::to_string(f) + " is not after the one before"};
    }
  }
  SceneWriter scene(take, *poses);
  scene.addBodies();
  scene.addCameras();
  scene.addGroups();
  scene.addSun();
  if (!scene.addAnimation(progress)) return cancelled(path);
  scene.finish();
  AtomicFile file(path);
  if (Status opened = file.open(); !opened) return opened;
  if (!scene.builder().writeTo(file)) return Error{ErrorCode::limitExceeded, path + ": more than the 4 GiB of a GLB"};
  if (progress && !progress(1)) return cancelled(path);
  return file.commit();
}

}  // namespace brickfall
