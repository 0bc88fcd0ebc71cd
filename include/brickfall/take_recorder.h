// Records a running scene into a take: a frame whenever one is due, with all that happened since the last.
#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "brickfall/scene.h"
#include "brickfall/take.h"

namespace brickfall {

class AsideFile;

// The file is "<path>.part" until it is finished: under its name a take is always whole, and an older one stays until then.
class TakeRecorder {
 public:
  // Creates the file and writes the first frame: the scene before its first step.
  static Result<TakeRecorder> create(const std::string& path, const SceneRun& run);
  TakeRecorder(TakeRecorder&&) noexcept;
  ~TakeRecorder();
  Status afterStep(const SceneRun& run, const StepReport& report);
  Status finish(const std::string& summaryJson);
  // Where the recording is now.
  const std::string& file() const;

 private:
  TakeRecorder(std::unique_ptr<AsideFile> aside, TakeWriter writer, const SceneRun& run, double framesPerSecond);
  void collectEvents(const SceneRun& run, const StepReport& report);
  Status writeFrame(const SceneRun& run);
  // Position in TakeHeader::bodies, -1 for a body that is not of the scene.
  int placeOf(BodyId id) const { return id.index < placeByIndex_.size() ? placeByIndex_[id.index] : -1; }

  std::unique_ptr<AsideFile> aside_;
  TakeWriter writer_;
  double framesPerSecond_;
  double nextFrame_ = 1;           // number of the frame that is due next
  std::vector<int> placeByIndex_;  // by BodyId::index
  std::vector<std::size_t> held_;  // places of bodies not yet launched
  std::vector<TakeEvent> events_;  // since the last frame
};

}  // namespace brickfall
