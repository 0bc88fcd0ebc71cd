// CRC-32 (IEEE 802.3, reflected 0xEDB88320, as zlib and PNG have it): tells a whole record from a torn or damaged one.
#pragma once
#include <cstdint>
#include <span>

namespace brickfall {

// Pass the result of one piece as `start` of the next to check pieces as if they were one.
std::uint32_t crc32(std::span<const std::uint8_t> bytes, std::uint32_t start = 0);

}  // namespace brickfall
