// The motion of a take in the form the replay page reads: small whole numbers, predicted from the frames before, in byte
// planes that zstd packs well. docs/decisions/0005-replay-data.md describes the bytes; apps/web/src/tracks.ts reads them.
#pragma once
#include "output/take_poses.h"
#include "record/byte_stream.h"

namespace brickfall {

constexpr double kReplayTurnStep = 4e-4;        // of tan(angle / 2) from frame to frame
constexpr double kReplayForceSteps = 12;        // per doubling of 1 N + force
constexpr std::size_t kReplayMostHits = 20000;  // the strongest are kept

// m per step: 0.1 mm, more only where bodies fly so far that 32 bits would not hold it.
double replayPositionStep(const TakePoses& poses);
// Packed. Empty only where zstd fails for want of memory.
Bytes replayTracks(const TakePoses& poses, double positionStep);

}  // namespace brickfall
