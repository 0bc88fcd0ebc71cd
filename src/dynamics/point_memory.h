// What the points of a contact remember from step to step: up to four points, one lane each, field by field, so that a
// point's arithmetic is one vector operation for all four.
//
// Whoever reads or writes all of it (snapshot, hashes, checks) goes through eachField(), which does not compile when a field
// is missing; whoever ends, scales or hands on the memory of a point calls a function of this page. So a field more is a
// matter of this file.
#pragma once
#include <cstdint>
#include <initializer_list>

namespace brickfall {

// Where a point stands in its life.
enum class PointPhase : std::uint32_t {
  fresh,   // remembers nothing: it gets its stiffness and its plastic offset in the coming step
  impact,  // born in an impact, soft until the surfaces close no longer
  resting  // at the full stiffness of its island
};

struct PointMemory {
  PointPhase phase[4] = {};
  std::uint32_t feature[4] = {};         // of the manifold
  float s1[4] = {}, s2[4] = {};          // m, place in the tangent plane, about the manifold's centre
  float gap[4] = {};                     // m, geometric normal gap; negative = overlap
  float offset[4] = {};                  // m, <= 0: overlap that causes no force (plastic)
  float drift1[4] = {}, drift2[4] = {};  // m, tangential way since the anchor was placed
  float stiffness[4] = {};               // N/m, normal and tangential; 0 in a fresh point
  float multiplierN[4] = {}, multiplier1[4] = {}, multiplier2[4] = {};  // N, multiplier of the augmented Lagrangian
  float forceN[4] = {}, force1[4] = {}, force2[4] = {};                 // N, applied in the last step
  float slip1[4] = {}, slip2[4] = {};  // m, where to place the anchor of a point that slid or rolls
  float impulse[4] = {};               // N s, taken so far by an impact that will rebound and is not over
  float impactSpeed[4] = {};           // m/s, of approach when it began
  float hitN[4] = {}, hit1[4] = {},
        hit2[4] = {};              // N, mean over the last step of what its force leaves out: impacts that were
                                   // over within it, rebounds, other parts of the step
  std::uint32_t metMask = 0;       // bit per point: hit in the last step, and not parted by it
  std::uint32_t impactMask = 0;    // bit per point: its force in the last step was an impact's
  std::uint32_t stickingMask = 0;  // bit per point: held by its anchor

  bool sticks(int i) const { return stickingMask >> i & 1; }
};

// What a field of floats is a measure of, for checks of its range.
enum class PointQuantity : std::uint8_t { length, overlap, force, pressure, stiffness };

// Calls visit(lanes, quantity) for each field of floats, visit(phases), visit(features) and visit(stickingMask), in a fixed
// order. `Memory`: PointMemory, const or not.
template <class Memory, class Visitor> void eachField(Memory& m, Visitor&& visit) {
  // As many names as there are fields: one more in PointMemory does not compile until it is visited here.
  auto& [phase, feature, s1, s2, gap, offset, drift1, drift2, stiffness, multiplierN, multiplier1, multiplier2, forceN,
         force1, force2, slip1, slip2, impulse, impactSpeed, hitN, hit1, hit2, metMask, impactMask, stickingMask] = m;
  visit(metMask);
  visit(impactMask);
  visit(stickingMask);
  for (auto* lanes : {&s1, &s2, &gap}) visit(*lanes, PointQuantity::length);
  visit(offset, PointQuantity::overlap);
  for (auto* lanes : {&drift1, &drift2}) visit(*lanes, PointQuantity::length);
  visit(stiffness, PointQuantity::stiffness);
  visit(multiplierN, PointQuantity::pressure);
  for (auto* lanes : {&multiplier1, &multiplier2}) visit(*lanes, PointQuantity::force);
  visit(forceN, PointQuantity::pressure);
  for (auto* lanes : {&force1, &force2}) visit(*lanes, PointQuantity::force);
  for (auto* lanes : {&slip1, &slip2}) visit(*lanes, PointQuantity::length);
  for (auto* lanes : {&impulse, &impactSpeed}) visit(*lanes, PointQuantity::pressure);
  for (auto* lanes : {&hitN, &hit1, &hit2}) visit(*lanes, PointQuantity::force);
  visit(feature);
  visit(phase);
}

// Limits of what is sound: beyond anything that bodies within theirs can cause, and far enough from the largest float for the
// sums and products of a step.
//! not of the method: what a snapshot may say
constexpr float kLargestPointLength = 1e7f;     // m
constexpr float kLargestPointForce = 1e28f;     // N, N/m
constexpr float kLeastPointStiffness = 1e-20f;  // N/m, but for 0

// Every field within its range, and phases that agree with it. What comes from a file is not trusted, what a step leaves is
// held to the same.
bool isSound(const PointMemory& m);

// The point knows nothing any more: its surfaces parted in a rebound, or its island was salvaged. Its place stays.
void clearPoint(PointMemory& m, int i);

// The point got an impulse over and above its force, as a mean force over the step; and forgets it.
void addHit(PointMemory& m, int i, float n, float t1, float t2);
void endHit(PointMemory& m, int i);

// Its last force and its multiplier become `share` of what they were.
void scaleForces(PointMemory& m, int i, float share);

// Tangents of another manifold seen from those of this one: what lay along the old pair lies along the new one.
struct TangentTurn {
  float m[4] = {1, 0, 0, 1};  // new = [m0 m1; m2 m3] old
};

// Point i of `to` goes on with what point j of `from` remembers: all but its place, gap, drift and feature, which belong to
// the manifold.
void carryOver(PointMemory& to, int i, const PointMemory& from, int j, const TangentTurn& turn);

}  // namespace brickfall
