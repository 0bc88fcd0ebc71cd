#include "viewer_window/instance_batch.h"

#include <OgreHardwareBufferManager.h>

#include <algorithm>

namespace brickfall::viewer {
namespace {

constexpr int kMeshSource = 0, kInstanceSource = 1;
constexpr int kInstanceRows = int(sizeof(Instance) / (4 * sizeof(float)));

struct MeshVertex {
  std::array<float, 3> position, normal, uv;
};

}  // namespace

void Instance::setPose(const Transform& pose, Vec3 scale) {
  const Mat3 turn = toMatrix(pose.rotation);
  for (int i = 0; i < 3; i++) {
    const Vec3 row = scaled(turn.row[i], scale);
    rows[i * 4] = float(row.x);
    rows[i * 4 + 1] = float(row.y);
    rows[i * 4 + 2] = float(row.z);
    rows[i * 4 + 3] = float(pose.position[i]);
  }
}

InstanceBatch::InstanceBatch(const DrawMesh& mesh) {
  makeVertices(mesh);
  // Bodies are everywhere and move: whether any is in the picture is left to the graphics card.
  setBoundingBox(Ogre::AxisAlignedBox::BOX_INFINITE);
}

InstanceBatch::~InstanceBatch() {
  OGRE_DELETE mRenderOp.vertexData;
  OGRE_DELETE mRenderOp.indexData;
}

void InstanceBatch::makeVertices(const DrawMesh& mesh) {
  auto& buffers = Ogre::HardwareBufferManager::getSingleton();
  mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
  mRenderOp.useGlobalInstancingVertexBufferIsAvailable = false;
  mRenderOp.vertexData = OGRE_NEW Ogre::VertexData();
  Ogre::VertexDeclaration& form = *mRenderOp.vertexData->vertexDeclaration;
  form.addElement(kMeshSource, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
  form.addElement(kMeshSource, offsetof(MeshVertex, normal), Ogre::VET_FLOAT3, Ogre::VES_NORMAL);
  form.addElement(kMeshSource, offsetof(MeshVertex, uv), Ogre::VET_FLOAT3, Ogre::VES_TEXTURE_COORDINATES, 0);
  for (int i = 0; i < kInstanceRows; i++) {
    form.addElement(kInstanceSource, i * 4 * sizeof(float), Ogre::VET_FLOAT4, Ogre::VES_TEXTURE_COORDINATES, 1 + i);
  }

  std::vector<MeshVertex> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < vertices.size(); i++) vertices[i] = {mesh.positions[i], mesh.normals[i], mesh.uvs[i]};
  const auto vertexBuffer = buffers.createVertexBuffer(sizeof(MeshVertex), std::max<std::size_t>(vertices.size(), 1),
                                                       Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  if (!vertices.empty()) vertexBuffer->writeData(0, vertices.size() * sizeof(MeshVertex), vertices.data());
  mRenderOp.vertexData->vertexBufferBinding->setBinding(kMeshSource, vertexBuffer);
  mRenderOp.vertexData->vertexCount = vertices.size();

  const std::size_t count = mesh.indices.size();
  mRenderOp.useIndexes = true;
  mRenderOp.indexData = OGRE_NEW Ogre::IndexData();
  mRenderOp.indexData->indexBuffer =
      buffers.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_32BIT, std::max<std::size_t>(count, 3),
                                Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  if (count > 0) mRenderOp.indexData->indexBuffer->writeData(0, count * sizeof(std::uint32_t), mesh.indices.data());
  mRenderOp.indexData->indexCount = count;
  reserve(1);
  mRenderOp.numberOfInstances = 0;
}

void InstanceBatch::reserve(std::size_t count) {
  if (count <= capacity_) return;
  capacity_ = std::max(count, capacity_ * 2);
  const auto buffer = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      sizeof(Instance), capacity_, Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE);
  buffer->setIsInstanceData(true);
  buffer->setInstanceDataStepRate(1);
  mRenderOp.vertexData->vertexBufferBinding->setBinding(kInstanceSource, buffer);
}

void InstanceBatch::setInstances(std::span<const Instance> instances) {
  reserve(instances.size());
  mRenderOp.numberOfInstances = instances.size();
  if (instances.empty()) return;
  mRenderOp.vertexData->vertexBufferBinding->getBuffer(kInstanceSource)
      ->writeData(0, instances.size_bytes(), instances.data(), true);
}

void InstanceBatch::_updateRenderQueue(Ogre::RenderQueue* queue) {
  if (mRenderOp.numberOfInstances > 0) Ogre::SimpleRenderable::_updateRenderQueue(queue);
}

}  // namespace brickfall::viewer
