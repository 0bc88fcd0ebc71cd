// Collision shapes and materials.
#pragma once
#include <cstdint>
#include <memory>
#include <vector>

#include "brickfall/math.h"

namespace brickfall {

class MeshTree;  // brickfall/geometry/mesh_tree.h

enum class ShapeType : std::uint8_t { box, sphere, capsule, hull, plane, mesh, cylinder, cone };
constexpr int kShapeTypeCount = int(ShapeType::cone) + 1;  // a new one goes to the end (docs/how-to-add.md)

// How the values of two touching materials become one. If the two shapes ask for different rules, the later in this list
// wins.
enum class CombineRule : std::uint8_t { geometricMean, average, minimum, multiply, maximum };

struct Material {
  double density = 1900;  // kg/m3, > 0; sets mass and inertia of dynamic bodies
  double friction = 0.6;  // Coulomb coefficient, 0 .. 100
  // Pa, 1e3 .. 1e13: the pressure at which a blow crushes it. Read where something round hits what mortar holds.
  double hardness = 60e6;
  double restitution = 0;  // rebound speed / impact speed, 0 .. 1; see SolverSettings::restitutionSpeed
  // 0 .. 100: the torque that rolling takes to go on / (normal force x radius), of what is round. Of two materials the
  // larger counts. Car tyres 0.01, a stone ball on turf some 0.1.
  double rollingResistance = 0;
  CombineRule frictionRule = CombineRule::geometricMean;
  CombineRule restitutionRule = CombineRule::maximum;
};

// Two shapes collide if each one's category is in the other's mask, unless both have the same group: a negative group
// never collides with itself, a positive one always does. 0 = no group.
struct CollisionFilter {
  std::uint32_t category = 1;
  std::uint32_t mask = 0xffffffffu;
  std::int32_t group = 0;
};

constexpr int kMaxHullVertices = 64;

struct MassProperties {
  double mass = 0;                                  // kg
  Vec3 centre;                                      // m, centre of mass in the frame the shape was given in
  Mat3 inertia{{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};  // kg m2, about the centre, axes of that frame
};

// One piece of a body. Only the fields of its type are read.
struct ShapeDef {
  ShapeType type = ShapeType::box;
  Vec3 halfExtents{0.5, 0.5, 0.5};  // box: m, each > 0
  double radius = 0.5;              // sphere, capsule, cylinder: m, > 0; cone: at y = -halfHeight
  double topRadius = 0;             // cone: at y = +halfHeight, m, >= 0; 0: a point, else the cone is cut off
  double halfHeight = 0.5;          // capsule, cylinder, cone: half the distance of the two caps along local y, m, > 0
  std::vector<Vec3> vertices;       // hull: 4 .. 64 points that span a volume; inner points are dropped
  // plane: the half space y <= 0 of the shape's frame is solid; fixed bodies only
  // mesh: a surface of triangles that pushes towards the front of each; fixed and kinematic bodies only. Shared, not copied:
  // many shapes and worlds may use one. Docs: docs/mesh.md
  std::shared_ptr<const MeshTree> mesh;
  Transform local;  // the shape's frame in the body's frame
  Material material;
  // box, hull: how the mass of one that is hollow or of uneven density lies, at a density of 1 kg/m3 (its mass is the volume of
  // what it is made of). None: it is solid. Must be possible within the shape's bounds; hollows do not change what it collides as.
  std::shared_ptr<const MassProperties> distribution;
  CollisionFilter filter;
  // It only tells who is in it (Events::sensorBegin, sensorEnd): nothing collides with it, it weighs nothing, and rays and other
  // queries go past it. Its filter says whom it senses.
  bool sensor = false;
  std::uint64_t userData = 0;  // yours; never read
};

// The box around a shape of a body that lies at `body`. Tight but for meshes (that around their own box, turned); a plane's
// reaches 1e30 m, except that one whose normal is a world axis ends at its surface.
Aabb bounds(const ShapeDef& shape, const Transform& body);

}  // namespace brickfall
