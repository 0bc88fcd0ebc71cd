#include "viewer_window/body_drawer.h"

#include <OgreRoot.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>

#include <algorithm>

namespace brickfall::viewer {
namespace {

std::array<float, 3> parts(std::uint32_t colour) {
  return {float(colour >> 16 & 255) / 255, float(colour >> 8 & 255) / 255, float(colour & 255) / 255};
}

// What flies far off must not stretch the shadow map over a landscape.
constexpr double kShadowReach = 3;  // sizes of the scene

// As body.vert does: a volume that fits the edges as they are drawn leaves no specks along joints.
double sharpenedAt(double far) {
  constexpr double kChamfer = 0.0022, kFrom = 0.8, kTo = 2.2;  // m
  const double t = std::clamp((far - kFrom) / (kTo - kFrom), 0.0, 1.0);
  return kChamfer * t * t * (3 - 2 * t);
}

}  // namespace

BodyDrawer::BodyDrawer(Renderer& renderer)
    : renderer_(renderer),
      node_(renderer.scene().getRootSceneNode()->createChildSceneNode()),
      looks_(renderer.fine()),
      depth_(renderer.scene()) {
  Ogre::Root::getSingleton().addMovableObjectFactory(&volumesFactory_);
  volumes_ = static_cast<ShadowVolumes*>(renderer_.scene().createMovableObject("volumes", ShadowVolumesFactory::kType));
  node_->attachObject(volumes_);
  volumes_->setVisible(false);
}

BodyDrawer::~BodyDrawer() {
  renderer_.scene().destroyMovableObject(volumes_);
  Ogre::Root::getSingleton().removeMovableObjectFactory(&volumesFactory_);
}

BodyDrawer::Batch& BodyDrawer::batchFor(const ShapeDef& shape, const ListedBody& body) {
  const SurfaceKey surface = surfaceOf(body, shape);
  Batch& batch = batches_[{surface, meshKey(shape)}];
  if (batch.drawn) return batch;
  const DrawMesh mesh = drawMeshOf(shape, surface);
  batch.surface = surface;
  batch.drawn = std::make_unique<InstanceBatch>(mesh);
  batch.drawn->setCastShadows(!surface.plane);
  if (!surface.plane) batch.shadow = std::make_unique<ShadowShape>(mesh);
  useMaterial(batch);
  node_->attachObject(batch.drawn.get());
  return batch;
}

void BodyDrawer::useMaterial(Batch& batch) { batch.drawn->setMaterial(looks_.material(batch.surface, shadows_)); }

void BodyDrawer::setSun(Vec3 towardsSun) {
  sun_ = towardsSun;
  looks_.setSun(towardsSun);
  renderer_.setSun(towardsSun);
}

void BodyDrawer::setShadows(ShadowMode mode) {
  shadows_ = mode;
  renderer_.setShadows(mode);
  volumes_->setVisible(mode == ShadowMode::stencil);
  for (auto& [key, batch] : batches_) useMaterial(batch);
}

void BodyDrawer::list(const BodyList& bodies) {
  pieces_.clear();
  for (std::size_t i = 0; i < bodies.bodies.size(); i++) {
    const ListedBody& body = bodies.bodies[i];
    for (const ShapeDef& shape : body.shapes) {
      Piece piece;
      piece.body = int(i);
      piece.batch = &batchFor(shape, body);
      piece.local = shape.local;
      if (isScaled(shape)) piece.scale = Vec3{1, 1, 1} * shape.radius;
      piece.usual = instanceOf(body, piece.batch->surface);
      piece.ball = isScaled(shape);
      piece.usual.ball = piece.ball ? 1 : 0;
      piece.casts = piece.batch->shadow != nullptr;
      pieces_.push_back(std::move(piece));
    }
  }
}

void BodyDrawer::tint(Instance& instance, const BodyTint& tint, bool flat) {
  if (tint.strength <= 0) return;
  const auto colour = parts(tint.colour);
  // The polygon view shows the tint alone, so there it must hold the body's own colour as well.
  for (int k = 0; k < 3; k++)
    instance.tint[k] = flat ? instance.tint[k] + (colour[k] - instance.tint[k]) * tint.strength : colour[k];
  instance.tinted = tint.strength;
}

void BodyDrawer::draw(const Frame& frame, double blend, const ViewOptions& options, const View& view, Serial glowing) {
  if (frame.list != listed_) {
    listed_ = frame.list;
    list(*listed_);
  }
  if (options.wireframe != flat_) {
    flat_ = options.wireframe;
    looks_.setFlat(flat_);
  }
  for (auto& [key, batch] : batches_) batch.instances.clear();
  for (const Piece& piece : pieces_) {
    const ListedBody& body = listed_->bodies[std::size_t(piece.body)];
    const FrameBody& state = frame.bodies[std::size_t(piece.body)];
    Instance instance = piece.usual;
    instance.setPose(poseAt(state, blend) * piece.local, piece.scale);
    tint(instance, tintOf(body, state, options), options.wireframe);
    if (glowing != 0 && body.serial == glowing) instance.glow = 0.35f;
    piece.batch->instances.push_back(instance);
  }
  for (auto& [key, batch] : batches_) batch.drawn->setInstances(batch.instances);
  castShadows(frame, blend, view);
}

void BodyDrawer::castShadows(const Frame& frame, double blend, const View& view) {
  if (shadows_ == ShadowMode::none) return;
  const Aabb extent = frame.info->extent;
  const Vec3 middle = (extent.lower + extent.upper) * 0.5;
  const double reach = kShadowReach * (length(extent.upper - extent.lower) / 2 + 0.5);
  Aabb casters{middle, middle};
  geometry_.clear();
  for (const Piece& piece : pieces_) {
    if (!piece.casts) continue;
    const Transform pose = poseAt(frame.bodies[std::size_t(piece.body)], blend);
    const double radius = listed_->bodies[std::size_t(piece.body)].radius;
    if ((radius <= reach && length(pose.position - middle) < reach + radius) || shadows_ == ShadowMode::stencil) {
      casters = merged(casters, grown({pose.position, pose.position}, radius));
    }
    if (shadows_ == ShadowMode::stencil) {
      const Transform place = pose * piece.local;
      if (piece.ball) {
        geometry_.addBall(place.position, piece.scale.x, sun_);
        continue;
      }
      const double far = dot(place.position - view.position, view.forward());
      geometry_.add(*piece.batch->shadow, place, piece.scale, sun_, piece.batch->surface.faces ? sharpenedAt(far) : 0);
    }
  }
  if (shadows_ == ShadowMode::stencil) {
    volumes_->set(geometry_, casters);
  } else {
    depth_.fit(casters, sun_);
  }
}

}  // namespace brickfall::viewer
