// Where the bodies of a take are at any moment, also between its frames.
#pragma once
#include <list>
#include <optional>
#include <vector>

#include "brickfall/take.h"

namespace brickfall::render {

// By number of body. One that is not there at the moment is not drawn.
struct Instant {
  std::vector<Transform> poses;
  std::vector<bool> there;
};

class Motion {
 public:
  explicit Motion(const TakeReader& take) : take_(&take) {}
  // s: of a frame, one that can be read
  Result<double> timeOf(std::size_t frame);
  // Before the first and after the last frame as in these. An error only where the take is damaged there.
  Result<Instant> at(double time);
  // What a picture needs: at its shutter's opening and closing. Who is there is told by the first; the second has the same.
  struct Shutter {
    Instant open, close;
  };
  Result<Shutter> between(double open, double close);

 private:
  struct Known {
    std::size_t frame = 0;
    TakeFrame poses;
    std::vector<std::uint32_t> bodies;
  };
  // Stays where it is until kKeptFrames others were asked for.
  Result<const Known*> frame(std::size_t index);
  Result<std::size_t> frameBefore(double time);
  const TakeReader* take_;
  std::list<Known> known_;       // the last few that were asked for, the latest at the end
  std::optional<double> start_;  // s, of the first frame
};

}  // namespace brickfall::render
