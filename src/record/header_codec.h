// TakeHeader <-> bytes.
#pragma once
#include <span>
#include <vector>

#include "brickfall/result.h"
#include "brickfall/take.h"
#include "record/byte_stream.h"

namespace brickfall {

// What no take may hold: not finite, out of range. The message names the field.
Status checkHeader(const TakeHeader& header);
Bytes encodeHeader(const TakeHeader& header);

struct DecodedHeader {
  TakeHeader header;
  std::vector<TakeBody> bodies;  // version 1 lists them here: all are there from the first frame to the last
};
Result<DecodedHeader> decodeHeader(std::span<const std::uint8_t> bytes, std::uint32_t version);

}  // namespace brickfall
