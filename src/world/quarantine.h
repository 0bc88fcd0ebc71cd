// Bodies with an impossible motion: not finite, absurdly fast, or lost in space. They stay where they last were,
// without velocity, and are taken out of all contacts and lists, so that the motion never spreads.
#pragma once
#include <vector>

#include "world/upkeep.h"

namespace brickfall {

class Quarantine {
 public:
  Quarantine(Registry& registry, StepReport& report, Upkeep upkeep)
      : registry_(registry), report_(report), upkeep_(upkeep) {}

  void hold(BodyIndex body);  // at once; the lists are being walked, so it stays in them ...
  void isolateHeld();         // ... until this

 private:
  Registry& registry_;
  StepReport& report_;
  Upkeep upkeep_;
  std::vector<BodyIndex> caught_;
};

// A body that its forces or impulses would make absurdly fast is taken out before it can spoil the sums of its island.
void quarantineAbsurd(const Registry& registry, const Activity& activity, double dt, Quarantine quarantine);

}  // namespace brickfall
