// Dust where bodies hit each other: a few puffs each, that rise, spread and fade. Where and how much; dust.h draws it.
#pragma once
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "appearance/colour.h"
#include "viewer_core/frame.h"

namespace brickfall::viewer {

class DustCloud {
 public:
  struct Puff {
    double born = 0;  // s, simulated
    Vec3 place, drift;
    appearance::Rgb colour;  // of what broke, paler than the whole
    float radius = 0.05f, strength = 1;
  };
  static constexpr std::size_t kMostPuffs = 400;
  static constexpr double kLife = 1.6;        // s, simulated
  static constexpr double kLeastSpeed = 0.8;  // m/s at which two met: what is slower raises none
  static constexpr double kLeastRest = 0.15;  // s between two puffs of a body that goes on being hit

  // Looks for the hits since the last frame that it was given, however long that is ago; going back takes puffs away again.
  void update(const Frame& frame);
  void clear();
  std::span<const Puff> puffs() const { return puffs_; }

 private:
  void findHits(const Frame& frame);
  void puff(const Frame& frame, std::size_t body, double born, std::uint32_t salt);

  std::vector<Puff> puffs_;
  std::unordered_map<Serial, double> lastOf_;  // s: when a body's last was born
  std::shared_ptr<const RunInfo> run_;
  double lastTime_ = 0;
};

}  // namespace brickfall::viewer
