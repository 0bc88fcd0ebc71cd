// The mortar of a scene's walls, from where the bricks lie to what the world is to make.
#pragma once
#include <string>
#include <vector>

#include "brickfall/masonry.h"
#include "brickfall/scene.h"

namespace brickfall::scene {

// What mortar is drawn as, unless the scene has a material of that name.
constexpr const char* kMortarMaterial = "mortar";
constexpr std::uint32_t kMortarColour = 0xA9A69F;  // 0xRRGGBB

struct LaidWall {
  const SceneWall* scene = nullptr;
  std::vector<BrickPlacement> bricks;
  std::size_t firstBody = 0;   // of its bricks, among all bodies
  std::size_t firstBrick = 0;  // among the bricks of all mortared walls
};

// Between two bodies by their places among all bodies.
struct BrickJoint {
  std::size_t a = 0, b = 0;
  std::vector<Vec3> outline;
  MortarStrength strength;
};

struct WallMortar {
  std::vector<GrownBrick> grown;               // by brick of all mortared walls
  std::vector<std::vector<MortarSlab>> slabs;  // the same
  struct Joint {
    std::size_t wallA, brickA, wallB, brickB;
    std::vector<Vec3> outline;
    MortarStrength strength;
  };
  std::vector<Joint> joints;
};

// Sets firstBrick of each.
WallMortar mortarOf(std::vector<LaidWall>& walls, std::uint64_t seed);
// By places among all bodies, once firstBody is set.
std::vector<BrickJoint> jointsOf(const WallMortar& mortar, const std::vector<LaidWall>& walls);
// The lowest course of a wall on the boxes and planes that it stands on.
std::vector<BrickJoint> footOf(const LaidWall& wall, const std::vector<PlacedBody>& bodies, std::uint64_t seed);

// The strength of one joint: its kind's, times its own factor, which follows from the seed and the two names.
MortarStrength scattered(const MortarKind& kind, bool bed, std::uint64_t seed, const std::string& a,
                         const std::string& b);
// True if its bricks are hollow or of uneven density.
bool isUneven(const SceneWall& wall);
// Gives the shape of a brick in mortar its size, its mean density and its mass: that of the brick (of the shape's density), of its share
// of mortar, and of what fills its frog.
void growBrick(const SceneWall& wall, const BrickPlacement& brick, const GrownBrick& grown, std::uint64_t seed,
               ShapeDef& shape);
// A brick in mortar as it is drawn: as it is laid, and its slabs of mortar.
DrawnBody drawnBrick(const BrickPlacement& brick, const GrownBrick& grown, const std::vector<MortarSlab>& slabs,
                     const std::string& material);
std::string mortarTitle(const SceneMortar& mortar);

}  // namespace brickfall::scene
