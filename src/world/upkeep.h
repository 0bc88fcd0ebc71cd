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
  // By pieces, whose contacts go on with what those of the body remember.
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
