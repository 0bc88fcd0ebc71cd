// Arguments and scene files that cannot be used: the exit code and one line that says what was found and expected.
#include "bad_input/cli/command_fixture.h"

namespace brickfall::test {
namespace {

class BadArguments : public Command {};

TEST_F(BadArguments, helpAndVersionAreNoErrors) {
  const std::pair<std::vector<std::string>, const char*> commands[] = {
      {{"--help"}, "what was simulated is kept.\n"},
      {{"run", "--help"}, "what was simulated is kept.\n"},
      {{"check", "--help"}, "read or written.\n"},
      {{"scenes", "--help"}, "read or written.\n"},
      {{"replay", "--help"}, "130 interrupted, the take stays as it is.\n"},
      {{"trace", "--help"}, "what was traced is kept.\n"},
      {{"check-dt", "--help"}, "130 interrupted, nothing is told.\n"}};
  for (const auto& [arguments, end] : commands) {
    const Finished help = run(arguments);
    EXPECT_EQ(help.exitCode, 0);
    EXPECT_EQ(help.errors, "");
    EXPECT_NE(help.output.find("Examples:"), std::string::npos) << help.output;
    EXPECT_TRUE(help.output.ends_with(end)) << help.output;
    EXPECT_NE(help.output.find("Exit codes:"), std::string::npos) << help.output;
  }
  const Finished version = run({"--version"});
  EXPECT_EQ(version.exitCode, 0);
  EXPECT_EQ(version.output.rfind("brickfall ", 0), 0u) << version.output;
}

TEST_F(BadArguments, aCommandIsExpected) {
  const Finished none = run({});
  EXPECT_EQ(none.exitCode, 2);
  EXPECT_TRUE(isOneComplaint(none.errors, {"command: found nothing, expected one of: run, check, scenes, replay, "
                                           "export, trace, check-dt, completion, man, help, version, view, render"}));
  const Finished typo = run({"rnu", "wall"});
  EXPECT_EQ(typo.exitCode, 2);
  EXPECT_TRUE(isOneComplaint(typo.errors, {"command: found \"rnu\"", "did you mean \"run\"?"}));
  const Finished option = run({"--frobnicate"});
  EXPECT_EQ(option.exitCode, 2);
  EXPECT_TRUE(isOneComplaint(option.errors, {"--frobnicate"}));
}

TEST_F(BadArguments, optionsOfACommand) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"run"}, "scene is required"},
      {{"run", "cube", "-o", ""}, "--output: found \"\", expected a name"},
      {{"run", "cube", "--frobnicate"}, "--frobnicate"},
      {{"run", "cube", "--second", "3"}, "--second (did you mean \"--seconds\"?)"},
      {{"run", "cube", "--outptu=x"}, "did you mean \"--output\"?"},
      {{"run", "cube", "--seconds"}, "--seconds"},
      {{"run", "cube", "--seconds", "nan"}, "--seconds: found \"nan\", expected a number of seconds above 0"},
      {{"run", "cube", "--seconds", "-1"}, "--seconds: found \"-1\", expected"},
      {{"run", "cube", "--seconds", "0"}, "--seconds: found \"0\", expected"},
      {{"run", "cube", "--seconds", "inf"}, "--seconds: found \"inf\", expected"},
      {{"run", "cube", "--seconds", "1e300"}, "--seconds: found \"1e300\", expected"},
      {{"run", "cube", "--seconds", "soon"}, "--seconds: found \"soon\", expected"},
      {{"run", "cube", "--threads", "0"}, "--threads: found \"0\", expected a whole number from 1 to 64"},
      {{"run", "cube", "--threads", "-3"}, "--threads: found \"-3\", expected"},
      {{"run", "cube", "--threads", "1000"}, "--threads: found \"1000\", expected"},
      {{"run", "cube", "--threads", "2.5"}, "--threads: found \"2.5\", expected"},
      {{"run", "cube", "--set", "seconds"}, "--set: found \"seconds\", expected KEY=VALUE"},
      {{"run", "cube", "--set", "=3"}, "--set: found \"=3\", expected KEY=VALUE"},
      {{"check"}, "file is required"},
      {{"replay"}, "take is required"},
      {{"scenes", "cube"}, "cube"},
  };
  for (const auto& [arguments, expected] : cases) {
    const Finished refused = run(arguments);
    EXPECT_EQ(refused.exitCode, 2) << expected;
    EXPECT_TRUE(isOneComplaint(refused.errors, {expected}));
    EXPECT_EQ(refused.output, "");
    EXPECT_FALSE(exists("out")) << "nothing may be made before the arguments are known to be good";
  }
}

TEST_F(BadArguments, helpAndVersionAreCommandsToo) {
  EXPECT_EQ(run({"version"}).output, run({"--version"}).output);
  EXPECT_EQ(run({"help"}).output, run({"--help"}).output);
  EXPECT_EQ(run({"help", "run"}).output, run({"run", "--help"}).output);
  EXPECT_EQ(run({"help", "rnu"}).exitCode, 2);
  const Finished man = run({"man"});
  EXPECT_EQ(man.output.rfind(".TH BRICKFALL 1", 0), 0u) << man.output;
  EXPECT_NE(man.output.find("\n.SS run\n"), std::string::npos);
  for (const char* shell : {"bash", "zsh", "fish"}) {
    const Finished words = run({"completion", shell});
    EXPECT_EQ(words.exitCode, 0);
    EXPECT_NE(words.output.find("seconds"), std::string::npos) << shell;
  }
  EXPECT_EQ(run({"completion", "tcsh"}).exitCode, 2);
}

TEST_F(BadArguments, aSceneComesFromStandardInput) {
  write("in.toml", "[world]\nseconds = 0.1\n[[body]]\nposition = [0, 1, 0]\n");
  ProcessOptions options;
  options.inputPath = "in.toml";
  EXPECT_EQ(run({"run", "-", "--no-html", "--no-glb"}, options).exitCode, 0);
  EXPECT_TRUE(exists("out/stdin/summary.json"));
  write("in.toml", "[[bodi]]\n");
  const Finished refused = run({"run", "-"}, options);
  EXPECT_EQ(refused.exitCode, 2);
  EXPECT_NE(refused.errors.find("stdin:1:3: error: bodi: "), std::string::npos) << refused.errors;
}

TEST_F(BadArguments, scenesOfOneNameHaveTheirOwnResults) {
  for (const char* folder : {"a", "b"}) {
    std::filesystem::create_directory(folder_ / folder);
    write(std::string(folder) + "/x.toml", "[world]\nseconds = 0.1\nseed = 3\n[[body]]\nposition = [0, 1, 0]\n");
    for (int again = 0; again < 2; again++)
      EXPECT_EQ(run({"run", std::string(folder) + "/x.toml", "--no-html", "--no-glb"}).exitCode, 0);
  }
  EXPECT_NE(read("out/x/summary.json").find("/a/x.toml"), std::string::npos);
  EXPECT_NE(read("out/x-2/summary.json").find("/b/x.toml"), std::string::npos);
  EXPECT_FALSE(exists("out/x-3"));
}

TEST_F(BadArguments, aRunEndsWhenAllRestsAndWhatFallsIsTakenOut) {
  write("rest.toml",
        "[world]\nseconds = 9\nstop_when = \"rest\"\nremove_below = -1\n[ground]\ntype = \"box\"\nsize = [1, 1, 1]\n"
        "[[body]]\nsize = [0.2, 0.2, 0.2]\nposition = [0, 0.1, 0]\n[[body]]\nposition = [5, 0, 0]\n");
  const Finished done = run({"run", "rest.toml", "--no-html", "--no-glb"});
  EXPECT_EQ(done.exitCode, 0) << done.errors;
  const std::string summary = read("out/rest/summary.json");
  const double seconds = std::stod(summary.substr(summary.find("simulated_s\": ") + 14));
  EXPECT_GT(seconds, 0.5);
  EXPECT_LT(seconds, 3);
}

TEST_F(BadArguments, unknownSceneNamesTheNearest) {
  for (const char* command : {"run", "check"}) {
    const Finished refused = run({command, "cubee"});
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_TRUE(isOneComplaint(refused.errors, {"scene: found \"cubee\"", "one of: ", "did you mean \"cube\"?"}));
  }
  EXPECT_EQ(run({"run", ""}).exitCode, 2);
}

TEST_F(BadArguments, missingAndUnreadableFiles) {
  std::filesystem::create_directory(folder_ / "folder.toml");
  for (const char* command : {"run", "check"}) {
    const Finished missing = run({command, "no/such.toml"});
    EXPECT_EQ(missing.exitCode, 3);
    EXPECT_TRUE(isOneComplaint(missing.errors, {"'no/such.toml'", "No such file"}));
    const Finished folder = run({command, "folder.toml"});
    EXPECT_EQ(folder.exitCode, 3);
    EXPECT_TRUE(isOneComplaint(folder.errors, {"'folder.toml'", "Is a directory"}));
  }
  const Finished take = run({"replay", "no.take"});
  EXPECT_EQ(take.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(take.errors, {"no.take"}));
}

TEST_F(BadArguments, controlCharactersOfNamesAreNotShown) {
  const Finished refused = run({"run", "no\nsuch\x1b[31m/scene.toml"});
  EXPECT_EQ(refused.exitCode, 3);
  EXPECT_TRUE(isOneComplaint(refused.errors, {"no?such?[31m"}));
}

TEST_F(BadArguments, mistakesOfASceneFileEndARunBeforeItStarts) {
  write("bad.toml", "this is = = not toml\n");
  for (const char* command : {"run", "check"}) {
    const Finished refused = run({command, "bad.toml"});
    EXPECT_EQ(refused.exitCode, 2);
    EXPECT_NE(refused.errors.find("bad.toml:1:"), std::string::npos) << refused.errors;
    EXPECT_FALSE(exists("out"));
  }
  write("empty.toml", "");
  write("noise.toml", std::string("\x00\xff\xfe\x80", 4));
  EXPECT_EQ(run({"check", "noise.toml"}).exitCode, 2);
  const Finished setting = run({"run", "cube", "--set", "no.such.key=1"});
  EXPECT_EQ(setting.exitCode, 2);
  EXPECT_NE(setting.errors.find("no"), std::string::npos);
}

TEST_F(BadArguments, checkLooksAtEveryFile) {
  write("bad.toml", "= 1\n");
  const Finished both = run({"check", "bad.toml", "cube", "missing.toml"});
  EXPECT_EQ(both.exitCode, 3) << "the gravest counts";
  EXPECT_NE(both.errors.find("bad.toml"), std::string::npos);
  EXPECT_NE(both.errors.find("missing.toml"), std::string::npos);
  EXPECT_NE(both.output.find("cube"), std::string::npos);
}

TEST_F(BadArguments, shippedScenesAreListedAndFine) {
  const Finished list = run({"scenes"});
  EXPECT_EQ(list.exitCode, 0);
  for (const char* name : {"cube", "wall", "hole", "house"})
    EXPECT_NE(list.output.find(std::string(name) + " "), std::string::npos) << list.output;
  const Finished checked = run({"check", "cube", "wall", "hole", "house"});
  EXPECT_EQ(checked.exitCode, 0) << checked.errors;
}

TEST_F(BadArguments, whatARunCanBeToldCanBeChecked) {
  EXPECT_NE(run({"check", "wall", "--set", "courses=2", "--set", "bricks=3"}).output.find("7 bricks"),
            std::string::npos);
  const Finished wrong = run({"check", "wall", "--set", "wall.bond=brick"});
  EXPECT_EQ(wrong.exitCode, 2);
  EXPECT_NE(wrong.errors.find("wall[0].bond"), std::string::npos) << wrong.errors;
  EXPECT_EQ(run({"check", "wall", "--set", "bricks"}).exitCode, 2);
}

}  // namespace
}  // namespace brickfall::test
