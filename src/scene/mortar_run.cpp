#include "scene/mortar_run.h"

#include <algorithm>
#include <cmath>

#include "masonry/named_seed.h"
#include "masonry/scatter.h"
#include "scene/body_bounds.h"

namespace brickfall::scene {

namespace {

double volumeOf(Vec3 size) { return size.x * size.y * size.z; }

// A box, or the part of a plane that lies under the wall, as a brick.
void addSupports(const PlacedBody& body, const Aabb& foot, std::vector<BrickPlacement>& supports) {
  const Transform pose{body.def.position, normalized(body.def.rotation)};
  const Vec3 middle = (foot.lower + foot.upper) * 0.5;
  const double reach = 2 * length(foot.upper - foot.lower);
  for (const ShapeDef& shape : body.def.shapes) {
    const Transform place = pose * shape.local;
    BrickPlacement support;
    support.rotation = normalized(place.rotation);
    support.centre = place.position;
    support.size = shape.halfExtents * 2.0;
    if (shape.type == ShapeType::plane) {
      const Vec3 up = rotate(support.rotation, Vec3{0, 1, 0});
      support.size = {reach, reach, reach};
      support.centre = middle - up * (dot(middle - place.position, up) + 0.5 * reach);
    } else if (shape.type != ShapeType::box) {
      continue;
    }
    supports.push_back(support);
  }
}

}  // namespace

MortarStrength scattered(const MortarKind& kind, bool bed, std::uint64_t seed, const std::string& a,
                         const std::string& b) {
  const auto [first, second] = std::minmax(a, b);
  const double factor = masonry::scatterFactor(masonry::namedSeed(seed, first + " | " + second), kind.scatter) *
                        (bed ? 1 : kind.headFilling);
  MortarStrength strength = kind.strength;
  // Within what createMortar takes; cohesion stays more than tension times friction.
  const double least = std::max(
      {1 / strength.tension, 1 / strength.cohesion, 1e-6 / strength.tensionEnergy, 1e-6 / strength.shearEnergy});
  const double most = std::min(
      {1e9 / strength.tension, 1e9 / strength.cohesion, 1e6 / strength.tensionEnergy, 1e6 / strength.shearEnergy});
  const double share = std::min(std::max(factor, least), most);
  strength.tension *= share;
  strength.cohesion *= share;
  strength.tensionEnergy *= share;
  strength.shearEnergy *= share;
  if (!bed) {  // what is not filled neither crushes nor gives
    strength.compression = std::max(1.0, strength.compression * kind.headFilling);
    strength.crushingEnergy = std::max(1e-6, strength.crushingEnergy * kind.headFilling);
    strength.stiffness = std::max(1e6, strength.stiffness * kind.headFilling);
  }
  return strength;
}

bool isUneven(const SceneWall& wall) {
  return wall.wall.brick.frog.depth > 0 || wall.wall.brick.holes.along > 0 || wall.uneven.gradient > 0 ||
         wall.uneven.noise > 0;
}

void growBrick(const SceneWall& wall, const BrickPlacement& brick, const GrownBrick& grown, std::uint64_t seed,
               ShapeDef& shape) {
  const MassProperties atOne =
      brickMass(wall.wall, brick, wall.uneven, masonry::namedSeed(seed, brick.name + " density"));
  MassProperties mass = mortaredBrickMass(wall.wall, brick, grown, atOne, shape.material.density, wall.mortar->density);
  shape.halfExtents = grown.size * 0.5;
  shape.material.density = mass.mass / volumeOf(grown.size);
  mass.mass /= shape.material.density;
  mass.inertia = mass.inertia * (1 / shape.material.density);
  shape.distribution = std::make_shared<const MassProperties>(mass);
}

DrawnBody drawnBrick(const BrickPlacement& brick, const GrownBrick& grown, const std::vector<MortarSlab>& slabs,
                     const std::string& material) {
  DrawnBody drawn;
  for (ShapeDef& shape : shapesOf(brick)) {
    shape.local.position = rotate(conjugate(brick.rotation), brick.centre - grown.centre);
    drawn.shapes.push_back(std::move(shape));
    drawn.materials.push_back(material);
  }
  for (const MortarSlab& slab : slabs) {
    ShapeDef shape;
    shape.halfExtents = slab.size * 0.5;
    shape.local.position = slab.centre;
    drawn.shapes.push_back(shape);
    drawn.materials.push_back(kMortarMaterial);
  }
  return drawn;
}

std::string mortarTitle(const SceneMortar& mortar) {
  std::string title = "mortar of \"" + mortar.bodyA + "\"";
  if (!mortar.bodyB.empty()) title += " and \"" + mortar.bodyB + "\"";
  if (mortar.place.line > 0) title += " (line " + std::to_string(mortar.place.line) + ")";
  return title;
}

WallMortar mortarOf(std::vector<LaidWall>& walls, std::uint64_t seed) {
  std::vector<MortaredBricks> mortared;
  std::vector<std::pair<std::size_t, std::size_t>> brickOf;  // wall and brick, by place among all mortared bricks
  for (std::size_t w = 0; w < walls.size(); w++) {
    walls[w].firstBrick = brickOf.size();
    if (!walls[w].scene->mortar) continue;
    mortared.push_back({walls[w].bricks, jointWidths(walls[w].scene->wall)});
    for (std::size_t k = 0; k < walls[w].bricks.size(); k++) brickOf.push_back({w, k});
  }
  MortarLayout layout = layMortar(mortared);
  WallMortar out;
  out.grown = std::move(layout.grown);
  out.slabs = std::move(layout.slabs);
  for (MortarJoint& joint : layout.joints) {
    const auto [wallA, brickA] = brickOf[joint.a];
    const auto [wallB, brickB] = brickOf[joint.b];
    // Where two walls meet, the weaker mortar counts; of equal ones the first.
    const MortarKind &one = *walls[wallA].scene->mortar, &other = *walls[wallB].scene->mortar;
    const MortarKind& kind = other.strength.tension < one.strength.tension ? other : one;
    if (!joint.bed && kind.headFilling == 0) continue;
    const MortarStrength strength =
        scattered(kind, joint.bed, seed, walls[wallA].bricks[brickA].name, walls[wallB].bricks[brickB].name);
    out.joints.push_back({wallA, brickA, wallB, brickB, std::move(joint.outline), strength});
  }
  return out;
}

std::vector<BrickJoint> jointsOf(const WallMortar& mortar, const std::vector<LaidWall>& walls) {
  std::vector<BrickJoint> joints;
  for (const WallMortar::Joint& joint : mortar.joints)
    joints.push_back({walls[joint.wallA].firstBody + joint.brickA, walls[joint.wallB].firstBody + joint.brickB,
                      joint.outline, joint.strength});
  return joints;
}

std::vector<BrickJoint> footOf(const LaidWall& wall, const std::vector<PlacedBody>& bodies, std::uint64_t seed) {
  std::vector<BrickPlacement> lowest, supports;
  std::vector<std::size_t> bodyOf, bodyUnder;
  const JointWidths widths = jointWidths(wall.scene->wall);
  Aabb foot{{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}};
  for (std::size_t k = 0; k < wall.bricks.size(); k++) {
    if (wall.bricks[k].course != 0) continue;
    lowest.push_back(wall.bricks[k]);
    bodyOf.push_back(wall.firstBody + k);
    foot = merged(foot, bodyBounds(bodies[bodyOf.back()].def));
  }
  const Aabb reach = grown(foot, 2 * widths.bed + 1e-3 * wall.scene->wall.brick.size.y);
  for (std::size_t k = 0; k < bodies.size(); k++) {
    const bool own = k >= wall.firstBody && k < wall.firstBody + wall.bricks.size();
    if (own || !overlaps(reach, bodyBounds(bodies[k].def))) continue;
    addSupports(bodies[k], foot, supports);
    bodyUnder.resize(supports.size(), k);
  }
  // The widths of the wall alone: what it stands on has none.
  const std::vector<MortaredBricks> both{{lowest, widths}, {supports, {}}};
  std::vector<BrickJoint> joints;
  for (MortarJoint& joint : layMortar(both).joints) {
    if (joint.a >= lowest.size() || joint.b < lowest.size()) continue;
    const std::size_t support = bodyUnder[joint.b - lowest.size()];
    const bool below = joint.outline[0].y < lowest[joint.a].centre.y;
    if (!joint.bed || !below) continue;
    const MortarStrength strength =
        scattered(*wall.scene->mortar, true, seed, lowest[joint.a].name, bodies[support].name);
    joints.push_back({bodyOf[joint.a], support, std::move(joint.outline), strength});
  }
  return joints;
}

}  // namespace brickfall::scene
