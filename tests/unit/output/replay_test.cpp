// The replay page: its size, its motion data read back, and that nothing in a take can break out of its place in the page.
#include <zstd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "output/replay_template.h"
#include "output/replay_tracks.h"
#include "output_helpers.h"

namespace brickfall {
namespace {

using test::OutputFolder;

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  std::size_t start = text.find(from);
  EXPECT_NE(start, std::string::npos) << from;
  start += from.size();
  return text.substr(start, text.find(to, start) - start);
}

// The page's own reading of the tracks, written a second time: position and rotation of every body in every frame.
struct Decoded {
  std::vector<Transform> poses;
};

std::int64_t next(std::uint8_t byte, ByteReader& large) { return unzigzag(byte < 255 ? byte : large.varint()); }

Decoded decode(const Bytes& packed, const TakePoses& poses, double step) {
  Bytes raw(ZSTD_getFrameContentSize(packed.data(), packed.size()));
  EXPECT_EQ(ZSTD_decompress(raw.data(), raw.size(), packed.data(), packed.size()), raw.size());
  ByteReader in(raw);
  in.take(poses.frames * 8);
  std::vector<std::span<const std::uint8_t>> parts;
  for (int k = 0; k < 11; k++) parts.push_back(in.take(in.u32()));
  EXPECT_FALSE(in.failed());
  EXPECT_EQ(in.left(), 0u);
  ByteReader start(parts[0]), large(parts[8]);
  Decoded out;
  out.poses.resize(poses.poses.size());
  std::size_t at = 0;
  for (std::size_t body = 0; body < poses.bodies; body++) {
    const std::size_t frames = poses.count(body), first = poses.start[body];
    for (int axis = 0; axis < 3; axis++) {
      std::int64_t last = start.signedVarint(), move = 0;
      out.poses[first].position[axis] = double(last) * step;
      for (std::size_t f = 1; f < frames; f++) {
        move += next(parts[1 + axis][at + f - 1], large);
        last += move;
        out.poses[first + f].position[axis] = double(last) * step;
      }
    }
    double q[4];
    for (double& part : q) part = double(start.signedVarint());
    Quat shown = out.poses[first].rotation = normalized(Quat{q[0], q[1], q[2], q[3]});
    std::int64_t turn[3] = {};
    for (std::size_t f = 1; f < frames; f++) {
      for (int axis = 0; axis < 3; axis++) turn[axis] += next(parts[4 + axis][at + f - 1], large);
      Quat done{double(turn[0]) * kReplayTurnStep, double(turn[1]) * kReplayTurnStep, double(turn[2]) * kReplayTurnStep,
                1};
      shown = out.poses[first + f].rotation = normalized(done * shown);
    }
    for (std::size_t f = 0; f < frames; f++) next(parts[7][first + f], large);
    at += frames - 1;
  }
  EXPECT_EQ(large.left(), 0u);
  EXPECT_EQ(start.left(), 0u);
  return out;
}

double angleBetween(Quat a, Quat b) {
  Quat d = conjugate(a) * b;
  return 2 * std::atan2(std::sqrt(d.x * d.x + d.y * d.y + d.z * d.z), std::fabs(d.w));
}

TEST(Replay, TracksStayWithinTheirSteps) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.frames = 300, .everResting = false, .breaking = true});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  Result<TakePoses> poses = readPoses(reader, "a", {}, 1);
  ASSERT_TRUE(poses);
  double step = replayPositionStep(*poses);
  EXPECT_EQ(step, 1e-4);
  Decoded decoded = decode(replayTracks(*poses, step), *poses, step);
  double worstPlace = 0, worstAngle = 0;
  for (std::size_t k = 0; k < decoded.poses.size(); k++) {
    worstPlace = std::max(worstPlace, length(decoded.poses[k].position - poses->poses[k].position));
    worstAngle = std::max(worstAngle, angleBetween(decoded.poses[k].rotation, poses->poses[k].rotation));
  }
  EXPECT_LE(worstPlace, 0.87e-4);  // half a step on each axis
  EXPECT_LE(worstAngle, 7e-4);
}

TEST(Replay, TurnsTooFastForAFrameAreCaughtUp) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake(
      {.courses = 1, .bricksPerCourse = 1, .frames = 60, .hitFrame = 1000, .otherShapes = false});
  for (std::size_t f = 30; f < 60; f++) take.frames[f].poses[2].rotation = {1, 0, 0, 0};  // half a turn at once
  TakeReader reader = test::opened(take, folder.file("a.take"));
  Result<TakePoses> poses = readPoses(reader, "a", {}, 1);
  Decoded decoded = decode(replayTracks(*poses, 1e-4), *poses, 1e-4);
  EXPECT_LE(angleBetween(decoded.poses[2 * 60 + 59].rotation, poses->pose(2, 59).rotation), 7e-4);
  EXPECT_LE(angleBetween(decoded.poses[2 * 60 + 32].rotation, poses->pose(2, 32).rotation), 0.02);
}

TEST(Replay, ThousandBricksForTenSecondsStayUnderFourMegabytes) {
  OutputFolder folder;
  for (bool everResting : {true, false}) {
    test::SyntheticTake take =
        test::makeSyntheticTake({.courses = 40, .bricksPerCourse = 25, .frames = 600, .everResting = everResting});
    TakeReader reader = test::opened(take, folder.file("a.take"));
    Status written = writeReplayHtml(reader, folder.file("a.html"));
    ASSERT_TRUE(written) << written.error().message;
    auto size = std::filesystem::file_size(folder.file("a.html"));
    RecordProperty(everResting ? "bytes_resting" : "bytes_chaotic", std::to_string(size));
    EXPECT_LT(size, everResting ? 2'000'000u : 4'000'000u);
  }
}

TEST(Replay, PosterIsInThePageAndInItsLinkPreview) {
  OutputFolder folder;
  TakeReader reader = test::opened(test::makeSyntheticTake({.frames = 2}), folder.file("a.take"));
  const std::string page = folder.file("a.html"), poster = folder.file("the \"wall\".png");
  std::ofstream(poster, std::ios::binary) << "\x89PNG\r\n\x1a\n...";
  ASSERT_TRUE(writeReplayHtml(reader, page, {}, {poster, "https://example.org/walls/a.html"}));
  const std::string made = test::contentOf(page);
  EXPECT_EQ(between(made, "id=\"poster\" alt=\"\" src=\"", "\">"), "data:image/png;base64,iVBORw0KGgouLi4=");
  EXPECT_EQ(between(made, "og:url\" content=\"", "\">"), "https://example.org/walls/a.html");
  EXPECT_EQ(between(made, "og:image\" content=\"", "\">"), "https://example.org/walls/the &quot;wall&quot;.png");
  ASSERT_TRUE(writeReplayHtml(reader, page, {}, {poster, "https://example.org"}));
  EXPECT_NE(test::contentOf(page).find("content=\"https://example.org/the "), std::string::npos);
  ASSERT_TRUE(writeReplayHtml(reader, page));
  for (const char* word : {"id=\"poster\"", "og:image", "og:url"})
    EXPECT_EQ(test::contentOf(page).find(word), std::string::npos) << word;

  EXPECT_EQ(writeReplayHtml(reader, page, {}, {"", "example.org"}).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(writeReplayHtml(reader, page, {}, {folder.file("none.png"), ""}).error().code, ErrorCode::inputOutput);
  EXPECT_EQ(writeReplayHtml(reader, page, {}, {page, ""}).error().code, ErrorCode::badFormat);
}

TEST(Replay, PageIsOneFileWithEverythingInItsPlace) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.frames = 100});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeReplayHtml(reader, folder.file("a.html")));
  std::string page = test::contentOf(folder.file("a.html"));
  for (std::string_view place : {kTitlePlace, kMetaPlace, kDataPlace}) EXPECT_EQ(page.find(place), std::string::npos);
  EXPECT_EQ(between(page, "<title>", "</title>"), "A wall that only pretends &lt;to fall&gt; &amp; &quot;lie&quot;");
  EXPECT_EQ(between(page, "og:title\" content=\"", "\">"), between(page, "<title>", "</title>"));
  EXPECT_NE(between(page, "og:description\" content=\"", "\">").find(" bricks, simulated by Brickfall"),
            std::string::npos);
  EXPECT_EQ(page.find("src=\"http"), std::string::npos);
  auto meta = nlohmann::json::parse(between(page, "id=\"meta\">", "</script>"));
  EXPECT_EQ(meta["frames"], 100);
  EXPECT_EQ(meta["bodies"].size(), take.bodies.size());
  EXPECT_EQ(meta["bodies"][2]["name"], "brick 0");
  EXPECT_EQ(meta["bodies"][2]["role"], "brick");
  EXPECT_EQ(meta["shapes"].size(), 6u);  // plane, ball, one box for all bricks and the pair, its sphere, capsule, hull
  EXPECT_EQ(meta["cameras"][0]["name"], "front");
}

TEST(Replay, PageIsToldOfMortarAndOfWhoFellByIt) {
  OutputFolder folder;
  const test::SyntheticTake take = test::makeSyntheticTake(
      {.courses = 2, .bricksPerCourse = 3, .frames = 60, .hitFrame = 30, .otherShapes = false, .mortared = true});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeReplayHtml(reader, folder.file("a.html")));
  auto meta = nlohmann::json::parse(between(test::contentOf(folder.file("a.html")), "id=\"meta\">", "</script>"));
  EXPECT_EQ(meta["mortar"].size(), 5u);
  EXPECT_EQ(meta["mortar"][2]["a"], 4);
  ASSERT_EQ(meta["breaks"].size(), 1u);
  EXPECT_EQ(meta["breaks"][0]["joint"], 2);
  EXPECT_EQ(meta["breaks"][0]["mode"], "shear");
  EXPECT_EQ(meta["breaks"][0]["takers"].size(), 2u);
  EXPECT_EQ(meta["breaks"][0]["takers"][1]["joint"], -1);
  // The row of bricks parted there. The force on the second of the two pointed up: the first held it, with all behind it.
  EXPECT_EQ(meta["falls"].size(), 6u);
  for (const auto& fall : meta["falls"]) EXPECT_EQ(fall[1], 0);
}

TEST(Replay, PageIsToldOfCylindersAndCones) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.frames = 2});
  ShapeDef &drum = take.bodies[3].shapes[0], &cone = take.bodies[4].shapes[0];
  drum.type = ShapeType::cylinder, drum.radius = 0.5, drum.halfHeight = 0.25;
  cone.type = ShapeType::cone, cone.radius = 0.5, cone.halfHeight = 0.25, cone.topRadius = 0.125;
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeReplayHtml(reader, folder.file("a.html")));
  auto meta = nlohmann::json::parse(between(test::contentOf(folder.file("a.html")), "id=\"meta\">", "</script>"));
  auto shapeOf = [&](std::size_t body) {
    return meta["shapes"][meta["bodies"][body]["parts"][0]["shape"].get<std::size_t>()];
  };
  EXPECT_EQ(shapeOf(3).dump(), R"({"halfHeight":0.25,"radius":0.5,"type":"cylinder"})");
  EXPECT_EQ(shapeOf(4).dump(), R"({"halfHeight":0.25,"radius":0.5,"topRadius":0.125,"type":"cone"})");
}

TEST(Replay, PageKnowsWhoComesAndGoes) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake(
      {.courses = 1, .bricksPerCourse = 2, .frames = 150, .otherShapes = false, .breaking = true});
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeReplayHtml(reader, folder.file("a.html")));
  auto meta = nlohmann::json::parse(between(test::contentOf(folder.file("a.html")), "id=\"meta\">", "</script>"));
  const auto& bodies = meta["bodies"];
  ASSERT_EQ(bodies.size(), 7u);
  EXPECT_FALSE(bodies[0].contains("birth") || bodies[0].contains("end"));
  EXPECT_EQ(bodies[2]["end"], 60);
  EXPECT_EQ(bodies[4]["birth"], 60);
  EXPECT_FALSE(bodies[4].contains("end"));
  EXPECT_EQ(bodies[5]["end"], 130);
}

TEST(Replay, NamesCannotBreakOutOfThePage) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 1, .frames = 2});
  take.header.title = "</title><script>alert(1)</script>{{BRICKFALL_META}}";
  take.bodies[2].name = "</script><script>alert(2)</script>{{BRICKFALL_DATA}}\xff\x80";
  TakeReader reader = test::opened(take, folder.file("a.take"));
  ASSERT_TRUE(writeReplayHtml(reader, folder.file("a.html")));
  std::string page = test::contentOf(folder.file("a.html"));
  EXPECT_EQ(page.find("<script>alert"), std::string::npos);
  auto meta = nlohmann::json::parse(between(page, "id=\"meta\">", "</script>"));
  EXPECT_EQ(meta["title"], take.header.title);
  EXPECT_EQ(meta["bodies"][2]["name"], "</script><script>alert(2)</script>{{BRICKFALL_DATA}}\uFFFD\uFFFD");
  EXPECT_GT(between(page, "id=\"data\">", "</script>").size(), 100u);
}

TEST(Replay, CancellingLeavesNothing) {
  OutputFolder folder;
  TakeReader reader = test::opened(test::makeSyntheticTake({.frames = 100}), folder.file("a.take"));
  bool finished = false;
  for (int calls = 0; !finished; calls++) {
    test::Canceller canceller{calls};
    Status status = writeReplayHtml(reader, folder.file("a.html"), [&](double share) { return canceller(share); });
    finished = status.ok();
    EXPECT_EQ(std::filesystem::exists(folder.file("a.html")), finished);
    EXPECT_EQ(folder.files(), finished ? 2u : 1u);
    EXPECT_EQ(finished, status.error().message.find("cancelled") == std::string::npos);
    ASSERT_LT(calls, 100);
  }
}

TEST(Replay, RefusesAnEmptyTakeAndABadFolder) {
  OutputFolder folder;
  test::SyntheticTake take = test::makeSyntheticTake({.frames = 1});
  take.frames.clear();
  TakeReader empty = test::opened(take, folder.file("a.take"));
  EXPECT_EQ(writeReplayHtml(empty, folder.file("a.html")).error().code, ErrorCode::invalidArgument);
  TakeReader reader = test::opened(test::makeSyntheticTake({.frames = 1}), folder.file("b.take"));
  Status nowhere = writeReplayHtml(reader, "/nowhere/at/all.html");
  EXPECT_EQ(nowhere.error().code, ErrorCode::inputOutput);
  EXPECT_NE(nowhere.error().message.find("/nowhere/at/all.html"), std::string::npos);
}

}  // namespace
}  // namespace brickfall
