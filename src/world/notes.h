// Notes for the program's log (brickfall/notes.h): made only while somebody listens.
#pragma once
#include "brickfall/step_report.h"
#include "dynamics/ties.h"
#include "world/registry.h"

namespace brickfall {

void noteStep(const StepReport& report);
// Before the body is destroyed.
void noteTiesOf(BodyIndex body, const Registry& registry, const Ties& ties, std::uint64_t stepIndex);

}  // namespace brickfall
