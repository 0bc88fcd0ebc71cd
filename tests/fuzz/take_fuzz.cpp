// libFuzzer: any bytes as a take, and, since checksums keep most of them out there, as the inside of its records and as
// records with sound checksums. What opens gives only finite poses, one for each body that is there.
#include "brickfall/take.h"
#include "fuzz/fuzz_check.h"
#include "record/body_codec.h"
#include "record/crc32.h"
#include "record/frame_codec.h"
#include "record/header_codec.h"
#include "record/take_record.h"

namespace {

using namespace brickfall;
using fuzz::require;

constexpr std::size_t kMostFrames = 200;

void checkFrame(const TakeFrame& frame, std::size_t there, std::size_t bodies, std::size_t mortar, std::size_t joints) {
  require(frame.poses.size() == there, "poses are missing, or too many");
  for (const TakePose& pose : frame.poses)
    require(isFinite(pose.position) && isFinite(pose.rotation), "a pose is not finite");
  for (const TakeEvent& event : frame.events)
    require(event.bodyA < bodies && event.bodyB < bodies, "an event names a body that is not there");
  require(frame.mortar.size() == mortar || frame.mortar.empty(), "states of mortar are missing, or too many");
  for (const TakeMortarState& state : frame.mortar)
    require(state.damage >= 0 && state.damage <= 1 && state.utilisation >= 0 && state.utilisation <= 1,
            "a state of mortar is not a share");
  for (const TakeBreak& broken : frame.breaks) {
    require(broken.mortar < joints, "a break names a joint that is not there");
    for (const TakeLoadTaker& taker : broken.takers)
      require(taker.bodyA < bodies && taker.bodyB < bodies &&
                  (taker.mortar < joints || taker.mortar == TakeLoadTaker::kContacts),
              "a break names who is not there");
  }
}

void readAll(const Bytes& bytes) {
  Result<TakeReader> reader = TakeReader::openBytes(bytes);
  if (!reader) {
    require(!reader.error().message.empty(), "an error without a reason");
    return;
  }
  std::size_t frames = std::min(reader->frameCount(), kMostFrames);
  for (const TakeMortar& joint : reader->mortar())
    require(joint.bodyA < reader->bodies().size() && joint.bodyB < reader->bodies().size(), "a joint of no body");
  for (const auto* lives : {&reader->lives(), &reader->mortarLives()})
    for (const TakeLife& life : *lives)
      require(life.birth <= life.end && life.end <= reader->frameCount(),
              "a body ends before it comes, or after the take");
  for (std::size_t f = frames; f-- > 0;) (void)reader->frame(f).ok();  // backwards: seeks
  for (std::size_t f = 0; f < frames; f++) {
    Result<TakeFrame> frame = reader->frame(f);
    if (frame)
      checkFrame(*frame, reader->bodiesAt(f).size(), reader->bodies().size(), reader->mortarAt(f).size(),
                 reader->mortar().size());
  }
}

// Records of any content, each "type, length (2 bytes), content", sealed as an attacker would.
Bytes sealed(fuzz::Bytes input, std::uint32_t version, bool finished) {
  constexpr RecordType kTypes[] = {RecordType::header, RecordType::frame, RecordType::index, RecordType::life};
  ByteWriter out;
  out.append(kTakeMagic);
  out.u32(version);
  std::size_t last = 0;
  std::uint8_t type = 0;
  std::uint16_t length = 0;
  while (input.take(type) && input.take(length)) {
    std::span<const std::uint8_t> content(input.data(), std::min<std::size_t>(length, input.size()));
    for (std::uint8_t skipped; length > 0 && input.take(skipped);) length--;
    ByteWriter head;
    head.u32(std::uint32_t(kTypes[type % 4]));
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
  std::uint8_t mode = data[0] % 8;
  std::size_t bodies = data[0] / 8;
  std::span<const std::uint8_t> bytes(data + 1, size - 1);
  if (mode == 0) {
    readAll({bytes.begin(), bytes.end()});
  } else if (mode == 1) {
    Result<DecodedHeader> header = decodeHeader(bytes, 1 + bodies % 4);
    require(header.ok() || !header.error().message.empty(), "an error without a reason");
  } else if (mode == 2) {
    // Two frames; with the second a body goes and two come.
    FrameCodec codec;
    codec.change({}, bodies, {}, bodies / 2);
    std::size_t half = bytes.size() / 2;
    Result<TakeFrame> first = codec.decode(bytes.first(half), true);
    if (!first) return 0;
    checkFrame(*first, bodies, bodies, bodies / 2, bodies / 2);
    const std::uint32_t goes[] = {0};
    codec.change(std::span(goes).first(bodies > 0 ? 1 : 0), 2, std::span(goes).first(bodies > 1 ? 1 : 0), 2);
    if (Result<TakeFrame> next = codec.decode(bytes.subspan(half), false))
      checkFrame(*next, bodies + (bodies > 0 ? 1 : 2), bodies + 2, bodies / 2 + (bodies > 1 ? 1 : 2), bodies / 2 + 2);
  } else if (mode == 3) {
    Result<TakeChange> change = decodeChange(bytes, 2 + bodies % 3);
    require(change.ok() || !change.error().message.empty(), "an error without a reason");
    if (!change) return 0;
    Result<TakeChange> again = decodeChange(encodeChange(*change), kTakeVersion);
    require(again.ok() && again->ends == change->ends && again->births.size() == change->births.size() &&
                again->mortar.size() == change->mortar.size() && again->mortarEnds == change->mortarEnds,
            "a change is not what it was");
  } else {
    readAll(sealed({bytes.data(), bytes.size()}, mode < 6 ? 2 + std::uint32_t(bodies % 3) : 1, mode % 2 == 0));
  }
  return 0;
}
