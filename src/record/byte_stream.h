// Little-endian bytes in and out. The reader never goes past its end: a read that would, gives zero and sets failed(),
// so a decoder checks once after a group of reads, and before it trusts any count.
#pragma once
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace brickfall {

using Bytes = std::vector<std::uint8_t>;

// Small magnitudes of either sign to small unsigned numbers: 0, -1, 1, -2, ... -> 0, 1, 2, 3, ...
inline std::uint64_t zigzag(std::int64_t v) { return (std::uint64_t(v) << 1) ^ (v < 0 ? ~std::uint64_t(0) : 0); }
inline std::int64_t unzigzag(std::uint64_t v) { return std::int64_t((v >> 1) ^ (~(v & 1) + 1)); }

class ByteWriter {
 public:
  void u8(std::uint8_t v) { bytes_.push_back(v); }
  void u32(std::uint32_t v) { fixed(v, 4); }
  void u64(std::uint64_t v) { fixed(v, 8); }
  void f32(float v) { u32(std::bit_cast<std::uint32_t>(v)); }
  void f64(double v) { u64(std::bit_cast<std::uint64_t>(v)); }
  // Seven bits a byte, low ones first, top bit = more follow.
  void varint(std::uint64_t v) {
    for (; v >= 0x80; v >>= 7) u8(std::uint8_t(v | 0x80));
    u8(std::uint8_t(v));
  }
  void signedVarint(std::int64_t v) { varint(zigzag(v)); }
  void text(std::string_view s) {
    varint(s.size());
    bytes_.insert(bytes_.end(), s.begin(), s.end());
  }
  void append(std::span<const std::uint8_t> more) { bytes_.insert(bytes_.end(), more.begin(), more.end()); }
  void clear() { bytes_.clear(); }
  const Bytes& bytes() const { return bytes_; }

 private:
  void fixed(std::uint64_t v, int count) {
    for (int k = 0; k < count; k++) u8(std::uint8_t(v >> (8 * k)));
  }
  Bytes bytes_;
};

class ByteReader {
 public:
  explicit ByteReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  bool failed() const { return failed_; }
  std::size_t left() const { return bytes_.size() - at_; }
  // May `count` items of at least `leastBytesEach` bytes still follow? Asked before anything of that size is allocated.
  bool canHold(std::uint64_t count, std::size_t leastBytesEach) const { return count <= left() / leastBytesEach; }

  std::uint8_t u8() { return std::uint8_t(fixed(1)); }
  std::uint32_t u32() { return std::uint32_t(fixed(4)); }
  std::uint64_t u64() { return fixed(8); }
  float f32() { return std::bit_cast<float>(u32()); }
  double f64() { return std::bit_cast<double>(u64()); }
  std::uint64_t varint() {
    std::uint64_t v = 0;
    for (int shift = 0; shift < 64; shift += 7) {
      std::uint8_t b = u8();
      v |= std::uint64_t(b & 0x7f) << shift;
      if (b < 0x80) return v;
    }
    failed_ = true;
    return 0;
  }
  std::int64_t signedVarint() { return unzigzag(varint()); }
  std::string text() {
    std::uint64_t size = varint();
    std::span<const std::uint8_t> s = take(size);
    return std::string(s.begin(), s.end());
  }
  std::span<const std::uint8_t> take(std::uint64_t size) {
    if (failed_ || size > left()) {
      failed_ = true;
      return {};
    }
    std::span<const std::uint8_t> out = bytes_.subspan(at_, std::size_t(size));
    at_ += std::size_t(size);
    return out;
  }

 private:
  std::uint64_t fixed(int count) {
    std::span<const std::uint8_t> s = take(std::uint64_t(count));
    std::uint64_t v = 0;
    for (std::size_t k = 0; k < s.size(); k++) v |= std::uint64_t(s[k]) << (8 * k);
    return v;
  }
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
  bool failed_ = false;
};

}  // namespace brickfall
