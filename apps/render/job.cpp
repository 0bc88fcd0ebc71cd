#include "render/job.h"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include "brickfall/scene.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/files.h"
#include "cli/interrupt.h"
#include "render/camera_move.h"
#include "render/film.h"
#include "render/frame_store.h"
#include "render/png_file.h"
#include "render/source.h"

namespace brickfall::render {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double kMostFrames = 1e6;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

// Of what is there at the start, as a scene without cameras gets one.
Camera madeUpCamera(const TakeReader& take) {
  const Result<TakeFrame> first = take.frame(0);
  if (!first) return {};
  std::vector<Aabb> boxes;
  const std::vector<std::uint32_t> there = take.bodiesAt(0);
  for (std::size_t k = 0; k < there.size(); k++) {
    const TakeBody& body = take.bodies()[there[k]];
    if (body.role == BodyRole::ground) continue;
    for (const ShapeDef& shape : body.shapes)
      if (shape.type != ShapeType::plane)
        boxes.push_back(bounds(shape, Transform{first->poses[k].position, first->poses[k].rotation}));
  }
  return fittedCamera(boxes, {0, 0, 1});
}

struct Job {
  RenderOptions options;
  OutputKind kind = OutputKind::film;
  Source source;
  std::string folder;  // of the pictures while they are made; of a still empty
  std::unique_ptr<TakeReader> take;
  Camera camera;
  std::optional<std::uint32_t> follow;  // body
  std::vector<double> moments;
  PaintSettings paint;
};

// Whichever is looked through: the sun goes by the first, as in window and page.
const Camera& firstCamera(const Job& job) {
  const std::vector<Camera>& cameras = job.take->header().cameras;
  return cameras.empty() ? job.camera : cameras.front();
}

std::string defaultOutput(const Source& source, const RenderOptions& options) {
  const std::string folder =
      source.isScene ? cli::joinPath("out", source.name) : fs::path(source.path).parent_path().string();
  const std::string name =
      options.frame ? fmt::format("{}_{:05}.png", source.name, *options.frame) : source.name + ".mp4";
  return cli::joinPath(folder, name);
}

int complainOf(const Error& error) {
  cli::complain(error.message);
  return error.code == ErrorCode::inputOutput || error.code == ErrorCode::badFormat ? cli::kFileError : cli::kBadInput;
}

// Makes the pictures of a job, one after the other.
class Painter {
 public:
  Painter(const Job& job, Stage stage)
      : job_(job),
        stage_(std::move(stage)),
        motion_(*job.take),
        dust_(*job.take),
        sky_(skyFor(firstCamera(job), job.options.sun)) {
    move_.camera = job.camera;
    move_.orbitDegrees = job.options.orbitDegrees;
    move_.from = job.moments.front();
    move_.to = job.moments.back();
    move_.follow = job.follow;
  }

  // Null where an interrupt came in between.
  Result<const Image*> at(double open) {
    const double close = open + job_.options.shutter * job_.options.speed / job_.options.framesPerSecond;
    Result<Motion::Shutter> shutter = motion_.between(open, close);
    if (!shutter) return shutter.error();
    const Camera first = cameraAt(move_, open, shutter->open), last = cameraAt(move_, close, shutter->close);
    const bool elsewhere = stage_.place(*shutter);
    const std::vector<Puff> puffs = job_.options.dust ? dust_.at(open) : std::vector<Puff>();
    // While all rests and the camera stands, one picture is as the other: it need not be drawn again.
    if (elsewhere || dusty_ || !puffs.empty() || job_.paint.width != image_.width || !samePose(first, first_) ||
        !samePose(last, last_)) {
      image_ = paint(stage_, first, last, sky_, job_.paint, puffs);
      dusty_ = !puffs.empty();
      first_ = first;
      last_ = last;
    }
    return cli::interruptCount() > 0 ? nullptr : &image_;
  }

 private:
  const Job& job_;
  Stage stage_;
  Motion motion_;
  Dust dust_;
  bool dusty_ = false;  // the last picture
  CameraMove move_;
  Sky sky_;
  Image image_;  // the last one
  Camera first_, last_;
};

int interrupted(const Job& job, std::size_t done) {
  if (job.kind == OutputKind::still)
    cli::complain("interrupted: no picture is left");
  else
    cli::complainf("interrupted: {} of {} pictures are kept in '{}', the same command goes on with them", done,
                   job.moments.size(), job.folder);
  return cli::interruptExitCode();
}

// All pictures that are not there yet, each to its file.
int paintAll(const Job& job, const std::function<std::string(std::size_t)>& fileOf, cli::ProgressDisplay& display) {
  Result<Stage> stage = Stage::create(*job.take);
  if (!stage) return complainOf(stage.error());
  Painter painter(job, std::move(stage).value());
  const auto there = [&](std::size_t k) {
    std::error_code ignored;
    return job.kind != OutputKind::still && fs::exists(fileOf(k), ignored);
  };
  cli::WorkState work{"picture", 0, job.moments.size(), 0, 0};
  for (std::size_t k = 0; k < job.moments.size(); k++) work.doneBefore += there(k);
  work.done = work.doneBefore;
  if (work.done > 0 && !job.options.quiet) cli::sayf("{} of {} pictures are there already", work.done, work.total);
  const Clock::time_point start = Clock::now();
  for (std::size_t k = 0; k < job.moments.size(); k++) {
    if (there(k)) continue;
    const Result<const Image*> image = painter.at(job.moments[k]);
    if (!image || !*image) display.finish();
    if (!image) return complainOf(image.error());
    if (!*image) return interrupted(job, work.done);
    if (const Status written = writePng(fileOf(k), **image); !written) {
      display.finish();
      return complainOf(written.error());
    }
    work.done++;
    work.wallSeconds = secondsSince(start);
    display.updateWork(work);
  }
  display.finish();
  if (!job.options.quiet)
    cli::sayf("{} picture{} in {}", work.total - work.doneBefore, work.total - work.doneBefore == 1 ? "" : "s",
              cli::durationText(work.wallSeconds));
  return cli::kOk;
}

int encode(const Job& job, const FrameStore& store, const std::string& program, cli::ProgressDisplay& display) {
  FilmSettings film{
      program,           job.options.output, job.options.width, job.options.height, job.options.framesPerSecond,
      job.moments.size()};
  bool stopped = false;
  const Status made = makeFilm(
      film, [&](std::size_t k) { return readPng(store.frame(k)); },
      [&](std::size_t done) {
        display.update("writing " + job.options.output, double(done) / double(job.moments.size()));
        stopped = cli::interruptCount() > 0;
        return !stopped;
      });
  display.finish();
  if (stopped || (!made && cli::interruptCount() > 0)) return interrupted(job, job.moments.size());
  if (!made) {
    cli::complainf("{}; the pictures are kept in '{}'", made.error().message, job.folder);
    return cli::kFileError;
  }
  return cli::kOk;
}

// What can be known before anything is simulated or drawn.
int prepare(Job& job) {
  SourceChoice choice = chooseSource(job.options);
  if (choice.exitCode != cli::kOk) return choice.exitCode;
  job.source = choice.source;
  if (job.options.output.empty()) job.options.output = defaultOutput(job.source, job.options);
  const Result<OutputKind> kind = outputKindOf(job.options.output);
  if (!kind) return complainOf(kind.error());
  job.kind = *kind;
  if (const Status possible = checkTogether(job.options, job.kind); !possible) return complainOf(possible.error());
  const std::string parent = fs::path(job.options.output).parent_path().string();
  if (!parent.empty() && job.kind != OutputKind::folder)  // that of pictures is made with its settings
    if (const Status made = cli::makeFolder(parent); !made) return complainOf(made.error());
  job.folder = job.kind == OutputKind::folder ? job.options.output : job.options.output + ".frames";
  job.paint.width = job.options.width;
  job.paint.height = job.options.height;
  job.paint.denoise = job.options.denoise;
  job.paint.exposure *= float(std::exp2(job.options.exposure));
  job.paint.trace.samples = job.options.samples.value_or(job.kind == OutputKind::still ? kStillSamples : kFilmSamples);
  job.paint.trace.bounces = job.options.bounces;
  job.paint.trace.threads = job.options.threads;
  job.paint.trace.stop = [] { return cli::interruptCount() > 0; };
  return cli::kOk;
}

// `takePath`: of a scene; `isThere`: a whole take of this very job lies there.
int openAndPlan(Job& job, const std::string& takePath, bool isThere, cli::ProgressDisplay& display) {
  OpenedTake opened = !job.source.isScene ? openTake(job.source.path)
                      : isThere           ? openTake(takePath)
                                          : runScene(job.source, job.options, takePath, display);
  if (!opened.take) return opened.exitCode;
  job.take = std::move(opened.take);
  const Result<Camera> camera = chooseCamera(*job.take, job.options.camera);
  if (!camera) return complainOf(camera.error());
  job.camera = *camera;
  if (!job.options.follow.empty()) {
    const Result<std::uint32_t> body = chooseBody(*job.take, job.options.follow);
    if (!body) return complainOf(body.error());
    job.follow = *body;
  } else if (const Result<std::uint32_t> body = chooseBody(*job.take, camera->follow); body) {
    job.follow = *body;
  }
  Result<std::vector<double>> moments = momentsOf(*job.take, job.options, job.kind);
  if (!moments) return complainOf(moments.error());
  job.moments = std::move(moments).value();
  return cli::kOk;
}

// Also one that an interrupt left unfinished.
void removeTake(const std::string& path) {
  std::error_code ignored;
  fs::remove(path, ignored);
  fs::remove(path + ".part", ignored);
}

int renderStill(Job& job, cli::ProgressDisplay& display) {
  // What an earlier start may have left there is of no use: nothing says what it is a take of.
  const fs::path output(job.options.output);
  const std::string takePath = cli::joinPath(output.parent_path().string(),
                                             fmt::format(".{}.brickfall-render.take", output.filename().string()));
  int exitCode = openAndPlan(job, takePath, false, display);
  if (exitCode == cli::kOk)
    exitCode = paintAll(
        job, [&](std::size_t) { return job.options.output; }, display);
  if (job.source.isScene) removeTake(takePath);
  return exitCode;
}

int renderMany(Job& job, cli::ProgressDisplay& display) {
  std::string program;
  if (job.kind == OutputKind::film && (program = findProgram("ffmpeg")).empty()) {
    cli::complain(
        "ffmpeg: not found in PATH, expected for a film; install the Debian package ffmpeg, or give a folder (-o "
        "pictures/)");
    return cli::kFileError;
  }
  const Result<std::uint64_t> fingerprint = fingerprintOf(job.source, job.options);
  if (!fingerprint) return complainOf(fingerprint.error());
  Result<FrameStore> store =
      FrameStore::open(job.folder, settingsText(job.options, job.source.name, *fingerprint, job.paint.trace.samples));
  if (!store) return complainOf(store.error());
  const std::string takePath = store->sceneTake();
  std::error_code ignored;
  const bool isThere = store->goesOn() && fs::exists(takePath, ignored);
  if (const int code = openAndPlan(job, takePath, isThere, display); code != cli::kOk) {
    if (!store->hasAny()) {  // pictures of an earlier start stay
      if (job.source.isScene) removeTake(takePath);
      store->remove(0);
    }
    return code;
  }
  int exitCode = paintAll(
      job, [&](std::size_t k) { return store->frame(k); }, display);
  if (exitCode == cli::kOk && job.kind == OutputKind::film) exitCode = encode(job, *store, program, display);
  if (exitCode != cli::kOk) return exitCode;
  if (job.source.isScene) removeTake(takePath);
  if (job.kind == OutputKind::folder || job.options.keepFrames)
    store->forgetSettings();
  else
    store->remove(job.moments.size());
  return exitCode;
}

}  // namespace

Result<Camera> chooseCamera(const TakeReader& take, const std::string& wanted) {
  const std::vector<Camera>& cameras = take.header().cameras;
  std::vector<std::string> names;
  std::string list;
  for (const Camera& camera : cameras) {
    if (camera.name == wanted) return camera;
    names.push_back(camera.name);
    list += (list.empty() ? "" : ", ") + camera.name;
  }
  if (wanted.empty()) return cameras.empty() ? madeUpCamera(take) : cameras[0];
  for (std::size_t k = 0; k < cameras.size(); k++)
    if (wanted == std::to_string(k + 1)) return cameras[k];
  return Error{ErrorCode::invalidArgument, fmt::format("--camera: found \"{}\", expected one of: {}{}", wanted,
                                                       list.empty() ? "(none)" : list, didYouMean(wanted, names))};
}

Result<std::uint32_t> chooseBody(const TakeReader& take, const std::string& wanted) {
  std::vector<std::string> names;
  for (std::uint32_t k = 0; k < take.bodies().size(); k++) {
    if (take.bodies()[k].name == wanted) return k;
    names.push_back(take.bodies()[k].name);
  }
  return Error{ErrorCode::invalidArgument,
               fmt::format("--follow: found \"{}\", expected the name of a body{}", wanted, didYouMean(wanted, names))};
}

Sky skyFor(const Camera& camera, const std::optional<Sun>& sun) {
  Sky sky;
  if (sun) {
    sky.sun = appearance::sunDirection(sun->azimuthDegrees, sun->elevationDegrees);
    return sky;
  }
  const Camera at = camera.path.empty() ? camera : cameraAt(camera, camera.path.front().time);
  const Vec3 back = at.position - at.target;
  sky.sun = appearance::sunOver({float(back.x), float(back.y), float(back.z)});
  return sky;
}

Result<std::vector<double>> momentsOf(const TakeReader& take, const RenderOptions& options, OutputKind kind) {
  Motion motion(take);
  const std::size_t last = take.frameCount() - 1;
  if (options.frame) {
    if (*options.frame > last)
      return Error{ErrorCode::invalidArgument,
                   fmt::format("--frame: found {}, expected 0 .. {}, the last of the take", *options.frame, last)};
    Result<double> time = motion.timeOf(*options.frame);
    if (!time) return time.error();
    return std::vector<double>{*time};
  }
  Result<double> start = motion.timeOf(0), end = motion.timeOf(last);
  if (!start) return start.error();
  if (!end) return end.error();
  const double from = std::max(options.from.value_or(*start), *start), to = std::min(options.to.value_or(*end), *end);
  if (from > *end + 1e-9)
    return Error{ErrorCode::invalidArgument,
                 fmt::format("--from: found {:g}, expected at most {:g} s, where the take ends", from, *end)};
  if (options.to && !(*options.to > *start))
    return Error{
        ErrorCode::invalidArgument,
        fmt::format("--to: found {:g}, expected more than {:g} s, where the take begins", *options.to, *start)};
  if (kind == OutputKind::still) return std::vector<double>{from};
  const double count = std::round((to - from) * options.framesPerSecond / options.speed);
  if (count > kMostFrames)
    return Error{ErrorCode::limitExceeded,
                 fmt::format("--fps: found {:.0f} pictures, expected at most {:.0f}", count, kMostFrames)};
  std::vector<double> moments;
  for (double k = 0; k < std::max(count, 1.0); k++)
    moments.push_back(from + k * options.speed / options.framesPerSecond);
  return moments;
}

std::string settingsText(const RenderOptions& o, const std::string& source, std::uint64_t fingerprint, int samples) {
  const auto time = [](const std::optional<double>& t) { return t ? fmt::format("{}", *t) : std::string("-"); };
  return fmt::format(
      "brickfall-render {}\nsource {} {:016x}\ncamera {}\nfrom {}\nto {}\nfps {}\nspeed {}\nshutter {}\nsize {}x{}\n"
      "samples {}\nbounces {}\nexposure {}\nsun {}\ndenoise {}\norbit {}\nfollow {}\ndust {}\n",
      versionString(), source, fingerprint, o.camera.empty() ? "-" : o.camera, time(o.from), time(o.to),
      o.framesPerSecond, o.speed, o.shutter, o.width, o.height, samples, o.bounces, o.exposure,
      o.sun ? fmt::format("{},{}", o.sun->azimuthDegrees, o.sun->elevationDegrees) : "-", o.denoise ? "on" : "off",
      o.orbitDegrees, o.follow.empty() ? "-" : o.follow, o.dust ? "on" : "off");
}

int render(const RenderOptions& options) {
  Job job;
  job.options = options;
  if (const int code = prepare(job); code != cli::kOk) return code;
  cli::watchInterrupts();
  cli::ProgressDisplay display(cli::ProgressDisplay::modeForOutput(options.quiet));
  const int code = job.kind == OutputKind::still ? renderStill(job, display) : renderMany(job, display);
  display.finish();
  if (code == cli::kOk && !options.quiet)
    cli::sayf("  {}{}", job.options.output,
              job.kind == OutputKind::folder ? "" : "  " + cli::sizeText(job.options.output));
  return code;
}

}  // namespace brickfall::render
