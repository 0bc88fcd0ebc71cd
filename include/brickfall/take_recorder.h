// Records a running world into a take: a frame whenever one is due, with all that happened since the last. Bodies may be
// created and destroyed meanwhile: the take tells in which frames each of them was there.
#pragma once
#include <functional>
#include <memory>
#include <string>

#include "brickfall/scene.h"
#include "brickfall/take.h"

namespace brickfall {

// The file is "<path>.part" until it is finished: under its name a take is always whole, and an older one stays until then.
class TakeRecorder {
 public:
  // How a body is called and looks in the take; asked once, when it is first seen. Where `shapes` is left empty they are those
  // of the world.
  using Describe = std::function<TakeBody(BodyId)>;

  // Creates the file and writes the first frame: the world as it is. Without `describe` bodies are "body 0", "body 1" ...
  static Result<TakeRecorder> create(const std::string& path, const TakeHeader& header, const World& world,
                                     const Describe& describe = {});
  // Of a scene: bodies are called as there, frames come as it asks for them, but no more than one a step.
  static Result<TakeRecorder> create(const std::string& path, const SceneRun& run);
  TakeRecorder(TakeRecorder&&) noexcept;
  TakeRecorder& operator=(TakeRecorder&&) noexcept;
  ~TakeRecorder();

  // After every step, with its report.
  Status afterStep(const World& world, const StepReport& report, const Describe& describe = {});
  Status afterStep(const SceneRun& run, const StepReport& report);
  Status finish(const std::string& summaryJson);
  // Where the recording is now.
  const std::string& file() const;

 private:
  struct Impl;
  explicit TakeRecorder(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace brickfall
