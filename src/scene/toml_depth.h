// How deeply the tables of a TOML text may nest, told before it is parsed.
#pragma once
#include <string_view>

namespace brickfall::scene {

constexpr int kMaxDottedKeys = 200;

// The line of the first statement whose dotted keys ("a.b.c") hold more than kMaxDottedKeys dots, or 0. The parser
// limits the nesting of values but not that of dotted keys, and a tree of a million levels would exhaust the stack.
int lineOfTooManyDots(std::string_view text);

}  // namespace brickfall::scene
