#include "viewer_window/dust.h"

#include <OgreHardwareBufferManager.h>
#include <OgreMaterial.h>
#include <OgrePass.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreSimpleRenderable.h>

#include <cmath>

#include "viewer_window/programs.h"

namespace brickfall::viewer {
namespace {

struct Vertex {
  float place[3];
  float corner[4];  // -1 .. 1, radius, how much is left
  float colour[3];
};

}  // namespace

class Dust::Drawn : public Ogre::SimpleRenderable {
 public:
  Drawn() {
    mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
    mRenderOp.useIndexes = false;
    mRenderOp.vertexData = OGRE_NEW Ogre::VertexData();
    Ogre::VertexDeclaration& form = *mRenderOp.vertexData->vertexDeclaration;
    form.addElement(0, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
    form.addElement(0, 3 * sizeof(float), Ogre::VET_FLOAT4, Ogre::VES_TEXTURE_COORDINATES, 0);
    form.addElement(0, 7 * sizeof(float), Ogre::VET_FLOAT3, Ogre::VES_TEXTURE_COORDINATES, 1);
    mRenderOp.vertexData->vertexBufferBinding->setBinding(
        0, Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
               sizeof(Vertex), DustCloud::kMostPuffs * 6, Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE));
    setBoundingBox(Ogre::AxisAlignedBox::BOX_INFINITE);
    setCastShadows(false);
  }
  ~Drawn() override { OGRE_DELETE mRenderOp.vertexData; }
  void set(const std::vector<Vertex>& vertices) {
    mRenderOp.vertexData->vertexCount = vertices.size();
    if (vertices.empty()) return;
    mRenderOp.vertexData->vertexBufferBinding->getBuffer(0)->writeData(0, vertices.size() * sizeof(Vertex),
                                                                       vertices.data(), true);
  }
  void _updateRenderQueue(Ogre::RenderQueue* queue) override {
    if (mRenderOp.vertexData->vertexCount > 0) Ogre::SimpleRenderable::_updateRenderQueue(queue);
  }
  Ogre::Real getBoundingRadius() const override { return 1e6f; }
  Ogre::Real getSquaredViewDepth(const Ogre::Camera*) const override { return 0; }
};

Dust::Dust(Ogre::SceneManager& scene) : drawn_(std::make_unique<Drawn>()) {
  const auto material = makeMaterial({"dust", "dust.vert", "dust.frag", {"light.glsl", "lighting.glsl"}});
  material->setReceiveShadows(false);
  Ogre::Pass& pass = passOf(material);
  pass.setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  pass.setDepthWriteEnabled(false);
  pass.setCullingMode(Ogre::CULL_NONE);
  drawn_->setMaterial(material);
  scene.getRootSceneNode()->createChildSceneNode()->attachObject(drawn_.get());
}

Dust::~Dust() = default;

void Dust::setSun(Vec3 towardsSun) {
  setSunOf(*passOf(drawn_->getMaterial()).getFragmentProgramParameters(), towardsSun);
}

void Dust::update(const Frame& frame, const View& view, bool shown) {
  cloud_.update(frame);
  if (!shown) cloud_.clear();
  std::vector<Vertex> vertices;
  for (const DustCloud::Puff& puff : cloud_.puffs()) {
    const double age = frame.status.time - puff.born, share = age / DustCloud::kLife;
    const Vec3 at = puff.place + puff.drift * (age * (1 - 0.4 * share));
    const auto radius = float(puff.radius * (0.5 + 1.6 * std::sqrt(share)));
    const auto left = float(0.5 * puff.strength * (1 - share) * (1 - share));
    constexpr float kCorners[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
    for (const auto& corner : kCorners) {
      vertices.push_back({{float(at.x), float(at.y), float(at.z)},
                          {corner[0], corner[1], radius, left},
                          {puff.colour.x, puff.colour.y, puff.colour.z}});
    }
  }
  const Ogre::Pass& pass = passOf(drawn_->getMaterial());
  const Vec3 right = view.right(), up = view.up();
  for (const auto& parameters : {pass.getVertexProgramParameters(), pass.getFragmentProgramParameters()}) {
    parameters->setNamedConstant("right", Ogre::Vector3(float(right.x), float(right.y), float(right.z)));
    parameters->setNamedConstant("up", Ogre::Vector3(float(up.x), float(up.y), float(up.z)));
  }
  drawn_->set(vertices);
}

}  // namespace brickfall::viewer
