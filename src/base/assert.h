// BRICKFALL_ASSERT(condition, text): a bug of ours. On when the build sets BRICKFALL_ASSERTS (the default; off for benches).
// Never for bad input, which gets an error value in every build.
#pragma once

#if BRICKFALL_ASSERTS
#include "brickfall/hooks.h"
#define BRICKFALL_ASSERT(condition, text)                                        \
  do {                                                                           \
    if (!(condition)) ::brickfall::fail({__FILE__, __LINE__, text, #condition}); \
  } while (false)
#else
#define BRICKFALL_ASSERT(condition, text) \
  do {                                    \
    (void)sizeof(condition);              \
  } while (false)
#endif
