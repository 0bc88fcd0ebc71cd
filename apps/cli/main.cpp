// The arguments of `brickfall`. The only file that sees CLI11; the commands are in files of their own.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <new>
#include <stdexcept>

#include "brickfall/scene.h"
#include "brickfall/world.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/companion.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "cli/outputs.h"

namespace brickfall::cli {
namespace {

// `more`: those that the command has besides.
std::string exitCodes(const std::string& more = {}) {
  return "Exit codes: 0 done; 1 internal error; 2 bad arguments or scene; 3 a file cannot be read or written" +
         (more.empty() ? "." : ";\n" + more + ".");
}
constexpr const char* kRunCodes = "4 done, but bodies became non-finite; 130 interrupted, what was simulated is kept";

struct Arguments {
  RunOptions run;
  std::string seconds, threads;
  std::vector<std::string> overrides;
  std::vector<std::string> checked;
  std::string take;
  OutputOptions replay;
  TraceCommand trace;
  CheckDtCommand checkDt;
  ExportCommand exported;
  std::string every;
  bool checkJson = false, scenesJson = false;
  std::string items;
  std::vector<std::string> compared;
  std::string shell;
};

// A name that a script left empty would be the default one.
std::string namesSomething(const std::string& text) {
  return text.empty() ? "found \"\", expected a name" : std::string();
}

void addOutputOptions(CLI::App& command, OutputOptions& options, const std::string& defaultFolder) {
  command.add_option("-o,--output", options.folder, "Folder for the results (default: " + defaultFolder + ")")
      ->type_name("DIR")
      ->check(namesSomething);
  for (const OutputKind& kind : outputKinds()) {
    const auto leaveOut = [&options, name = std::string(kind.name)] { options.leftOut.push_back(name); };
    command.add_flag_callback(std::string("--no-") + kind.name, leaveOut, "Leave out " + outputFile(kind, "<scene>"));
  }
  command.add_flag("--quiet", options.quiet, "Say nothing but errors");
}

void addSetOption(CLI::App& command, Arguments& arguments) {
  command.add_option("--set", arguments.overrides, "Change a parameter or value of the scene file; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
}

// What decides about a simulation.
void addRunOptions(CLI::App& command, Arguments& arguments) {
  command.add_option("--seconds", arguments.seconds, "Simulate so long instead of what the scene says")->type_name("S");
  addSetOption(command, arguments);
  command.add_option("--threads", arguments.threads, "Worker threads, 1 to 64; the result does not depend on it")
      ->type_name("N");
}

void defineTrace(CLI::App& app, Arguments& arguments) {
  CLI::App& trace = *app.add_subcommand("trace", "Find the first step and stage in which two runs part");
  trace.add_option("scene", arguments.trace.scene, "A scene file, or a shipped scene: its trace is written")
      ->type_name("SCENE");
  trace.add_option("-o,--output", arguments.trace.output, "The trace (default: out/<scene>/<scene>.trace)")
      ->type_name("FILE")
      ->check(namesSomething);
  addRunOptions(trace, arguments);
  trace.add_option("--items", arguments.items, "In this step also a hash of each body and contact")->type_name("STEP");
  trace.add_option("--compare", arguments.compared, "Two traces: where do they part? No scene is run")
      ->expected(2)
      ->type_name("TRACE");
  trace.add_flag("--quiet", arguments.trace.quiet, "Say nothing but errors");
  trace.footer(
      std::string("Examples:\n"
                  "  brickfall trace wall -o here.trace              one run, on this machine\n"
                  "  brickfall trace --compare here.trace there.trace\n"
                  "  brickfall trace wall -o here.trace --items 17   which body or contact it was, in step 17\n\n"
                  "--compare: exit code 1 if the runs part.\n") +
      exitCodes("130 interrupted, what was traced is kept"));
}

void defineCheckDt(CLI::App& app, Arguments& arguments) {
  CLI::App& command = *app.add_subcommand("check-dt", "Tell how far the outcome depends on the time step");
  command.add_option("scene", arguments.checkDt.scene, "A scene file, or a shipped scene")
      ->required()
      ->type_name("SCENE");
  addRunOptions(command, arguments);
  command.add_flag("--quiet", arguments.checkDt.quiet, "Leave out the progress");
  command.add_flag("--json", arguments.checkDt.asJson, "Answer in JSON, on standard output");
  command.footer(
      std::string(
          "Runs it at 1/60, 1/120, 1/240 and 1/480 s: what moved, what broke, and how much of that is the same.\n\n"
          "Examples:\n  brickfall check-dt wall\n  brickfall check-dt hole --seconds 3\n"
          "  brickfall check-dt hole --json > hole.json\n\n") +
      exitCodes("130 interrupted, nothing is told"));
}

void defineExport(CLI::App& app, Arguments& arguments) {
  CLI::App& command = *app.add_subcommand("export", "A take as numbers: CSV, JSON, NumPy");
  command.add_option("take", arguments.exported.take, "A recording made by brickfall run, also one that was cut off")
      ->required()
      ->type_name("TAKE");
  command.add_option("--to", arguments.exported.kinds, "csv, json or npz; may be repeated (default: csv)")
      ->type_name("FORMAT")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  command.add_option("--every", arguments.every, "Poses of every N-th frame only")->type_name("N");
  command
      .add_option("-o,--output", arguments.exported.folder, "Folder for the files (default: the folder of the take)")
      ->type_name("DIR")
      ->check(namesSomething);
  command.add_flag("--quiet", arguments.exported.quiet, "Say nothing but errors");
  command.footer(std::string("Examples:\n"
                             "  brickfall export out/wall/wall.take                four tables of text\n"
                             "  brickfall export out/wall/wall.take --to npz       for numpy.load\n"
                             "  brickfall export wall.take --to json --every 6\n\n") +
                 exitCodes("130 interrupted, the take stays as it is"));
}

void defineCommands(CLI::App& app, Arguments& arguments) {
  app.name("brickfall");
  app.set_version_flag("--version", std::string("brickfall ") + versionString());
  app.footer(std::string("Examples:\n"
                         "  brickfall run wall                 knock down the shipped wall, into out/wall/\n"
                         "  brickfall check mine.toml          all mistakes of a scene file\n"
                         "  brickfall run --help               more on a command\n\n") +
             exitCodes(kRunCodes));

  CLI::App& run =
      *app.add_subcommand("run", "Simulate a scene: replay.html, <scene>.glb, summary.json, series.csv, <scene>.take");
  run.add_option("scene", arguments.run.scene,
                 "A scene file, a shipped scene (brickfall scenes), or - for standard input")
      ->required()
      ->type_name("SCENE");
  addOutputOptions(run, arguments.run.output, "out/<scene>");
  addRunOptions(run, arguments);
  run.footer(std::string("Examples:\n"
                         "  brickfall run wall\n"
                         "  brickfall run hole -o short --seconds 3\n"
                         "  brickfall run mortar-wall --set world.seed=7 --no-glb\n\n"
                         "Ctrl-C ends the simulation and still writes the results of what was simulated.\n") +
             exitCodes(kRunCodes));

  CLI::App& check = *app.add_subcommand("check", "Report all mistakes of scene files, with line and column");
  check.add_option("file", arguments.checked, "Scene files, or shipped scenes by name")->required()->type_name("SCENE");
  addSetOption(check, arguments);
  check.add_flag("--json", arguments.checkJson, "Answer in JSON, on standard output");
  check.footer(std::string("Examples:\n  brickfall check mine.toml\n  brickfall check scenes/*.toml\n\n") +
               exitCodes());

  CLI::App& scenes = *app.add_subcommand("scenes", "List the shipped scenes");
  scenes.add_flag("--json", arguments.scenesJson, "Answer in JSON");
  scenes.footer(std::string("Examples:\n  brickfall scenes\n\n") + exitCodes());

  CLI::App& replay = *app.add_subcommand("replay", "Make the results again from a recorded take");
  replay.add_option("take", arguments.take, "A recording made by brickfall run, also one that was cut off")
      ->required()
      ->type_name("TAKE");
  addOutputOptions(replay, arguments.replay, "the folder of the take");
  replay.add_option("--poster", arguments.replay.page.poster, "A picture in the page until its own first one is drawn")
      ->type_name("PICTURE");
  replay
      .add_option("--address", arguments.replay.page.address,
                  "Where the page will be found: link previews show the poster beside it")
      ->type_name("URL");
  replay.footer(std::string("Examples:\n"
                            "  brickfall replay out/wall/wall.take\n"
                            "  brickfall replay wall.take -o again --no-html\n"
                            "  brickfall replay wall.take --poster wall.png --address https://example.org/wall/\n\n") +
                exitCodes("130 interrupted, the take stays as it is"));
  defineExport(app, arguments);
  defineTrace(app, arguments);
  defineCheckDt(app, arguments);
  CLI::App& words = *app.add_subcommand("completion", "Print completions for a shell: bash, zsh or fish");
  words.add_option("shell", arguments.shell, "bash, zsh or fish")->required()->type_name("SHELL");
  words.footer(std::string("Examples:\n  source <(brickfall completion bash)\n\n") + exitCodes());
  app.add_subcommand("man", "Print the man page: brickfall man | man -l -");
  app.add_subcommand("help", "Help of a command: brickfall help run");
  app.add_subcommand("version", "Print the version");
  // Only so that they are in the list: what follows their word is for them alone (dispatch).
  for (const Companion& companion : companions()) app.add_subcommand(companion.word, companion.purpose);
}

// False after a complaint: a value that cannot be used.
bool readOverrides(const std::vector<std::string>& texts, Overrides& out) {
  for (const std::string& text : texts) {
    const auto pair = parseOverride(text);
    if (!pair) return complain(pair.error().message), false;
    out.push_back(*pair);
  }
  return true;
}

bool readValues(Arguments& arguments, const CLI::App& command) {
  if (command.count("--seconds") > 0) {
    const Result<double> seconds = parseSeconds(arguments.seconds);
    if (!seconds) return complain(seconds.error().message), false;
    arguments.run.seconds = arguments.trace.seconds = arguments.checkDt.seconds = *seconds;
  }
  if (command.count("--threads") > 0) {
    const Result<int> threads = parseThreads(arguments.threads);
    if (!threads) return complain(threads.error().message), false;
    arguments.run.threads = arguments.trace.threads = arguments.checkDt.threads = *threads;
  }
  Overrides overrides;
  if (!readOverrides(arguments.overrides, overrides)) return false;
  arguments.run.overrides = arguments.trace.overrides = arguments.checkDt.overrides = overrides;
  return true;
}

int exportCommand(Arguments& arguments, const CLI::App& command) {
  if (command.count("--every") > 0) {
    const Result<std::uint64_t> every = parseStep(arguments.every);
    if (!every)
      return complainf("--every: found \"{}\", expected a number of frames from 1", arguments.every), kBadInput;
    arguments.exported.every = *every;
  }
  if (arguments.exported.kinds.empty()) arguments.exported.kinds = {"csv"};
  return exportTake(arguments.exported);
}

int traceCommand(Arguments& arguments, const CLI::App& command) {
  if (!readValues(arguments, command)) return kBadInput;
  if (command.count("--items") > 0) {
    const Result<std::uint64_t> step = parseStep(arguments.items);
    if (!step) return complain(step.error().message), kBadInput;
    arguments.trace.itemsOfStep = *step;
  }
  const bool compares = !arguments.compared.empty();
  if (compares == !arguments.trace.scene.empty()) {
    complainf("trace: found {}, expected either a scene or --compare with two traces; see brickfall trace --help",
              compares ? "both" : "neither");
    return kBadInput;
  }
  return compares ? compareTraces(arguments.compared[0], arguments.compared[1]) : trace(arguments.trace);
}

// " (did you mean \"--seconds\"?)": the first of the words that begins with a dash and is no option of the command's, nor of all.
std::string nearestOption(const CLI::App& app, const CLI::App& command, const std::vector<std::string>& words) {
  std::vector<std::string> options;
  for (const CLI::App* one : {&app, &command})
    for (const CLI::Option* option : one->get_options())
      for (const std::string& name : option->get_lnames()) options.push_back("--" + name);
  for (const std::string& word : words) {
    const std::string name = word.substr(0, word.find('='));
    if (name.rfind("--", 0) == 0 && std::find(options.begin(), options.end(), name) == options.end())
      return didYouMean(name, options);
  }
  return {};
}

// What was typed where a command or an option belongs is worth a better answer than the parser's.
int refuse(const CLI::App& app, const CLI::ParseError& error, const std::vector<std::string>& words) {
  std::vector<std::string> commands;
  std::string list;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    commands.push_back(command->get_name());
    list += (list.empty() ? "" : ", ") + command->get_name();
  }
  const bool known = !words.empty() && std::find(commands.begin(), commands.end(), words[0]) != commands.end();
  if (known) {
    complainf("{}{}; see brickfall {} --help", error.what(), nearestOption(app, *app.get_subcommand(words[0]), words),
              words[0]);
  } else {
    const std::string found = words.empty() ? "nothing" : '"' + words[0] + '"';
    complainf("command: found {}, expected one of: {}{}; see brickfall --help", found, list,
              words.empty() ? "" : didYouMean(words[0], commands));
  }
  return kBadInput;
}

// The commands as they are defined, for completion and the man page.
std::vector<CommandWords> commandWords(const CLI::App& app) {
  std::vector<CommandWords> all;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    CommandWords words{command->get_name(), command->get_description(), {}, false};
    for (const CLI::Option* option : command->get_options()) {
      for (const std::string& name : option->get_lnames())
        words.options.push_back({"--" + name, option->get_description()});
      words.takesScene = words.takesScene || option->get_type_name() == "SCENE";
    }
    all.push_back(std::move(words));
  }
  return all;
}

// "help run" is "run --help", "help" and "version" are --help and --version.
std::vector<std::string> plainWords(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (!words.empty() && words[0] == "version") words[0] = "--version";
  if (!words.empty() && words[0] == "help") {
    words.erase(words.begin());
    words.push_back("--help");
  }
  return words;
}

int dispatch(int argc, char** argv) {
  const std::vector<std::string> typed = plainWords(argc, argv);
  if (const Companion* companion = typed.empty() ? nullptr : findCompanion(typed[0]))
    return startCompanion(*companion, programFolder(), {typed.begin() + 1, typed.end()});
  CLI::App app("Knocks down brick walls, for real.");
  Arguments arguments;
  defineCommands(app, arguments);
  app.require_subcommand(1);
  try {
    std::vector<std::string> words = typed;
    std::reverse(words.begin(), words.end());  // as the parser takes them
    app.parse(words);
  } catch (const CLI::CallForVersion& version) {
    say(version.what());
    return kOk;
  } catch (const CLI::Success& help) {  // help, of the command if there is one
    if (!typed.empty() && !typed[0].starts_with('-') && app.get_subcommands().empty()) return refuse(app, help, typed);
    std::string text = app.help();
    while (text.ends_with('\n')) text.pop_back();
    say(text);
    return kOk;
  } catch (const CLI::ParseError& error) {
    return refuse(app, error, typed);
  }
  if (app.got_subcommand("run"))
    return readValues(arguments, *app.get_subcommand("run")) ? run(arguments.run) : kBadInput;
  if (app.got_subcommand("check")) {
    Overrides overrides;
    return readOverrides(arguments.overrides, overrides) ? check(arguments.checked, overrides, arguments.checkJson)
                                                         : kBadInput;
  }
  if (app.got_subcommand("check-dt"))
    return readValues(arguments, *app.get_subcommand("check-dt")) ? checkDt(arguments.checkDt) : kBadInput;
  if (app.got_subcommand("replay")) return replay(arguments.take, arguments.replay);
  if (app.got_subcommand("export")) return exportCommand(arguments, *app.get_subcommand("export"));
  if (app.got_subcommand("trace")) return traceCommand(arguments, *app.get_subcommand("trace"));
  if (app.got_subcommand("completion")) return completion(arguments.shell, commandWords(app));
  if (app.got_subcommand("man")) return manPage(commandWords(app));
  return listScenes(arguments.scenesJson);
}

}  // namespace
}  // namespace brickfall::cli

int main(int argc, char** argv) {
  using namespace brickfall::cli;
  int exitCode = kInternalError;
  try {
    openMissingStreams();
    makeFailedWritesErrors();
    exitCode = dispatch(argc, argv);
  } catch (const std::bad_alloc&) {
    complain("out of memory");
  } catch (const std::exception& error) {
    complainf("internal error: {}", error.what());
  }
  if (!flushOutput() && exitCode == kOk) exitCode = kFileError;
  return exitCode;
}
