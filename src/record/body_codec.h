// What a take says of a body, and of who comes and goes with a frame, <-> bytes.
#pragma once
#include <cstdint>
#include <span>
#include <string>

#include "brickfall/result.h"
#include "brickfall/take.h"
#include "record/byte_stream.h"

namespace brickfall {

constexpr double kMostTakeSize = 1e9;  // m, of shapes and of where they and cameras are
// The least bytes a body takes, so that a count can be checked before room is made for it.
constexpr std::size_t kLeastBodyBytes = 1 + 1 + 3 + 8 + 1;
// Of the take format: from here on it has names of materials and paths of cameras.
constexpr std::uint32_t kVersion3 = 3;
// From here on it has mortar.
constexpr std::uint32_t kVersion4 = 4;
// From here on it has the numbers that looks go by.
constexpr std::uint32_t kVersion5 = 5;
// From here on cameras say whom they turn after.
constexpr std::uint32_t kVersion6 = 6;
// From here on shapes have colours of their own.
constexpr std::uint32_t kVersion7 = 7;
constexpr std::size_t kLeastMortarBytes = 2 + 9 * 4;

bool withinTakeSize(Vec3 v);
void put(ByteWriter& out, Vec3 v);
Vec3 getVec3(ByteReader& in);

std::string bodyFault(const TakeBody& body);                            // empty: fine
std::string mortarFault(const TakeMortar& mortar, std::size_t bodies);  // `bodies`: how many ever were there
void put(ByteWriter& out, const TakeBody& body);
// `sound` becomes false where a count cannot be true.
TakeBody getBody(ByteReader& in, std::uint32_t version, bool& sound);

// The content of a record LIFE. What is decoded is sound in itself; whether the numbers fit is for the reader to see.
Bytes encodeChange(const TakeChange& change);
Result<TakeChange> decodeChange(std::span<const std::uint8_t> bytes, std::uint32_t version);

}  // namespace brickfall
