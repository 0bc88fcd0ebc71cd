// Opens a take. With a sound index at its end the frames, and who comes and goes with them, are found there; without one (the
// run was killed) the records are walked from the start up to the last whole frame. Nothing in the file is trusted before it
// is checked.
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <optional>

#include "brickfall/take.h"
#include "record/body_codec.h"
#include "record/frame_codec.h"
#include "record/header_codec.h"
#include "record/take_record.h"

namespace brickfall {

struct TakeReader::Impl {
  std::string name;  // for messages
  Bytes file;
  std::uint32_t version = kTakeVersion;
  TakeHeader header;
  std::vector<TakeBody> bodies;
  std::vector<TakeMortar> mortar;
  std::vector<TakeLife> mortarLives;
  std::vector<TakeLife> lives;  // of each; while the take is being opened kStays for those that have no end yet
  struct Change {
    std::size_t frame = 0;  // with which it comes
    std::vector<std::uint32_t> ends;
    std::size_t births = 0;
    std::vector<std::uint32_t> mortarEnds;
    std::size_t mortarBirths = 0;
  };
  std::vector<Change> changes;  // in the order of frames
  std::vector<std::size_t> offsets;
  std::string summary;
  bool complete = false;
  std::uint64_t tornBytes = 0;
  // The group that is being read: frames in order cost one decode each.
  FrameCodec codec;
  std::size_t nextFrame = 0;
  bool codecReady = false;

  Error bad(const std::string& what) const { return {ErrorCode::badFormat, name + ": " + what}; }

  Status readStart(std::size_t& firstFrame);
  bool readIndex(std::size_t firstFrame);
  bool readFrames(ByteReader& in, std::size_t firstFrame, std::size_t end);
  bool readChanges(ByteReader& in, std::size_t firstFrame);
  void scan(std::size_t firstFrame);
  bool addChange(std::size_t frame, const Record& record);
  void forgetChanges();
  FrameCast castOf(std::size_t frame) const;
  void prepareCodec(std::size_t index, bool goesOn);
  Result<TakeFrame> decode(std::size_t index);
};

constexpr std::size_t kStays = SIZE_MAX;

bool isTake(std::string_view start) {
  return start.size() >= std::size(kTakeMagic) &&
         std::equal(std::begin(kTakeMagic), std::end(kTakeMagic), start.begin(),
                    [](std::uint8_t magic, char found) { return magic == std::uint8_t(found); });
}

Status TakeReader::Impl::readStart(std::size_t& firstFrame) {
  if (file.size() < kTakeStartBytes || !isTake({reinterpret_cast<const char*>(file.data()), file.size()})) {
    return bad("not a Brickfall take (its first bytes are not a take's)");
  }
  ByteReader in(std::span<const std::uint8_t>(file).subspan(8, 4));
  version = in.u32();
  if (version < 1 || version > kTakeVersion) {
    return bad("take format version " + std::to_string(version) + ", this program reads versions 1 to " +
               std::to_string(kTakeVersion));
  }
  Result<Record> record = recordAt(file, kTakeStartBytes);
  if (!record) return bad("header: " + record.error().message);
  if (record->type != RecordType::header) return bad("the first record is not the header");
  Result<Bytes> raw = unpack(*record);
  if (!raw) return bad("header: " + raw.error().message);
  Result<DecodedHeader> decoded = decodeHeader(*raw, version);
  if (!decoded) return bad(decoded.error().message);
  header = std::move(decoded->header);
  bodies = std::move(decoded->bodies);
  for (std::size_t k = 0; k < bodies.size(); k++) bodies[k].look = std::uint32_t(k);
  lives.assign(bodies.size(), {0, kStays});
  codec = FrameCodec(version);
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
  bool sound = readFrames(in, firstFrame, std::size_t(at)) && (version == 1 || readChanges(in, firstFrame));
  std::string text = in.text();
  if (!sound || in.failed() || in.left() != 0) {
    offsets.clear();
    forgetChanges();
    return false;
  }
  summary = std::move(text);
  return true;
}

bool TakeReader::Impl::readFrames(ByteReader& in, std::size_t firstFrame, std::size_t end) {
  std::uint64_t count = in.varint();
  if (!in.canHold(count, 1)) return false;
  offsets.reserve(std::size_t(count));
  std::uint64_t offset = 0;
  for (std::uint64_t k = 0; k < count; k++) {
    std::uint64_t step = in.varint();
    if (step == 0 || step > end || offset + step >= end || offset + step < firstFrame) return false;
    offset += step;
    offsets.push_back(std::size_t(offset));
  }
  return !in.failed();
}

// Each change lies right before its frame; the index tells which frames have one, and how long it is.
bool TakeReader::Impl::readChanges(ByteReader& in, std::size_t firstFrame) {
  std::uint64_t count = in.varint(), frame = 0;
  if (!in.canHold(count, 2)) return false;
  for (std::uint64_t k = 0; k < count; k++) {
    std::uint64_t step = in.varint(), size = in.varint();
    if (in.failed() || (k > 0 && step == 0) || step >= offsets.size() || frame + step >= offsets.size()) return false;
    frame += step;
    std::size_t at = offsets[std::size_t(frame)];
    if (size > at - firstFrame) return false;
    Result<Record> record = recordAt(file, at - std::size_t(size));
    if (!record || record->type != RecordType::life || record->end != at) return false;
    if (!addChange(std::size_t(frame), *record)) return false;
  }
  return true;
}

void TakeReader::Impl::scan(std::size_t firstFrame) {
  std::size_t at = firstFrame;
  while (at < file.size()) {
    Result<Record> record = recordAt(file, at);
    if (!record) break;
    std::size_t frameAt = at;
    std::optional<Record> change;
    if (record->type == RecordType::life && version > 1) {
      change = *record;
      frameAt = record->end;
      record = recordAt(file, frameAt);
    }
    if (!record || record->type != RecordType::frame) break;
    if (change && !addChange(offsets.size(), *change)) break;
    offsets.push_back(frameAt);
    at = record->end;
  }
  tornBytes = file.size() - at;
}

// False, and nothing changed, if it is damaged or does not fit those before it.
bool TakeReader::Impl::addChange(std::size_t frame, const Record& record) {
  Result<Bytes> raw = unpack(record);
  if (!raw) return false;
  Result<TakeChange> change = decodeChange(*raw, version);
  if (!change || change->births.size() > UINT32_MAX - bodies.size() ||
      change->mortar.size() > UINT32_MAX - mortar.size())
    return false;
  auto mayEnd = [](const std::vector<std::uint32_t>& ends, const std::vector<TakeLife>& all) {
    return std::all_of(ends.begin(), ends.end(),
                       [&](std::uint32_t one) { return one < all.size() && all[one].end == kStays; });
  };
  if (!mayEnd(change->ends, lives) || !mayEnd(change->mortarEnds, mortarLives)) return false;
  for (const TakeMortar& joint : change->mortar)
    if (!mortarFault(joint, bodies.size() + change->births.size()).empty()) return false;
  for (std::uint32_t body : change->ends) lives[body].end = frame;
  for (std::uint32_t joint : change->mortarEnds) mortarLives[joint].end = frame;
  for (const TakeMortar& joint : change->mortar) {
    mortar.push_back(joint);
    mortarLives.push_back({frame, kStays});
  }
  for (TakeBody& body : change->births) {
    if (!body.look) body.look = std::uint32_t(bodies.size());
    bodies.push_back(std::move(body));
    lives.push_back({frame, kStays});
  }
  changes.push_back(
      {frame, std::move(change->ends), change->births.size(), std::move(change->mortarEnds), change->mortar.size()});
  return true;
}

// Back to the bodies of the header.
void TakeReader::Impl::forgetChanges() {
  std::size_t births = 0;
  for (const Change& change : changes) births += change.births;
  bodies.resize(bodies.size() - births);
  lives.assign(bodies.size(), {0, kStays});
  mortar.clear();
  mortarLives.clear();
  changes.clear();
}

namespace {

std::vector<std::uint32_t> thereAt(std::size_t frame, const std::vector<TakeLife>& lives) {
  std::vector<std::uint32_t> out;
  for (std::size_t k = 0; k < lives.size(); k++)
    if (lives[k].holds(frame)) out.push_back(std::uint32_t(k));
  return out;
}

// How many have come up to the frame.
std::size_t knownAt(std::size_t frame, const std::vector<TakeLife>& lives) {
  auto later = std::partition_point(lives.begin(), lives.end(), [&](const TakeLife& l) { return l.birth <= frame; });
  return std::size_t(later - lives.begin());
}

}  // namespace

FrameCast TakeReader::Impl::castOf(std::size_t frame) const {
  return {thereAt(frame, lives), thereAt(frame, mortarLives), knownAt(frame, lives), knownAt(frame, mortarLives)};
}

// Who is there in the frame: from what the codec knows of the one before, or from scratch.
void TakeReader::Impl::prepareCodec(std::size_t index, bool goesOn) {
  if (!goesOn) {
    codec.start(castOf(index));
    return;
  }
  auto change = std::partition_point(changes.begin(), changes.end(), [&](const Change& c) { return c.frame < index; });
  if (change != changes.end() && change->frame == index)
    codec.change(change->ends, change->births, change->mortarEnds, change->mortarBirths);
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
  for (auto* lives : {&impl->lives, &impl->mortarLives})
    for (TakeLife& life : *lives) life.end = std::min(life.end, impl->offsets.size());
  return TakeReader(std::move(impl));
}

const TakeHeader& TakeReader::header() const { return impl_->header; }
std::size_t TakeReader::frameCount() const { return impl_->offsets.size(); }
const std::vector<TakeBody>& TakeReader::bodies() const { return impl_->bodies; }
const std::vector<TakeLife>& TakeReader::lives() const { return impl_->lives; }
std::vector<std::uint32_t> TakeReader::bodiesAt(std::size_t frame) const { return thereAt(frame, impl_->lives); }
const std::vector<TakeMortar>& TakeReader::mortar() const { return impl_->mortar; }
const std::vector<TakeLife>& TakeReader::mortarLives() const { return impl_->mortarLives; }
std::vector<std::uint32_t> TakeReader::mortarAt(std::size_t frame) const { return thereAt(frame, impl_->mortarLives); }
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
    take.prepareCodec(at, goOn);
    if (Result<TakeFrame> before = take.decode(at); !before) return before.error();
    goOn = true;
  }
  take.prepareCodec(index, goOn);
  Result<TakeFrame> frame = take.decode(index);
  take.codecReady = frame.ok();
  take.nextFrame = index + 1;
  return frame;
}

}  // namespace brickfall
