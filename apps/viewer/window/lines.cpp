#include "viewer_window/lines.h"

#include <OgreHardwareBufferManager.h>
#include <OgreMaterial.h>
#include <OgrePass.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreSimpleRenderable.h>

#include <algorithm>
#include <cmath>

#include "viewer_window/programs.h"

namespace brickfall::viewer {

class Lines::Drawn : public Ogre::SimpleRenderable {
 public:
  Drawn() {
    mRenderOp.operationType = Ogre::RenderOperation::OT_LINE_LIST;
    mRenderOp.useIndexes = false;
    mRenderOp.vertexData = OGRE_NEW Ogre::VertexData();
    Ogre::VertexDeclaration& form = *mRenderOp.vertexData->vertexDeclaration;
    form.addElement(0, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
    form.addElement(0, 3 * sizeof(float), Ogre::VET_UBYTE4_NORM, Ogre::VES_DIFFUSE);
    setBoundingBox(Ogre::AxisAlignedBox::BOX_INFINITE);
    setCastShadows(false);
    setPolygonModeOverrideable(false);
    setRenderQueueGroup(Ogre::RENDER_QUEUE_8);
  }
  ~Drawn() override { OGRE_DELETE mRenderOp.vertexData; }
  void set(const std::vector<Vertex>& vertices) {
    Ogre::VertexData& data = *mRenderOp.vertexData;
    data.vertexCount = vertices.size();
    if (vertices.empty()) return;
    if (capacity_ < vertices.size()) {
      capacity_ = vertices.size() * 3 / 2;
      data.vertexBufferBinding->setBinding(
          0, Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
                 sizeof(Vertex), capacity_, Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE));
    }
    data.vertexBufferBinding->getBuffer(0)->writeData(0, vertices.size() * sizeof(Vertex), vertices.data(), true);
  }
  void _updateRenderQueue(Ogre::RenderQueue* queue) override {
    if (mRenderOp.vertexData->vertexCount > 0) Ogre::SimpleRenderable::_updateRenderQueue(queue);
  }
  Ogre::Real getBoundingRadius() const override { return 1e6f; }
  Ogre::Real getSquaredViewDepth(const Ogre::Camera*) const override { return 0; }

 private:
  std::size_t capacity_ = 0;
};

Lines::Lines(Ogre::SceneManager& scene) : drawn_(std::make_unique<Drawn>()) {
  const auto material = makeMaterial({"lines", "line.vert", "line.frag", {}});
  material->setReceiveShadows(false);
  passOf(material).setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  passOf(material).setDepthWriteEnabled(false);
  // Seen through walls: contacts lie inside of them.
  passOf(material).setDepthCheckEnabled(false);
  drawn_->setMaterial(material);
  scene.getRootSceneNode()->createChildSceneNode()->attachObject(drawn_.get());
}

Lines::~Lines() = default;

void Lines::clear() { vertices_.clear(); }

void Lines::add(Vec3 from, Vec3 to, std::uint32_t colour, float alpha) {
  const auto shown = std::uint32_t(std::lround(std::clamp(alpha, 0.0f, 1.0f) * 255)) << 24 | (colour & 255) << 16 |
                     (colour >> 8 & 255) << 8 | (colour >> 16 & 255);
  vertices_.push_back({float(from.x), float(from.y), float(from.z), shown});
  vertices_.push_back({float(to.x), float(to.y), float(to.z), shown});
}

void Lines::addBox(const Transform& pose, Vec3 half, std::uint32_t colour, float alpha) {
  const auto corner = [&](int i) {
    return transformPoint(pose, {i & 1 ? half.x : -half.x, i & 2 ? half.y : -half.y, i & 4 ? half.z : -half.z});
  };
  for (int i = 0; i < 8; i++) {
    for (int bit = 1; bit < 8; bit *= 2) {
      if (!(i & bit)) add(corner(i), corner(i | bit), colour, alpha);
    }
  }
}

void Lines::addBox(const Aabb& box, std::uint32_t colour, float alpha) {
  addBox(Transform{(box.lower + box.upper) * 0.5, {}}, (box.upper - box.lower) * 0.5, colour, alpha);
}

void Lines::addCircle(Vec3 middle, Vec3 axisA, Vec3 axisB, std::uint32_t colour, float alpha) {
  constexpr int kSides = 24;
  Vec3 last = middle + axisA;
  for (int i = 1; i <= kSides; i++) {
    double sine = 0, cosine = 0;
    sinCos(i * 6.283185307179586 / kSides, sine, cosine);
    const Vec3 next = middle + axisA * cosine + axisB * sine;
    add(last, next, colour, alpha);
    last = next;
  }
}

void Lines::show() { drawn_->set(vertices_); }

}  // namespace brickfall::viewer
