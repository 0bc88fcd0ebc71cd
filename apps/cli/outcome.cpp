#include "cli/outcome.h"

#include <algorithm>

namespace brickfall::cli {
namespace {

double leastExtent(const BodyDef& def) {
  Aabb box{{1e30, 1e30, 1e30}, {-1e30, -1e30, -1e30}};
  for (const ShapeDef& shape : def.shapes) box = merged(box, bounds(shape, {}));
  const Vec3 size = box.upper - box.lower;
  return std::min({size.x, size.y, size.z});
}

}  // namespace

double overlapOf(const std::set<std::string>& a, const std::set<std::string>& b) {
  std::size_t both = 0;
  for (const std::string& name : a) both += b.count(name);
  const std::size_t either = a.size() + b.size() - both;
  return either == 0 ? 1 : double(both) / double(either);
}

double apartOf(const Outcome& a, const Outcome& b) {
  std::set<std::string> either = a.moved;
  either.insert(b.moved.begin(), b.moved.end());
  double sum = 0;
  int found = 0;
  for (const std::string& name : either) {
    const auto inA = a.ends.find(name), inB = b.ends.find(name);
    if (inA == a.ends.end() || inB == b.ends.end()) continue;
    sum += length(inA->second - inB->second);
    found++;
  }
  return found == 0 ? 0 : sum / found;
}

OutcomeWatch::OutcomeWatch(const SceneRun& run) {
  for (auto& [id, name] : run.joints()) joints_[id] = name;
  for (MortarId id : run.mortars()) mortars_.emplace(id, "mortar " + std::to_string(mortars_.size() + 1));
}

void OutcomeWatch::afterStep(const SceneRun& run) {
  for (const BreakEvent& event : run.world().events().breaks)
    if (const auto found = joints_.find(event.joint); found != joints_.end()) broken_.insert(found->second);
  for (const MortarEvent& event : run.world().events().mortar)
    if (const auto found = mortars_.find(event.mortar); event.broken && found != mortars_.end())
      broken_.insert(found->second);
}

Outcome OutcomeWatch::outcomeOf(const SceneRun& run) const {
  Outcome out;
  out.broken = broken_;
  for (const PlacedBody& body : run.bodies()) {
    const Result<BodyState> state = run.world().state(body.id);
    if (!state || body.def.type != BodyType::dynamic) continue;
    out.ends[body.name] = state->position;
    if (length(state->position - body.def.position) > 0.5 * leastExtent(body.def)) out.moved.insert(body.name);
  }
  return out;
}

}  // namespace brickfall::cli
