// What scenes and takes both speak of: the part that a body plays, and from where it is looked at.
#pragma once
#include <cstdint>
#include <string>

#include "brickfall/math.h"

namespace brickfall {

enum class BodyRole : std::uint8_t { ground, brick, ball, body };
constexpr int kBodyRoleCount = 4;

struct Camera {
  std::string name = "main";
  Vec3 position{3, 2, 5}, target{0, 0.5, 0};  // m
  double fieldOfViewDegrees = 45;             // vertical
};

}  // namespace brickfall
