// Counts what the program takes from operator new. The counting replacements are linked into this executable alone.
#pragma once
#include <cstdint>

namespace brickfall::test {

// Of all threads, since the program began.
std::uint64_t allocations();

}  // namespace brickfall::test
