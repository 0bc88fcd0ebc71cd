// One Newton step of a rigid cluster on the rows of its boundary.
#pragma once
#include "solver/island.h"
#include "solver/symmetric6.h"

namespace brickfall {

// Forces at the present motion of one cluster's boundary and inertia of its bodies: residual about the cluster's centre.
// With `matrix`, also its Newton matrix. Returns true if a boundary point slides or yields.
bool clusterResidual(const Island& island, const Level& level, const Cluster& cluster, Wrench& residual,
                     Symmetric6* matrix, double& visits);
// One Newton step of a cluster, moving it rigidly; with a line search where friction slides.
void clusterStep(Island& island, const Level& level, const Cluster& cluster, double& visits);

}  // namespace brickfall
