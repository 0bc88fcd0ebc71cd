// Names of contact points. A point is a corner of one shape on a face of the other, or the crossing of two edges; its
// name says which, and nothing else: not which face was the reference, nor in which order the polygon was cut. So a
// name survives when the reference face changes from one shape to the other, or when a face contact becomes an edge
// contact, and the solver keeps the force of the point.
#pragma once
#include <cstdint>

namespace brickfall {

inline std::uint32_t cornerOfA(int corner) { return 0x10000000u | std::uint32_t(corner); }
inline std::uint32_t cornerOfB(int corner) { return 0x20000000u | std::uint32_t(corner); }
inline std::uint32_t edgeCrossing(int edgeA, int edgeB) {
  return 0x30000000u | std::uint32_t(edgeA) << 12 | std::uint32_t(edgeB);
}
// Round shapes have one point, or a numbered few.
inline std::uint32_t roundPoint(int number) { return 0x40000000u | std::uint32_t(number); }

// Boxes: corner = a bit per axis, set on the positive side; edge = 4 * its direction + a bit for each of the next two
// axes.
inline int boxEdge(int direction, bool nextPositive, bool afterNextPositive) {
  return 4 * direction + (nextPositive ? 1 : 0) + (afterNextPositive ? 2 : 0);
}

}  // namespace brickfall
