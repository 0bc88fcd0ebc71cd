// Which frames a body's animation must keep so that what is drawn between them stays within a tolerance.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "brickfall/math.h"

namespace brickfall {

constexpr double kGlbPositionTolerance = 1e-4;                        // m
constexpr double kGlbAngleTolerance = 0.05 * 3.14159265358979 / 180;  // rad

// Frames in order, the first and the last among them; one alone if nothing moves. times are increasing.
std::vector<std::uint32_t> keysOfPositions(std::span<const Transform> poses, std::span<const double> times);
std::vector<std::uint32_t> keysOfRotations(std::span<const Transform> poses, std::span<const double> times);

// As the standard has it: along the shorter arc at even speed.
Quat slerp(Quat a, Quat b, double share);
// As Blender and some engines have it: component by component, made a unit again. The keys serve both.
Quat blend(Quat a, Quat b, double share);
double angleBetween(Quat a, Quat b);

}  // namespace brickfall
