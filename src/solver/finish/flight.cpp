#include "solver/finish/flight.h"

#include <utility>

namespace brickfall {

namespace {

// Marks the bodies from which a chain of ties leads to something fixed.
void findSupported(const Island& island, const StepContext& context, float reach, std::pmr::vector<char>& supported) {
  std::size_t bodies = island.bodies.size();
  supported.assign(bodies + island.partners.size(), 0);
  std::fill(supported.begin() + std::ptrdiff_t(bodies), supported.end(), 1);
  std::pmr::vector<std::pair<std::uint32_t, std::uint32_t>> links(island.memory);
  links.reserve(island.rows.size());
  island.rows.each([&](const auto& kind, std::size_t k) {
    RowEnds ends = kind.ends(k);
    if (kind.holds(k, reach, island.motion.data(), context)) links.push_back({ends.a, ends.b});
  });
  for (bool grew = true, forwards = true; grew; forwards = !forwards) {
    grew = false;
    auto join = [&](std::pair<std::uint32_t, std::uint32_t> l) {
      if (supported[l.first] == supported[l.second]) return;
      supported[l.first] = supported[l.second] = 1;
      grew = true;
    };
    if (forwards)
      for (std::size_t i = 0; i < links.size(); i++) join(links[i]);
    else
      for (std::size_t i = links.size(); i-- > 0;) join(links[i]);
  }
}

}  // namespace

void correctFlight(Island& island, StepContext& context) {
  if (island.resting()) {
    for (BodyIndex body : island.bodies) context.solved[body].flying = false;
    return;
  }
  Vec3 correction = context.gravity * (-0.5 * context.dt * context.dt);
  std::pmr::vector<char> supported(island.memory), near(island.memory);
  findSupported(island, context, 0, supported);
  findSupported(island, context, float(length(correction)), near);
  for (std::size_t i = 0; i < island.bodies.size(); i++) {
    SolvedMotion& s = context.solved[island.bodies[i]];
    s.flying = !supported[i];
    if (!near[i]) s.d += correction * context.bodies->data[island.bodies[i]].gravityScale;
  }
}

}  // namespace brickfall
