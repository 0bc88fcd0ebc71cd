// One mesh drawn at many places in one call: what differs from body to body lies in a buffer of its own that is written anew
// for each picture.
#pragma once
#include <OgreSimpleRenderable.h>

#include <array>
#include <span>

#include "brickfall/math.h"
#include "viewer_window/draw_mesh.h"

namespace brickfall::viewer {

// In the order in which body.vert reads it.
struct Instance {
  std::array<float, 12> rows{};          // of the matrix from the mesh to the world
  std::array<float, 3> colour{1, 1, 1};  // linear: times what the texture has
  float layer = 0;                       // of the texture, added to the mesh's own
  std::array<float, 3> tint{1, 1, 1};    // as pixels, 0 .. 1: what a view colours the body with
  float tinted = 0;                      // how much of that, 0 .. 1
  std::array<float, 2> texturePlace{};   // added to the mesh's own
  float glow = 0;                        // added light, for what is selected
  float ball = 0;  // 1: its shadow begins where its smooth shading ends, not at an edge of its mesh
  void setPose(const Transform& pose, Vec3 scale = {1, 1, 1});
};
static_assert(sizeof(Instance) == 24 * sizeof(float));

class InstanceBatch : public Ogre::SimpleRenderable {
 public:
  explicit InstanceBatch(const DrawMesh& mesh);
  ~InstanceBatch() override;
  // What is drawn from now on; none: nothing is.
  void setInstances(std::span<const Instance> instances);

  void _updateRenderQueue(Ogre::RenderQueue* queue) override;
  Ogre::Real getBoundingRadius() const override { return 1e6f; }
  Ogre::Real getSquaredViewDepth(const Ogre::Camera*) const override { return 0; }

 private:
  void makeVertices(const DrawMesh& mesh);
  void reserve(std::size_t count);

  std::size_t capacity_ = 0;
};

}  // namespace brickfall::viewer
