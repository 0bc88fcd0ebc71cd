// Whether a part of a step, as it would end, opens a joint. What can't be solved in one part may be in shorter ones.
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/island.h"

namespace brickfall {

// m, by how much an island's joints are open now, in the order of its rows; appended. Of what is settled: zeros.
void tellOpenings(const Island& island, const StepContext& context, std::pmr::vector<double>& out);

// `before`: those of its joints when the part began, which goes on to those of the next island. Its impacts have moved
// bodies since.
bool opensJoints(const Island& island, const StepContext& context, const double*& before);

}  // namespace brickfall
