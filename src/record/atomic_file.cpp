#include "record/atomic_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "brickfall/whole_file.h"

namespace brickfall {
namespace {

Error refusal(const std::string& path, const char* what) {
  return {ErrorCode::inputOutput, path + ": cannot " + what + ": " + std::strerror(errno)};
}

// The file may have been renamed or removed by its last owner between our opening and locking it.
bool isNamed(int file, const std::string& name) {
  struct stat opened {
  }, named{};
  return ::fstat(file, &opened) == 0 && ::stat(name.c_str(), &named) == 0 && opened.st_ino == named.st_ino &&
         opened.st_dev == named.st_dev;
}

}  // namespace

AsideFile::AsideFile(std::string path, std::string name, int file)
    : path_(std::move(path)), name_(std::move(name)), file_(file) {}

AsideFile::AsideFile(AsideFile&& other) noexcept
    : path_(std::move(other.path_)), name_(std::move(other.name_)), file_(std::exchange(other.file_, -1)) {}

AsideFile& AsideFile::operator=(AsideFile&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(name_, other.name_);
  std::swap(file_, other.file_);
  return *this;
}

AsideFile::~AsideFile() {
  if (file_ >= 0) ::close(file_);
}

Result<AsideFile> AsideFile::open(const std::string& path) {
  constexpr int kMostTries = 100;
  if (::access(path.c_str(), W_OK) != 0 && errno != ENOENT) return refusal(path, "write");
  const std::string name = path + ".part";
  for (int i = 0; i < kMostTries; i++) {
    const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666);
    if (file < 0) return refusal(name, "create");
    AsideFile aside(path, name, file);
    // A file system without locks is no reason to refuse.
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      return Error{ErrorCode::inputOutput, name + ": cannot write: it is being written by another process"};
    }
    if (!isNamed(file, name)) continue;
    if (::ftruncate(file, 0) != 0) {
      const Error error = refusal(name, "write");
      aside.remove();
      return error;
    }
    return aside;
  }
  return Error{ErrorCode::inputOutput, name + ": cannot write: others keep replacing it"};
}

Status AsideFile::takePlace() {
  if (std::rename(name_.c_str(), path_.c_str()) != 0) return refusal(path_, "create");
  name_ = path_;
  return {};
}

void AsideFile::remove() { ::unlink(name_.c_str()); }

AtomicFile::AtomicFile(std::string path) : path_(std::move(path)), aside_(Error{}) {}

AtomicFile::~AtomicFile() { giveUp(); }

void AtomicFile::giveUp() {
  if (aside_) aside_->remove();
  aside_ = Error{};
  if (direct_ >= 0) ::close(direct_);
  direct_ = file_ = -1;
}

Error AtomicFile::refused(const char* what) const { return refusal(path_, what); }

Status AtomicFile::open() {
  struct stat there {};
  const bool exists = ::stat(path_.c_str(), &there) == 0;
  if (exists && !S_ISREG(there.st_mode) && !S_ISDIR(there.st_mode)) {
    file_ = direct_ = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    return direct_ < 0 ? Status(refused("write")) : Status();
  }
  aside_ = AsideFile::open(path_);
  if (!aside_) return aside_.error();
  file_ = aside_->descriptor();
  return {};
}

void AtomicFile::write(std::span<const std::uint8_t> bytes) {
  while (state_ && !bytes.empty()) {
    ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      state_ = refused("write");
      return;
    }
    bytes = bytes.subspan(std::size_t(count));
  }
}

void AtomicFile::write(std::string_view text) {
  write(std::span(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
}

Status AtomicFile::commit() {
  // The data must be on the disk before the name is, or a power cut could leave an empty file under it. After that nothing
  // is left that closing could refuse.
  if (state_ && ::fsync(file_) != 0 && errno != EINVAL) state_ = refused("write");
  if (state_ && aside_) state_ = aside_->takePlace();
  if (state_) aside_ = Error{};
  giveUp();
  return state_;
}

Status writeWhole(const std::string& path, std::string_view content) {
  AtomicFile file(path);
  if (Status opened = file.open(); !opened) return opened;
  file.write(content);
  return file.commit();
}

}  // namespace brickfall
