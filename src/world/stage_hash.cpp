#include "world/stage_hash.h"

namespace brickfall {

std::string_view nameOf(const StageHash& hash) {
  return hash.stage && *hash.stage < Stage::count ? kStageNames[std::size_t(*hash.stage)] : "given";
}

void mix(Mix& h, const BodyMotion& m) { h(m.position, m.rotation, m.linearVelocity, m.angularVelocity); }
void mix(Mix& h, const SolvedMotion& s) { h(s.d, s.th, s.velocity, s.angularMomentum, s.freeTurn, s.rest, s.flying); }
void mix(Mix& h, const FreeMotion& f) { h(f.d, f.th, f.rotation, f.angularMomentum, f.startVelocity, f.startSpin); }

void HashItems::add(BodyId a, BodyId b, const Mix& item) {
  sum_(a.index, a.generation, b.index, b.generation, item.value());
  if (keep_) items_.push_back({a, b, item.value()});
}

StageHash HashItems::take(int substep, std::optional<Stage> stage) {
  return {substep, stage, sum_.value(), std::move(items_)};
}

void HashItems::solved(const IslandSet& islands, const StepContext& context) {
  auto write = [&](Mix& h, BodyIndex body) { mix(h, context.solved[body]); };
  bodies(islands.single, write);
  for (const IslandPointer& island : islands.awake)
    if (!island->settled()) bodies(island->bodies, write);
}

void HashItems::memories(const IslandSet& islands, const Ties& ties) {
  rows(islands, ties, [&](Mix& h, const Island&, const auto& kind, std::size_t k) { kind.hashMemory(h, k, ties); });
}

void hashGiven(const Registry& registry, const IslandSet& islands, const Ties& ties, HashItems& out) {
  const BodySet& bodies = registry.bodies;
  out.bodies(bodies.inOrder(), [&](Mix& h, BodyIndex body) {
    const BodyData& d = bodies.data[body];
    mix(h, bodies.motion[body]);
    h(int(d.type), int(d.activity), d.quarantined, d.gravityScale, d.linearDamping, d.angularDamping, d.dragArea,
      d.force, d.torque, d.turnEnergy, bodies.still[body]);
  });
  ties.eachAwake(out.links(ties));
  ties.eachAsleep(out.links(ties));
  for (const auto* list : {&islands.awake, &islands.asleep})
    out.islands(*list, [](Mix& h, const Island& i) { h(int(i.ending), i.restTime, i.inPlaceTime, i.fastestLately); });
}

}  // namespace brickfall
