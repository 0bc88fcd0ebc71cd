// The cut edges of a brick and its texture, of which each pair of faces has one of its own.
#pragma once
#include "brickfall/math.h"
#include "viewer_window/draw_mesh.h"

namespace brickfall::viewer {

// m, of a brick's texture, which cut bricks and stones of other sizes wear too: a part of it, or mirrored on.
constexpr float kBrickHalf[3] = {0.1075f, 0.0325f, 0.05125f};

// Of a box's mesh whose third coordinate of texture is the axis of the face. A strip along an edge belongs to two faces, but wears the
// texture of one: between the places of two textures it would wear all of both.
void giveStripsOneFace(DrawMesh& mesh, Vec3 half);

}  // namespace brickfall::viewer
