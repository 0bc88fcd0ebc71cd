// From disk: endings, missing files, buffers beside a .gltf; and as the ground of a scene.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "brickfall/geometry/mesh_tree.h"
#include "brickfall/mesh_file.h"
#include "brickfall/output.h"
#include "brickfall/scene.h"
#include "brickfall/take.h"

namespace {

using namespace brickfall;
namespace fs = std::filesystem;

class MeshFiles : public testing::Test {
 protected:
  void SetUp() override {
    folder = fs::temp_directory_path() / ("brickfall_mesh_" + std::to_string(::getpid()));
    fs::create_directories(folder / "sub");
    write("floor.obj", "v -5 0 -5\nv -5 0 5\nv 5 0 5\nv 5 0 -5\nf 1 2 3 4\n");
  }
  void TearDown() override { fs::remove_all(folder); }
  void write(const std::string& name, const std::string& text) {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  SceneLoad load(const std::string& body) {
    write("scene.toml", "[ground]\nenabled = false\n[[ball]]\nposition = [0, 0.1, 0]\n[[body]]\n" + body);
    return loadSceneFile((folder / "scene.toml").string());
  }
  std::string firstMessage(const SceneLoad& scene) {
    return scene.diagnostics.empty() ? "" : format(scene.diagnostics[0]);
  }
  fs::path folder;
};

TEST_F(MeshFiles, LoadsByEndingAndSaysWhatIsMissing) {
  EXPECT_TRUE(loadMeshFile((folder / "floor.obj").string()));
  fs::copy_file(folder / "floor.obj", folder / "FLOOR.OBJ");
  EXPECT_TRUE(loadMeshFile((folder / "FLOOR.OBJ").string()));
  auto message = [&](const std::string& name) {
    Result<MeshFileData> data = loadMeshFile((folder / name).string());
    return data ? std::string() : data.error().message;
  };
  EXPECT_NE(message("none.obj").find("there is no such file"), std::string::npos);
  EXPECT_NE(message("sub").find("found the ending"), std::string::npos);
  fs::create_directories(folder / "folder.obj");
  EXPECT_NE(message("folder.obj").find("expected a file"), std::string::npos);
  write("empty.glb", "");
  EXPECT_NE(message("empty.glb").find("JSON"), std::string::npos);
}

TEST_F(MeshFiles, HeightsAreGroundAndMistakesNameTheLine) {
  write("ground.csv", "# metres\n0, 1, 0\n\n0;0.5;0\n0 -1 0\n");
  Result<MeshFileData> ground = loadMeshFile((folder / "ground.csv").string());
  ASSERT_TRUE(ground) << ground.error().message;
  EXPECT_EQ(ground->indices.size(), 3u * 8);
  ASSERT_EQ(ground->vertices.size(), 9u);
  for (const Vec3& v : ground->vertices) EXPECT_EQ(v.y, v.x != 0 ? 0 : v.z < 0 ? 1 : v.z > 0 ? -1 : 0.5);
  SceneLoad scene = load("type = \"fixed\"\nshape = \"mesh\"\nfile = \"ground.csv\"\nscale = [2, 1, 2]\n");
  EXPECT_TRUE(scene.scene) << firstMessage(scene);
  auto message = [&](const std::string& text) {
    Result<MeshFileData> data = readHeights(text, "h");
    return data ? std::string() : data.error().message;
  };
  EXPECT_NE(message("0 1\n0 x\n").find("h:2: found \"x\""), std::string::npos);
  EXPECT_NE(message("0 1\n0 nan\n").find("h:2"), std::string::npos);
  EXPECT_NE(message("0 1\n0 1 2\n").find("h:2: found 3 heights, expected 2"), std::string::npos);
  EXPECT_NE(message("0 1\n").find("expected two whole rows"), std::string::npos);
  EXPECT_NE(message("").find("expected two whole rows"), std::string::npos);
}

TEST_F(MeshFiles, BuffersLieBesideOrBelow) {
  auto gltf = [](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"accessors":[{"bufferView":0,)"
           R"("componentType":5126,"count":3,"type":"VEC3"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
           uri + "\"}]}";
  };
  float corners[9] = {0, 0, 0, 0, 0, 1, 1, 0, 0};
  std::string bytes(reinterpret_cast<const char*>(corners), sizeof corners);
  write("sub/a.bin", bytes);
  write("m.gltf", gltf("sub/a.bin"));
  Result<MeshFileData> data = loadMeshFile((folder / "m.gltf").string());
  ASSERT_TRUE(data) << data.error().message;
  EXPECT_EQ(data->indices.size(), 3u);
  write("sub/m.gltf", gltf("../sub/a.bin"));
  EXPECT_FALSE(loadMeshFile((folder / "sub/m.gltf").string()));
  write("m.gltf", gltf((folder / "sub/a.bin").string()));
  EXPECT_FALSE(loadMeshFile((folder / "m.gltf").string()));
}

TEST_F(MeshFiles, AMeshIsTheGroundOfAScene) {
  SceneLoad scene =
      load("type = \"fixed\"\nshape = \"mesh\"\nfile = \"floor.obj\"\nscale = [2, 1, 3]\nposition = [0, -1, 0]\n");
  ASSERT_TRUE(scene.scene) << firstMessage(scene);
  const ShapeDef& shape = scene.scene->bodies[0].def.shapes[0];
  ASSERT_TRUE(shape.mesh);
  EXPECT_EQ(shape.mesh->bounds().upper, (Vec3{10, 0, 15}));
  Result<SceneRun> run = SceneRun::create(*scene.scene);
  ASSERT_TRUE(run) << run.error().message;
  for (int n = 0; n < 120; n++) ASSERT_TRUE(run->step());
  for (const PlacedBody& body : run->bodies())
    if (body.role == BodyRole::ball) {
      EXPECT_NEAR(run->world().state(body.id)->position.y, -0.9, 1e-3);
    }
}

TEST_F(MeshFiles, TwoBodiesOfOneFileShareItsMesh) {
  std::string body = "type = \"fixed\"\nshape = \"mesh\"\nfile = \"floor.obj\"\n";
  SceneLoad scene =
      load(body + "[[body]]\n" + body + "position = [0, -3, 0]\n[[body]]\n" + body + "scale = [1, 1, 2]\n");
  ASSERT_TRUE(scene.scene) << firstMessage(scene);
  EXPECT_EQ(scene.scene->bodies[0].def.shapes[0].mesh, scene.scene->bodies[1].def.shapes[0].mesh);
  EXPECT_NE(scene.scene->bodies[0].def.shapes[0].mesh, scene.scene->bodies[2].def.shapes[0].mesh);
}

// A take carries the mesh; the page and the glTF made from it show it, and the glTF reads back as the same surface.
TEST_F(MeshFiles, TakesAndOutputsCarryTheMesh) {
  SceneLoad scene = load("type = \"fixed\"\nshape = \"mesh\"\nfile = \"floor.obj\"\n");
  ASSERT_TRUE(scene.scene) << firstMessage(scene);
  TakeChange start;
  start.births.resize(1);
  start.births[0].name = "floor";
  start.births[0].shapes = scene.scene->bodies[0].def.shapes;
  std::string path = (folder / "a.take").string();
  {
    Result<TakeWriter> writer = TakeWriter::create(path, {});
    ASSERT_TRUE(writer) << writer.error().message;
    TakeFrame frame;
    frame.poses.resize(1);
    frame.poses[0].position = {0, 2, 0};
    ASSERT_TRUE(writer->write(frame, start));
    ASSERT_TRUE(writer->finish(""));
  }
  Result<TakeReader> take = TakeReader::open(path);
  ASSERT_TRUE(take) << take.error().message;
  const ShapeDef& shape = take->bodies()[0].shapes[0];
  ASSERT_EQ(shape.type, ShapeType::mesh);
  ASSERT_TRUE(shape.mesh);
  EXPECT_EQ(shape.mesh->mesh().vertices(), start.births[0].shapes[0].mesh->mesh().vertices());
  EXPECT_EQ(shape.mesh->mesh().count(), 2u);

  ASSERT_TRUE(writeReplayHtml(*take, (folder / "a.html").string()));
  ASSERT_TRUE(writeGlb(*take, (folder / "a.glb").string()));
  Result<MeshFileData> back = loadMeshFile((folder / "a.glb").string());
  ASSERT_TRUE(back) << back.error().message;
  Result<TriangleMesh> mesh = TriangleMesh::create(back->vertices, back->indices);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->count(), 2u);
  EXPECT_EQ(mesh->bounds().lower, (Vec3{-5, 2, -5}));
  EXPECT_GT(mesh->normal(0).y, 0.999);

  // Every prefix of the take is refused or opens without frames that are not there.
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(file)), {});
  for (std::size_t length = 0; length < bytes.size(); length++) {
    Result<TakeReader> cut = TakeReader::openBytes({bytes.begin(), bytes.begin() + std::ptrdiff_t(length)});
    if (cut) {
      EXPECT_LE(cut->frameCount(), 1u);
    }
  }
}

TEST_F(MeshFiles, SceneFilesSayWhatIsWrong) {
  auto refused = [&](const std::string& body, const std::string& key, const std::string& word) {
    SceneLoad scene = load(body);
    ASSERT_FALSE(scene.scene) << body;
    ASSERT_EQ(scene.diagnostics.size(), 1u) << body;
    EXPECT_EQ(scene.diagnostics[0].key, key) << format(scene.diagnostics[0]);
    EXPECT_GT(scene.diagnostics[0].line, 0);
    EXPECT_NE(scene.diagnostics[0].message.find(word), std::string::npos) << format(scene.diagnostics[0]);
  };
  std::string fixed = "type = \"fixed\"\nshape = \"mesh\"\n";
  refused(fixed, "body[0].file", "not given");
  refused(fixed + "file = \"none.obj\"\n", "body[0].file", "there is no such file");
  refused(fixed + "file = \"floor.stl\"\n", "body[0].file", ".obj, .gltf, .glb or .csv");
  refused(fixed + "file = \"floor.obj\"\nscale = [1, 0, 1]\n", "body[0].scale[1]", "expected");
  refused(fixed + "file = \"floor.obj\"\nsize = [1, 1, 1]\n", "body[0].size", "mesh does not have");
  refused("shape = \"mesh\"\nfile = \"floor.obj\"\n", "body[0].type", "which means \"dynamic\"");
  refused("type = \"fixed\"\nfile = \"floor.obj\"\n", "body[0].file", "a box does not have");
  write("bad.obj", "v 0 0 0\nv 1 1\n");
  refused(fixed + "file = \"bad.obj\"\n", "body[0].file", "bad.obj:2: found nothing, expected a coordinate");
  write("flat.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  refused(fixed + "file = \"flat.obj\"\n", "body[0].file", "no triangle");
  refused(fixed + "file = \"floor.obj\"\nscale = [1e5, 1, 1]\n", "body[0].file", "10000 m");
}

}  // namespace
