// Triangles to draw a shape with. A box gets its edges rounded off a little, as no brick is sharp: the thin bright line where an
// edge catches the light tells one brick from the next. Whatever is drawn stays inside the collider.
#pragma once
#include "brickfall/geometry/shape_mesh.h"

namespace brickfall::appearance {

constexpr double kChamfer = 0.0022;  // m; at most a tenth of the box's smallest half length

// Six faces with corners of their own and texture coordinates as boxMesh has them (1 = one metre), joined by a strip along each
// edge and a triangle at each corner, whose normals go over from face to face. 24 vertices, 44 triangles.
ShapeMesh chamferedBoxMesh(Vec3 halfExtents, double chamfer = kChamfer);

// Any shape, in its own frame; all but boxes as makeShapeMesh has them.
Result<ShapeMesh> makeDrawMesh(const ShapeDef& shape, RoundDetail detail = {});

}  // namespace brickfall::appearance
