// TakeHeader <-> bytes.
#pragma once
#include <span>

#include "brickfall/result.h"
#include "brickfall/take.h"
#include "record/byte_stream.h"

namespace brickfall {

// What no take may hold: not finite, out of range. The message names the field.
Status checkHeader(const TakeHeader& header);
Bytes encodeHeader(const TakeHeader& header);
Result<TakeHeader> decodeHeader(std::span<const std::uint8_t> bytes);

}  // namespace brickfall
