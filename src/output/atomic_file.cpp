#include "output/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

namespace brickfall {

AtomicFile::AtomicFile(std::string path)
    : path_(std::move(path)), aside_(path_ + ".part" + std::to_string(::getpid())) {}

AtomicFile::~AtomicFile() {
  if (file_ < 0) return;
  ::close(file_);
  ::unlink(aside_.c_str());
}

Error AtomicFile::refused(const char* what) const {
  return {ErrorCode::inputOutput, path_ + ": cannot " + what + ": " + std::strerror(errno)};
}

Status AtomicFile::open() {
  file_ = ::open(aside_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  return file_ < 0 ? Status(refused("create")) : Status();
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
  if (!state_) return state_;
  int file = file_;
  file_ = -1;
  // The data must be on the disk before the name is, or a power cut could leave an empty file under it.
  if (::fsync(file) != 0 && errno != EINVAL) state_ = refused("write");
  if (::close(file) != 0 && state_) state_ = refused("write");
  if (state_ && std::rename(aside_.c_str(), path_.c_str()) != 0) state_ = refused("create");
  if (!state_) ::unlink(aside_.c_str());
  return state_;
}

}  // namespace brickfall
