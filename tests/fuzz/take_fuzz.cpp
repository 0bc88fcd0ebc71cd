// libFuzzer: any bytes as a take, and, since checksums keep most of them out there, as the inside of its records and as
// records with sound checksums. What opens gives only finite poses, as many as the header says.
#include "brickfall/take.h"
#include "fuzz/fuzz_check.h"
#include "record/crc32.h"
#include "record/frame_codec.h"
#include "record/header_codec.h"
#include "record/take_record.h"

namespace {

using namespace brickfall;
using fuzz::require;

constexpr std::size_t kMostFrames = 200;

void checkFrame(const TakeFrame& frame, std::size_t bodies) {
  require(frame.poses.size() == bodies, "poses are missing, or too many");
  for (const TakePose& pose : frame.poses)
    require(isFinite(pose.position) && isFinite(pose.rotation), "a pose is not finite");
  for (const TakeEvent& event : frame.events)
    require(event.bodyA < bodies && event.bodyB < bodies, "an event names a body that is not there");
}

void readAll(const Bytes& bytes) {
  Result<TakeReader> reader = TakeReader::openBytes(bytes);
  if (!reader) {
    require(!reader.error().message.empty(), "an error without a reason");
    return;
  }
  std::size_t frames = std::min(reader->frameCount(), kMostFrames);
  for (std::size_t f = frames; f-- > 0;) (void)reader->frame(f).ok();  // backwards: seeks
  for (std::size_t f = 0; f < frames; f++) {
    Result<TakeFrame> frame = reader->frame(f);
    if (frame) checkFrame(*frame, reader->header().bodies.size());
  }
}

// Records of any content, each "type, length (2 bytes), content", sealed as an attacker would.
Bytes sealed(fuzz::Bytes input, bool finished) {
  constexpr RecordType kTypes[] = {RecordType::header, RecordType::frame, RecordType::index};
  ByteWriter out;
  out.append(kTakeMagic);
  out.u32(kTakeVersion);
  std::size_t last = 0;
  std::uint8_t type = 0;
  std::uint16_t length = 0;
  while (input.take(type) && input.take(length)) {
    std::span<const std::uint8_t> content(input.data(), std::min<std::size_t>(length, input.size()));
    for (std::uint8_t skipped; length > 0 && input.take(skipped);) length--;
    ByteWriter head;
    head.u32(std::uint32_t(kTypes[type % 3]));
    head.u32(std::uint32_t(content.size()));
    head.u32(std::uint32_t(content.size()));
    head.u32(crc32(content, crc32(head.bytes())));
    last = out.bytes().size();
    out.append(head.bytes());
    out.append(content);
  }
  if (!finished) return out.bytes();
  out.u64(last);
  out.append(kTakeEndMagic);
  return out.bytes();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::uint8_t mode = data[0] % 5;
  std::size_t bodies = data[0] / 5;
  std::span<const std::uint8_t> bytes(data + 1, size - 1);
  if (mode == 0) {
    readAll({bytes.begin(), bytes.end()});
  } else if (mode == 1) {
    Result<TakeHeader> header = decodeHeader(bytes);
    require(header.ok() || !header.error().message.empty(), "an error without a reason");
  } else if (mode == 2) {
    FrameCodec codec(bodies);
    std::size_t half = bytes.size() / 2;
    Result<TakeFrame> first = codec.decode(bytes.first(half), true);
    if (!first) return 0;
    checkFrame(*first, bodies);
    if (Result<TakeFrame> next = codec.decode(bytes.subspan(half), false)) checkFrame(*next, bodies);
  } else {
    readAll(sealed({bytes.data(), bytes.size()}, mode == 4));
  }
  return 0;
}
