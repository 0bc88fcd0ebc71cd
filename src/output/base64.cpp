#include "output/base64.h"

namespace brickfall {

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t k = 0; k < bytes.size(); k += 3) {
    std::size_t here = bytes.size() - k;
    std::uint32_t bits = std::uint32_t(bytes[k]) << 16;
    if (here > 1) bits |= std::uint32_t(bytes[k + 1]) << 8;
    if (here > 2) bits |= bytes[k + 2];
    out += kDigits[bits >> 18];
    out += kDigits[bits >> 12 & 63];
    out += here > 1 ? kDigits[bits >> 6 & 63] : '=';
    out += here > 2 ? kDigits[bits & 63] : '=';
  }
  return out;
}

}  // namespace brickfall
