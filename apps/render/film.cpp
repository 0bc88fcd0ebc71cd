#include "render/film.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

extern char** environ;

namespace brickfall::render {
namespace {

Error refused(const std::string& what) { return {ErrorCode::inputOutput, what}; }

std::string lastLine(const std::string& path) {
  std::ifstream file(path);
  std::string line, last;
  while (std::getline(file, line))
    if (!line.empty()) last = line;
  return last;
}

// The running program, to which pictures are written.
class Encoder {
 public:
  Encoder(const FilmSettings& settings) : part_(settings.path + ".part"), log_(settings.path + ".log") {
    words_ = {"ffmpeg",    "-hide_banner",
              "-loglevel", "error",
              "-nostdin",  "-y",
              "-f",        "rawvideo",
              "-pix_fmt",  "rgb24",
              "-s",        fmt::format("{}x{}", settings.width, settings.height),
              "-r",        fmt::format("{}", settings.framesPerSecond),
              "-i",        "pipe:0",
              "-c:v",      "libx264",
              "-preset",   "medium",
              "-crf",      "17",
              "-pix_fmt",  "yuv420p",
              "-movflags", "+faststart",
              "-f",        "mp4",
              part_};
    program_ = settings.program;
  }
  ~Encoder() {
    (void)finish();
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
    std::filesystem::remove(log_, ignored);
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  Status start() {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return refused(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    std::vector<char*> pointers;
    for (std::string& word : words_) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 2, log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    const int failure = posix_spawn(&process_, program_.c_str(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    if (failure != 0) {
      process_ = -1;
      close(ends[1]);
      return refused(fmt::format("cannot start '{}': {}", program_, std::strerror(failure)));
    }
    pipe_ = ends[1];
    return {};
  }

  // False: it reads no more; why is told by finish().
  bool write(const std::vector<std::uint8_t>& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t count = ::write(pipe_, bytes.data() + done, bytes.size() - done);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      done += std::size_t(count);
    }
    return true;
  }

  Status finish() {
    if (pipe_ >= 0) close(pipe_);
    pipe_ = -1;
    if (process_ < 0) return {};
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
    const std::string said = lastLine(log_);
    return refused(fmt::format("'{}' could not make the film{}{}", program_, said.empty() ? "" : ": ", said));
  }

  Status takePlace(const std::string& path) {
    std::error_code error;
    std::filesystem::rename(part_, path, error);
    if (error) return refused(fmt::format("cannot write '{}': {}", path, error.message()));
    return {};
  }

 private:
  std::string part_, log_, program_;
  std::vector<std::string> words_;
  pid_t process_ = -1;
  int pipe_ = -1;
};

}  // namespace

std::string findProgram(const std::string& name) {
  const char* folders = std::getenv("PATH");
  std::istringstream list(folders ? folders : "");
  for (std::string folder; std::getline(list, folder, ':');) {
    const std::string path = (folder.empty() ? "." : folder) + "/" + name;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored) && access(path.c_str(), X_OK) == 0) return path;
  }
  return {};
}

Status makeFilm(const FilmSettings& settings, const std::function<Result<Image>(std::size_t)>& frame,
                const std::function<bool(std::size_t done)>& progress) {
  Encoder encoder(settings);
  if (Status started = encoder.start(); !started) return started;
  for (std::size_t k = 0; k < settings.frames; k++) {
    Result<Image> image = frame(k);
    if (!image) return image.error();
    if (image->width != settings.width || image->height != settings.height)
      return Error{ErrorCode::badFormat, fmt::format("picture {}: found {}x{} pixels, expected {}x{}", k, image->width,
                                                     image->height, settings.width, settings.height)};
    if (!encoder.write(image->bytes)) break;
    if (!progress(k + 1)) return {};
  }
  if (Status finished = encoder.finish(); !finished) return finished;
  return encoder.takePlace(settings.path);
}

}  // namespace brickfall::render
