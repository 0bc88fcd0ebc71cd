#include "viewer_window/dust.h"

#include <OgreHardwareBufferManager.h>
#include <OgreMaterial.h>
#include <OgrePass.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreSimpleRenderable.h>

#include <algorithm>
#include <cmath>

#include "appearance/noise.h"
#include "viewer_window/programs.h"

namespace brickfall::viewer {
namespace {

constexpr std::size_t kMostPuffs = 400;
constexpr double kLife = 1.6;        // s, simulated
constexpr double kLeastSpeed = 0.8;  // m/s: what is slower raises none
constexpr double kLeastRest = 0.15;  // s between two puffs of a body that goes on being hit

struct Vertex {
  float place[3];
  float corner[4];  // -1 .. 1, radius, how much is left
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
    mRenderOp.vertexData->vertexBufferBinding->setBinding(
        0, Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
               sizeof(Vertex), kMostPuffs * 6, Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE));
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
  const auto material = makeMaterial({"dust", "dust.vert", "dust.frag", {"lighting.glsl"}});
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

void Dust::puff(const Frame& frame, std::size_t body, std::uint32_t salt) {
  const ListedBody& listed = frame.list->bodies[body];
  const FrameBody& state = frame.bodies[body];
  const auto any = [&](std::uint32_t which) {
    return double(appearance::chance(listed.serial * 31 + which, salt)) * 2 - 1;
  };
  Puff made;
  made.born = frame.status.time;
  const double size = std::min(listed.radius, 0.25);
  made.place = state.pose.position + Vec3{any(1), any(2), any(3)} * (0.7 * size);
  made.drift = state.linearVelocity * 0.12 + Vec3{any(4), 0.6 + 0.5 * any(5), any(6)} * 0.25;
  made.radius = float(size * (0.45 + 0.2 * any(7)));
  made.strength = float(std::clamp(length(state.linearVelocity) / 6, 0.15, 0.8));
  puffs_.push_back(made);
}

void Dust::findHits(const Frame& frame) {
  for (std::size_t i = 0; i < frame.bodies.size(); i++) {
    const FrameBody& body = frame.bodies[i];
    if (frame.list->bodies[i].role != BodyRole::brick || body.activity == Activity::fixed) continue;
    if (body.sinceHit > frame.status.time - lastTime_ || length(body.linearVelocity) < kLeastSpeed) continue;
    for (std::uint32_t k = 0; k < 2; k++) puff(frame, i, std::uint32_t(frame.number) * 2 + k);
  }
  // The oldest go where there are too many.
  if (puffs_.size() > kMostPuffs) puffs_.erase(puffs_.begin(), puffs_.end() - std::ptrdiff_t(kMostPuffs));
}

void Dust::update(const Frame& frame, const View& view, bool shown) {
  const double time = frame.status.time;
  if (frame.info != run_) puffs_.clear();
  run_ = frame.info;
  if (shown && frame.number != lastFrame_ && time > lastTime_ && time - lastTime_ < kLeastRest) findHits(frame);
  lastFrame_ = frame.number;
  lastTime_ = time;
  std::erase_if(puffs_, [&](const Puff& puff) { return !shown || time < puff.born || time > puff.born + kLife; });

  std::vector<Vertex> vertices;
  for (const Puff& puff : puffs_) {
    const double age = time - puff.born, share = age / kLife;
    const Vec3 at = puff.place + puff.drift * (age * (1 - 0.4 * share));
    const auto radius = float(puff.radius * (0.5 + 1.6 * std::sqrt(share)));
    const auto left = float(0.5 * puff.strength * (1 - share) * (1 - share));
    constexpr float kCorners[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
    for (const auto& corner : kCorners) {
      vertices.push_back({{float(at.x), float(at.y), float(at.z)}, {corner[0], corner[1], radius, left}});
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
