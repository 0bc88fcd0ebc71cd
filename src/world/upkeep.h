// Keeps the owners in step with each other when a body is made, changed, woken or taken out: what then must be done to
// which list. The one way in which a call of the API or a stage changes several of them at once.
#pragma once
#include "world/activity.h"
#include "world/diary.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

class Upkeep {
 public:
  Upkeep(Registry& registry, Activity& activity, Proximity& proximity, Diary& diary)
      : registry_(registry), activity_(activity), proximity_(proximity), diary_(diary) {}

  BodyIndex create(BodyPlan&& plan);
  void destroy(BodyIndex body);
  // By pieces, whose contacts go on with what those of the body remember. The body's forces of the coming step go to
  // them.
  std::vector<BodyIndex> replace(BodyIndex body, std::vector<BodyPlan>&& pieces);
  void setType(BodyIndex body, BodyType type);
  void setPose(BodyIndex body, Vec3 position, Quat rotation);
  void setMaterial(ShapeIndex shape, const Material& material);
  void relist(BodyIndex body);   // its velocity was set
  void isolate(BodyIndex body);  // a quarantined one: out of all contacts and of every list that the step walks

  void disturb(BodyIndex body);       // its state was changed from outside: wake it, nothing about it is settled
  void wakeIslandOf(BodyIndex body);  // if it sleeps
  void wakeAll();

 private:
  // A force and a torque about `at` for the coming step, shared by dynamic pieces so that they gain speed as one rigid
  // body would.
  void push(const std::vector<BodyIndex>& pieces, Vec3 at, Vec3 force, Vec3 torque);
  void removeContactsOf(BodyIndex body);
  void renewProxies(BodyIndex body);
  void wakeTouching(BodyIndex body);  // sleeping islands in contact with the body
  void wakeIsland(std::size_t asleepIndex);

  Registry& registry_;
  Activity& activity_;
  Proximity& proximity_;
  Diary& diary_;
};

}  // namespace brickfall
