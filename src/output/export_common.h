// Parts that all exports write alike.
#pragma once
#include <charconv>
#include <string>
#include <string_view>

#include "brickfall/export.h"
#include "record/atomic_file.h"

namespace brickfall {

// The shortest text that reads back as the number; what is not finite is left empty.
template <class T> void appendNumber(std::string& out, T value) {
  char text[40];
  if constexpr (std::is_floating_point_v<T>)
    if (!(value - value == 0)) return;
  const auto end = std::to_chars(text, text + sizeof text, value);
  out.append(text, end.ptr);
}

const char* eventName(TakeEventType type);

// Text that goes to a file in pieces of some size.
class TextFile {
 public:
  explicit TextFile(const std::string& path) : file_(path) {}
  Status open() { return file_.open(); }
  std::string& text() { return text_; }
  void flush(bool all) {
    if (!all && text_.size() < (1u << 20)) return;
    file_.write(text_);
    text_.clear();
  }
  Status commit() {
    flush(true);
    return file_.commit();
  }

 private:
  AtomicFile file_;
  std::string text_;
};

Status exportCsv(const TakeReader& take, const std::string& stem, const ExportOptions& options,
                 const Progress& progress, std::vector<std::string>& files);
Status exportJson(const TakeReader& take, const std::string& stem, const ExportOptions& options,
                  const Progress& progress, std::vector<std::string>& files);
Status exportNpz(const TakeReader& take, const std::string& stem, const ExportOptions& options,
                 const Progress& progress, std::vector<std::string>& files);

}  // namespace brickfall
