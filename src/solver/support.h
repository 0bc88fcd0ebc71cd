// Walks over the rows of an island: which bodies are supported from the ground by a chain of loaded rows, and how much
// of their common slide friction at the supports can stop.
#pragma once
#include <algorithm>

#include "solver/island.h"

namespace brickfall {

// Marks the bodies that a chain of rows that `counts(kind, k)` joins to bodies marked already. A row is asked only
// where its answer matters. In a wall rows lie from the ground up, so hardly any has to be kept for a second look.
template <class Counts> void growSupported(const Island& island, std::pmr::vector<char>& supported, Counts&& counts) {
  std::pmr::vector<RowEnds> open(island.memory);
  open.reserve(island.rows.size());
  island.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    const bool a = supported[ends.a], b = supported[ends.b];
    if ((a && b) || !counts(kind, k)) return;
    if (a || b)
      supported[ends.a] = supported[ends.b] = 1;
    else
      open.push_back(ends);
  });
  for (bool grew = !open.empty(), forwards = false; grew; forwards = !forwards) {
    grew = false;
    auto join = [&](RowEnds ends) {
      if (supported[ends.a] == supported[ends.b]) return;
      supported[ends.a] = supported[ends.b] = 1;
      grew = true;
    };
    if (forwards)
      for (std::size_t i = 0; i < open.size(); i++) join(open[i]);
    else
      for (std::size_t i = open.size(); i-- > 0;) join(open[i]);
  }
}

// Marks the bodies (and all partners) that a chain of rows that `counts(kind, k)` joins to a partner.
template <class Counts> void findSupported(const Island& island, std::pmr::vector<char>& supported, Counts&& counts) {
  std::size_t bodies = island.bodies.size();
  supported.assign(bodies + island.partners.size(), 0);
  std::fill(supported.begin() + std::ptrdiff_t(bodies), supported.end(), 1);
  growSupported(island, supported, counts);
}

// Common velocity (m/s) of the bodies `of` an island, less the share that friction at its supports can stop within the
// step. On smooth ground nothing along the ground is stopped.
template <class VelocityOf>
Vec3 slideLeft(const Island& island, const std::pmr::vector<char>& of, const StepContext& context,
               VelocityOf&& velocityOf) {
  const std::size_t count = island.bodies.size();
  Vec3 support, momentum;  // N, kg m/s
  double friction = 0, mass = 0;
  island.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    if (ends.a < count && ends.b < count) return;
    RowGrip grip = kind.grip(k, context);
    support += grip.force * (ends.a < count ? -1.0 : 1.0);
    friction += grip.friction;
  });
  for (std::size_t i = 0; i < count; i++) {
    if (!of[i]) continue;
    double m = context.bodies->mass[island.bodies[i]].mass;
    mass += m;
    momentum += velocityOf(island.bodies[i]) * m;
  }
  double most = length(support);
  if (!(most > 0)) return mass > 0 ? momentum * (1 / mass) : Vec3{};
  Vec3 normal = support * (1 / most), along = momentum - normal * dot(momentum, normal);
  double slides = length(along), stopped = friction * island.dt;
  return slides > stopped ? along * ((1 - stopped / slides) / mass) : Vec3{};
}

// The whole island slides, along ground that cannot stop it. However slow, the slide goes on: all that floats can tell
// from rest, of 1 m/s.
inline bool slides(const Island& island, const StepContext& context) {
  std::pmr::vector<char> all(island.bodies.size() + island.partners.size(), 1, island.memory);
  return length(slideLeft(island, all, context, [&](BodyIndex body) {
           return context.bodies->motion[body].linearVelocity;
         })) > kFloatsRound * island.facts.scale.speed;
}

}  // namespace brickfall
