// Takes made without the engine: a wall whose bricks are thrown about by a simple fake (flight, bounces, tumbling, rest).
// Their motion only has to look and compress like a real one.
#pragma once
#include "brickfall/take.h"

namespace brickfall::test {

struct SyntheticTake {
  TakeHeader header;
  std::vector<TakeBody> bodies;  // all that ever are there, by number
  std::vector<TakeLife> lives;   // of those; bodies beyond its end are always there
  std::vector<TakeFrame> frames;
  std::vector<TakeMortar> mortar;  // all from the first frame on; a joint goes with the first of its bodies

  // Who comes and goes with a frame.
  TakeChange change(std::size_t frame) const;
  std::size_t mortarEnd(std::size_t joint) const;  // the frame in which it is no longer there
};

struct SyntheticOptions {
  int courses = 10, bricksPerCourse = 10;
  int frames = 240;
  int hitFrame = 60;        // when the ball reaches the wall
  bool everResting = true;  // false: bricks bounce and tumble to the end, the worst case for compression
  bool otherShapes = true;  // also a capsule, a hull and a body of two shapes beside the wall
  bool breaking =
      false;  // "brick 0" breaks when the ball is there: three pieces come, of which "piece 1" goes 70 frames later
  bool mortared = false;  // each brick to the next; the third joint breaks at the hit
  std::uint64_t seed = 1;
};

// Bodies: "ground", "ball", "brick 0" ..., with the wall along x at z = 0 and the ball coming along -z.
SyntheticTake makeSyntheticTake(const SyntheticOptions& options);

// Written to `path` with finish(); the text of an error, or empty.
std::string writeTake(const SyntheticTake& take, const std::string& path,
                      const std::string& summary = "{\"scene\": \"synthetic\"}");

}  // namespace brickfall::test
