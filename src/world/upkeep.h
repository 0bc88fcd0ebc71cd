// Keeps the owners in step with each other when a body is made, changed, woken or taken out: it makes the changes in
// every list. A call of the API or a stage changes several owners at once only in this way.
#pragma once
#include "dynamics/ties.h"
#include "world/activity.h"
#include "world/diary.h"
#include "world/proximity.h"
#include "world/registry.h"

namespace brickfall {

class Upkeep {
 public:
  Upkeep(Registry& registry, Activity& activity, Proximity& proximity, Ties& ties, Diary& diary)
      : registry_(registry), activity_(activity), proximity_(proximity), ties_(ties), diary_(diary) {}

  BodyIndex create(BodyPlan&& plan);
  void destroy(BodyIndex body);
  // Replaces the body by pieces, whose contacts go on with the memory of the body's contacts. The pieces get the body's
  // forces of the coming step.
  std::vector<BodyIndex> replace(BodyIndex body, std::vector<BodyPlan>&& pieces);
  void setType(BodyIndex body, BodyType type);
  void setLocks(BodyIndex body, std::uint8_t locks);
  void setEnabled(BodyIndex body, bool enabled);
  void setPose(BodyIndex body, Vec3 position, Quat rotation);
  void setMaterial(ShapeIndex shape, const Material& material);
  void setMass(BodyIndex body, const std::optional<MassProperties>& given);
  // Ties its bodies, which it wakes; contacts between them end unless it lets them collide.
  JointIndex join(const Joint& joint);
  void disturbJoint(JointIndex joint);  // it was changed from outside
  void unjoin(JointIndex joint);        // what it tied may collide from now on
  // Glues its bodies, which it wakes; contacts between them end.
  MortarIndex glue(const Mortar& mortar, const SharedStrength& shared, std::uint64_t userData);
  void unglue(MortarIndex mortar);   // it was taken away
  void crumble(MortarIndex mortar);  // it broke: what it held may collide from now on
  void relist(BodyIndex body);       // its velocity was set
  void isolate(BodyIndex body);      // a quarantined body: out of all ties and of every list that the step walks

  void disturb(BodyIndex body);       // its state was changed from outside: wakes the body and unsettles its island
  void wakeIslandOf(BodyIndex body);  // if the body sleeps
  void wakeAll();

 private:
  // A force and a torque about `at` for the coming step, shared by dynamic pieces so that they gain speed as one rigid
  // body would.
  void push(const std::vector<BodyIndex>& pieces, Vec3 at, Vec3 force, Vec3 torque);
  template <class Change> void remake(BodyIndex body, bool massChanges, Change change);
  template <class Tie> void disturbEnds(const Tie& tie);
  void meetAnew(BodyIndex a, BodyIndex b);
  void endTiesOf(BodyIndex body);  // of a body that goes
  void displace(BodyIndex body);   // a body that is put elsewhere, or becomes another: ties to its place end
  void tiesEnded(BodyIndex body);
  void renewProxies(BodyIndex body);
  void wakeTied(BodyIndex body);  // sleeping islands that something ties to the body
  void wakeIsland(std::size_t asleepIndex);

  Registry& registry_;
  Activity& activity_;
  Proximity& proximity_;
  Ties& ties_;
  Diary& diary_;
};

}  // namespace brickfall
