#include "viewer_core/state_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>

#include "brickfall/whole_file.h"
#include "viewer_core/history.h"

namespace brickfall::viewer {

namespace {

// magic, version, end of line, then texts and bytes, each with its length (8 bytes, little end first), lists with their count,
// then a sum of all before it.
constexpr std::string_view kMagic =
    "\x89"
    "BFSTATE";
constexpr std::string_view kVersion = "2\n";

void put(std::string& out, std::uint64_t number) {
  for (int k = 0; k < 8; k++) out.push_back(char(number >> (8 * k)));
}
void put(std::string& out, std::string_view text) {
  put(out, std::uint64_t(text.size()));
  out.append(text);
}

std::uint64_t numberAt(std::string_view bytes) {
  std::uint64_t number = 0;
  for (int k = 0; k < 8; k++) number |= std::uint64_t(std::uint8_t(bytes[std::size_t(k)])) << (8 * k);
  return number;
}

// FNV-1a: finds damage, not intent; the snapshot has its own checks.
std::uint64_t sumOf(std::string_view bytes) {
  std::uint64_t sum = 14695981039346656037ull;
  for (char c : bytes) sum = (sum ^ std::uint8_t(c)) * 1099511628211ull;
  return sum;
}

// Takes what was put; false when there is too little left.
class Reader {
 public:
  explicit Reader(std::string_view in) : in_(in) {}
  bool take(std::uint64_t& number) {
    if (in_.size() < 8) return false;
    number = numberAt(in_);
    in_.remove_prefix(8);
    return true;
  }
  bool take(std::string& text) {
    std::uint64_t size = 0;
    if (!take(size) || size > in_.size()) return false;
    text = in_.substr(0, std::size_t(size));
    in_.remove_prefix(std::size_t(size));
    return true;
  }
  bool atEnd() const { return in_.empty(); }

 private:
  std::string_view in_;
};

Error refused(const std::string& path) {
  return {ErrorCode::inputOutput, "cannot read '" + path + "': " + std::strerror(errno)};
}

}  // namespace

Result<std::size_t> writeState(const std::string& path, const SavedState& state) {
  std::string out = std::string(kMagic) + std::string(kVersion);
  put(out, state.source.file);
  put(out, state.source.text);
  put(out, std::uint64_t(state.source.overrides.size()));
  for (const auto& [key, value] : state.source.overrides) {
    put(out, key);
    put(out, value);
  }
  put(out, std::uint64_t(state.settings.size()));
  for (const auto& [key, value] : state.settings) {
    put(out, key);
    put(out, std::bit_cast<std::uint64_t>(value));
  }
  const std::vector<std::byte> bytes = compressed(state.snapshot);
  put(out, std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
  put(out, sumOf(out));
  if (Status written = writeWhole(path, out); !written) return written.error();
  return out.size();
}

bool isState(std::string_view bytes) { return bytes.starts_with(kMagic); }

Result<SavedState> readState(const std::string& path, const std::string& bytes) {
  const Error bad{ErrorCode::badFormat, path + ": found a damaged or cut-off state, expected a whole one"};
  if (!isState(bytes)) return Error{ErrorCode::badFormat, path + ": found other bytes, expected a saved state"};
  const std::string_view all = bytes, version = all.substr(kMagic.size(), kVersion.size());
  if (bytes.size() < kMagic.size() + kVersion.size() + 8) return bad;
  if (version != kVersion && version[0] >= '1' && version[0] <= '9')
    return Error{ErrorCode::badFormat, path + ": found a state of format " + std::string(1, version[0]) +
                                           ", saved by another version of the viewer; expected format " +
                                           std::string(1, kVersion[0])};
  const std::string_view content = all.substr(0, all.size() - 8);
  if (numberAt(all.substr(content.size())) != sumOf(content)) return bad;
  Reader reader(content.substr(kMagic.size() + kVersion.size()));
  SavedState state;
  std::uint64_t overrides = 0, settings = 0;
  std::string packed;
  if (!reader.take(state.source.file) || !reader.take(state.source.text) || !reader.take(overrides)) return bad;
  for (std::uint64_t i = 0; i < overrides; i++) {
    std::pair<std::string, std::string> pair;
    if (!reader.take(pair.first) || !reader.take(pair.second)) return bad;
    state.source.overrides.push_back(std::move(pair));
  }
  if (!reader.take(settings)) return bad;
  for (std::uint64_t i = 0; i < settings; i++) {
    std::string key;
    std::uint64_t bits = 0;
    if (!reader.take(key) || !reader.take(bits)) return bad;
    state.settings.push_back({std::move(key), std::bit_cast<double>(bits)});
  }
  if (!reader.take(packed) || !reader.atEnd()) return bad;
  Result<std::vector<std::byte>> snapshot = decompressed(std::as_bytes(std::span(packed)));
  if (!snapshot) return bad;
  state.snapshot = std::move(*snapshot);
  return state;
}

// Read here, since streams do not tell why reading failed.
Result<InputFile> InputFile::open(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (file < 0) return refused(path);
  return InputFile(path, file);
}

InputFile::InputFile(InputFile&& other) noexcept
    : path_(std::move(other.path_)), text_(std::move(other.text_)), file_(std::exchange(other.file_, -1)) {}

InputFile::~InputFile() {
  if (file_ >= 0) ::close(file_);
}

Status InputFile::readUpTo(std::size_t bytes) {
  std::vector<char> block(1 << 16);
  while (text_.size() < bytes) {
    const ssize_t count = ::read(file_, block.data(), std::min(block.size(), bytes - text_.size()));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return refused(path_);
    if (count == 0) break;
    text_.append(block.data(), std::size_t(count));
  }
  return {};
}

Status InputFile::readAll(std::size_t mostBytes) {
  if (Status read = readUpTo(mostBytes + 1); !read) return read;
  if (text_.size() <= mostBytes) return {};
  return Error{ErrorCode::limitExceeded,
               path_ + ": found more than " + std::to_string(mostBytes >> 20) + " MB, expected a smaller file"};
}

}  // namespace brickfall::viewer
