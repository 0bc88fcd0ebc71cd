// The arguments of brickfall-render. The only file of it that sees CLI11.
#include <malloc.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <new>
#include <thread>

#include "brickfall/world.h"
#include "cli/arguments.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/interrupt.h"
#include "render/job.h"

namespace brickfall::render {
namespace {

constexpr const char* kFooter =
    "Examples:\n"
    "  brickfall render out/wall/wall.take                    a film beside the take\n"
    "  brickfall render hole --frame 40 -o hole.png           one picture\n"
    "  brickfall render wall --from 0.9 --to 2 --speed 0.2    slow motion\n\n"
    "Pictures of a film lie in <film>.frames/ until it is whole: after a break the same command goes on with them.\n\n"
    "Exit codes: 0 done; 1 internal error; 2 bad arguments or scene; 3 a file cannot be read or written, or no "
    "ffmpeg;\n"
    "130 interrupted, whole pictures are kept.";

// As they were typed; empty: not given.
struct Words {
  std::string orbit, from, to, frame, fps, speed, shutter, size, samples, bounces, threads, exposure, sun, seconds;
  std::vector<std::string> overrides;
};

void define(CLI::App& app, RenderOptions& options, Words& words) {
  app.name("brickfall render");
  app.set_version_flag("--version", std::string("brickfall ") + versionString());
  app.footer(kFooter);
  app.add_option("source", options.source, "A take, or a scene (file or shipped name), which is run first")
      ->required()
      ->type_name("TAKE|SCENE");
  app.add_option("-o,--output", options.output,
                 "film.mp4, picture.png or folder/ (default: <name>.mp4 beside the take)")
      ->type_name("FILE");
  app.add_option("--camera", options.camera, "Name or number of a camera of the scene (default: the first)")
      ->type_name("NAME");
  app.add_option("--orbit", words.orbit, "Turn the camera about what it looks at by so much, from begin to end")
      ->type_name("DEGREES");
  app.add_option("--follow", options.follow, "Look at this body all the while")->type_name("BODY");
  app.add_option("--from", words.from, "Begin at this simulated time (default: where the take begins)")->type_name("S");
  app.add_option("--to", words.to, "End there (default: the end)")->type_name("S");
  app.add_option("--frame", words.frame, "One picture: of this frame of the take, from 0")->type_name("N");
  app.add_option("--fps", words.fps, "Pictures a second of film (default: 25)")->type_name("N");
  app.add_option("--speed", words.speed, "Simulated seconds a second of film; below 1 slow motion (default: 1)")
      ->type_name("X");
  app.add_option("--shutter", words.shutter, "Share of a picture's time that blurs what moves (default: 0.5)")
      ->type_name("X");
  app.add_option("--size", words.size, "Pixels (default: 960x540)")->type_name("WxH");
  app.add_option("--samples", words.samples,
                 "Rays a pixel: half in plain parts, 4 times as many in motion (default: 4 for films, 64 for pictures)")
      ->type_name("N");
  app.add_option("--bounces", words.bounces, "How often light is followed on from body to body (default: 1)")
      ->type_name("N");
  app.add_option("--threads", words.threads, "Threads (default: one a core); the pictures do not depend on it")
      ->type_name("N");
  app.add_option("--exposure", words.exposure, "Brighter or darker, in powers of 2 (default: 0)")->type_name("X");
  app.add_option("--sun", words.sun, "Where it stands, in degrees: azimuth from +z towards +x, elevation")
      ->type_name("AZ,EL");
  app.add_flag_callback(
      "--no-denoise", [&] { options.denoise = false; }, "Leave the noise in");
  app.add_flag_callback(
      "--no-dust", [&] { options.dust = false; }, "No dust where bodies hit");
  app.add_flag("--keep-frames", options.keepFrames, "Leave the pictures of a film");
  app.add_option("--seconds", words.seconds, "Of a scene: simulate so long")->type_name("S");
  app.add_option("--set", words.overrides, "Of a scene: change a parameter or value; may be repeated")
      ->type_name("KEY=VALUE")
      ->take_all()
      ->expected(1)
      ->allow_extra_args(false);
  app.add_flag("--quiet", options.quiet, "Say nothing but errors");
}

template <class Value, class Target> Status take(Result<Value> value, Target& target) {
  if (!value) return value.error();
  target = *value;
  return {};
}

// The first that cannot be used.
Status readWords(const Words& w, RenderOptions& o) {
  Status s;
  const auto number = [&](const char* flag, const std::string& text, double least, double most, auto& target) {
    if (s && !text.empty()) s = take(parseNumber(flag, text, least, most), target);
  };
  const auto count = [&](const char* flag, const std::string& text, int most, auto& target) {
    if (s && !text.empty()) s = take(parseCount(flag, text, 1, most), target);
  };
  number("--orbit", w.orbit, -3600, 3600, o.orbitDegrees);
  number("--from", w.from, 0, 1e5, o.from);
  number("--to", w.to, 0, 1e5, o.to);
  if (s && !w.frame.empty()) s = take(parseCount("--frame", w.frame, 0, 1'000'000'000), o.frame);
  number("--fps", w.fps, 0.1, 1000, o.framesPerSecond);
  number("--speed", w.speed, 1e-4, 1000, o.speed);
  number("--shutter", w.shutter, 0, 1, o.shutter);
  if (s && !w.size.empty()) {
    std::pair<int, int> size;
    s = take(parseSize(w.size), size);
    if (s) std::tie(o.width, o.height) = size;
  }
  count("--samples", w.samples, 65536, o.samples);
  count("--bounces", w.bounces, 16, o.bounces);
  if (s && !w.threads.empty()) s = take(cli::parseThreads(w.threads), o.threads);
  number("--exposure", w.exposure, -10, 10, o.exposure);
  if (s && !w.sun.empty()) s = take(parseSun(w.sun), o.sun);
  if (s && !w.seconds.empty()) s = take(cli::parseSeconds(w.seconds), o.seconds);
  for (const std::string& text : w.overrides) {
    if (!s) break;
    const auto pair = cli::parseOverride(text);
    if (pair)
      o.overrides.push_back(*pair);
    else
      s = pair.error();
  }
  return s;
}

int run(int argc, char** argv) {
  CLI::App app("Makes pictures or a film of a take or a scene, without a window.");
  RenderOptions options;
  options.threads = int(std::clamp(std::thread::hardware_concurrency(), 1u, 64u));
  Words words;
  define(app, options, words);
  try {
    app.parse(argc, argv);
  } catch (const CLI::CallForVersion& version) {
    cli::say(version.what());
    return cli::kOk;
  } catch (const CLI::Success&) {
    std::string help = app.help();
    while (help.ends_with('\n')) help.pop_back();
    cli::say(help);
    return cli::kOk;
  } catch (const CLI::ParseError& error) {
    cli::complainf("{}; see brickfall render --help", error.what());
    return cli::kBadInput;
  }
  if (const Status read = readWords(words, options); !read) {
    cli::complain(read.error().message);
    return cli::kBadInput;
  }
  return render(options);
}

}  // namespace
}  // namespace brickfall::render

int main(int argc, char** argv) {
  using namespace brickfall;
  int exitCode = cli::kInternalError;
  try {
    // The memory of one picture serves for the next; given back in between, it would have to be cleared each time.
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    cli::openMissingStreams();
    cli::makeFailedWritesErrors();
    exitCode = render::run(argc, argv);
  } catch (const std::bad_alloc&) {
    cli::complain("out of memory");
  } catch (const std::exception& error) {
    cli::complainf("internal error: {}", error.what());
  }
  if (!cli::flushOutput() && exitCode == cli::kOk) exitCode = cli::kFileError;
  return exitCode;
}
