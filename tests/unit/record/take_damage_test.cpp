// Takes that were cut off or damaged: an error or a shorter take, never a crash, never wrong numbers passed off as right
// out of proportion, never memory out of proportion to the file.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

#include "record/body_codec.h"
#include "record/crc32.h"
#include "record/frame_codec.h"
#include "record/header_codec.h"
#include "record/take_record.h"
#include "support/synthetic_take.h"

namespace brickfall {
namespace {

Bytes smallTake(int frames, bool finished) {
  std::string path = (std::filesystem::temp_directory_path() / (std::to_string(::getpid()) + "_damage.take")).string();
  test::SyntheticTake take = test::makeSyntheticTake(
      {.courses = 2, .bricksPerCourse = 2, .frames = frames, .hitFrame = 2, .otherShapes = true, .breaking = true});
  if (finished) {
    EXPECT_EQ(test::writeTake(take, path), "");
  } else {
    Result<TakeWriter> writer = TakeWriter::create(path, take.header);
    for (std::size_t f = 0; f < take.frames.size(); f++) EXPECT_TRUE(writer->write(take.frames[f], take.change(f)));
  }
  std::ifstream in(path, std::ios::binary);
  Bytes bytes{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  return bytes;
}

// Written by version 1 of the format.
Bytes fixture() {
  std::ifstream in(BRICKFALL_SOURCE_DIR "/tests/unit/record/version1.take", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Reads all there is; the number of frames that came out, -1 = not opened.
int readAll(const Bytes& bytes) {
  Result<TakeReader> reader = TakeReader::openBytes(bytes);
  if (!reader) {
    EXPECT_FALSE(reader.error().message.empty());
    return -1;
  }
  int good = 0;
  for (std::size_t f = 0; f < reader->frameCount(); f++) {
    Result<TakeFrame> frame = reader->frame(f);
    if (frame) {
      EXPECT_EQ(frame->poses.size(), reader->bodiesAt(f).size());
      for (const TakePose& pose : frame->poses) EXPECT_TRUE(isFinite(pose.position) && isFinite(pose.rotation));
      good++;
    }
  }
  return good;
}

// Of a take of 70 frames.
void expectPrefixesToOpen(const Bytes& whole) {
  const TakeReader all = TakeReader::openBytes(whole).value();
  std::vector<std::size_t> ends;  // of the header and of each frame
  for (std::size_t at = kTakeStartBytes;;) {
    Result<Record> record = recordAt(whole, at);
    if (!record || record->type == RecordType::index) break;
    at = record->end;
    if (record->type != RecordType::life) ends.push_back(at);
  }
  ASSERT_EQ(ends.size(), 71u);
  for (std::size_t size = 0; size < whole.size(); size++) {
    int want = int(std::upper_bound(ends.begin(), ends.end(), size) - ends.begin()) - 1;
    Result<TakeReader> reader = TakeReader::openBytes(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(size)));
    if (want < 0) {
      EXPECT_FALSE(reader) << size;
      continue;
    }
    ASSERT_TRUE(reader) << size << ": " << reader.error().message;
    EXPECT_FALSE(reader->complete()) << size;
    ASSERT_EQ(int(reader->frameCount()), want) << size;
    if (want == 0) continue;
    EXPECT_TRUE(reader->frame(std::size_t(want) - 1)) << size;
    ASSERT_EQ(reader->bodiesAt(std::size_t(want) - 1), all.bodiesAt(std::size_t(want) - 1)) << size;
    for (const TakeLife& life : reader->lives()) EXPECT_TRUE(life.birth < life.end && life.end <= std::size_t(want));
  }
  EXPECT_EQ(readAll(whole), 70);
}

TEST(DamagedTake, EveryPrefixOpensUpToItsLastWholeFrame) { expectPrefixesToOpen(smallTake(70, true)); }

TEST(DamagedTake, EveryPrefixOfVersionOneDoesToo) { expectPrefixesToOpen(fixture()); }

TEST(DamagedTake, NoSingleFlippedBitGoesUnnoticed) {
  Bytes whole = smallTake(4, false);
  std::size_t noticed = 0;
  for (std::size_t bit = 0; bit < whole.size() * 8; bit++) {
    Bytes damaged = whole;
    damaged[bit / 8] ^= std::uint8_t(1u << (bit % 8));
    noticed += readAll(damaged) < 4;
  }
  EXPECT_EQ(noticed, whole.size() * 8);
}

TEST(DamagedTake, RandomDamageNeverCrashes) {
  Bytes whole = smallTake(70, true);
  std::mt19937_64 random(7);
  int refused = 0, shorter = 0, same = 0;
  for (int round = 0; round < 6000; round++) {
    Bytes damaged = whole;
    int changes = 1 + int(random() % 8);
    for (int c = 0; c < changes; c++) {
      std::size_t at = random() % damaged.size();
      switch (random() % 4) {
        case 0:
          damaged[at] = std::uint8_t(random());
          break;
        case 1:
          damaged.erase(damaged.begin() + std::ptrdiff_t(at));
          break;
        case 2:
          damaged.insert(damaged.begin() + std::ptrdiff_t(at), std::uint8_t(random()));
          break;
        default:
          damaged[at] = random() % 2 ? 0xff : 0;
          break;
      }
    }
    int good = readAll(damaged);
    (good < 0 ? refused : good < 70 ? shorter : same)++;
  }
  EXPECT_GT(refused, 100);
  EXPECT_GT(shorter, 100);
  EXPECT_LT(same, 3000);
}

// The same behind the checksums: bytes that are damaged and then sealed again, as an attacker would.
TEST(DamagedTake, RandomFrameBytesNeverCrash) {
  test::SyntheticTake take =
      test::makeSyntheticTake({.courses = 2, .bricksPerCourse = 3, .frames = 3, .hitFrame = 1, .mortared = true});
  FrameCodec encoder;
  encoder.change({}, take.bodies.size(), {}, take.mortar.size());
  std::vector<Bytes> frames;
  for (std::size_t f = 0; f < 3; f++) frames.push_back(encoder.encode(take.frames[f], f == 0));
  std::mt19937_64 random(8);
  int refused = 0;
  for (int round = 0; round < 20000; round++) {
    FrameCodec decoder;
    decoder.change({}, take.bodies.size(), {}, take.mortar.size());
    bool ok = true;
    for (std::size_t f = 0; f < 3 && ok; f++) {
      Bytes bytes = frames[f];
      for (std::uint64_t c = random() % 4; c > 0; c--) bytes[random() % bytes.size()] = std::uint8_t(random());
      if (random() % 8 == 0) bytes.resize(random() % bytes.size());
      Result<TakeFrame> frame = decoder.decode(bytes, f == 0);
      ok = frame.ok();
      if (ok) {
        EXPECT_EQ(frame->poses.size(), take.bodies.size());
        EXPECT_EQ(frame->mortar.size(), take.mortar.size());
      }
    }
    refused += !ok;
  }
  EXPECT_GT(refused, 2000);
  EXPECT_LT(refused, 20000);
}

// Any decoder: its own bytes, cut off and damaged.
template <class Decode> void expectDistrust(const Bytes& whole, const Decode& decode) {
  ASSERT_TRUE(decode(whole));
  for (std::size_t size = 0; size < whole.size(); size++) {
    EXPECT_FALSE(decode(Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(size)))) << size;
  }
  std::mt19937_64 random(9);
  int refused = 0;
  for (int round = 0; round < 20000; round++) {
    Bytes bytes = whole;
    for (std::uint64_t c = 1 + random() % 4; c > 0; c--) bytes[random() % bytes.size()] = std::uint8_t(random());
    refused += !decode(bytes);
  }
  EXPECT_GT(refused, 2000);
}

TEST(DamagedTake, RandomHeaderBytesNeverCrash) {
  TakeHeader header = test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 3, .frames = 1}).header;
  header.cameras.resize(8);
  header.cameras[3].path = {{0, {1, 1, 1}, {}, 40}, {2, {1, 1, 2}, {}, 50}};
  expectDistrust(encodeHeader(header), [](const Bytes& bytes) { return decodeHeader(bytes, kTakeVersion).ok(); });
}

TEST(DamagedTake, RandomHeaderBytesOfVersionOneNeverCrash) {
  Bytes file = fixture();
  Result<Record> record = recordAt(file, kTakeStartBytes);
  ASSERT_TRUE(record);
  expectDistrust(unpack(*record).value(), [](const Bytes& bytes) { return decodeHeader(bytes, 1).ok(); });
}

TEST(DamagedTake, RandomChangesNeverCrash) {
  TakeChange change;
  change.births = test::makeSyntheticTake({.courses = 1, .bricksPerCourse = 3, .frames = 1}).bodies;
  change.births[1].material = "steel";
  change.births.back().shapeMaterials.assign(change.births.back().shapes.size(), "brick");
  change.ends = {0, 1, 300};
  change.mortar = {{0, 1, {}, {1, 0, 0}, {0, 1, 0}}};
  change.mortarEnds = {2, 7};
  Bytes whole = encodeChange(change);
  Result<TakeChange> back = decodeChange(whole, kTakeVersion);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->ends, change.ends);
  EXPECT_EQ(back->births.size(), change.births.size());
  EXPECT_EQ(back->mortar.size(), 1u);
  EXPECT_EQ(back->mortarEnds, change.mortarEnds);
  expectDistrust(whole, [](const Bytes& bytes) { return decodeChange(bytes, kTakeVersion).ok(); });
}

Bytes sealedRecord(std::uint32_t type, std::uint32_t stored, std::uint32_t unpacked, const Bytes& payload) {
  ByteWriter out;
  out.u32(type);
  out.u32(stored);
  out.u32(unpacked);
  out.u32(crc32(payload, crc32(out.bytes())));
  out.append(payload);
  return out.bytes();
}

TEST(DamagedTake, LengthsOutOfProportionAreRefusedBeforeMemoryIsTaken) {
  Bytes payload(64, 1);
  Bytes huge = sealedRecord(std::uint32_t(RecordType::frame), 64, 0xffffffffu, payload);
  Result<Record> record = recordAt(huge, 0);
  ASSERT_FALSE(record);
  EXPECT_NE(record.error().message.find("claims to unpack to 4294967295"), std::string::npos) << record.error().message;
  Bytes longer = sealedRecord(std::uint32_t(RecordType::frame), 0xfffffff0u, 64, payload);
  EXPECT_FALSE(recordAt(longer, 0));

  ByteWriter header;  // three empty texts, seed, rate, then far too many bodies
  for (int k = 0; k < 3; k++) header.text("");
  header.u64(0);
  header.f64(60);
  header.varint(std::uint64_t(1) << 60);
  Result<DecodedHeader> decoded = decodeHeader(header.bytes(), 1);
  ASSERT_FALSE(decoded);
  EXPECT_NE(decoded.error().message.find("bodies announced"), std::string::npos);
  ByteWriter births, ends;
  births.varint(std::uint64_t(1) << 60);
  EXPECT_NE(decodeChange(births.bytes(), kTakeVersion).error().message.find("bodies announced"), std::string::npos);
  ends.varint(0);
  ends.varint(std::uint64_t(1) << 60);
  EXPECT_NE(decodeChange(ends.bytes(), kTakeVersion).error().message.find("ends announced"), std::string::npos);

  FrameCodec codec;
  ByteWriter frame;
  frame.f64(0);
  frame.varint(std::uint64_t(1) << 40);
  Result<TakeFrame> events = codec.decode(frame.bytes(), true);
  ASSERT_FALSE(events);
  EXPECT_NE(events.error().message.find("events announced"), std::string::npos);
}

// Changes that are whole but cannot be true: the take ends before them.
TEST(DamagedTake, ImpossibleChangesEndTheTake) {
  auto framed = [](const TakeChange& change, std::size_t bodies) {
    FrameCodec codec;
    codec.change({}, bodies);
    TakeFrame frame;
    frame.poses.resize(bodies);
    Bytes out = makeRecord(RecordType::life, encodeChange(change));
    Bytes record = makeRecord(RecordType::frame, codec.encode(frame, false));
    out.insert(out.end(), record.begin(), record.end());
    return out;
  };
  const Bytes whole = smallTake(2, false);
  TakeChange comes, goes, never, lost, alien;
  comes.births.resize(1);
  goes.ends = {1};
  never.ends = {4000};
  lost.mortarEnds = {0};
  alien.mortar = {{0, 4000, {}, {}, {}}};
  struct Case {
    std::vector<Bytes> more;
    std::size_t frames;
  };
  const Case cases[] = {{{framed(comes, 0)}, 3}, {{framed(goes, 0)}, 3},  {{framed(never, 0)}, 2},
                        {{framed(lost, 0)}, 2},  {{framed(alien, 0)}, 2}, {{framed(goes, 0), framed(goes, 0)}, 3}};
  for (const Case& c : cases) {
    Bytes bytes = whole;
    for (const Bytes& more : c.more) bytes.insert(bytes.end(), more.begin(), more.end());
    Result<TakeReader> reader = TakeReader::openBytes(bytes);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(reader->frameCount(), c.frames);
    EXPECT_TRUE(reader->frame(1));
    if (c.frames > 2) {
      EXPECT_FALSE(reader->frame(2)) << "its frame has no poses for those that are there";
    }
  }
  // A change of which the frame was torn off is not taken over.
  Bytes torn = whole, change = makeRecord(RecordType::life, encodeChange(comes));
  torn.insert(torn.end(), change.begin(), change.end());
  Result<TakeReader> reader = TakeReader::openBytes(torn);
  ASSERT_TRUE(reader);
  EXPECT_EQ(reader->frameCount(), 2u);
  EXPECT_EQ(reader->bodies().size(), TakeReader::openBytes(whole)->bodies().size());
  EXPECT_EQ(reader->tornBytes(), change.size());
}

TEST(DamagedTake, RecordsThatCompressExtremelyWellStillOpen) {
  Bytes zeros(3'000'000, 0);
  Bytes bytes = makeRecord(RecordType::frame, zeros);
  Result<Record> record = recordAt(bytes, 0);
  ASSERT_TRUE(record) << record.error().message;
  Result<Bytes> back = unpack(*record);
  ASSERT_TRUE(back);
  EXPECT_EQ(*back, zeros);
}

TEST(DamagedTake, MessagesSayWhatIsWrong) {
  Bytes whole = smallTake(2, true);
  Bytes other = whole;
  other[0] = 'P';
  EXPECT_NE(TakeReader::openBytes(other).error().message.find("not a Brickfall take"), std::string::npos);
  Bytes newer = whole;
  newer[8] = 9;
  EXPECT_NE(TakeReader::openBytes(newer).error().message.find("version 9"), std::string::npos);
  Bytes torn(whole.begin(), whole.begin() + 40);
  EXPECT_NE(TakeReader::openBytes(torn).error().message.find("header: the file ends inside"), std::string::npos);
  Bytes damaged = whole;
  damaged[whole.size() / 2] ^= 0x55;  // inside a frame: the index still opens it
  Result<TakeReader> reader = TakeReader::openBytes(damaged);
  if (reader) {
    bool named = false;
    for (std::size_t f = 0; f < reader->frameCount(); f++) {
      Result<TakeFrame> frame = reader->frame(f);
      named = named ||
              (!frame && frame.error().message.find("frame " + std::to_string(f) + ": checksum") != std::string::npos);
    }
    EXPECT_TRUE(named || reader->frameCount() < 2);
  } else {
    EXPECT_NE(reader.error().message.find("header: "), std::string::npos);
  }
}

}  // namespace
}  // namespace brickfall
