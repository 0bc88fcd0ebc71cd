#include "viewer_core/picking.h"

#include <vector>

#include "brickfall/limits.h"
#include "brickfall/world.h"

namespace brickfall::viewer {

namespace {

constexpr double kFarthest = 1e6;  // m

}  // namespace

class Picker::Impl {
 public:
  std::optional<PickHit> pick(const Frame& frame, const Ray& ray, double blend) {
    place(frame, blend);
    if (!world_) return {};
    const Result<std::optional<RayHit>> found = world_->castRay(ray.origin, ray.direction, kFarthest);
    if (!found || !*found) return {};
    const RayHit& hit = **found;
    PickHit out;
    out.place = hit.body.index < placeByIndex_.size() ? placeByIndex_[hit.body.index] : -1;
    if (out.place < 0) return {};
    out.serial = frame.list->bodies[std::size_t(out.place)].serial;
    out.point = hit.pointWorld;
    out.local = transformPoint(inverse(stood_[std::size_t(out.place)].pose), hit.pointWorld);
    out.normal = hit.normalWorld;
    out.distance = hit.distance;
    return out;
  }

 private:
  struct Stood {
    BodyId id;  // null: it can't be hit (too far away)
    Transform pose;
  };

  // Another list: those that stayed keep their bodies.
  void take(const std::shared_ptr<const BodyList>& list) {
    std::vector<Stood> stood(list->bodies.size());
    std::vector<bool> kept(stood_.size(), false);
    for (std::size_t i = 0; i < stood.size(); i++) {
      const int was = list_ ? list_->find(list->bodies[i].serial) : -1;
      if (was < 0) continue;
      stood[i] = stood_[std::size_t(was)];
      kept[std::size_t(was)] = true;
    }
    for (std::size_t i = 0; i < stood_.size(); i++)
      if (!kept[i] && stood_[i].id) (void)world_->destroyBody(stood_[i].id).ok();
    stood_ = std::move(stood);
    list_ = list;
  }

  BodyId make(const ListedBody& body, const Transform& pose) {
    BodyDef def;
    def.type = BodyType::fixed;
    def.shapes = body.shapes;
    def.position = pose.position;
    def.rotation = pose.rotation;
    const Result<BodyId> id = world_->createBody(def);
    return id ? *id : BodyId{};
  }

  void place(const Frame& frame, double blend) {
    if (!world_) {
      WorldDef def;
      def.maxBodies = limits::kMostBodies;
      Result<World> world = World::create(def);
      if (!world) return;
      world_.emplace(std::move(*world));
    }
    const bool other = list_ != frame.list;
    if (other) take(frame.list);
    bool renumber = other;
    for (std::size_t i = 0; i < stood_.size(); i++) {
      Stood& s = stood_[i];
      const Transform pose = poseAt(frame.bodies[i], blend);
      if (s.id && pose.position == s.pose.position && pose.rotation == s.pose.rotation) continue;
      s.pose = pose;
      if (s.id && world_->setTransform(s.id, pose.position, pose.rotation)) continue;
      if (s.id) (void)world_->destroyBody(s.id).ok();
      s.id = make(frame.list->bodies[i], pose);
      renumber = true;
    }
    if (!renumber) return;
    std::fill(placeByIndex_.begin(), placeByIndex_.end(), -1);
    for (std::size_t i = 0; i < stood_.size(); i++) {
      const std::size_t index = stood_[i].id.index;
      if (!stood_[i].id) continue;
      if (index >= placeByIndex_.size()) placeByIndex_.resize(index + 1, -1);
      placeByIndex_[index] = int(i);
    }
  }

  std::optional<World> world_;
  std::shared_ptr<const BodyList> list_;
  std::vector<Stood> stood_;       // one for each of the list
  std::vector<int> placeByIndex_;  // by BodyId::index of this world
};

Picker::Picker() : impl_(std::make_unique<Impl>()) {}
Picker::~Picker() = default;

std::optional<PickHit> Picker::pick(const Frame& frame, const Ray& ray, double blend) {
  return impl_->pick(frame, ray, blend);
}

}  // namespace brickfall::viewer
