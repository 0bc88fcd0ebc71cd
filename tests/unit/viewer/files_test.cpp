// Opening, saving and recording: mistakes with their line, files whole or not at all.
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <set>

#include "brickfall/take.h"
#include "unit/viewer/viewer_support.h"
#include "viewer_core/file_list.h"
#include "viewer_core/history.h"
#include "viewer_core/opening.h"
#include "viewer_core/scene_menu.h"
#include "viewer_core/scene_text.h"

namespace brickfall::viewer {
namespace {

TEST(Files, AMistakeIsToldWithItsLineAndTheSceneStays) {
  TestSession t(kWall, true);
  t.pass(0.1);
  TempFile bad("bad.toml", "[[wall]]\ncourses = 3\nbricks = -2\n");
  EXPECT_FALSE(t.does(Open{bad.path(), {}, true}));
  ASSERT_EQ(t.result.details.size(), 1u);
  EXPECT_NE(t.result.details[0].find("bad.toml:3:"), std::string::npos) << t.result.details[0];
  EXPECT_NE(t.serialOf("w/0/0"), 0u);
  EXPECT_TRUE(t.frame()->status.running);
  EXPECT_EQ(t.frame()->status.loading, "");
  EXPECT_FALSE(t.does(Open{"wal", {}, true}));
  EXPECT_NE(t.result.message.find("did you mean \"wall\""), std::string::npos) << t.result.message;
  EXPECT_FALSE(t.does(Open{"no/such/file.toml", {}, true}));
  EXPECT_NE(t.result.message.find("No such file"), std::string::npos) << t.result.message;
}

TEST(Files, AreToldApartBeforeAWindowOpens) {
  TempFile bad("bad.toml", "[[wall]]\nbricks = -2\n"), noise("noise.take", std::string("\x89"
                                                                                       "BFTAKE\nrest"));
  EXPECT_EQ(readOpening("wall", {}).opening.exitCode, 0);
  EXPECT_EQ(readOpening("wall", {{"speed", "3"}}).opening.exitCode, 0);
  EXPECT_EQ(readOpening("wall", {{"world.nonsense", "3"}}).opening.exitCode, 2);
  EXPECT_EQ(readOpening("cheese", {}).opening.exitCode, 2);
  EXPECT_EQ(readOpening("no/such.toml", {}).opening.exitCode, 3);
  EXPECT_EQ(readOpening("/", {}).opening.exitCode, 3);
  EXPECT_EQ(readOpening(bad.path(), {}).opening.exitCode, 2);
  EXPECT_EQ(readOpening(bad.path(), {}).opening.diagnostics.size(), 1u);
  const Opening take = readOpening(noise.path(), {}).opening;
  EXPECT_EQ(take.kind, OpeningKind::take);
  EXPECT_NE(take.exitCode, 0);
  EXPECT_FALSE(take.problem.empty());
  EXPECT_EQ(readOpening(noise.path(), {{"a", "1"}}).opening.exitCode, 2);
}

TEST(Files, ASavedStateGoesOnBitForBit) {
  TempFile state("saved.state");
  TestSession first(kWall, true);
  first.pass(0.3);
  first.does(ShootBall{{{0.4, 0.2, 1}, {0, 0, -1}}, 0.06, 7, "steel"});
  first.does(ChangeSetting{"gravity.y", -7});
  first.pass(0.2);
  first.does(Pause{});
  const std::uint64_t step = first.frame()->status.step;
  ASSERT_TRUE(first.does(SaveState{state.path()})) << first.result.message;
  EXPECT_NE(first.result.message.find("MB"), std::string::npos);
  first.does(Step{40});

  TestSession second;
  ASSERT_TRUE(second.does(Open{state.path(), {}, false})) << second.result.message;
  EXPECT_EQ(second.frame()->status.step, step);
  EXPECT_EQ(second.frame()->info->title, "A small wall");
  EXPECT_NE(second.serialOf("shot 1"), 0u);
  second.does(Step{40});
  EXPECT_EQ(stateOf(*second.frame()), stateOf(*first.frame()));
  // From its beginning the scene needs no file.
  ASSERT_TRUE(second.does(Restart{})) << second.result.message;
  EXPECT_EQ(second.frame()->status.step, 0u);
}

// The report's system was chosen in the panel, not in the file: the snapshot fits no other.
TEST(Files, ASavedStateHasTheSettingsThatTheRunBeganWith) {
  TempFile state("settings.state");
  TestSession first(kWall, false);
  ASSERT_TRUE(first.does(ChangeSetting{"method", 1}));
  ASSERT_TRUE(first.does(ChangeSetting{"report.warmStarting", 1}));
  ASSERT_TRUE(first.does(ChangeSetting{"report.impulseFactor", 0.1 + 0.2}));
  ASSERT_TRUE(first.does(Restart{}));
  ASSERT_TRUE(first.frame()->info->reportMethod);
  first.does(Step{20});
  ASSERT_TRUE(first.does(ChangeSetting{"maxBodies", 500}));  // waits, and is not saved
  ASSERT_TRUE(first.does(SaveState{state.path()})) << first.result.message;
  first.does(Step{20});

  TestSession second;
  ASSERT_TRUE(second.does(Open{state.path(), {}, false})) << second.result.message;
  EXPECT_TRUE(second.frame()->info->reportMethod);
  EXPECT_EQ(second.frame()->status.settingsWait, 0u);
  second.does(Step{20});
  EXPECT_EQ(stateOf(*second.frame()), stateOf(*first.frame()));
  ASSERT_TRUE(second.does(Restart{})) << second.result.message;
  EXPECT_TRUE(second.frame()->info->reportMethod);
  ASSERT_TRUE(second.does(Restart{true})) << second.result.message;
  EXPECT_FALSE(second.frame()->info->reportMethod) << "as in the file";
}

TEST(Files, AStateOfAnotherVersionIsNamedSo) {
  TempFile state("old.state", std::string("\x89") + "BFSTATE1\nand so on");
  const OpenedFile file = readOpening(state.path(), {});
  EXPECT_EQ(file.opening.kind, OpeningKind::state);
  EXPECT_EQ(file.opening.exitCode, 2);
  EXPECT_NE(file.opening.problem.find("format 1"), std::string::npos) << file.opening.problem;
}

TEST(Files, AForgedStateClaimsNoMemory) {
  std::vector<std::byte> zeros(std::size_t(64) << 20);
  std::vector<std::byte> packed = compressed(zeros);
  ASSERT_LT(packed.size(), 10'000u);
  EXPECT_TRUE(decompressed(packed).ok());
  // Its frame header tells the size in 4 bytes after magic and descriptor: 3 GiB.
  ASSERT_EQ(std::to_integer<int>(packed[4]) >> 6, 2);
  packed[4 + 4] = std::byte(0xc0);
  const auto refused = decompressed(packed);
  ASSERT_FALSE(refused.ok());
}

TEST(Files, ASceneMayComeFromAPipe) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_GT(::write(ends[1], kWall, std::strlen(kWall)), 0);
  ::close(ends[1]);
  const std::string path = "/dev/fd/" + std::to_string(ends[0]);
  TestSession t;
  const auto file = std::make_shared<OpenedFile>(readOpening(path, {}));
  EXPECT_EQ(file->opening.exitCode, 0) << file->opening.problem;
  ASSERT_TRUE(t.does(Open{path, {}, false, file})) << t.result.message;
  ::close(ends[0]);
  EXPECT_EQ(t.frame()->info->title, "A small wall");
  ASSERT_TRUE(t.does(Restart{true})) << t.result.message;
  EXPECT_EQ(t.frame()->info->title, "A small wall");
}

// The disk is full when the recording ends: no command answers for it, so it is told by itself.
TEST(Files, ARecordingThatDiesIsTold) {
  TempFile take("dies.take");
  TestSession t(kWall, true);
  ASSERT_TRUE(t.does(StartRecording{take.path()}));
  t.pass(0.1);
  // Where its file should get its name stands a folder.
  std::filesystem::create_directory(take.path());
  t.session.send(Rewind{0});
  t.session.pump();
  const std::vector<CommandResult> results = t.session.takeResults();
  ASSERT_EQ(results.size(), 2u);
  EXPECT_TRUE(results[0].ok) << results[0].message;
  EXPECT_EQ(results[1].ticket, 0u);
  EXPECT_FALSE(results[1].ok);
  EXPECT_NE(results[1].message.find(take.path()), std::string::npos) << results[1].message;
  ASSERT_FALSE(t.does(StartRecording{take.path()}) && t.session.finish().ok());
}

TEST(Files, ADamagedStateIsRefused) {
  TempFile state("saved.state");
  TestSession t(kWall, true);
  t.pass(0.1);
  ASSERT_TRUE(t.does(SaveState{state.path()}));
  const std::string good = state.read();
  const std::string before = stateOf(*t.frame());
  t.does(Pause{});
  for (std::size_t length = 10; length < good.size(); length += 1 + good.size() / 25) {
    state.write(good.substr(0, length));
    EXPECT_FALSE(t.does(Open{state.path(), {}, false})) << length;
    EXPECT_NE(t.result.message.find("saved.state"), std::string::npos) << t.result.message;
  }
  for (std::size_t at = 10; at < good.size(); at += 1 + good.size() / 25) {
    std::string bad = good;
    bad[at] = char(bad[at] ^ 0x5a);
    state.write(bad);
    EXPECT_FALSE(t.does(Open{state.path(), {}, false})) << at;
  }
  EXPECT_EQ(stateOf(*t.frame()), before);
}

TEST(Files, WhatCanNotBeWrittenIsSaidAndLeavesNothing) {
  TestSession t(kWall, true);
  EXPECT_FALSE(t.does(SaveState{"no/such/folder/x.state"}));
  EXPECT_NE(t.result.message.find("no/such/folder/x.state"), std::string::npos) << t.result.message;
  EXPECT_FALSE(t.does(StartRecording{"no/such/folder/x.take"}));
  EXPECT_EQ(t.frame()->status.recording, "");
  EXPECT_FALSE(t.does(StopRecording{}));
}

TEST(Files, RecordsFromNowOnUntilStopped) {
  TempFile take("recorded.take");
  TestSession t(kWall, true);
  t.pass(0.5);
  ASSERT_TRUE(t.does(StartRecording{take.path()})) << t.result.message;
  t.pass(0.02);
  EXPECT_EQ(t.frame()->status.recording, take.path());
  EXPECT_FALSE(t.does(StartRecording{take.path()}));
  t.does(ShootBall{{{0.4, 0.2, 1}, {0, 0, -1}}, 0.06, 7, "steel"});
  t.pass(0.5);
  EXPECT_FALSE(take.exists());
  ASSERT_TRUE(t.does(StopRecording{})) << t.result.message;
  const Result<TakeReader> read = TakeReader::open(take.path());
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_TRUE(read->complete());
  EXPECT_NEAR(double(read->frameCount()), 32, 3);
  EXPECT_NEAR(read->frame(0)->time, 0.5, 0.02);
  EXPECT_EQ(read->bodies().back().name, "shot 1");
}

TEST(Files, RewindingEndsARecordingWhole) {
  TempFile take("rewound.take");
  TestSession t(kWall, true);
  t.pass(0.2);
  ASSERT_TRUE(t.does(StartRecording{take.path()}));
  t.pass(0.4);
  ASSERT_TRUE(t.does(Rewind{0.3}));
  EXPECT_EQ(t.frame()->status.recording, "");
  EXPECT_TRUE(TakeReader::open(take.path())->complete());
}

TEST(Files, TheMenuHasTheReportsTestsAndAllShippedScenes) {
  const std::vector<MenuGroup> menu = sceneMenu();
  ASSERT_GT(menu.size(), 3u);
  ASSERT_EQ(menu[0].entries.size(), 4u);
  EXPECT_EQ(menu[0].entries[0].scene, "cube");
  std::set<std::string> once;
  for (const MenuGroup& group : menu) {
    EXPECT_NE(group.label, "More") << "a shipped scene stands under no kind in scene_menu.cpp";
    for (const MenuEntry& entry : group.entries) EXPECT_TRUE(once.insert(entry.scene).second) << entry.scene;
  }
  EXPECT_EQ(once.size(), shippedScenes().size());
  TestSession t;
  for (const MenuEntry& entry : menu[0].entries) {
    EXPECT_TRUE(t.does(Open{entry.scene, {}, false})) << t.result.message;
    EXPECT_EQ(t.frame()->info->name, entry.scene);
    EXPECT_FALSE(t.frame()->info->cameras.empty());
  }
}

TEST(Files, AMomentIsASceneThatBeginsThere) {
  TempFile file("moment.toml");
  TestSession t(kCubes, true);
  t.pass(0.1);
  ASSERT_TRUE(t.does(ShootBall{{{0, 3, 0}, {0.6, 0, 0.8}}, 0.07, 5, "steel"}));
  t.pass(0.1);
  ASSERT_TRUE(t.does(Pause{}));
  const std::shared_ptr<const Frame> before = t.frame();
  const SceneText scene = sceneTextOf(*before, {});
  EXPECT_EQ(scene.leftOut, "");
  file.write(scene.text);
  ASSERT_TRUE(t.does(Open{file.path(), {}, false})) << t.result.message << "\n" << scene.text;
  const std::shared_ptr<const Frame> after = t.frame();
  ASSERT_EQ(after->bodies.size(), before->bodies.size());
  for (std::size_t i = 0; i < after->bodies.size(); i++) {
    const std::string& name = before->list->bodies[i].name;
    const auto same = [&](const ListedBody& body) { return body.name == name; };
    const auto& bodies = after->list->bodies;
    const auto at = std::find_if(bodies.begin(), bodies.end(), same);
    ASSERT_NE(at, bodies.end()) << name;
    const FrameBody &a = after->bodies[std::size_t(at - bodies.begin())], &b = before->bodies[i];
    EXPECT_NEAR(length(a.pose.position - b.pose.position), 0, 1e-7) << name;
    EXPECT_NEAR(length(rotate(a.pose.rotation, Vec3{1, 2, 3}) - rotate(b.pose.rotation, Vec3{1, 2, 3})), 0, 1e-6)
        << name;
    EXPECT_NEAR(length(a.linearVelocity - b.linearVelocity), 0, 1e-7) << name;
    EXPECT_NEAR(at->mass, before->list->bodies[i].mass, 1e-6) << name;
  }
}

TEST(Files, ASavedStateKeepsTheNumbersThatColoursGoBy) {
  TempFile file("numbers.state");
  TestSession t(kWall, true);
  t.pass(0.1);
  ASSERT_TRUE(t.does(SaveState{file.path()}));
  const std::shared_ptr<const BodyList> before = t.frame()->list;
  ASSERT_TRUE(t.does(Open{file.path(), {}, false})) << t.result.message;
  const std::shared_ptr<const BodyList> after = t.frame()->list;
  ASSERT_EQ(after->bodies.size(), before->bodies.size());
  for (std::size_t i = 0; i < after->bodies.size(); i++) {
    EXPECT_EQ(after->bodies[i].number, before->bodies[i].number);
    EXPECT_NE(after->bodies[i].serial, before->bodies[i].serial);
  }
}

TEST(Files, TheListHasTheFoldersFilesAndFindsThemByTheirWords) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("brickfall-" + std::to_string(::getpid()) + "-list");
  std::filesystem::create_directories(folder / "out" / ".hidden");
  for (const char* name : {"b.toml", "a.state", "out/One Wall.take", "out/notes.txt", "out/.hidden/c.toml"})
    std::ofstream(folder / name) << "x";
  const std::vector<FileEntry> files = findFiles(folder.string(), {"/last.toml"});
  std::filesystem::remove_all(folder);
  ASSERT_EQ(files.size(), 4u);
  EXPECT_EQ(files[0].path, "/last.toml");
  EXPECT_EQ(files[1].kind, FileKind::scene);
  EXPECT_EQ(files[2].kind, FileKind::take);
  EXPECT_EQ(files[3].kind, FileKind::state);
  EXPECT_TRUE(fits(files[2], "wall out"));
  EXPECT_TRUE(fits(files[2], ""));
  EXPECT_FALSE(fits(files[2], "wall b.toml"));
}

}  // namespace
}  // namespace brickfall::viewer
