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

constexpr double kPlateWider = 1.03, kPlateThick = 0.2;  // of joints: of half edges; of the smaller of these
constexpr float kPlateGlow = 0.12f;                      // their colours are to be compared with the legend's

// x and y: unit, at right angles.
Quat rotationFromAxes(Vec3 x, Vec3 y) {
  const Vec3 z = cross(x, y);
  const double four[4] = {1 + x.x - y.y - z.z, 1 - x.x + y.y - z.z, 1 - x.x - y.y + z.z, 1 + x.x + y.y + z.z};
  switch (std::max_element(four, four + 4) - four) {
    case 0:
      return normalized(Quat{four[0], x.y + y.x, z.x + x.z, y.z - z.y});
    case 1:
      return normalized(Quat{x.y + y.x, four[1], y.z + z.y, z.x - x.z});
    case 2:
      return normalized(Quat{z.x + x.z, y.z + z.y, four[2], x.y - y.x});
    default:
      return normalized(Quat{y.z - z.y, z.x - x.z, x.y - y.x, four[3]});
  }
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

BodyDrawer::Batch& BodyDrawer::batchFor(const ShapeDef& shape, const PartLook& look) {
  const SurfaceKey surface = surfaceOf(look, shape);
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
  if (plates_) plates_->setMaterial(looks_.material(plateSurface_, shadows_));
}

void BodyDrawer::list(const BodyList& bodies) {
  pieces_.clear();
  for (std::size_t i = 0; i < bodies.bodies.size(); i++) {
    const ListedBody& body = bodies.bodies[i];
    const std::vector<ShapeDef>& shapes = body.drawn.empty() ? body.shapes : body.drawn;
    for (std::size_t part = 0; part < shapes.size(); part++) {
      const ShapeDef& shape = shapes[part];
      const PartLook look = partLook(body, part);
      Piece piece;
      piece.body = int(i);
      piece.batch = &batchFor(shape, look);
      piece.local = shape.local;
      if (isScaled(shape)) piece.scale = Vec3{1, 1, 1} * shape.radius;
      piece.usual = instanceOf(look, piece.batch->surface);
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
  drawMortar(frame, blend, options);
  castShadows(frame, blend, view);
}

// Plates a little larger than the faces, so that their edges are seen.
void BodyDrawer::drawMortar(const Frame& frame, double blend, const ViewOptions& options) {
  std::vector<Instance> plates;
  for (const FrameMortar& joint : frame.mortar) {
    const bool broken = joint.damage >= 1;
    if (options.mortar == MortarView::none || (options.mortar == MortarView::utilisation && broken)) continue;
    const double first = length(joint.along1), second = length(joint.along2);
    if (!(first > 0 && second > 0)) continue;
    const Vec3 x = joint.along1 * (1 / first), y = joint.along2 * (1 / second);
    const Transform place{joint.centre, rotationFromAxes(x, y)};
    Instance plate;
    plate.setPose(poseAt(frame.bodies[std::size_t(joint.body)], blend) * place,
                  {first * kPlateWider, second * kPlateWider, 0.5 * kPlateThick * std::min(first, second)});
    tint(plate, {scaleColour(double(options.mortar == MortarView::damage ? joint.damage : joint.utilisation)), 1},
         false);
    plate.glow = kPlateGlow;
    plates.push_back(plate);
  }
  if (!plates_) {
    if (plates.empty()) return;
    ShapeDef unit;
    unit.halfExtents = {1, 1, 1};
    plateSurface_ = surfaceOf(PartLook{"mortar", BodyRole::body, 0xFFFFFF, 0}, unit);
    plates_ = std::make_unique<InstanceBatch>(drawMeshOf(unit, plateSurface_));
    plates_->setCastShadows(false);
    plates_->setMaterial(looks_.material(plateSurface_, shadows_));
    node_->attachObject(plates_.get());
  }
  plates_->setInstances(plates);
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
