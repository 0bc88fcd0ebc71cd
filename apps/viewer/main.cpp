// The arguments of `brickfall-view`, and from there to a window. The only file of the viewer that sees CLI11.
#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <memory>

#include "brickfall/world.h"
#include "cli/arguments.h"
#include "viewer_core/opening.h"
#include "viewer_window/app.h"

namespace brickfall::viewer {
namespace {

// Of docs/command-line.md.
constexpr int kInternalError = 1, kBadInput = 2, kCannotReadOrWrite = 3, kNoDisplay = 5;

// An option's text, and whether it was there at all: an empty one is a mistake.
struct Text {
  std::string text;
  CLI::Option* option = nullptr;
};
struct Texts {
  Text shadows, size, samples, seconds, frames, screenshot, log, status;
  std::vector<std::string> overrides;
};

void complain(const std::string& message) { std::fprintf(stderr, "brickfall-view: %s\n", message.c_str()); }

void define(CLI::App& app, Options& options, Texts& texts) {
  app.name("brickfall-view");
  app.description(
      "Opens a window on a scene that runs live, or on a recorded take. Shoot at the wall, drag bricks, rewind.");
  app.set_version_flag("--version", std::string("brickfall ") + versionString());
  app.add_option("opening", options.opening, "A shipped scene, a scene file, a take or a saved state (default: wall)")
      ->type_name("SCENE|TAKE");
  app.add_flag("--run", options.runs, "Run at once instead of waiting for Space");
  app.add_flag("--paused", options.paused, "Wait for Space also with --time or --frames, which else run");
  app.add_option("--set", texts.overrides, "Change a parameter or value of the scene file; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  const auto add = [&app](Text& into, const char* name, const char* type, const char* help) {
    into.option = app.add_option(name, into.text, help)->type_name(type);
  };
  add(texts.shadows, "--shadows", "KIND", "depth (soft; the default), stencil (sharp) or none");
  add(texts.size, "--size", "WIDTHxHEIGHT", "Of the window in pixels (default: 1280x720)");
  add(texts.samples, "--samples", "N",
      "Smooth edges: 0, 2, 4 or 8 samples a pixel (default: 4, without a graphics card 0)");
  app.add_flag_callback(
      "--no-panel", [&options] { options.panel = false; }, "Start without the panel (Tab shows it)");
  add(texts.seconds, "--time", "S", "Quit after so many seconds");
  add(texts.frames, "--frames", "N", "Draw so many pictures of what was opened as fast as it goes, then quit");
  add(texts.screenshot, "--screenshot", "PNG", "Save the last picture before quitting");
  add(texts.log, "--log", "FILE", "What the renderer says, for bug reports");
  add(texts.status, "--status", "FILE", "A line of JSON for each picture and after each action");
  app.footer(
      "Examples:\n"
      "  brickfall-view                         the wall of 105 bricks, live\n"
      "  brickfall-view hole                    look first; Space runs it, the left button shoots\n"
      "  brickfall-view out/wall/wall.take      a recording: scrub it to and fro\n"
      "  brickfall-view mine.toml --set speed=6\n\n"
      "F1 in the window shows all keys. docs/viewer.md has the rest.\n\n"
      "Exit codes: 0 done; 1 internal error; 2 bad arguments or scene; 3 a file cannot be read or written;\n"
      "5 no display, or none that can draw.");
}

template <class Value> bool read(const Text& text, Result<Value> (*parse)(const std::string&), Value& into) {
  if (text.option->count() == 0) return true;
  Result<Value> value = parse(text.text);
  if (!value) return complain(value.error().message), false;
  into = std::move(value).value();
  return true;
}

bool readName(const Text& text, std::string& into) {
  into = text.text;
  if (text.option->count() == 0 || !into.empty()) return true;
  return complain(text.option->get_name() + ": found '', expected the name of a file"), false;
}

bool readTexts(const Texts& texts, Options& options) {
  for (const std::string& text : texts.overrides) {
    Result<std::pair<std::string, std::string>> pair = cli::parseOverride(text);
    if (!pair) return complain(pair.error().message), false;
    options.overrides.push_back(std::move(pair).value());
  }
  return read(texts.shadows, parseShadows, options.shadows) && read(texts.size, parseSize, options.size) &&
         read(texts.samples, parseSamples, options.samples) && read(texts.seconds, parseTime, options.seconds) &&
         read(texts.frames, parseFrames, options.frames) && readName(texts.screenshot, options.screenshot) &&
         readName(texts.log, options.log) && readName(texts.status, options.status);
}

// Ogre does not say when its log cannot be written.
Status tryLog(const std::string& path) {
  if (path.empty() || std::ofstream(path)) return {};
  return Error{ErrorCode::inputOutput, "--log: " + path + ": cannot be written: " + std::strerror(errno)};
}

int view(const Options& options) {
  const auto file = std::make_shared<OpenedFile>(readOpening(options.opening, options.overrides));
  const Opening& opening = file->opening;
  for (const Diagnostic& diagnostic : opening.diagnostics) std::fprintf(stderr, "%s\n", format(diagnostic).c_str());
  if (!opening.problem.empty()) complain(opening.problem);
  if (opening.exitCode != 0) return opening.exitCode;
  Result<StatusFile> status = StatusFile::open(options.status);
  if (!status) return complain("--status: " + status.error().message), kCannotReadOrWrite;
  if (const Status log = tryLog(options.log); !log) return complain(log.error().message), kCannotReadOrWrite;

  Result<NativeWindow> window = NativeWindow::open("Brickfall", options.size);
  if (!window) return complain(window.error().message), kNoDisplay;
  Session session;
  const bool unattended = options.frames > 0 || options.seconds > 0;
  const bool runs = options.runs || (unattended && !options.paused);
  const std::uint64_t opens = session.send(Open{options.opening, options.overrides, runs, file});
  RendererOptions drawing;
  drawing.log = options.log;
  drawing.fine = NativeWindow::hasGraphicsCard();
  drawing.samples = options.samples >= 0 ? options.samples : drawing.fine ? 4 : 0;
  drawing.vsync = options.frames == 0;
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(*window, drawing);
  if (!renderer) return complain(renderer.error().message), kNoDisplay;
  App app(options, session, *window, **renderer, *status, opens);
  return app.run();
}

int start(int argc, char** argv) {
  CLI::App app;
  Options options;
  Texts texts;
  define(app, options, texts);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& asked) {
    return app.exit(asked);
  } catch (const CLI::ParseError& mistake) {
    complain(std::string(mistake.what()) + " (brickfall-view --help shows what there is)");
    return kBadInput;
  }
  if (!readTexts(texts, options)) return kBadInput;
  return view(options);
}

}  // namespace
}  // namespace brickfall::viewer

int main(int argc, char** argv) {
  try {
    return brickfall::viewer::start(argc, argv);
  } catch (const std::exception& error) {
    brickfall::viewer::complain(std::string("internal error: ") + error.what());
    return brickfall::viewer::kInternalError;
  }
}
