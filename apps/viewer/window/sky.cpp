#include "viewer_window/sky.h"

#include <OgreHardwareBufferManager.h>
#include <OgrePass.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreSimpleRenderable.h>

#include "viewer_window/programs.h"

namespace brickfall::viewer {

// One triangle that reaches over the whole screen.
class Sky::Screen : public Ogre::SimpleRenderable {
 public:
  Screen() {
    constexpr float kCorners[] = {-1, -1, 0, 3, -1, 0, -1, 3, 0};
    mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
    mRenderOp.useIndexes = false;
    mRenderOp.vertexData = OGRE_NEW Ogre::VertexData();
    mRenderOp.vertexData->vertexCount = 3;
    mRenderOp.vertexData->vertexDeclaration->addElement(0, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
    const auto buffer = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
        3 * sizeof(float), 3, Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
    buffer->writeData(0, sizeof(kCorners), kCorners);
    mRenderOp.vertexData->vertexBufferBinding->setBinding(0, buffer);
    setBoundingBox(Ogre::AxisAlignedBox::BOX_INFINITE);
    setCastShadows(false);
    setPolygonModeOverrideable(false);
    setRenderQueueGroup(Ogre::RENDER_QUEUE_SKIES_EARLY);
  }
  ~Screen() override { OGRE_DELETE mRenderOp.vertexData; }
  Ogre::Real getBoundingRadius() const override { return 1e6f; }
  Ogre::Real getSquaredViewDepth(const Ogre::Camera*) const override { return 0; }
};

Sky::Sky(Ogre::SceneManager& scene) : screen_(std::make_unique<Screen>()) {
  const auto material = makeMaterial({"sky", "sky.vert", "sky.frag", {"light.glsl", "lighting.glsl"}});
  material->setReceiveShadows(false);
  Ogre::Pass& pass = passOf(material);
  pass.setDepthCheckEnabled(false);
  pass.setDepthWriteEnabled(false);
  pass.setCullingMode(Ogre::CULL_NONE);
  screen_->setMaterial(material);
  scene.getRootSceneNode()->createChildSceneNode()->attachObject(screen_.get());
}

Sky::~Sky() = default;

void Sky::setSun(Vec3 towardsSun) {
  setSunOf(*passOf(screen_->getMaterial()).getFragmentProgramParameters(), towardsSun);
}

void Sky::setVisible(bool visible) { screen_->setVisible(visible); }

}  // namespace brickfall::viewer
