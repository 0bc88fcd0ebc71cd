#include "record/take_record.h"

#include <zstd.h>

#include <algorithm>

#include "record/crc32.h"

namespace brickfall {
namespace {

constexpr int kZstdLevel = 3;  // a frame of 1000 falling bricks in well under a millisecond

Error bad(std::string message) { return {ErrorCode::badFormat, std::move(message)}; }

std::uint64_t mostUnpacked(std::uint64_t stored) { return stored * kMostUnpackRatio + kMostUnpackFree; }

}  // namespace

Bytes makeRecord(RecordType type, std::span<const std::uint8_t> raw) {
  Bytes packed(ZSTD_compressBound(raw.size()));
  std::size_t size = ZSTD_compress(packed.data(), packed.size(), raw.data(), raw.size(), kZstdLevel);
  // Equal lengths mean "stored as it is".
  bool store = ZSTD_isError(size) || size >= raw.size() || raw.size() > mostUnpacked(size);
  packed.resize(store ? 0 : size);
  if (store) packed.assign(raw.begin(), raw.end());

  ByteWriter out;
  out.u32(std::uint32_t(type));
  out.u32(std::uint32_t(packed.size()));
  out.u32(std::uint32_t(raw.size()));
  out.u32(crc32(packed, crc32(out.bytes())));
  out.append(packed);
  return out.bytes();
}

Result<Record> recordAt(std::span<const std::uint8_t> file, std::size_t offset) {
  if (offset > file.size() || file.size() - offset < kRecordHeadBytes)
    return bad("the file ends inside a record's head");
  std::span<const std::uint8_t> head = file.subspan(offset, kRecordHeadBytes);
  ByteReader in(head);
  Record record;
  record.type = RecordType(in.u32());
  std::uint32_t storedBytes = in.u32();
  record.unpackedBytes = in.u32();
  std::uint32_t checksum = in.u32();
  if (record.type != RecordType::header && record.type != RecordType::life && record.type != RecordType::frame &&
      record.type != RecordType::index) {
    return bad("unknown record type " + std::to_string(std::uint32_t(record.type)));
  }
  if (storedBytes > file.size() - offset - kRecordHeadBytes) {
    return bad("the file ends inside a record: " + std::to_string(storedBytes) + " bytes announced, " +
               std::to_string(file.size() - offset - kRecordHeadBytes) + " left");
  }
  if (record.unpackedBytes > mostUnpacked(storedBytes)) {
    return bad("a record of " + std::to_string(storedBytes) + " bytes claims to unpack to " +
               std::to_string(record.unpackedBytes));
  }
  record.stored = file.subspan(offset + kRecordHeadBytes, storedBytes);
  if (crc32(record.stored, crc32(head.first(12))) != checksum) return bad("checksum mismatch");
  record.end = offset + kRecordHeadBytes + storedBytes;
  return record;
}

Result<Bytes> unpack(const Record& record) {
  if (record.stored.size() == record.unpackedBytes) return Bytes(record.stored.begin(), record.stored.end());
  Bytes raw(record.unpackedBytes);
  std::size_t size = ZSTD_decompress(raw.data(), raw.size(), record.stored.data(), record.stored.size());
  if (ZSTD_isError(size)) return bad(std::string("zstd: ") + ZSTD_getErrorName(size));
  if (size != raw.size()) {
    return bad("a record unpacks to " + std::to_string(size) + " bytes, expected " + std::to_string(raw.size()));
  }
  return raw;
}

}  // namespace brickfall
