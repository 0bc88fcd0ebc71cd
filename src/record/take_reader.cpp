// Opens a take. With a sound index at its end the frames are found there; without one (the run was killed) the records are
// walked from the start up to the last whole one. Nothing in the file is trusted before it is checked.
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "brickfall/take.h"
#include "record/frame_codec.h"
#include "record/header_codec.h"
#include "record/take_record.h"

namespace brickfall {

struct TakeReader::Impl {
  std::string name;  // for messages
  Bytes file;
  TakeHeader header;
  std::vector<std::size_t> offsets;
  std::string summary;
  bool complete = false;
  std::uint64_t tornBytes = 0;
  // The group that is being read: frames in order cost one decode each.
  FrameCodec codec{0};
  std::size_t nextFrame = 0;
  bool codecReady = false;

  Error bad(const std::string& what) const { return {ErrorCode::badFormat, name + ": " + what}; }

  Status readStart(std::size_t& firstFrame);
  bool readIndex(std::size_t firstFrame);
  void scan(std::size_t firstFrame);
  Result<TakeFrame> decode(std::size_t index);
};

Status TakeReader::Impl::readStart(std::size_t& firstFrame) {
  if (file.size() < kTakeStartBytes || !std::equal(std::begin(kTakeMagic), std::end(kTakeMagic), file.begin())) {
    return bad("not a Brickfall take (its first bytes are not a take's)");
  }
  ByteReader in(std::span<const std::uint8_t>(file).subspan(8, 4));
  if (std::uint32_t version = in.u32(); version != kTakeVersion) {
    return bad("take format version " + std::to_string(version) + ", this program reads version " +
               std::to_string(kTakeVersion));
  }
  Result<Record> record = recordAt(file, kTakeStartBytes);
  if (!record) return bad("header: " + record.error().message);
  if (record->type != RecordType::header) return bad("the first record is not the header");
  Result<Bytes> raw = unpack(*record);
  if (!raw) return bad("header: " + raw.error().message);
  Result<TakeHeader> decoded = decodeHeader(*raw);
  if (!decoded) return bad(decoded.error().message);
  header = std::move(decoded).value();
  firstFrame = record->end;
  return {};
}

// False: no sound index; nothing is then changed.
bool TakeReader::Impl::readIndex(std::size_t firstFrame) {
  if (file.size() < firstFrame + kTakeEndBytes) return false;
  ByteReader end(std::span<const std::uint8_t>(file).last(kTakeEndBytes));
  std::uint64_t at = end.u64();
  std::span<const std::uint8_t> magic = end.take(8);
  if (!std::equal(magic.begin(), magic.end(), std::begin(kTakeEndMagic))) return false;
  if (at < firstFrame || at > file.size() - kTakeEndBytes) return false;
  Result<Record> record = recordAt(file, std::size_t(at));
  if (!record || record->type != RecordType::index || record->end != file.size() - kTakeEndBytes) return false;
  Result<Bytes> raw = unpack(*record);
  if (!raw) return false;
  ByteReader in(*raw);
  std::uint64_t count = in.varint();
  if (!in.canHold(count, 1)) return false;
  std::vector<std::size_t> found;
  found.reserve(std::size_t(count));
  std::uint64_t offset = 0;
  for (std::uint64_t k = 0; k < count; k++) {
    std::uint64_t step = in.varint();
    if (step == 0 || step > at || offset + step >= at || offset + step < firstFrame) return false;
    offset += step;
    found.push_back(std::size_t(offset));
  }
  std::string text = in.text();
  if (in.failed() || in.left() != 0) return false;
  offsets = std::move(found);
  summary = std::move(text);
  return true;
}

void TakeReader::Impl::scan(std::size_t firstFrame) {
  std::size_t at = firstFrame;
  while (at < file.size()) {
    Result<Record> record = recordAt(file, at);
    if (!record || record->type != RecordType::frame) break;
    offsets.push_back(at);
    at = record->end;
  }
  tornBytes = file.size() - at;
}

Result<TakeFrame> TakeReader::Impl::decode(std::size_t index) {
  std::string where = "frame " + std::to_string(index) + ": ";
  Result<Record> record = recordAt(file, offsets[index]);
  if (!record) return bad(where + record.error().message);
  if (record->type != RecordType::frame) return bad(where + "the index points at another kind of record");
  Result<Bytes> raw = unpack(*record);
  if (!raw) return bad(where + raw.error().message);
  Result<TakeFrame> frame = codec.decode(*raw, index % kTakeGroupFrames == 0);
  if (!frame) return bad(where + frame.error().message);
  return frame;
}

TakeReader::TakeReader(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TakeReader::TakeReader(TakeReader&&) noexcept = default;
TakeReader& TakeReader::operator=(TakeReader&&) noexcept = default;
TakeReader::~TakeReader() = default;

Result<TakeReader> TakeReader::open(const std::string& path) {
  auto refused = [&](const char* what) {
    return Error{ErrorCode::inputOutput, path + ": cannot " + what + ": " + std::strerror(errno)};
  };
  std::FILE* file = std::fopen(path.c_str(), "rb");
  if (!file) return refused("open");
  struct Closer {
    std::FILE* file;
    ~Closer() { std::fclose(file); }
  } closer{file};
  struct stat status {};
  if (::fstat(::fileno(file), &status) != 0) return refused("read");
  if (!S_ISREG(status.st_mode)) return Error{ErrorCode::inputOutput, path + ": not a file, expected a take"};
  Bytes bytes(std::size_t(status.st_size));
  std::size_t got = bytes.empty() ? 0 : std::fread(bytes.data(), 1, bytes.size(), file);
  if (std::ferror(file)) return refused("read");
  bytes.resize(got);  // the file may have become shorter meanwhile

  auto impl = std::make_unique<Impl>();
  impl->name = path;
  impl->file = std::move(bytes);
  return openImpl(std::move(impl));
}

Result<TakeReader> TakeReader::openBytes(std::vector<std::uint8_t> bytes) {
  auto impl = std::make_unique<Impl>();
  impl->name = "take";
  impl->file = std::move(bytes);
  return openImpl(std::move(impl));
}

Result<TakeReader> TakeReader::openImpl(std::unique_ptr<Impl> impl) {
  std::size_t firstFrame = 0;
  if (Status started = impl->readStart(firstFrame); !started) return started.error();
  impl->complete = impl->readIndex(firstFrame);
  if (!impl->complete) impl->scan(firstFrame);
  impl->codec = FrameCodec(impl->header.bodies.size());
  return TakeReader(std::move(impl));
}

const TakeHeader& TakeReader::header() const { return impl_->header; }
std::size_t TakeReader::frameCount() const { return impl_->offsets.size(); }
bool TakeReader::complete() const { return impl_->complete; }
std::uint64_t TakeReader::tornBytes() const { return impl_->tornBytes; }
const std::string& TakeReader::summaryJson() const { return impl_->summary; }

Result<TakeFrame> TakeReader::frame(std::size_t index) const {
  Impl& take = *impl_;
  if (index >= take.offsets.size()) {
    return Error{ErrorCode::invalidArgument, take.name + ": frame " + std::to_string(index) +
                                                 " asked for, the take has " + std::to_string(take.offsets.size())};
  }
  std::size_t groupStart = index - index % kTakeGroupFrames;
  bool goOn = take.codecReady && take.nextFrame >= groupStart && take.nextFrame <= index;
  std::size_t at = goOn ? take.nextFrame : groupStart;
  take.codecReady = false;
  for (; at < index; at++) {
    if (Result<TakeFrame> before = take.decode(at); !before) return before.error();
  }
  Result<TakeFrame> frame = take.decode(index);
  take.codecReady = frame.ok();
  take.nextFrame = index + 1;
  return frame;
}

}  // namespace brickfall
