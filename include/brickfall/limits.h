// What the engine takes and what it gives up, in one place. Three sets, which must not be taken for each other.
// What a call may say: anything else is an error value, in every build. What a scene file may say: less, since a number beyond it is
// sooner a slip of the pen than a wish. Beyond what a body counts as lost: no error, its forces took it there; it is quarantined.
#pragma once
#include <cstddef>
#include <cstdint>

namespace brickfall {

// What calls of the API take.
namespace limits {

constexpr double kLargestCoordinate = 1e6;  // m, along each axis: doubles then still tell 2e-10 m apart
constexpr double kLargestSize = 1e4;        // m: of shapes and of their place in a body; contacts are solved in float
constexpr double kSmallestSize = 1e-4;      // m
constexpr double kLargestSpeed = 1e5;       // m/s and rad/s, as set
constexpr double kLargestPush = 1e12;       // N, N m, N s, N m s a call; calls add up
constexpr double kLargestGravity = 1e4;     // m/s2
constexpr double kLargestGravityScale = 1000;  // times the world's, either way
constexpr double kLargestDamping = 1e6;        // 1/s
constexpr double kLargestDragArea = 1e6;       // m2
constexpr double kLargestAirDensity = 1e4;     // kg/m3
constexpr double kLargestDensity = 1e7;        // kg/m3, of a material
constexpr double kLargestFriction = 100;
constexpr double kLeastHardness = 1e3, kLargestHardness = 1e13;  // Pa, of a material
constexpr double kSmallestMass = 1e-15, kLargestMass = 1e15;     // kg, of a body that may move: sums in float hold it
constexpr double kShortestTimeStep = 1e-5, kLongestTimeStep = 0.1;  // s, of a call of step
constexpr double kLongestDelay = 1e6;                               // s, of sleepDelay
constexpr double kLargestReach = 1e7;      // m: of queries and of points where forces act: whatever is not lost
constexpr std::size_t kMostShapes = 4096;  // of a body
constexpr int kMostSubsteps = 64;
constexpr int kMostThreads = 64;
constexpr int kMostBodies = 16'000'000;  // of a world: WorldDef::maxBodies

}  // namespace limits

// What keys of a scene file take, where it is less than a call would.
namespace scene_limits {

constexpr double kLargestCoordinate = 1e5;  // m, as written; arrays and rotated walls reach on to limits::
constexpr double kLargestSpeed = 1e4;       // m/s and rad/s
constexpr double kSmallestSize = 1e-3;      // m
constexpr double kLargestSize = 1000;       // m
constexpr double kSmallestDensity = 0.01, kLargestDensity = 1e6;  // kg/m3
constexpr std::int64_t kMostBodies = 1'000'000;                   // also the bricks of one wall

}  // namespace scene_limits

// Where a body ends up only by absurd forces, as one does that became non-finite: it is quarantined in that step.
namespace lost {

constexpr double kDistance = 1e7;  // m from the origin, along any axis: ten times what calls take
constexpr double kSpeed =
    1e6;  // m/s; rad/s, or m/s of the surface for what is smaller than 1 m: ten times what calls take

}  // namespace lost

}  // namespace brickfall
