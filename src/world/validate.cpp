// Every invariant of every owner, for tests and for finding our bugs. A restored snapshot must fulfil them, whoever
// made it: the step follows these links without looking.
#include <cmath>

#include "brickfall/limits.h"
#include "world/world_impl.h"

namespace brickfall {

void World::Impl::checkStructure(Findings& f) const {
  const BodySet& bodies = registry.bodies;
  registry.checkStructure(f);
  if (!f.any()) proximity.checkStructure(f, registry);
  if (!f.any()) ties.checkStructure(f, bodies, registry.shapes);
  if (!f.any()) activity.checkStructure(f, bodies, ties);
  if (!f.any()) diary.checkStructure(f, registry);
}

void World::Impl::checkLinks(Findings& f) const {
  registry.check(f);
  ties.check(f, registry.bodies, registry.shapes);
  activity.check(f, registry.bodies, ties);
  diary.check(f, registry);
  auto isStep = [](double dt) { return dt >= 0 && dt <= limits::kLongestTimeStep; };
  f.expect(clock.time >= 0 && std::isfinite(clock.time) && isStep(clock.lastDt) && isStep(clock.stiffnessDt) &&
               isStep(clock.rings) && clock.steadySteps >= 0,
           "time: out of range");
}

std::vector<std::string> World::validate() const {
  Findings f;
  impl_->checkStructure(f);
  if (f.any()) return f.take();
  impl_->checkLinks(f);
  impl_->proximity.checkBounds(f, impl_->registry);
  return f.take();
}

}  // namespace brickfall
