// A file that appears whole or not at all: made aside, then renamed over its place.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "brickfall/result.h"

namespace brickfall {

// "<path>.part", where a file is made before it gets its name. It is locked while somebody writes it, so that two writers
// never mix in one file; the system takes the lock back whatever ends the process, and what a killed one left is used again.
class AsideFile {
 public:
  // Empty when it is opened. Refuses if `path` is write-protected, although renaming would not ask.
  static Result<AsideFile> open(const std::string& path);
  AsideFile(AsideFile&& other) noexcept;
  AsideFile& operator=(AsideFile&& other) noexcept;
  ~AsideFile();  // gives up the lock; the file stays

  int descriptor() const { return file_; }
  const std::string& name() const { return name_; }  // ends with ".part" until takePlace()
  // Renames it over its place; after that name() is the path.
  Status takePlace();
  void remove();

 private:
  AsideFile(std::string path, std::string name, int file);
  std::string path_, name_;
  int file_;
};

class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();  // without commit(): what was written is removed again

  // A device or a pipe is written to as it is: nothing may be put into its place.
  Status open();
  // Failures are kept and reported by commit().
  void write(std::span<const std::uint8_t> bytes);
  void write(std::string_view text);
  Status commit();

 private:
  Error refused(const char* what) const;
  void giveUp();
  std::string path_;
  Result<AsideFile> aside_;
  int direct_ = -1;
  int file_ = -1;  // of either
  Status state_;
};

}  // namespace brickfall
