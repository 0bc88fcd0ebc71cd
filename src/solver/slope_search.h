// How far to go along a step that is too long: to about the zero of the slope, bracketed, by secants (Illinois rule,
// every third time halving).
#pragma once
#include <algorithm>
#include <cmath>

namespace brickfall {

//! - | too small: searches and new matrices that change little
//! | too large: steps end beyond their minimum; walls lean; what overlaps by a micrometre is thrown by millimetres
constexpr float kNearMinimum = 0.3f;  // of the slope at the start, of a weight, of what a body may be left with, of the
                                      // residual of a system: a step that ends with less fits
//! - | too small: searches that change little; bodies are polished while all around them still moves: cost
//! | too large: steps end short of their minimum; more cycles
constexpr float kFarFromMinimum = 0.5f;  // of the slope or residual at the start: a search, or a body's exact steps in
                                         // a large island, go on above it

//! - | too small: a block just past its balance can hang (seen with 8)
//! | too large: cost where float rounding hides the minimum
constexpr int kSearchSteps = 16;  // evaluations along a step: sticking is a very narrow range of motion to find
//! - | too small: a corbel of nineteen just past its balance stands (seen with 16)
//! | too large: a grain under 1e19 times its mass is thrown (seen with 24); a ragdoll's falls gain more
constexpr int kSearchStepsOfAll = 20;  // along a step of all bodies at once

// `way`: moveTo(part) goes to a part of the step and returns the downward slope there; start() is the slope at 0; a
// slope between lowest() and highest() is near enough. `slope`: the slope at 1, where the way is now.
template <class Way> void searchAlong(Way& way, float slope) {
  float low = 0, slopeLow = way.start(), high = 1, slopeHigh = slope;
  for (int k = 0; k < kSearchSteps; k++) {
    float fall = slopeLow - slopeHigh, width = high - low;
    if (!(fall > 0)) return;  // both have underflowed: forces that a float can hardly express are balanced
    float next = k % 3 == 2 ? 0.5f * (low + high) : low + width * slopeLow / fall;
    if (k >= 1) next = std::min(std::max(next, low + 0.05f * width), high - 0.05f * width);
    slope = way.moveTo(next);
    if (slope >= way.lowest() && slope <= way.highest()) return;
    // Otherwise one end of the bracket might never move.
    if (slope > 0) {
      low = next;
      slopeLow = slope;
      slopeHigh *= 0.5f;
    } else {
      high = next;
      slopeHigh = slope;
      slopeLow *= 0.5f;
    }
  }
}

// The same along a step of many bodies, in doubles, until the slope is `share` of that at the start. While the slope
// says so, the step is doubled first, so many times at most.
template <class MoveTo> void searchAlong(double start, double share, int doublings, int steps, MoveTo moveTo) {
  const double enough = share * start;
  double low = 0, slopeLow = start, high = 1, slopeHigh = moveTo(1), slope = slopeHigh;
  for (int k = 0; slope > enough && k < doublings; k++) {
    low = high;
    slopeLow = slope;
    high *= 2;
    slope = slopeHigh = moveTo(high);
  }
  for (int k = 0; k < steps && std::fabs(slope) > enough && slopeHigh < 0; k++) {
    const double next = k % 3 == 2 ? 0.5 * (low + high) : low + (high - low) * slopeLow / (slopeLow - slopeHigh);
    slope = moveTo(next);
    (slope > 0 ? low : high) = next;
    (slope > 0 ? slopeLow : slopeHigh) = slope;
    (slope > 0 ? slopeHigh : slopeLow) *= 0.5;
  }
}

// The same where the slope has kinks, as where limits and ropes are reached. By turns a secant, and the line through
// the last two points on one side of the zero: of a slope that is straight on that side, it leads there.
template <class MoveTo> void searchOverKinks(double start, double share, int doublings, int steps, MoveTo moveTo) {
  struct Point {
    double at, slope;
  };
  const double enough = share * start;
  Point low{0, start}, high{1, moveTo(1)}, beforeLow = low;
  for (int k = 0; high.slope > enough && k < doublings; k++) {
    beforeLow = low;
    low = high;
    high.at *= 2;
    high.slope = moveTo(high.at);
  }
  if (!(high.slope < 0)) return;
  Point beforeHigh = high;
  auto zeroOf = [](Point a, Point b) { return a.at + (b.at - a.at) * a.slope / (a.slope - b.slope); };
  auto inside = [&](double at) { return at > low.at && at < high.at; };
  double slope = high.slope;
  for (int k = 0; k < steps && std::fabs(slope) > enough; k++) {
    double next = zeroOf(low, high);
    if (k % 2 > 0) {
      const double fromHigh = beforeHigh.at > high.at ? zeroOf(high, beforeHigh) : high.at;
      const double fromLow = beforeLow.at < low.at ? zeroOf(beforeLow, low) : low.at;
      next = inside(fromHigh) ? fromHigh : inside(fromLow) ? fromLow : 0.5 * (low.at + high.at);
    }
    slope = moveTo(next);
    (slope > 0 ? beforeLow : beforeHigh) = slope > 0 ? low : high;
    (slope > 0 ? low : high) = {next, slope};
  }
}

}  // namespace brickfall
