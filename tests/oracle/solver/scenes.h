// Scenes in which the engine's step is held against the converged one, beyond those of support/lab_scenes.h.
#pragma once
#include <functional>

#include "support/lab_scenes.h"
#include "support/random_geometry.h"

namespace brickfall::oracle {

// A world and what happens to it in every step.
struct Trial {
  World world;
  double dt = 1.0 / 60;
  std::function<void(World&)> push = {};  // forces for the next step
};

Trial fromLab(const std::string& name, const lab::Options& options = {});
Trial walls(int courses, int bricks, double gap, int seed, double dt = 1.0 / 60);
// Rows of `base`, base - 1, ... boxes.
Trial pyramid(int base);
// `voussoirs` hulls between two fixed abutments, over `degrees` of a circle, of mean radius 1 m; thickness as a share of
// it. An arch of 180 degrees needs 0.1075 to stand (Milankovitch 1907).
Trial arch(int voussoirs, double degrees, double thickness);
enum class Litter { boxes, hulls, spheres, capsules, mixed };
// Random bodies let fall into a pit, sizes 1 : 3, densities 1 : 4.
Trial pile(Litter kind, int count, std::uint64_t seed);
// A box on a slope, either the ground or gravity tilted.
Trial incline(double degrees, double friction, bool tiltGravity);
// A row of boxes on the ground, each pushed along it with `share` of what its friction can hold.
Trial pushed(double share, double friction);
// A column of ten boxes with one above or below that is `ratio` times as heavy.
Trial column(double ratio, bool heavyAbove);

}  // namespace brickfall::oracle
