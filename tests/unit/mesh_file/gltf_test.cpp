#include <gtest/gtest.h>

#include <cstring>

#include "brickfall/geometry/triangle_mesh.h"
#include "brickfall/mesh_file.h"

namespace {

using namespace brickfall;
using Bytes = std::vector<std::byte>;

template <class T> void put(Bytes& out, T value) {
  const std::byte* from = reinterpret_cast<const std::byte*>(&value);
  out.insert(out.end(), from, from + sizeof value);
}

// A square of two triangles at y = 0, with 16-bit indices: 48 bytes of positions, 12 of indices.
Bytes squareBuffer() {
  Bytes out;
  for (float v : {0.f, 0.f, 0.f, 0.f, 0.f, 1.f, 1.f, 0.f, 1.f, 1.f, 0.f, 0.f}) put(out, v);
  for (std::uint16_t i : {0, 1, 2, 0, 2, 3}) put(out, i);
  return out;
}

std::string squareJson(const std::string& uri = "", const std::string& nodes = R"([{"mesh":0}])", int mode = 4) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":)" + nodes +
         R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":)" + std::to_string(mode) +
         R"(}]}],"accessors":[{"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
         R"({"bufferView":1,"componentType":5123,"count":6,"type":"SCALAR"}],)"
         R"("bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12}],)"
         R"("buffers":[{"byteLength":60)" +
         (uri.empty() ? std::string() : ",\"uri\":\"" + uri + "\"") + "}]}";
}

Bytes toGlb(std::string json, Bytes binary) {
  while (json.size() % 4) json += ' ';
  while (binary.size() % 4) binary.push_back({});
  Bytes out;
  put(out, std::uint32_t(0x46546C67));
  put(out, std::uint32_t(2));
  put(out, std::uint32_t(12 + 8 + json.size() + 8 + binary.size()));
  put(out, std::uint32_t(json.size()));
  put(out, std::uint32_t(0x4E4F534A));
  for (char c : json) out.push_back(std::byte(c));
  put(out, std::uint32_t(binary.size()));
  put(out, std::uint32_t(0x004E4942));
  out.insert(out.end(), binary.begin(), binary.end());
  return out;
}
Bytes toBytes(const std::string& text) {
  const auto* from = reinterpret_cast<const std::byte*>(text.data());
  return Bytes(from, from + text.size());
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), with);
}

TEST(Gltf, ReadsAGlb) {
  Result<MeshFileData> data = readGltf(toGlb(squareJson(), squareBuffer()), "square.glb");
  ASSERT_TRUE(data) << data.error().message;
  ASSERT_EQ(data->vertices.size(), 4u);
  EXPECT_EQ(data->vertices[2], (Vec3{1, 0, 1}));
  EXPECT_EQ(data->indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Gltf, ReadsDataUrisAndFilesBesideIt) {
  const char* base64 = "AAAAAAAAAAAAAAAAAAAAAAAAAAAAAIA/AACAPwAAAAAAAIA/AACAPwAAAAAAAAAAAAABAAIAAAACAAMA";
  Result<MeshFileData> data =
      readGltf(toBytes(squareJson(std::string("data:application/octet-stream;base64,") + base64)), "square.gltf");
  ASSERT_TRUE(data) << data.error().message;
  EXPECT_EQ(data->vertices[3], (Vec3{1, 0, 0}));

  std::string asked;
  auto opener = [&](const std::string& path) -> Result<Bytes> {
    asked = path;
    return squareBuffer();
  };
  data = readGltf(toBytes(squareJson("a%20b.bin")), "square.gltf", opener);
  ASSERT_TRUE(data) << data.error().message;
  EXPECT_EQ(asked, "a b.bin");
  auto missing = [](const std::string&) -> Result<Bytes> {
    return Error{ErrorCode::inputOutput, "there is no such file"};
  };
  data = readGltf(toBytes(squareJson("a.bin")), "square.gltf", missing);
  ASSERT_FALSE(data);
  EXPECT_EQ(data.error().message, "square.gltf: buffers[0].uri: there is no such file");
}

// Translation, rotation and scale; a matrix; children; a mirrored node keeps its front.
TEST(Gltf, PlacesWhatNodesPlace) {
  std::string nodes =
      R"([{"children":[1,2],"translation":[10,0,0]},{"mesh":0,"scale":[2,1,1],"rotation":[0,0.7071067811865476,0,0.7071067811865476]},)"
      R"({"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 0,5,0,1]}])";
  Result<MeshFileData> data = readGltf(toGlb(squareJson("", nodes), squareBuffer()), "nodes.glb");
  ASSERT_TRUE(data) << data.error().message;
  ASSERT_EQ(data->vertices.size(), 8u);
  // (1, 0, 0): twice as long, turned by 90 degrees about y, moved.
  EXPECT_NEAR(data->vertices[3].x, 10, 1e-12);
  EXPECT_NEAR(data->vertices[3].z, -2, 1e-12);
  EXPECT_EQ(data->vertices[7], (Vec3{9, 5, 0}));
  for (std::size_t t = 0; t < 4; t++) {
    Vec3 a = data->vertices[data->indices[3 * t]], b = data->vertices[data->indices[3 * t + 1]],
         c = data->vertices[data->indices[3 * t + 2]];
    EXPECT_GT(cross(b - a, c - a).y, 0) << t;
  }
}

TEST(Gltf, ReadsStripsFansAndOtherIndices) {
  for (int mode : {4, 5, 6})
    for (int component : {5121, 5123, 5125, 0}) {
      std::vector<int> order = mode == 4   ? std::vector{0, 1, 2, 0, 2, 3}
                               : mode == 5 ? std::vector{3, 0, 2, 1}
                                           : std::vector{0, 1, 2, 3};
      if (component == 0 && mode != 6) continue;  // without indices: as they come
      Bytes buffer = squareBuffer();
      buffer.resize(48);
      for (int i : order) {
        if (component == 5121) put(buffer, std::uint8_t(i));
        if (component == 5123) put(buffer, std::uint16_t(i));
        if (component == 5125) put(buffer, std::uint32_t(i));
      }
      buffer.resize(72);
      std::string json = squareJson("", R"([{"mesh":0}])", mode);
      json = replaced(json, "5123,\"count\":6",
                      std::to_string(component ? component : 5123) + ",\"count\":" + std::to_string(order.size()));
      json = replaced(json, "\"byteLength\":12", "\"byteLength\":24");
      json = replaced(json, "\"byteLength\":60", "\"byteLength\":72");
      if (component == 0) json = replaced(json, "\"indices\":1,", "");
      Result<MeshFileData> data = readGltf(toGlb(json, buffer), "m.glb");
      ASSERT_TRUE(data) << data.error().message;
      ASSERT_EQ(data->indices.size(), 6u) << mode;
      for (std::size_t t = 0; t < 2; t++) {
        Vec3 a = data->vertices[data->indices[3 * t]], b = data->vertices[data->indices[3 * t + 1]],
             c = data->vertices[data->indices[3 * t + 2]];
        EXPECT_GT(cross(b - a, c - a).y, 0) << mode << " " << t;
      }
    }
}

TEST(Gltf, NamesTheFieldOfAMistake) {
  std::string good = squareJson();
  auto refused = [&](const std::string& json, const std::string& wanted) {
    Result<MeshFileData> data = readGltf(toGlb(json, squareBuffer()), "m.glb");
    ASSERT_FALSE(data) << json;
    EXPECT_EQ(data.error().code, ErrorCode::badFormat);
    EXPECT_EQ(data.error().message.rfind("m.glb: " + wanted, 0), 0u) << data.error().message << "\nwanted " << wanted;
  };
  refused("[]", "JSON: ");
  refused("{", "JSON: ");
  refused(replaced(good, "\"2.0\"", "\"1.0\""), "asset.version: ");
  refused(replaced(good, "{\"asset\"", "{\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"asset\""),
          "extensionsRequired: found \"KHR_draco_mesh_compression\"");
  refused(replaced(good, "\"scene\":0", "\"scene\":7"), "scene: found 7");
  refused(replaced(good, "\"nodes\":[0]", "\"nodes\":[1]"), "scene.nodes: found 1");
  refused(replaced(good, "\"mesh\":0", "\"mesh\":-1"), "nodes[0].mesh: expected a whole number");
  refused(replaced(good, "\"mesh\":0", "\"mesh\":3"), "nodes[0].mesh: found 3");
  refused(squareJson("", R"([{"children":[0]}])"), "nodes[0].children: expected a tree");
  refused(squareJson("", R"([{"mesh":0,"scale":[1,2]}])"), "nodes[0].scale: expected 3 numbers");
  refused(squareJson("", R"([{"mesh":0,"rotation":[1,1,1,1]}])"), "nodes[0].rotation: ");
  refused(replaced(good, "\"POSITION\":0", "\"NORMAL\":0"), "meshes[0].primitives[0].attributes.POSITION: not given");
  refused(replaced(good, "\"POSITION\":0", "\"POSITION\":1"), "accessors[1].type: expected \"VEC3\"");
  refused(replaced(good, "\"count\":4", "\"count\":5"), "accessors[0].count: found 5");
  refused(replaced(good, "\"count\":4", "\"count\":4294967295"), "accessors[0].count: found 4294967295");
  refused(replaced(good, "\"count\":4", "\"count\":3"),
          "meshes[0].primitives[0].indices: found 3, expected less than the 3");
  refused(replaced(good, "\"count\":6", "\"count\":5"), "meshes[0].primitives[0].indices: found 5, expected three");
  refused(replaced(good, "5126", "5125"), "accessors[0].componentType: found 5125");
  refused(replaced(good, "\"byteLength\":48}", "\"byteLength\":48,\"byteStride\":8}"),
          "bufferViews[0].byteStride: found 8");
  refused(replaced(good, "\"byteOffset\":48", "\"byteOffset\":50"), "bufferViews[1].byteLength: found more");
  refused(replaced(good, "\"byteLength\":60", "\"byteLength\":600"), "buffers[0].byteLength: found 600");
  refused(replaced(good, "\"type\":\"VEC3\"", "\"type\":\"VEC3\",\"sparse\":{}"), "accessors[0].sparse: ");
  refused(replaced(good, "\"mode\":4", "\"mode\":1"), "scene: found no triangles");
  refused(squareJson("../x.bin"), "buffers[0].uri: ");
}

// Many nodes that name each other would be visited without end.
TEST(Gltf, DeepAndWideNodesEnd) {
  std::string nodes = "[";
  for (int i = 0; i < 200; i++)
    nodes +=
        (i ? "," : "") + std::string("{\"children\":[") + std::to_string(i + 1) + "," + std::to_string(i + 1) + "]}";
  nodes += ",{\"mesh\":0}]";
  Result<MeshFileData> data = readGltf(toGlb(squareJson("", nodes), squareBuffer()), "deep.glb");
  EXPECT_FALSE(data);
  std::string deep(100000, '[');
  EXPECT_FALSE(readGltf(toGlb(deep, {}), "brackets.glb"));
}

TEST(Gltf, EveryPrefixIsAnErrorAndEveryFlippedByteIsSoundOrAnError) {
  Bytes whole = toGlb(squareJson(), squareBuffer());
  for (std::size_t length = 0; length < whole.size(); length++)
    ASSERT_FALSE(readGltf(std::span(whole).first(length), "p.glb")) << length;
  std::string text = squareJson("data:;base64,AAAA");
  for (std::size_t length = 0; length < text.size(); length++)
    ASSERT_FALSE(readGltf(toBytes(text.substr(0, length)), "p.gltf")) << length;
  int sound = 0, wrong = 0;
  for (std::size_t i = 0; i < whole.size(); i++)
    for (int bit = 0; bit < 8; bit++) {
      Bytes changed = whole;
      changed[i] ^= std::byte(1 << bit);
      Result<MeshFileData> data = readGltf(changed, "f.glb");
      (data ? sound : wrong)++;
      if (!data) continue;
      for (std::uint32_t index : data->indices) ASSERT_LT(index, data->vertices.size());
    }
  EXPECT_GT(sound, 500);
  EXPECT_GT(wrong, 2000);
}

}  // namespace
