// A take played: frames as they were recorded, at any place and speed. Each is shown for as long as it lasted: a run whose time step
// was changed has frames that lie further apart than its header says, or nearer.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "brickfall/take.h"
#include "viewer_core/event_log.h"
#include "viewer_core/frame.h"

namespace brickfall::viewer {

class TakePlayer {
 public:
  // At its first frame. `path` is where it came from.
  static Result<std::unique_ptr<TakePlayer>> start(TakeReader take, const std::string& path, Serial& nextSerial);

  const std::shared_ptr<const RunInfo>& info() const { return info_; }
  double dt() const;  // s, to the next frame
  std::size_t frame() const { return at_; }
  std::size_t last() const { return take_.frameCount() - 1; }
  double time() const { return now_.time; }  // s
  double firstTime() const { return firstTime_; }
  double lastTime() const { return lastTime_; }
  bool atEnd() const { return at_ == last(); }

  // Goes on by frames, at most to the end (back, at most to the beginning). What happened on the way forward goes to the log.
  Status step(int frames, EventLog* log);
  Status seek(double time);

  void fill(Frame& frame, const FrameNeeds& needs, Serial selected);
  // The next frame is not reached by moving there.
  void jump() { before_.clear(); }

 private:
  TakePlayer(TakeReader take, std::string path, Serial firstSerial);
  Status go(std::size_t frame);
  Status jumpTo(std::size_t frame);
  Result<std::size_t> frameAt(double time) const;
  void list();
  void hear(EventLog* log);
  Aabb extent() const;
  void readMortar();
  void fillMortar(Frame& frame) const;
  std::vector<std::string> mortarOf(std::uint32_t body, const TakePose& pose) const;

  TakeReader take_;
  Serial firstSerial_;  // of body 0
  std::shared_ptr<const RunInfo> info_;
  std::size_t at_ = 0;
  TakeFrame now_, next_;                // next_: the one after it, read ahead for its time
  std::vector<std::uint32_t> numbers_;  // of the bodies that are there
  std::shared_ptr<const BodyList> list_;
  std::vector<std::uint32_t> beforeNumbers_;
  std::vector<Transform> before_;  // where they were in the frame made before
  TakeFrame previous_;             // the frame before this one in the take, for velocities
  std::vector<std::uint32_t> previousNumbers_;
  struct Hit {
    double time = -1e9;  // s
    float speed = 0;     // m/s
  };
  std::vector<Hit> lastHit_;  // by number
  // Of all the take, where it has mortar.
  std::vector<TakeBreak> breaks_;
  std::vector<std::size_t> fallOf_;  // by body: which of the breaks gave way first; breaks_.size(): none
  std::vector<Vec3> firstPlace_;     // m, by body: where it came
  double firstTime_ = 0, lastTime_ = 0;
};

}  // namespace brickfall::viewer
