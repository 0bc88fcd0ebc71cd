// The tool in the user's hand: turns presses and moves of the mouse, as rays, into commands.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "viewer_core/camera_rig.h"
#include "viewer_core/commands.h"
#include "viewer_core/picking.h"

namespace brickfall::viewer {

enum class Tool : std::uint8_t { select, shoot, drag, remove, blast, cut };
constexpr int kToolCount = 6;
const char* nameOf(Tool tool);  // "Select", "Shoot" ...

struct ToolSettings {
  double ballRadius = 0.1;  // m, kLeastBall .. kLargestBall
  double ballSpeed = 10;    // m/s, 0 .. kFastestBall
  std::string ballMaterial = "steel";
  double dragStrength = 20;    // weights of the body, 1 .. 1000
  double blastImpulse = 5000;  // N s, 1 .. 1e6
  double blastRadius = 5;      // m, 0.1 .. 100
};
constexpr double kLeastBall = 0.01, kLargestBall = 2, kFastestBall = 200;
// Rounded to what a slider shows, and within the limits.
void growBall(ToolSettings& settings, double factor);
void hastenBall(ToolSettings& settings, double factor);

// From presses to commands. Where a tool needs a body, it is what `picked` says.
class Hand {
 public:
  Tool tool = Tool::shoot;
  ToolSettings settings;

  // `ray` through the mouse. Remembers how far away the body was grabbed: it is dragged in the plane across the view through
  // that point.
  std::vector<Command> press(const Ray& ray, const View& view, const std::optional<PickHit>& picked);
  std::vector<Command> move(const Ray& ray, const View& view);
  std::vector<Command> release();
  // While dragging: further away (> 0) or nearer by the wheel.
  std::vector<Command> wheel(double notches, const Ray& ray, const View& view);
  bool dragging() const { return dragging_; }
  // The frame no longer has the drag (the body went, the run was rewound).
  void letGo() { dragging_ = false; }

  // A ball as the tool is set, along the ray. It starts a little in front of the eye, so that it is seen.
  Command shot(const Ray& ray) const;
  // The ground's right side, as seen, goes up (side 1) or down (-1) by a step.
  Command tilt(const View& view, double side) const;
  // A jerk across the view, to one side and the other in turn.
  Command jerk(const View& view);

 private:
  Vec3 targetOf(const Ray& ray, const View& view) const;
  bool dragging_ = false;
  double depth_ = 0;  // m, along the view's forward
  double side_ = 1;   // of the next jerk
};

}  // namespace brickfall::viewer
