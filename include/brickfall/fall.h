// Which mortar joint is to blame for a fall: from which joints there were, when each broke, and which way it held.
// World::whyFell asks this of a world. Who shows a recording asks it of what the recording knows.
#pragma once
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace brickfall {

// Bodies are numbers below the count that FallFinder gets.
struct FallJoint {
  std::uint32_t bodyA = 0, bodyB = 0;
  double breakTime = std::numeric_limits<double>::infinity();  // s; infinite: it holds
  double lift = 0;  // N: of the force on B before it opened, what pointed up. Above 0: A held B up; below: B held A up
};

class FallFinder {
 public:
  // `moves[body]`: false for what is fixed or kinematic. The joints must outlive this.
  FallFinder(std::span<const FallJoint> joints, const std::vector<bool>& moves);

  // Number of the joint that gave way first, none where none did. Of the joints between the body's chunk (what hangs
  // together with it through mortar) and others, those count that held the chunk up, or all if none did. From the first
  // of them the way goes on down: to the first joint that held up the body under it and had broken before.
  std::optional<std::uint32_t> first(std::uint32_t body) const;

 private:
  bool isEarlier(std::uint32_t a, std::uint32_t b) const;
  bool holdsUp(std::uint32_t joint, std::uint32_t body) const;

  std::span<const FallJoint> joints_;
  std::vector<bool> moves_;
  std::vector<std::uint32_t> chunk_;                // by body: another of its chunk, or itself
  std::vector<std::uint32_t> firstOf_, firstHeld_;  // by chunk: first joint that broke; that held it up
  std::vector<std::uint32_t> start_, broken_;       // joints that broke, by body
};

}  // namespace brickfall
