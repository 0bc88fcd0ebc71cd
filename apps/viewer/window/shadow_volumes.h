// Stencil shadows as in the report: Ogre darkens all that lies in the volumes. All bodies are one caster, so that their volumes
// are one call; as entities they would be two calls each.
#pragma once
#include <OgreMovableObject.h>

#include <memory>

#include "viewer_window/silhouette.h"

namespace brickfall::viewer {

class ShadowVolumes : public Ogre::MovableObject {
 public:
  explicit ShadowVolumes(const Ogre::String& name);
  ~ShadowVolumes() override;
  // Copies it to the graphics card. bounds: of the bodies that cast, m.
  void set(const ShadowGeometry& geometry, const Aabb& bounds);

  const Ogre::String& getMovableType() const override;
  const Ogre::AxisAlignedBox& getBoundingBox() const override { return bounds_; }
  Ogre::Real getBoundingRadius() const override { return 1e6f; }
  void _updateRenderQueue(Ogre::RenderQueue*) override {}
  void visitRenderables(Ogre::Renderable::Visitor*, bool) override {}

  // Ogre asks whether there are edges; they are kept here and not in its way.
  Ogre::EdgeData* getEdgeList() override { return edges_.get(); }
  const ShadowRenderableList& getShadowVolumeRenderableList(Ogre::ShadowTechnique, const Ogre::Light*,
                                                            Ogre::HardwareIndexBufferSharedPtr*, std::size_t*, bool,
                                                            Ogre::Real, unsigned long) override {
    return volumes_;
  }

 private:
  class Part;
  Ogre::AxisAlignedBox bounds_;
  std::unique_ptr<Ogre::EdgeData> edges_;
  ShadowRenderableList volumes_;  // one, or none while nothing casts
  std::unique_ptr<Part> sides_;
};

// Ogre looks for casters only among objects of kinds that have a factory.
class ShadowVolumesFactory : public Ogre::MovableObjectFactory {
 public:
  static const Ogre::String kType;
  const Ogre::String& getType() const override { return kType; }

 private:
  Ogre::MovableObject* createInstanceImpl(const Ogre::String& name, const Ogre::NameValuePairList*) override {
    return new ShadowVolumes(name);
  }
};

}  // namespace brickfall::viewer
