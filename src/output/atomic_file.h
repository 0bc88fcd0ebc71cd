// A file that appears whole or not at all: written aside, then renamed over its place.
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "brickfall/result.h"

namespace brickfall {

class AtomicFile {
 public:
  explicit AtomicFile(std::string path);
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;
  ~AtomicFile();  // without commit(): what was written is removed again

  Status open();
  // Failures are kept and reported by commit().
  void write(std::span<const std::uint8_t> bytes);
  void write(std::string_view text);
  Status commit();

 private:
  Error refused(const char* what) const;
  std::string path_, aside_;
  int file_ = -1;
  Status state_;
};

}  // namespace brickfall
