// The glTF binary read back: structure, shared meshes, and animations that stay within their tolerance of every frame. That
// it keeps the standard's rules is for the Khronos validator to say (tests/web/glb_valid_test.mjs).
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "output/glb_animation.h"
#include "output_helpers.h"

namespace brickfall {
namespace {

using nlohmann::json;
using test::OutputFolder;

struct Glb {
  json root;
  std::string buffer;

  std::vector<float> floats(int accessor) const {
    const json& a = root["accessors"][accessor];
    const json& view = root["bufferViews"][a["bufferView"].get<int>()];
    std::size_t width = a["type"] == "SCALAR" ? 1 : a["type"] == "VEC3" ? 3 : a["type"] == "VEC4" ? 4 : 2;
    std::vector<float> out(a["count"].get<std::size_t>() * width);
    std::memcpy(out.data(), buffer.data() + view["byteOffset"].get<std::size_t>(), out.size() * 4);
    return out;
  }
};

std::uint32_t word(const std::string& text, std::size_t at) {
  std::uint32_t v = 0;
  std::memcpy(&v, text.data() + at, 4);
  return v;
}

Glb readGlb(const std::string& path) {
  std::string all = test::contentOf(path);
  EXPECT_EQ(all.substr(0, 4), "glTF");
  EXPECT_EQ(word(all, 4), 2u);
  EXPECT_EQ(word(all, 8), all.size());
  std::uint32_t size = word(all, 12);
  EXPECT_EQ(size % 4, 0u);
  return {json::parse(all.substr(20, size)), all.substr(20 + size + 8)};
}

// As a player: the value at a time, between two keys; before the first and after the last they hold.
struct NodeTrack {
  std::vector<float> times, values;

  std::pair<std::size_t, double> at(double time) const {
    std::size_t k = 0;
    while (k + 1 < times.size() && times[k + 1] <= time) k++;
    if (k + 1 == times.size()) return {k - 1, 1.0};
    return {k, std::clamp((time - times[k]) / (double(times[k + 1]) - times[k]), 0.0, 1.0)};
  }
  Vec3 position(double time) const {
    auto [k, share] = at(time);
    Vec3 a{values[3 * k], values[3 * k + 1], values[3 * k + 2]},
        b{values[3 * k + 3], values[3 * k + 4], values[3 * k + 5]};
    return a + (b - a) * share;
  }
  Quat rotation(double time, bool even) const {
    auto [k, share] = at(time);
    const float* v = values.data() + 4 * k;
    return (even ? slerp : blend)({v[0], v[1], v[2], v[3]}, {v[4], v[5], v[6], v[7]}, share);
  }
};

TEST(Glb, HasOneNodePerBodyAndSharesMeshes) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  ASSERT_EQ(glb.root["nodes"].size(), take.bodies.size() + take.header.cameras.size() + 1);  // and the sun
  EXPECT_EQ(glb.root["scenes"][0]["nodes"].size(), glb.root["nodes"].size());
  EXPECT_EQ(glb.root["asset"]["extras"]["framesPerSecond"], take.header.framesPerSecond);
  std::set<int> meshesOfBricks;
  for (std::size_t k = 0; k < take.bodies.size(); k++) {
    const json& node = glb.root["nodes"][k];
    EXPECT_EQ(node["name"], take.bodies[k].name);
    EXPECT_EQ(node["extras"]["mass"], take.bodies[k].mass);
    if (take.bodies[k].role == BodyRole::brick) {
      meshesOfBricks.insert(node["mesh"].get<int>());
      EXPECT_EQ(node["extras"]["role"], "brick");
    }
  }
  // A mesh for each of eight tones, all of them with the same vertices; ground, ball, capsule, hull and pair.
  EXPECT_EQ(meshesOfBricks.size(), 8u);
  EXPECT_EQ(glb.root["meshes"].size(), 13u);
  std::set<std::string> vertices, materials;
  for (int mesh : meshesOfBricks) {
    vertices.insert(glb.root["meshes"][mesh]["primitives"][0]["attributes"].dump());
    materials.insert(glb.root["materials"][glb.root["meshes"][mesh]["primitives"][0]["material"].get<int>()]["name"]);
  }
  EXPECT_EQ(vertices.size(), 1u);
  EXPECT_EQ(materials.size(), 8u);
  EXPECT_EQ(glb.root["cameras"].size(), 2u);
}

// Bricks wear one small picture of grain, which neither lightens nor darkens them; a steel ball wears none.
TEST(Glb, BricksHaveGrain) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  ASSERT_EQ(glb.root["images"].size(), 1u);
  for (const json& material : glb.root["materials"]) {
    const std::string name = material["name"];
    const bool grainy = name.find("brick") != std::string::npos && name.find("ball") == std::string::npos;
    EXPECT_TRUE(!grainy || material["pbrMetallicRoughness"].contains("baseColorTexture")) << name;
    EXPECT_TRUE(name.find("ball") == std::string::npos ||
                !material["pbrMetallicRoughness"].contains("baseColorTexture"));
  }
  const json& view = glb.root["bufferViews"][glb.root["images"][0]["bufferView"].get<int>()];
  const std::size_t start = view["byteOffset"], size = view["byteLength"];
  constexpr std::size_t kSide = 64, kPixels = 48, kRow = kSide + 1;  // stored, after the heads of PNG and zlib
  ASSERT_EQ(size, kPixels + kSide * kRow + 4 + 4 + 12);
  double sum = 0;
  int seam = 0;
  for (std::size_t y = 0; y < kSide; y++) {
    const std::uint8_t* row = reinterpret_cast<const std::uint8_t*>(glb.buffer.data()) + start + kPixels + y * kRow + 1;
    for (std::size_t x = 0; x < kSide; x++) sum += row[x];
    seam = std::max(seam, std::abs(int(row[0]) - int(row[kSide - 1])));
  }
  EXPECT_NEAR(sum / (kSide * kSide), 238, 2);  // sRGB of the light that the colour is over
  EXPECT_LT(seam, 40);
}

TEST(Glb, ColoursTellMeshesApartButShareTheirVertices) {
  OutputFolder folder;
  test::SyntheticTake take =
      test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 2, .otherShapes = false});
  take.bodies[3].colour = 0x112233;
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  const json &nodes = glb.root["nodes"], &meshes = glb.root["meshes"];
  const json &a = meshes[nodes[2]["mesh"].get<int>()]["primitives"][0],
             &b = meshes[nodes[3]["mesh"].get<int>()]["primitives"][0];
  EXPECT_EQ(a["attributes"], b["attributes"]);
  EXPECT_NE(a["material"], b["material"]);
}

TEST(Glb, BricksOfAWallHangOnItsNode) {
  OutputFolder folder;
  test::SyntheticTake take =
      test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 2, .otherShapes = false});
  take.bodies[2].name = "front/0/0";
  take.bodies[3].name = "front/0/1";
  take.bodies[3].material = "clay";
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  const json& nodes = glb.root["nodes"];
  EXPECT_EQ(nodes[3]["name"], "front/0/1");
  const json* front = nullptr;
  for (const json& node : nodes)
    if (node["name"] == "front") front = &node;
  ASSERT_NE(front, nullptr);
  EXPECT_EQ((*front)["children"], (json{2, 3}));
  const json roots = glb.root["scenes"][0]["nodes"];
  EXPECT_EQ(std::count(roots.begin(), roots.end(), json(2)), 0);
  const json& primitive = glb.root["meshes"][nodes[3]["mesh"].get<int>()]["primitives"][0];
  const std::string name = glb.root["materials"][primitive["material"].get<int>()]["name"];
  EXPECT_EQ(name.substr(0, 5), "clay ");
}

// Light comes from the left, behind the camera, and from above.
TEST(Glb, TheSunIsBehindTheFirstCamera) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.frames = 2});
  take.header.cameras = {{"main", {0, 1, 5}, {0, 1, 0}, 45}};
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  const json& sun = glb.root["nodes"].back();
  ASSERT_EQ(sun["name"], "sun");
  EXPECT_EQ(sun["extensions"]["KHR_lights_punctual"]["light"], 0);
  const json& r = sun["rotation"];
  const Vec3 shines = rotate(Quat{r[0], r[1], r[2], r[3]}, Vec3{0, 0, -1});
  EXPECT_LT(shines.y, -0.5);
  EXPECT_LT(shines.z, -0.2);  // away from the camera
  EXPECT_GT(shines.x, 0.4);   // from its left to its right
}

TEST(Glb, MortarOnABrickHasItsOwnColour) {
  OutputFolder folder;
  test::SyntheticTake take =
      test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 2, .frames = 2, .otherShapes = false});
  for (std::size_t k : {2, 3}) {
    take.bodies[k].material = "brick";
    ShapeDef slab = take.bodies[k].shapes[0];
    slab.halfExtents.y = 0.005;
    take.bodies[k].shapes.push_back(slab);
    take.bodies[k].shapeMaterials = {"brick", "mortar"};
  }
  take.bodies[3].colour = 0x112233;
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  const json &nodes = glb.root["nodes"], &meshes = glb.root["meshes"];
  const json &a = meshes[nodes[2]["mesh"].get<int>()]["primitives"],
             &b = meshes[nodes[3]["mesh"].get<int>()]["primitives"];
  ASSERT_EQ(a.size(), 2u);
  EXPECT_NE(a[0]["material"], a[1]["material"]);
  EXPECT_NE(a[0]["material"], b[0]["material"]);
  EXPECT_EQ(a[1], b[1]);
  EXPECT_EQ(glb.root["materials"][a[1]["material"].get<int>()]["name"], "mortar");
}

TEST(Glb, PartsHaveTheColoursOfTheirMaterials) {
  OutputFolder folder;
  TakeReader reader = test::opened(test::makeSyntheticTake({.frames = 2}), folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  const std::size_t pair = reader.bodies().size() - 1;
  const json& parts = glb.root["meshes"][glb.root["nodes"][pair]["mesh"].get<int>()]["primitives"];
  ASSERT_EQ(parts.size(), 2u);
  const json& dark = glb.root["materials"][parts[1]["material"].get<int>()];
  EXPECT_EQ(dark["name"], "steel");
  EXPECT_LT(dark["pbrMetallicRoughness"]["baseColorFactor"][0], 0.03);
}

TEST(Glb, AnimationStaysWithinToleranceOfEveryFrameAndIsThinned) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  const json& animation = glb.root["animations"][0];
  std::set<int> moving;
  std::size_t keys = 0;
  for (const json& channel : animation["channels"]) {
    const json& sampler = animation["samplers"][channel["sampler"].get<int>()];
    NodeTrack track{glb.floats(sampler["input"]), glb.floats(sampler["output"])};
    int body = channel["target"]["node"].get<int>();
    moving.insert(body);
    keys += track.times.size();
    bool translation = channel["target"]["path"] == "translation";
    for (std::size_t f = 0; f < take.frames.size(); f++) {
      const TakePose& pose = take.frames[f].poses[body];
      if (translation) {
        EXPECT_LE(length(track.position(take.frames[f].time) - pose.position), 1.2e-4) << body << " frame " << f;
      } else {
        for (bool even : {true, false}) {
          EXPECT_LE(angleBetween(track.rotation(take.frames[f].time, even), pose.rotation), kGlbAngleTolerance + 2e-4)
              << body << " frame " << f;
        }
      }
    }
    if (!translation) {
      for (std::size_t k = 4; k < track.values.size(); k += 4) {
        float side = 0;
        for (std::size_t c = 0; c < 4; c++) side += track.values[k + c] * track.values[k + c - 4];
        EXPECT_GE(side, 0) << body << " key " << k / 4;
      }
    }
  }
  EXPECT_EQ(moving.size(), 101u);  // the bricks and the ball; ground, capsule, hull and pair rest all the time
  EXPECT_LT(keys, moving.size() * 2 * take.frames.size() / 2);
}

// A body is of size 0 where it is not there, and where it is its motion is that of the take.
TEST(Glb, BodiesComeAndGoByTheirScale) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake(
      {.courses = 2, .bricksPerCourse = 3, .frames = 200, .otherShapes = false, .breaking = true});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  const json& animation = glb.root["animations"][0];
  std::set<int> scaled;
  for (const json& channel : animation["channels"]) {
    const json& sampler = animation["samplers"][channel["sampler"].get<int>()];
    NodeTrack track{glb.floats(sampler["input"]), glb.floats(sampler["output"])};
    const int body = channel["target"]["node"].get<int>();
    const TakeLife life = reader.lives()[std::size_t(body)];
    if (channel["target"]["path"] == "scale") {
      scaled.insert(body);
      EXPECT_EQ(sampler["interpolation"], "STEP");
      for (std::size_t f = 0; f < take.frames.size(); f++) {
        std::size_t key = 0;
        while (key + 1 < track.times.size() && double(track.times[key + 1]) <= take.frames[f].time + 1e-5) key++;
        for (std::size_t axis = 0; axis < 3; axis++)
          EXPECT_EQ(track.values[3 * key + axis], life.holds(f) ? 1 : 0) << body << " frame " << f;
      }
    } else if (channel["target"]["path"] == "translation") {
      for (std::size_t f = life.birth; f < life.end; f++) {
        const std::vector<std::uint32_t> there = reader.bodiesAt(f);
        const std::size_t place =
            std::size_t(std::lower_bound(there.begin(), there.end(), std::uint32_t(body)) - there.begin());
        EXPECT_LE(length(track.position(take.frames[f].time) - take.frames[f].poses[place].position), 1.2e-4)
            << body << " frame " << f;
      }
    }
  }
  EXPECT_EQ(scaled, (std::set<int>{2, 8, 9, 10}));  // the brick that broke, its pieces
  const json& nodes = glb.root["nodes"];
  EXPECT_FALSE(nodes[2].contains("scale"));
  EXPECT_EQ(nodes[8]["scale"], (json{0, 0, 0}));
}

TEST(Glb, CamerasLookAtTheirTarget) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.frames = 2});
  take.header.cameras.push_back({"down", {0, 5, 0}, {0, 0, 0}, 50});
  take.header.cameras.push_back({"back", {0, 1, -5}, {0, 1, 0}, 50});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeGlb(reader, folder.file("a.glb")));
  Glb glb = readGlb(folder.file("a.glb"));
  for (std::size_t k = 0; k < take.header.cameras.size(); k++) {
    const Camera& camera = take.header.cameras[k];
    const json& node = glb.root["nodes"][take.bodies.size() + k];
    const json& r = node["rotation"];
    Quat q{r[0], r[1], r[2], r[3]};
    Vec3 looks = rotate(q, Vec3{0, 0, -1}), up = rotate(q, Vec3{0, 1, 0});
    EXPECT_LE(length(looks - normalized(camera.target - camera.position)), 1e-5) << camera.name;
    EXPECT_GE(up.y, -1e-6) << camera.name;
  }
}

TEST(Glb, WorksWithoutAnythingToDraw) {
  OutputFolder folder;
  test::SyntheticTake take;
  take.bodies.resize(1);
  take.frames.resize(1);
  take.frames[0].poses.resize(1);
  TakeReader reader = test::opened(take, folder.file("a.take"));
  Status written = writeGlb(reader, folder.file("a.glb"));
  ASSERT_TRUE(written) << written.error().message;
  std::string all = test::contentOf(folder.file("a.glb"));
  EXPECT_EQ(word(all, 8), all.size());
  EXPECT_FALSE(json::parse(all.substr(20, word(all, 12))).contains("buffers"));
}

TEST(Glb, CancellingLeavesNothing) {
  OutputFolder folder;
  TakeReader reader = test::opened(test::makeSyntheticTake({.frames = 100}), folder.file("a.take"));
  bool finished = false;
  for (int calls = 0; !finished; calls++) {
    test::Canceller canceller{calls};
    Status status = writeGlb(reader, folder.file("a.glb"), [&](double share) { return canceller(share); });
    finished = status.ok();
    EXPECT_EQ(folder.files(), finished ? 2u : 1u);
    ASSERT_LT(calls, 100);
  }
}

TEST(Glb, FramesThatDoNotFollowInTimeAreRefused) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.frames = 5});
  take.frames[3].time = take.frames[2].time;
  TakeReader reader = test::opened(take, folder.file("a.take"));
  Status status = writeGlb(reader, folder.file("a.glb"));
  EXPECT_EQ(status.error().code, ErrorCode::badFormat);
  EXPECT_NE(status.error().message.find("frame 3"), std::string::npos);
}

}  // namespace
}  // namespace brickfall
