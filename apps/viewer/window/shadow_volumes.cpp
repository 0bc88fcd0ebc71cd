#include "viewer_window/shadow_volumes.h"

#include <OgreEdgeListBuilder.h>
#include <OgreHardwareBufferManager.h>
#include <OgreNode.h>
#include <OgreShadowCaster.h>

#include <algorithm>

namespace brickfall::viewer {

// Sides or caps: the vertices are common, the indices each one's own.
class ShadowVolumes::Part : public Ogre::ShadowRenderable {
 public:
  Part() {
    mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
    mRenderOp.useIndexes = true;
    mRenderOp.vertexData = OGRE_NEW Ogre::VertexData();
    mRenderOp.indexData = OGRE_NEW Ogre::IndexData();
    auto& form = *mRenderOp.vertexData->vertexDeclaration;
    form.addElement(0, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
    form.addElement(0, offsetof(VolumeVertex, w), Ogre::VET_FLOAT1, Ogre::VES_TEXTURE_COORDINATES, 0);
  }
  ~Part() override {
    OGRE_DELETE mRenderOp.vertexData;
    OGRE_DELETE mRenderOp.indexData;
  }
  void addCaps() { mLightCap = OGRE_NEW Part(); }
  Part& caps() { return static_cast<Part&>(*mLightCap); }

  void set(const Ogre::HardwareVertexBufferSharedPtr& vertices, std::size_t count,
           std::span<const std::uint32_t> indices) {
    mRenderOp.vertexData->vertexBufferBinding->setBinding(0, vertices);
    mRenderOp.vertexData->vertexCount = count;
    auto& data = *mRenderOp.indexData;
    if (!data.indexBuffer || data.indexBuffer->getNumIndexes() < indices.size()) {
      data.indexBuffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
          Ogre::HardwareIndexBuffer::IT_32BIT, std::max<std::size_t>(indices.size() * 3 / 2, 3),
          Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
    }
    if (!indices.empty()) data.indexBuffer->writeData(0, indices.size_bytes(), indices.data(), true);
    data.indexCount = indices.size();
  }
  bool isVisible() const override { return mRenderOp.indexData->indexCount > 0; }
  void getWorldTransforms(Ogre::Matrix4* out) const override { *out = Ogre::Matrix4::IDENTITY; }
  void rebindIndexBuffer(const Ogre::HardwareIndexBufferSharedPtr&) override {}  // its indices are its own
};

const Ogre::String ShadowVolumesFactory::kType = "ShadowVolumes";

ShadowVolumes::ShadowVolumes(const Ogre::String& name)
    : Ogre::MovableObject(name), edges_(std::make_unique<Ogre::EdgeData>()), sides_(std::make_unique<Part>()) {
  sides_->addCaps();
  setCastShadows(true);
}
ShadowVolumes::~ShadowVolumes() = default;

const Ogre::String& ShadowVolumes::getMovableType() const { return ShadowVolumesFactory::kType; }

void ShadowVolumes::set(const ShadowGeometry& geometry, const Aabb& bounds) {
  volumes_.clear();
  if (geometry.caps().empty()) return;
  bounds_.setExtents(Ogre::Vector3(Ogre::Real(bounds.lower.x), Ogre::Real(bounds.lower.y), Ogre::Real(bounds.lower.z)),
                     Ogre::Vector3(Ogre::Real(bounds.upper.x), Ogre::Real(bounds.upper.y), Ogre::Real(bounds.upper.z)));
  const auto vertices = geometry.vertices();
  auto& binding = *sides_->getRenderOperationForUpdate()->vertexData->vertexBufferBinding;
  Ogre::HardwareVertexBufferSharedPtr buffer;
  if (binding.isBufferBound(0)) buffer = binding.getBuffer(0);
  if (!buffer || buffer->getNumVertices() < vertices.size()) {
    buffer = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
        sizeof(VolumeVertex), vertices.size() * 3 / 2, Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
  }
  buffer->writeData(0, vertices.size_bytes(), vertices.data(), true);
  sides_->set(buffer, vertices.size(), geometry.sides());
  sides_->caps().set(buffer, vertices.size(), geometry.caps());
  volumes_.push_back(sides_.get());
  if (mParentNode) mParentNode->needUpdate();
}

}  // namespace brickfall::viewer
