// libFuzzer: any bytes as a take, and, since checksums keep most of them out there, as the inside of its records.
#include <cstddef>
#include <cstdint>

#include "brickfall/take.h"
#include "record/frame_codec.h"
#include "record/header_codec.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace brickfall;
  if (size == 0) return 0;
  std::span<const std::uint8_t> bytes(data + 1, size - 1);
  if (data[0] % 3 == 0) {
    Result<TakeReader> reader = TakeReader::openBytes({bytes.begin(), bytes.end()});
    for (std::size_t f = 0; reader && f < reader->frameCount(); f++) (void)reader->frame(f).ok();
  } else if (data[0] % 3 == 1) {
    (void)decodeHeader(bytes).ok();
  } else {
    FrameCodec codec(data[0] / 3);
    std::size_t half = bytes.size() / 2;
    if (codec.decode(bytes.first(half), true)) (void)codec.decode(bytes.subspan(half), false).ok();
  }
  return 0;
}
