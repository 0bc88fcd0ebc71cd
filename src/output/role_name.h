// What a body's role is called in the outputs.
#pragma once
#include "brickfall/scenery.h"

namespace brickfall {

inline const char* roleName(BodyRole role) {
  switch (role) {
    case BodyRole::ground:
      return "ground";
    case BodyRole::brick:
      return "brick";
    case BodyRole::ball:
      return "ball";
    case BodyRole::body:
      break;
  }
  return "body";
}

}  // namespace brickfall
