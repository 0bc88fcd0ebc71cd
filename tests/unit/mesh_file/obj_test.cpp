#include <gtest/gtest.h>

#include "brickfall/geometry/triangle_mesh.h"
#include "brickfall/mesh_file.h"

namespace {

using namespace brickfall;

const char* const kCube = R"(# a cube, quads
o Cube
v -1 -1 -1
v 1.0 -1 -1
v 1 1e0 -1
v -1 1 -1 1.0
v -1 -1 1 0.5 0.5 0.5
v +1 -1 1
v 1 1 1
v -1 1 1
vt 0 0
vn 0 0 1
usemtl stone
s off
f 4 3 2 1
f 5/1 6/1 7/1 8/1
f 1//1 2//1 6//1 5//1
f -5/1/1 -6/1/1 -2/1/1 -1/1/1  # the same as 4 3 7 8
f 1 5 8 4
f 2 3 7 6
)";

TEST(Obj, ReadsPolygonsInEveryWayOfWriting) {
  Result<MeshFileData> data = readObj(kCube, "cube.obj");
  ASSERT_TRUE(data) << data.error().message;
  EXPECT_EQ(data->vertices.size(), 8u);
  EXPECT_EQ(data->indices.size(), 36u);
  Result<TriangleMesh> mesh = TriangleMesh::create(data->vertices, data->indices);
  ASSERT_TRUE(mesh);
  EXPECT_EQ(mesh->count(), 12u);
  EXPECT_EQ(mesh->bounds().upper, (Vec3{1, 1, 1}));
}

TEST(Obj, TakesWindowsLineEndsAndNoLastOne) {
  Result<MeshFileData> data = readObj("v 0 0 0\r\nv 1 0 0\r\n\r\nv 0 1 0\r\nf 1 2 3", "t.obj");
  ASSERT_TRUE(data) << data.error().message;
  EXPECT_EQ(data->indices, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Obj, NamesTheLineOfAMistake) {
  auto refused = [](const std::string& text, const std::string& wanted) {
    Result<MeshFileData> data = readObj(text, "m.obj");
    ASSERT_FALSE(data) << text;
    EXPECT_EQ(data.error().code, ErrorCode::badFormat);
    EXPECT_EQ(data.error().message, wanted);
  };
  refused("", "m.obj: found no face (f), expected at least one");
  refused("v 0 0 0\nv 1 0\n", "m.obj:2: found nothing, expected a coordinate");
  refused("v 0 0 1x\n", "m.obj:1: found \"1x\", expected a coordinate");
  refused("v 0 0 nan\n", "m.obj:1: found \"nan\", expected a coordinate");
  refused("v 0 0 1e999\n", "m.obj:1: found \"1e999\", expected a coordinate");
  std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  refused(three + "f 1 2 4\n", "m.obj:4: found \"4\", expected a vertex 1 .. 3 given above");
  refused(three + "f 1 2 0\n", "m.obj:4: found \"0\", expected a vertex 1 .. 3 given above");
  refused(three + "f 1 2 -4\n", "m.obj:4: found \"-4\", expected a vertex 1 .. 3 given above");
  refused(three + "f 1 2 3q\n", "m.obj:4: found \"3q\", expected a vertex 1 .. 3 given above");
  refused(three + "f 1 2 3/x\n", "m.obj:4: found \"3/x\", expected a vertex 1 .. 3 given above");
  refused(three + "f 1 2 99999999999999999999\n",
          "m.obj:4: found \"99999999999999999999\", expected a vertex 1 .. 3 given above");
  refused(three + "f 1 2\n", "m.obj:4: found a face of 2 corners, expected at least 3");
  refused(three + "f 1 2 \\\n3\n", "m.obj:4: found a line that goes on (\\), expected each on its own");
}

// Cut off anywhere it is an error with a place, or sound; never anything else.
TEST(Obj, EveryPrefixIsSoundOrAnError) {
  std::string text = kCube;
  int sound = 0, wrong = 0;
  for (std::size_t length = 0; length <= text.size(); length++) {
    Result<MeshFileData> data = readObj(std::string_view(text).substr(0, length), "p.obj");
    (data ? sound : wrong)++;
    if (!data) {
      EXPECT_EQ(data.error().message.rfind("p.obj", 0), 0u);
      continue;
    }
    for (std::uint32_t i : data->indices) ASSERT_LT(i, data->vertices.size());
  }
  EXPECT_GT(sound, 50);
  EXPECT_GT(wrong, 150);
}

}  // namespace
