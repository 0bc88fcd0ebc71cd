// Walls that meet, what stands on them and what is told of them: in scene files.
#include <algorithm>
#include <cmath>

#include "unit/scene/scene_support.h"

namespace brickfall {
namespace {

std::string twoWalls(const std::string& bond, const std::string& more) {
  const std::string common = "bond = \"" + bond + "\"\ncourses = 4\nhead_joint = 0.01\nbed_joint = 0.01\n" + more;
  return "[[wall]]\nname = \"long\"\nbricks = 13\n" + common +
         "[[wall]]\nname = \"stem\"\npath = [[1.3, 0], [1.3, -1.2]]\n" + common + "tied_to = \"long\"\n";
}

TEST(MeetingWalls, AreBondedInEveryBond) {
  for (const char* bond : {"running", "header", "english", "flemish", "stack"}) {
    const SceneDescription scene = sound(twoWalls(bond, ""));
    EXPECT_EQ(allOf(checkScene(scene)), "") << bond;
    const double thickness = wallThickness(scene.walls[0].wall);
    // In odd courses the stem's bricks reach the long wall's far face, in even ones they end at its near face.
    double reach[2] = {-9, -9};
    const Result<std::vector<BrickPlacement>> stem = layBricks(scene.walls[1].wall, 1);
    ASSERT_TRUE(stem.ok()) << stem.error().message;
    for (const BrickPlacement& brick : *stem) {
      const double half = 0.5 * std::fabs(rotate(brick.rotation, Vec3{brick.size.x, 0, 0}).z) +
                          0.5 * std::fabs(rotate(brick.rotation, Vec3{0, 0, brick.size.z}).z);
      reach[brick.course % 2] = std::max(reach[brick.course % 2], brick.centre.z + half);
    }
    EXPECT_NEAR(reach[1], 0.5 * thickness, 1e-9) << bond;
    EXPECT_NEAR(reach[0], -0.5 * thickness - 0.01, 0.011) << bond;
  }
}

TEST(MeetingWalls, AreOneInMortar) {
  const SceneDescription scene = sound(twoWalls("running", "mortar = \"lime\"\n"));
  const Result<SceneRun> run = SceneRun::create(scene);
  ASSERT_TRUE(run.ok()) << run.error().message;
  int across = 0;
  for (MortarId id : run->mortars()) {
    const Result<MortarState> state = run->world().state(id);
    ASSERT_TRUE(state.ok());
    across += run->find(state->bodyA)->name.starts_with("long") != run->find(state->bodyB)->name.starts_with("long");
  }
  EXPECT_GE(across, 8);
}

TEST(MeetingWalls, ThatOverlapAreToldOnceWithHowToMendIt) {
  const SceneDescription scene =
      sound("[[wall]]\nname = \"a\"\n[[wall]]\nname = \"b\"\nposition = [0.5, 0, 0.3]\nyaw_degrees = 90\n");
  const std::vector<Diagnostic> told = checkScene(scene);
  ASSERT_EQ(told.size(), 1u) << allOf(told);
  EXPECT_EQ(told[0].line, 3);
  EXPECT_EQ(told[0].key, "b");
  EXPECT_NE(told[0].message.find("inside wall \"a\" (line 1)"), std::string::npos) << told[0].message;
  EXPECT_NE(told[0].message.find("tied_to"), std::string::npos) << told[0].message;
}

TEST(MeetingWalls, ARoofStandsOnTwoWalls) {
  const SceneDescription scene = sound(
      "[[wall]]\nname = \"a\"\ncourses = 3\nbricks = 10\nposition = [-1.075, 0, 0.8]\n"
      "repeat = { count = 2, step = [0, 0, -1.6] }\n"
      "[[roof]]\nname = \"roof\"\nlength = 2.15\nspan = 1.7025\nposition = [0, 0.195, 0]\nboards = 4\ntrusses = 3\n");
  EXPECT_EQ(allOf(checkScene(scene)), "");
  Result<SceneRun> run = SceneRun::create(scene);
  ASSERT_TRUE(run.ok());
  for (int k = 0; k < 90; k++) ASSERT_TRUE(run->step().ok());
  for (const PlacedBody& body : run->bodies())
    EXPECT_LT(length(run->world().state(body.id)->position - body.def.position), 0.02) << body.name;
  const std::string nailed = "[[roof]]\nnail_force = 500\nboards = 2\ntrusses = 2\n";
  EXPECT_EQ(sound(nailed).joints.size(), 8u);
}

// A doorway with an arched head: the wall leaves out a block, which the arch's stones fill.
TEST(MeetingWalls, AnArchFillsAnOpeningAndCarriesWhatIsAbove) {
  const std::string text =
      "[[wall]]\nbricks = 9\ncourses = 14\n"
      "[[wall.opening]]\nfrom = 0.645\nwidth = 0.645\nheight = 0.26\nlintel_height = 0\n"
      "[[wall.opening]]\nfrom = 0.5375\nwidth = 0.86\nsill = 0.26\nheight = 0.455\nlintel_height = 0\n"
      "[[arch]]\nstones = 9\nradius = 0.3725\nthickness = 0.1\ndepth = 0.1025\nblock = [0.86, 0.455]\nposition = "
      "[0.9675, "
      "0.26, 0]\n";
  const SceneDescription scene = sound(text);
  EXPECT_EQ(allOf(checkScene(scene)), "");
  Result<SceneRun> run = SceneRun::create(scene);
  ASSERT_TRUE(run.ok()) << run.error().message;
  double area = 0;
  for (const PlacedBody& body : run->bodies())
    if (body.name.starts_with("arch")) area += run->world().state(body.id)->mass / (1900 * 0.1025);
  // The block without half a circle, whose round is of chords.
  EXPECT_NEAR(area, 0.86 * 0.455 - 0.5 * 9 * std::sin(20 * 0.017453292519943295) * 0.3225 * 0.3225, 1e-6);
  for (int i = 0; i < 60; i++) ASSERT_TRUE(run->step().ok());
  for (const PlacedBody& body : run->bodies())
    EXPECT_LT(length(run->world().state(body.id)->position - body.def.position), 0.002) << body.name;
  EXPECT_FALSE(run->world().castRay({0.9675, 0.5, 1}, {0, 0, -1}, 2)->has_value());
  EXPECT_TRUE(run->world().castRay({0.9675, 0.65, 1}, {0, 0, -1}, 2)->has_value());
}

TEST(MeetingWalls, ABlockHasRoomForItsOpening) {
  EXPECT_TRUE(has(faults("[[arch]]\nblock = [1.7, 2]\n"), "expected more than 1.8 x 0.9 m"));
  EXPECT_TRUE(has(faults("[[arch]]\nblock = [3, 2]\nangle_degrees = 90\n"), "expected 180 where there is a block"));
}

// One rule: the material of the walls.
TEST(MeetingWalls, ABrickIsWhatIsMadeOfTheWallsMaterial) {
  const SceneDescription scene = sound(
      "[[material]]\nname = \"clay\"\n[[wall]]\nmaterial = \"clay\"\ncolour = \"#102030\"\ncourses = 6\n"
      "[[wall.opening]]\nfrom = 0.8\nwidth = 0.4\nheight = 0.2\n"
      "[[arch]]\nstones = 13\nposition = [9, 0, 0]\n[[body]]\nname = \"clay\"\nmaterial = \"clay\"\nposition = [0, 5, "
      "0]\n"
      "[[body]]\nname = \"wood\"\nmaterial = \"wood\"\nposition = [0, 7, 0]\ncolour = \"#00FF00\"\n");
  const Result<SceneRun> run = SceneRun::create(scene);
  ASSERT_TRUE(run.ok());
  std::size_t stones = 0;
  for (const PlacedBody& body : run->bodies()) {
    const bool lintel = body.materials[0] == "concrete";
    if (body.role == BodyRole::ground) continue;
    EXPECT_EQ(body.role == BodyRole::brick, !lintel && body.name != "wood") << body.name;
    stones += body.name.starts_with("arch");
    const bool own = body.name.starts_with("wall") && !lintel;
    EXPECT_EQ(body.colour == 0x102030u, own) << body.name;
    EXPECT_EQ(body.colour == 0x00FF00u, body.name == "wood") << body.name;
  }
  EXPECT_EQ(stones, 13u);
}

TEST(MeetingWalls, CamerasLookAtBodiesAndArraysTakeEveryShape) {
  const SceneDescription scene = sound(
      "[[array]]\nname = \"a\"\nshape = \"cone\"\nradius = 0.2\nheight = 0.6\ncount = [2, 1, 1]\nyaw_degrees = 90\n"
      "[[array]]\nshape = \"hull\"\nvertices = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]\nposition = [5, 0, 0]\n"
      "[[camera]]\nlook_at = \"a/1\"\n");
  EXPECT_EQ(scene.cameras[0].target, scene.bodies[2].def.position);
  EXPECT_NEAR(scene.bodies[1].def.position.z, 0.2, 1e-12);
  EXPECT_EQ(scene.bodies[3].def.shapes[0].type, ShapeType::hull);
  EXPECT_EQ(scene.bodies[3].def.position.y, 0);
  EXPECT_TRUE(has(faults("[[wall]]\nname = \"north\"\n[[camera]]\nlook_at = \"nort\"\n"), "did you mean \"north\""));
  const SceneDescription arch = sound(
      "[[arch]]\nname = \"bow\"\nposition = [3, 0, 0]\n[[ball]]\nposition = [3, 2, 4]\naim_at = \"bow\"\nspeed = 9\n"
      "[[camera]]\nlook_at = \"bow\"\n");
  EXPECT_NEAR(arch.cameras[0].target.x, 3, 1e-9);
  EXPECT_GT(arch.cameras[0].target.y, 0.5);  // not the middle of its circle, that of its stones
  const SceneBody& ball = arch.bodies.back();
  EXPECT_NEAR(length(ball.def.linearVelocity), 9, 1e-9);
  EXPECT_NEAR(ball.def.linearVelocity.x, 0, 1e-9);
  EXPECT_LT(ball.def.linearVelocity.z, -8);
  EXPECT_TRUE(has(faults("[[wall]]\nname = \"w\"\n[[ball]]\nposition = [0, 1, 4]\naim_at = \"v\"\nspeed = 9\n"),
                  "aim_at: found \"v\", expected the name of a body, a wall, a group"));
  EXPECT_TRUE(has(faults("[[ball]]\nposition = [0, 1, 4]\ntarget = \"gate\"\nspeed = 9\n"), "a name goes into aim_at"));
  EXPECT_TRUE(has(faults("[world]\nsleep = false\nstop_when = \"rest\"\n[[wall]]\n"), "stop_when"));
}

TEST(MeetingWalls, ACameraTurnsAfterOneBody) {
  const SceneDescription scene = sound(
      "[[wall]]\nname = \"w\"\n[[ball]]\nname = \"shot\"\nposition = [0, 1, 4]\n"
      "[[camera]]\nlook_at = \"shot\"\nfollow = true\n[[camera]]\nname = \"b\"\nlook_at = \"w\"\n");
  EXPECT_EQ(scene.cameras[0].follow, "shot");
  EXPECT_EQ(scene.cameras[0].target, (Vec3{0, 1, 4}));
  EXPECT_EQ(scene.cameras[1].follow, "");
  EXPECT_TRUE(has(faults("[[camera]]\nfollow = true\n"), "follow: found without look_at"));
  EXPECT_TRUE(has(faults("[[wall]]\nname = \"w\"\n[[camera]]\nlook_at = \"w\"\nfollow = true\n"),
                  "follow: found beside \"w\", which many are called after, expected one body"));
}

// A joint or a chain that names a wall holds on to the brick at its point.
TEST(MeetingWalls, AGateHangsOnTheNearestBrick) {
  const SceneDescription scene = sound(
      "[[wall]]\nname = \"left\"\nhead_joint = 0.01\nposition = [-2.25, 0, 0]\n[[body]]\nname = \"gate\"\nsize = [1, "
      "0.6, 0.05]\n"
      "position = [0.6, 0.35, 0]\n[[joint]]\nbody_a = \"left\"\nbody_b = \"gate\"\ntype = \"revolute\"\n"
      "anchor = [0.05, 0.35, 0]\n[[chain]]\nbody_a = \"gate\"\nbody_b = \"left\"\nfrom = [0.6, 0.65, 0]\nto = [-1, "
      "0.66, 0]\n");
  ASSERT_EQ(scene.joints.size(), 12u);
  EXPECT_TRUE(scene.joints[10].bodyB.starts_with("left/9/")) << scene.joints[10].bodyB;  // the chain's last
  EXPECT_EQ(scene.joints[11].bodyA, "left/5/10");
  EXPECT_TRUE(SceneRun::create(scene).ok());
}

// The widest door of a round wall in the tests of masonry: it stands, dry and in mortar, and no brick lies in another.
TEST(MeetingWalls, ARoundTowerStandsOverItsDoor) {
  for (const char* more : {"", "bed_joint = 0.01\nmortar = \"cement\"\nfoot = true\n"}) {
    const SceneDescription scene = sound(std::string("[[wall]]\nname = \"tower\"\nradius = 0.8\ncourses = 12\n") +
                                         more + "[[wall.opening]]\nfrom = 0\nwidth = 0.6\nheight = 0.6\n");
    EXPECT_EQ(allOf(checkScene(scene)), "") << more;
    Result<SceneRun> run = SceneRun::create(scene);
    ASSERT_TRUE(run.ok()) << run.error().message;
    std::vector<Vec3> before;
    for (const PlacedBody& body : run->bodies()) before.push_back(body.def.position);
    for (int k = 0; k < 60; k++) ASSERT_TRUE(run->step().ok());
    for (std::size_t k = 0; k < before.size(); k++)
      EXPECT_LT(length(run->world().state(run->bodies()[k].id)->position - before[k]), 2e-3) << run->bodies()[k].name;
  }
}

}  // namespace
}  // namespace brickfall
