// The functions of queries.h where one of the two is a mesh: face by face, each face being convex.
//
// A mesh is a surface. The overlap depth with a face is the shortest way that brings the shape off it, to the side on which
// the shape's middle is; with the mesh, the largest of its faces'.
#pragma once
#include <optional>

#include "geometry/queries.h"

namespace brickfall {

inline bool hasMesh(const Shape& a, const Shape& b) { return a.type == ShapeType::mesh || b.type == ShapeType::mesh; }

// `mesh` first, the other's pose in its frame. Another mesh or a plane: 0 and nothing.
double meshPenetration(const Shape& mesh, const Shape& shape, const Transform& pose);
DistanceResult meshShapeDistance(const Shape& mesh, const Shape& shape, const Transform& pose);
// Only faces that the shape approaches from their front, with its middle in front of them.
std::optional<double> meshTimeOfImpact(const Shape& mesh, const Shape& shape, const Transform& pose, Vec3 motion,
                                       double target);

// Takes the room that these functions keep for each thread, so that the first of them takes none.
void keepMeshRoom();

}  // namespace brickfall
