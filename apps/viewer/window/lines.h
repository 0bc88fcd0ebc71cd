// Lines over the scene: debug layers, the spring of a drag. Thrown away and written anew for each picture.
#pragma once
#include <OgrePrerequisites.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "brickfall/math.h"

namespace brickfall::viewer {

class Lines {
 public:
  explicit Lines(Ogre::SceneManager& scene);
  ~Lines();
  void clear();
  void add(Vec3 from, Vec3 to, std::uint32_t colour, float alpha = 1);
  void addBox(const Aabb& box, std::uint32_t colour, float alpha = 1);
  void addBox(const Transform& pose, Vec3 halfExtents, std::uint32_t colour, float alpha = 1);
  void addCircle(Vec3 middle, Vec3 axisA, Vec3 axisB, std::uint32_t colour, float alpha = 1);
  void show();  // what was added since clear()
  std::size_t count() const { return vertices_.size() / 2; }

 private:
  struct Vertex {
    float x, y, z;
    std::uint32_t colour;
  };
  class Drawn;
  std::vector<Vertex> vertices_;
  std::unique_ptr<Drawn> drawn_;
};

}  // namespace brickfall::viewer
