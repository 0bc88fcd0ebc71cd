// The container of a take: a magic number, then records one after the other, each with its own lengths and checksum, so
// that a file cut off anywhere is whole up to its last whole record. docs/take-format.md shows the bytes.
//
//   magic (8) version (4) | HEAD | LIFE FRAM | FRAM | LIFE FRAM | ... | INDX | offset of INDX (8) end magic (8)
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "brickfall/result.h"
#include "record/byte_stream.h"

namespace brickfall {

constexpr std::uint8_t kTakeMagic[8] = {0x89, 'B', 'F', 'T', 'A', 'K', 'E', '\n'};
constexpr std::uint8_t kTakeEndMagic[8] = {0x89, 'B', 'F', 'T', 'E', 'N', 'D', '\n'};
constexpr std::uint32_t kTakeVersion = 7;  // which is written; versions 1 to 6 are read too
constexpr std::size_t kTakeStartBytes = 12;
constexpr std::size_t kTakeEndBytes = 16;

enum class RecordType : std::uint32_t {
  header = 0x44414548,  // "HEAD"
  life = 0x4546494C,    // "LIFE": which bodies come and go with the frame that follows; not in version 1
  frame = 0x4D415246,   // "FRAM"
  index = 0x58444E49,   // "INDX"
};

// type, stored bytes, bytes when unpacked, checksum of these three and of the stored bytes: 4 bytes each.
constexpr std::size_t kRecordHeadBytes = 16;
// A record claims at most this much more than it stores; the writer keeps to it. So a damaged length cannot make a reader
// ask for a memory out of all proportion to the file.
constexpr std::uint64_t kMostUnpackRatio = 256, kMostUnpackFree = 64 * 1024;

// The bytes of one record, packed with zstd where that helps.
Bytes makeRecord(RecordType type, std::span<const std::uint8_t> raw);

struct Record {
  RecordType type = RecordType::header;
  std::size_t end = 0;  // offset of what follows
  std::uint32_t unpackedBytes = 0;
  std::span<const std::uint8_t> stored;
};
// The record at `offset`, its lengths and checksum verified. The message of the error says what is wrong there.
Result<Record> recordAt(std::span<const std::uint8_t> file, std::size_t offset);
Result<Bytes> unpack(const Record& record);

}  // namespace brickfall
