// Typical values, fine to start from and not measured by us: clay brick and its friction after AS 3700 calculators and
// published rocking-wall experiments (0.62 .. 0.82 dry); the others are common handbook figures.
#include "brickfall/scene.h"

namespace brickfall {

namespace {

MaterialDef make(const char* name, double density, double friction, double restitution, double hardness,
                 std::uint32_t colour) {
  MaterialDef def;
  def.name = name;
  def.material.density = density;
  def.material.friction = friction;
  def.material.restitution = restitution;
  def.material.hardness = hardness;
  def.colour = colour;
  return def;
}

}  // namespace

const std::vector<MaterialDef>& predefinedMaterials() {
  static const std::vector<MaterialDef> materials = {
      make("brick", 1900, 0.65, 0.1, 60e6, 0xB5543A),    make("steel", 7800, 0.5, 0.3, 1.5e9, 0x70757A),
      make("concrete", 2400, 0.65, 0.1, 90e6, 0xA9A69F), make("wood", 600, 0.45, 0.2, 30e6, 0xB8864B),
      make("rubber", 1100, 0.9, 0.7, 5e6, 0x2E2E2E),
  };
  return materials;
}

}  // namespace brickfall
