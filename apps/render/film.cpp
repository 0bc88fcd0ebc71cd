#include "render/film.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <vector>

extern char** environ;

namespace brickfall::render {
namespace {

Error refused(const std::string& what) { return {ErrorCode::inputOutput, what}; }

// Of a file without a name.
std::string lastLine(int file) {
  std::string text;
  char block[4096];
  for (ssize_t count; (count = pread(file, block, sizeof block, off_t(text.size()))) > 0;)
    text.append(block, std::size_t(count));
  std::istringstream lines(text);
  std::string line, last;
  while (std::getline(lines, line))
    if (!line.empty()) last = line;
  return last;
}

// The running program, to which pictures are written.
class Encoder {
 public:
  explicit Encoder(const FilmSettings& settings) : part_(settings.path + ".part"), program_(settings.program) {
    // A write that fails must end it with an error (-xerror): of a disk that filled up while it wrote the film's end it else says so
    // and calls that a success. A name with a colon is a file all the same ("file:").
    std::istringstream list(fmt::format(
        "ffmpeg -hide_banner -loglevel error -xerror -nostdin -y -f rawvideo -pix_fmt rgb24 -s {}x{} -r {} -i pipe:0 "
        "-c:v libx264 -preset medium -crf 17 -pix_fmt yuv420p -movflags +faststart -f mp4",
        settings.width, settings.height, settings.framesPerSecond));
    for (std::string word; list >> word;) words_.push_back(word);
    words_.push_back("file:" + part_);
  }
  ~Encoder() {
    (void)finish();
    if (log_ >= 0) close(log_);
    removePart();
  }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  Status start() {
    removePart();  // of a start that was killed
    // What it says goes to memory: a disk that is full would keep nothing of it.
    log_ = memfd_create("ffmpeg", MFD_CLOEXEC);
    if (log_ < 0) return refused(fmt::format("cannot keep what '{}' says: {}", program_, std::strerror(errno)));
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return refused(fmt::format("cannot make a pipe: {}", std::strerror(errno)));
    std::vector<char*> pointers;
    for (std::string& word : words_) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], 0);
    posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&actions, log_, 2);
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
      if (count <= 0) return readAll_ = false;
      done += std::size_t(count);
    }
    return true;
  }

  // Good only if it ended well, had nothing to complain of and read every picture: a film that lacks something is none.
  Status finish() {
    if (pipe_ >= 0) close(pipe_);
    pipe_ = -1;
    if (process_ < 0) return {};
    int status = 0;
    while (waitpid(process_, &status, 0) < 0 && errno == EINTR) {
    }
    process_ = -1;
    std::string said = lastLine(log_);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
      if (said.empty() && readAll_) return {};
      if (said.empty()) said = "it ended before it had read all pictures";
    }
    return refused(fmt::format("'{}' could not make the film{}{}", program_, said.empty() ? "" : ": ", said));
  }

  Status takePlace(const std::string& path) {
    std::error_code error;
    std::filesystem::rename(part_, path, error);
    if (error) return refused(fmt::format("cannot write '{}': {}", path, error.message()));
    return {};
  }

 private:
  void removePart() const {
    std::error_code ignored;
    std::filesystem::remove(part_, ignored);
  }

  std::string part_, program_;
  std::vector<std::string> words_;
  pid_t process_ = -1;
  int pipe_ = -1, log_ = -1;
  bool readAll_ = true;
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
