// What a body's role is called in the outputs.
#pragma once
#include "brickfall/take.h"

namespace brickfall {

inline const char* roleName(TakeRole role) {
  switch (role) {
    case TakeRole::ground:
      return "ground";
    case TakeRole::brick:
      return "brick";
    case TakeRole::ball:
      return "ball";
    case TakeRole::body:
      break;
  }
  return "body";
}

}  // namespace brickfall
