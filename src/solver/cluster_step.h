// One Newton step of a rigid cluster on the rows of its boundary.
#pragma once
#include "solver/row_forces.h"
#include "solver/symmetric6.h"

namespace brickfall {

// The factor of a cluster's Newton matrix: inertia and the stiffness of its boundary, as it was when the factor was
// made. Kept until a step shows that it is off.
struct ClusterFactor {
  Symmetric6 matrix;
  bool valid = false;
  bool kept = false;  // a step has been made with it
};

// Moves a cluster's bodies by a part of its step, from these motions. Uses the arithmetic of the solve's loads: what is
// stored are lanes as they will be read.
void moveCluster(Island& island, const Level& level, const Cluster& cluster, const Wrench& step, float part,
                 const SolveMotion* from);

// Exact: open points are left out of the matrix and searched for. Else open points nearer than kNearContact are in it.
Symmetric6 clusterMatrix(RowForces& forces, const Level& level, const Cluster& cluster, bool exact);

// A step tried: the displacement of the cluster, and which part of it was made. The bodies have been moved; forces and
// residuals are those from before until the step is taken.
struct ClusterStep {
  Wrench whole;  // as displacement and turn of the cluster
  float part = 0;
};
// `residual` is that of the cluster, about its centre. Nothing is moved (part 0) if there is no way down.
ClusterStep tryStep(RowForces& forces, const Level& level, const Cluster& cluster, ClusterFactor& factor,
                    const Wrench& residual, bool exact);
// Adds the inertia of the moved bodies to their residuals.
void addInertiaOfStep(Island& island, const Level& level, const Cluster& cluster, const ClusterStep& step);

}  // namespace brickfall
