#include "output/glb_grain.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "record/crc32.h"

namespace brickfall {
namespace {

constexpr int kSide = 64;       // pixels
constexpr int kGreyMean = 238;  // sRGB of kGrainMean

void putBigEndian(Bytes& out, std::uint32_t v) {
  for (int k = 3; k >= 0; k--) out.push_back(std::uint8_t(v >> (8 * k)));
}

void addChunk(Bytes& out, std::string_view type, const Bytes& data) {
  putBigEndian(out, std::uint32_t(data.size()));
  const std::size_t start = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  putBigEndian(out, crc32({out.data() + start, out.size() - start}));
}

// Zlib's form without compression: the picture is smaller than what packs it would be.
Bytes stored(const Bytes& data) {
  Bytes out = {0x78, 0x01, 0x01};
  for (const std::size_t length : {data.size(), ~data.size()})
    for (int k = 0; k < 2; k++) out.push_back(std::uint8_t(length >> (8 * k)));
  out.insert(out.end(), data.begin(), data.end());
  std::uint32_t a = 1, b = 0;
  for (std::uint8_t byte : data) a = (a + byte) % 65521, b = (b + a) % 65521;
  putBigEndian(out, b << 16 | a);
  return out;
}

// -128 .. 127 at a corner of a grid, by whole numbers alone.
int noiseAt(int x, int y, int cells) {
  std::uint32_t h =
      std::uint32_t(x % cells) * 374761393u + std::uint32_t(y % cells) * 668265263u + std::uint32_t(cells);
  h = (h ^ (h >> 13)) * 1274126177u;
  return int((h ^ (h >> 16)) & 255) - 128;
}

// Between the corners of a grid of so many cells.
int smoothAt(int x, int y, int cells) {
  const int width = kSide / cells, i = x / width, j = y / width, s = x % width, t = y % width;
  const int top = noiseAt(i, j, cells) * (width - s) + noiseAt(i + 1, j, cells) * s;
  const int low = noiseAt(i, j + 1, cells) * (width - s) + noiseAt(i + 1, j + 1, cells) * s;
  return (top * (width - t) + low * t) / (width * width);
}

}  // namespace

Bytes grainPicture() {
  Bytes rows;
  for (int y = 0; y < kSide; y++) {
    rows.push_back(0);  // no filter
    for (int x = 0; x < kSide; x++) {
      const int grain = smoothAt(x, y, 8) / 9 + smoothAt(x, y, 16) / 9 + smoothAt(x, y, 64) / 16;
      rows.push_back(std::uint8_t(std::clamp(kGreyMean + grain, 0, 255)));
    }
  }
  Bytes head;
  putBigEndian(head, kSide);
  putBigEndian(head, kSide);
  head.insert(head.end(), {8, 0, 0, 0, 0});  // eight bits of grey
  Bytes out = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  addChunk(out, "IHDR", head);
  addChunk(out, "IDAT", stored(rows));
  addChunk(out, "IEND", {});
  return out;
}

}  // namespace brickfall
