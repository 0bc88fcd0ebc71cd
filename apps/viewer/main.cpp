// The arguments of `brickfall-view`, and from there to a window. The only file of the viewer that sees CLI11.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <memory>

#include "brickfall/world.h"
#include "viewer_core/scene_menu.h"
#include "viewer_window/app.h"

namespace brickfall::viewer {
namespace {

// Of docs/command-line.md.
constexpr int kInternalError = 1, kBadInput = 2, kCannotReadOrWrite = 3, kNoDisplay = 5;

struct Texts {
  std::string shadows, size, samples, seconds, frames;
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
  app.add_flag("--paused", options.paused, "Wait for Space instead of running at once");
  app.add_option("--set", texts.overrides, "Change a parameter or value of the scene file; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  app.add_option("--shadows", texts.shadows, "automatic (by the number of bodies), stencil, depth or none")
      ->type_name("KIND");
  app.add_option("--size", texts.size, "Of the window in pixels (default: 1280x720)")->type_name("WIDTHxHEIGHT");
  app.add_option("--samples", texts.samples,
                 "Smooth edges: 0, 2, 4 or 8 samples a pixel (default: 4, without a graphics card 0)")
      ->type_name("N");
  app.add_flag_callback(
      "--no-panel", [&options] { options.panel = false; }, "Start without the panel (Tab shows it)");
  app.add_option("--time", texts.seconds, "Quit after so many seconds")->type_name("S");
  app.add_option("--frames", texts.frames, "Draw so many pictures as fast as it goes, then quit")->type_name("N");
  app.add_option("--screenshot", options.screenshot, "Save the last picture before quitting")->type_name("PNG");
  app.add_option("--log", options.log, "What the renderer says, for bug reports")->type_name("FILE");
  app.add_option("--status", options.status, "A line of JSON each second and after each action")->type_name("FILE");
  app.footer(
      "Examples:\n"
      "  brickfall-view                         the wall of 100 bricks, live\n"
      "  brickfall-view hole --paused           look first; Space runs it, the left button shoots\n"
      "  brickfall-view out/wall/wall.take      a recording: scrub it to and fro\n"
      "  brickfall-view mine.toml --set speed=6\n\n"
      "F1 in the window shows all keys. docs/viewer.md has the rest.\n\n"
      "Exit codes: 0 done; 1 internal error; 2 bad arguments or scene; 3 a file cannot be read or written;\n"
      "5 no display, or none that can draw.");
}

template <class Value> bool read(const std::string& text, Result<Value> (*parse)(const std::string&), Value& into) {
  if (text.empty()) return true;
  Result<Value> value = parse(text);
  if (!value) return complain(value.error().message), false;
  into = std::move(value).value();
  return true;
}

bool readTexts(const Texts& texts, Options& options) {
  for (const std::string& text : texts.overrides) {
    std::pair<std::string, std::string> pair;
    if (!read(text, parseSet, pair)) return false;
    options.overrides.push_back(std::move(pair));
  }
  return read(texts.shadows, parseShadows, options.shadows) && read(texts.size, parseSize, options.size) &&
         read(texts.samples, parseSamples, options.samples) && read(texts.seconds, parseTime, options.seconds) &&
         read(texts.frames, parseFrames, options.frames);
}

int view(const Options& options) {
  const Opening opening = lookAtOpening(options.opening, options.overrides);
  for (const Diagnostic& diagnostic : opening.diagnostics) std::fprintf(stderr, "%s\n", format(diagnostic).c_str());
  if (!opening.problem.empty()) complain(opening.problem);
  if (opening.exitCode != 0) return opening.exitCode;
  Result<StatusFile> status = StatusFile::open(options.status);
  if (!status) return complain("--status: " + status.error().message), kCannotReadOrWrite;

  Result<NativeWindow> window = NativeWindow::open("Brickfall", options.size);
  if (!window) return complain(window.error().message), kNoDisplay;
  Session session;
  session.send(Open{options.opening, options.overrides, !options.paused});
  RendererOptions drawing;
  drawing.log = options.log;
  drawing.fine = NativeWindow::hasGraphicsCard();
  drawing.samples = options.samples >= 0 ? options.samples : drawing.fine ? 4 : 0;
  drawing.vsync = options.frames == 0;
  Result<std::unique_ptr<Renderer>> renderer = Renderer::create(*window, drawing);
  if (!renderer) return complain(renderer.error().message), kNoDisplay;
  App app(options, session, *window, **renderer, *status);
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
