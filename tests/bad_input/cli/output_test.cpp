// Where results cannot go, or what a run leaves when all is well.
#include <nlohmann/json.hpp>
#include <sstream>
#include <tuple>

#include "bad_input/cli/command_fixture.h"

namespace brickfall::test {
namespace {

using nlohmann::json;

class Outputs : public Command {};

TEST_F(Outputs, aRunLeavesAllItsFiles) {
  const Finished done = run({"run", "cube", "--seconds", "0.5", "-o", "made/here"});
  EXPECT_EQ(done.exitCode, 0) << done.errors;
  EXPECT_EQ(done.errors, "");
  for (const char* name : {"replay.html", "cube.glb", "summary.json", "series.csv", "cube.take"}) {
    EXPECT_TRUE(exists(std::string("made/here/") + name)) << name;
    EXPECT_NE(done.output.find(std::string("made/here/") + name), std::string::npos) << "not said: " << name;
  }
  EXPECT_EQ(done.output.find('\r'), std::string::npos) << "no moving line where there is no terminal";

  const json summary = json::parse(read("made/here/summary.json"));
  for (const char* key : {"scene",
                          "version",
                          "seed",
                          "state_hash",
                          "bodies",
                          "bricks",
                          "steps",
                          "dt_s",
                          "simulated_s",
                          "wall_clock_s",
                          "step_ms",
                          "stage_ms",
                          "realtime_factor",
                          "threads",
                          "displacement_max_m",
                          "bricks_moved_50mm",
                          "sag_max_m",
                          "creep_max_m",
                          "penetration_max_m",
                          "penetration_mean_m",
                          "kinetic_energy_max_j",
                          "kinetic_energy_end_j",
                          "energy_ratio_max",
                          "contacts_mean",
                          "asleep_end",
                          "quarantined"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_EQ(summary.size(), 27u);
  EXPECT_EQ(summary["scene"], "cube");
  EXPECT_NEAR(summary["simulated_s"].get<double>(), 0.5, 1e-6);
  EXPECT_NEAR(summary["steps"].get<double>() * summary["dt_s"].get<double>(), 0.5, 1e-6);
  EXPECT_EQ(summary["state_hash"].get<std::string>().size(), 16u);
  EXPECT_EQ(summary["quarantined"], 0);
  EXPECT_GT(summary["displacement_max_m"].get<double>(), 0.1) << "the cube falls";
}

TEST_F(Outputs, sameSceneSameBits) {
  ASSERT_EQ(run({"run", "cube", "--seconds", "1", "-o", "a", "--quiet", "--no-html", "--no-glb"}).exitCode, 0);
  ASSERT_EQ(
      run({"run", "cube", "--seconds", "1", "-o", "b", "--quiet", "--no-html", "--no-glb", "--threads", "2"}).exitCode,
      0);
  const json a = json::parse(read("a/summary.json")), b = json::parse(read("b/summary.json"));
  EXPECT_EQ(a["state_hash"], b["state_hash"]);
  EXPECT_EQ(b["threads"], 2);
  EXPECT_EQ(read("a/cube.take"), read("b/cube.take"));
  EXPECT_EQ(read("a/series.csv"), read("b/series.csv"));
}

// Energy that is there and energy that is lost are what was put in, at every moment; the last row is the summary's.
TEST_F(Outputs, aSeriesBalancesAndEndsAsTheSummary) {
  ASSERT_EQ(run({"run", "cube", "--seconds", "1.5", "-o", "a", "--quiet", "--no-html", "--no-glb"}).exitCode, 0);
  std::istringstream lines(read("a/series.csv"));
  std::string line;
  std::getline(lines, line);
  EXPECT_TRUE(line.starts_with("time_s,kinetic_way_j,kinetic_turn_j,potential_j,lost_j,momentum_x_kg_m_s,")) << line;
  std::vector<double> row;
  double whole = 0;
  int rows = 0;
  while (std::getline(lines, line)) {
    row.clear();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
    ASSERT_EQ(row.size(), 17u);
    const double sum = row[1] + row[2] + row[3] + row[4];
    if (rows++ == 0) whole = sum;
    EXPECT_NEAR(sum, whole, 1e-6 * whole) << "row " << rows;
  }
  EXPECT_EQ(rows, 91);
  EXPECT_GT(row[4], 0.5 * whole) << "the fall is lost in the end";
  const json summary = json::parse(read("a/summary.json"));
  EXPECT_NEAR(row[1] + row[2], summary["kinetic_energy_end_j"].get<double>(), 1e-5 * whole);
}

TEST_F(Outputs, exportsWhatTheTakeHas) {
  ASSERT_EQ(run({"run", "cube", "--seconds", "0.5", "-o", "a", "--quiet", "--no-html", "--no-glb"}).exitCode, 0);
  const Finished done = run({"export", "a/cube.take", "--to", "csv", "--to", "json", "--to", "npz", "-o", "b"});
  EXPECT_EQ(done.exitCode, 0) << done.errors;
  for (const char* name :
       {"cube.bodies.csv", "cube.poses.csv", "cube.events.csv", "cube.series.csv", "cube.json", "cube.npz"})
    EXPECT_TRUE(exists(std::string("b/") + name)) << name;
  // By readers of another make: Python's csv, json and zipfile, and NumPy where it is.
  const std::string check = "python3 '" BRICKFALL_SOURCE_DIR "/tests/bad_input/cli/read_exports.py' '" +
                            (folder_ / "b/cube").string() + "' > '" + (folder_ / "said").string() + "' 2>&1";
  EXPECT_EQ(std::system(check.c_str()), 0) << read("said");
  EXPECT_EQ(run({"export", "a/cube.take", "--to", "xls"}).exitCode, 2);
  EXPECT_EQ(run({"export", "a/cube.take", "--every", "0"}).exitCode, 2);
  EXPECT_EQ(run({"export", "a/summary.json"}).exitCode, 3);
  EXPECT_EQ(run({"export", "a/cube.take", "--to", "npz", "-o", "a/cube.take/x"}).exitCode, 3);
}

TEST_F(Outputs, jsonForPrograms) {
  write("bad.toml", "[world]\ngravty = 1\n");
  const Finished bad = run({"check", "bad.toml", "cube", "--json"});
  EXPECT_EQ(bad.exitCode, 2);
  EXPECT_EQ(bad.errors, "");
  const json answers = json::parse(bad.output);
  ASSERT_EQ(answers.size(), 2u);
  EXPECT_EQ(answers[0]["ok"], false);
  bool found = false;
  for (const json& diagnostic : answers[0]["diagnostics"])
    found = found || (diagnostic["line"] == 2 && diagnostic["key"] == "world.gravty");
  EXPECT_TRUE(found) << bad.output;
  EXPECT_EQ(answers[1]["ok"], true);
  const Finished scenes = run({"scenes", "--json"});
  bool listed = false;
  for (const json& scene : json::parse(scenes.output)) listed = listed || scene["name"] == "cube";
  EXPECT_TRUE(listed);
  const Finished compared = run({"check-dt", "cube", "--seconds", "0.5", "--json"});
  EXPECT_EQ(compared.exitCode, 0) << compared.errors;
  const json outcome = json::parse(compared.output);
  EXPECT_EQ(outcome["scene"], "cube");
  ASSERT_EQ(outcome["runs"].size(), 4u);
  EXPECT_DOUBLE_EQ(outcome["runs"][1]["dt"], 1.0 / 120);
  EXPECT_EQ(outcome["runs"][3]["moved_as_finest"], 1);
}

// The report's system, whose energy grows without end, leaves sound files too.
TEST_F(Outputs, theReportsWallLeavesWhatOthersLeave) {
  const Finished done = run({"run", "report_wall", "--seconds", "3", "-o", "wall"});
  EXPECT_EQ(done.exitCode, 0) << done.errors;
  EXPECT_EQ(done.errors, "");
  for (const char* name : {"replay.html", "report_wall.glb", "report_wall.take"})
    EXPECT_TRUE(exists(std::string("wall/") + name)) << name;
  const json summary = json::parse(read("wall/summary.json"));
  EXPECT_EQ(summary["bricks"], 105);
  EXPECT_EQ(summary["steps"], 180);
  EXPECT_GT(summary["displacement_max_m"].get<double>(), 0.05) << "it falls by itself";
  const Finished again = run({"replay", "wall/report_wall.take", "-o", "again"});
  EXPECT_EQ(again.exitCode, 0) << again.errors;
}

TEST_F(Outputs, switchesLeaveOutputsOut) {
  const Finished done = run({"run", "cube", "--seconds", "0.2", "--quiet", "--no-html", "--no-glb"});
  EXPECT_EQ(done.exitCode, 0) << done.errors;
  EXPECT_EQ(done.output, "");
  EXPECT_TRUE(exists("out/cube/summary.json"));
  EXPECT_TRUE(exists("out/cube/cube.take"));
  EXPECT_FALSE(exists("out/cube/replay.html"));
  EXPECT_FALSE(exists("out/cube/cube.glb"));
}

TEST_F(Outputs, aFileIsInTheWayOfTheFolder) {
  write("taken", "precious");
  for (const char* folder : {"taken", "taken/below"}) {
    const Finished refused = run({"run", "cube", "-o", folder});
    EXPECT_EQ(refused.exitCode, 3);
    EXPECT_TRUE(isOneComplaint(refused.errors, {"'taken' is a file"}));
  }
  EXPECT_EQ(read("taken"), "precious");
}

// The kernel refuses even root in /proc.
TEST_F(Outputs, folderThatCannotBeMade) {
  const Finished refused = run({"run", "cube", "-o", "/proc/brickfall"});
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(refused.errors, {"/proc/brickfall"}));
}

TEST_F(Outputs, folderThatCannotBeWrittenInto) {
  using std::filesystem::perms;
  std::filesystem::create_directory(folder_ / "locked");
  std::filesystem::permissions(folder_ / "locked",
                               perms::owner_read | perms::owner_exec | perms::others_read | perms::others_exec);
  ProcessOptions options;
  options.asNobody = true;
  const Finished refused = run({"run", "cube", "-o", "locked"}, options);
  const bool notStarted =
      refused.exitCode == 126 || refused.exitCode == 127;  // of process.cpp: exec or chdir was refused
  if (notStarted) GTEST_SKIP() << "missing: a build folder that others than root may enter";
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(refused.errors, {"'locked'", "Permission denied"}));
}

TEST_F(Outputs, aFolderInTheWayOfAFile) {
  for (const char* name : {"out/cube.take", "out/summary.json", "out/replay.html", "out/cube.glb"}) {
    std::filesystem::remove_all(folder_ / "out");
    std::filesystem::create_directories(folder_ / name / "inside");
    const Finished refused = run({"run", "cube", "--seconds", "0.1", "-o", "out"});
    EXPECT_EQ(refused.exitCode, 3) << name;
    EXPECT_TRUE(isOneComplaint(refused.errors, {std::filesystem::path(name).filename().string()}));
    EXPECT_TRUE(exists(std::string(name) + "/inside"));
  }
}

TEST_F(Outputs, aReaderThatLeavesDoesNotEndTheRun) {
  ProcessOptions options;
  options.closedPipe = true;
  const Finished done = run({"run", "cube", "--seconds", "0.2"}, options);
  EXPECT_EQ(done.exitCode, 0) << done.signal << done.errors;
  EXPECT_EQ(done.errors, "");
  EXPECT_TRUE(exists("out/cube/summary.json"));
  EXPECT_EQ(run({"scenes"}, options).exitCode, 0);
}

TEST_F(Outputs, aFullDiskUnderStandardOutputIsSaid) {
  ProcessOptions options;
  options.outputPath = "/dev/full";
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"scenes"}, {"--help"}, {"check", "cube"}}) {
    const Finished refused = run(arguments, options);
    EXPECT_EQ(refused.exitCode, 3) << arguments[0];
    EXPECT_TRUE(isOneComplaint(refused.errors, {"standard output", "No space left"}));
  }
}

TEST_F(Outputs, aFullDiskUnderTheResultsIsSaid) {
  ProcessOptions options;
  options.largestFile = 3000;
  const Finished refused = run({"run", "cube", "-o", "full"}, options);
  EXPECT_EQ(refused.exitCode, 3) << refused.signal;
  EXPECT_NE(refused.errors.find("cube.take"), std::string::npos) << refused.errors;
  std::istringstream lines(refused.errors);
  for (std::string line; std::getline(lines, line);) EXPECT_TRUE(line.starts_with("brickfall: ")) << line;
  // Whole or not at all; the recording opens as far as it came.
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "full")) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(name == "cube.take.part" || name == "summary.json" || name == "series.csv")
        << name << " is left behind";
  }
  EXPECT_EQ(run({"replay", "full/cube.take.part", "-o", "again", "--quiet"}).exitCode, 0);
}

TEST_F(Outputs, replayMakesTheSameAgain) {
  ASSERT_EQ(run({"run", "cube", "--seconds", "0.5", "-o", "a", "--quiet"}).exitCode, 0);
  const Finished again = run({"replay", "a/cube.take", "-o", "b"});
  EXPECT_EQ(again.exitCode, 0) << again.errors;
  for (const char* name : {"replay.html", "cube.glb"})
    EXPECT_EQ(read(std::string("a/") + name), read(std::string("b/") + name)) << name;
  // The take does not know what the run cost, and has its figures with six digits.
  json whole = json::parse(read("a/summary.json"));
  for (const char* key : {"wall_clock_s", "step_ms", "stage_ms", "realtime_factor", "threads"}) whole.erase(key);
  EXPECT_EQ(json::parse(read("b/summary.json")), whole);
  EXPECT_TRUE(read("b/series.csv").starts_with("time_s,"));
  // In the folder of the run its own summary stays.
  const std::string summary = read("a/summary.json");
  EXPECT_EQ(run({"replay", "a/cube.take"}).exitCode, 0);
  EXPECT_EQ(read("a/summary.json"), summary);
}

TEST_F(Outputs, replayOfACutTakeSaysSo) {
  ASSERT_EQ(run({"run", "cube", "--seconds", "1", "-o", "a", "--quiet", "--no-html", "--no-glb"}).exitCode, 0);
  const std::string whole = read("a/cube.take");
  write("cut.take", whole.substr(0, whole.size() * 3 / 5));
  const Finished again = run({"replay", "cut.take", "-o", "b"});
  EXPECT_EQ(again.exitCode, 0) << again.errors;
  EXPECT_TRUE(isOneComplaint(again.errors, {"cut.take", "cut off"}));
  EXPECT_TRUE(exists("b/replay.html"));
  EXPECT_FALSE(exists("b/summary.json"));
}

TEST_F(Outputs, replayTakesAPosterAndAnAddressOrSaysWhyNot) {
  ASSERT_EQ(run({"run", "cube", "--seconds", "0.1", "-o", "a", "--quiet", "--no-html", "--no-glb"}).exitCode, 0);
  write("p.png", "\x89PNG\r\n\x1a\n...");
  const auto replayed = [&](const char* poster, const char* address) {
    return run({"replay", "a/cube.take", "--no-glb", "--poster", poster, "--address", address});
  };
  EXPECT_EQ(replayed("p.png", "https://example.org/cube.html").exitCode, 0);
  EXPECT_NE(read("a/replay.html").find("\"https://example.org/p.png\""), std::string::npos);
  for (const auto& [poster, address, code] : {std::tuple{"none.png", "https://example.org", 3},
                                              {"a/cube.take", "https://example.org", 3},
                                              {"p.png", "example.org", 2}}) {
    const Finished refused = replayed(poster, address);
    EXPECT_EQ(refused.exitCode, code) << poster;
    EXPECT_TRUE(isOneComplaint(refused.errors, {code == 2 ? address : poster})) << refused.errors;
  }
}

TEST_F(Outputs, replayRefusesWhatIsNoTake) {
  write("empty.take", "");
  write("noise.take", std::string(1000, '\x5a'));
  for (const char* name : {"empty.take", "noise.take", "."}) {
    const Finished refused = run({"replay", name});
    EXPECT_EQ(refused.exitCode, 3) << name;
    EXPECT_TRUE(isOneComplaint(refused.errors, {name}));
  }
}

}  // namespace
}  // namespace brickfall::test
