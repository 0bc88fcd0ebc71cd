#include "world/notes.h"

#include <cstdio>

#include "brickfall/notes.h"

namespace brickfall {
namespace {

template <class Set> int countOf(const Set& set, BodyIndex body) {
  int count = 0;
  for (const auto& tie : set.slots) count += tie.alive && (tie.bodyA == body || tie.bodyB == body);
  return count;
}

}  // namespace

void noteStep(const StepReport& report) {
  const NoteHandler handler = detail::noteHandler.load();
  if (!handler) return;
  char text[128];
  for (BodyId body : report.quarantined) {
    std::snprintf(text, sizeof text, "step %llu: body %u became non-finite or was lost; it is held where it was",
                  static_cast<unsigned long long>(report.stepIndex), body.index);
    handler({NoteKind::quarantined, text, report.stepIndex, body.index, 0});
  }
}

void noteTiesOf(BodyIndex body, const Registry& registry, const Ties& ties, std::uint64_t stepIndex) {
  const NoteHandler handler = detail::noteHandler.load();
  if (!handler) return;
  const int joints = countOf(ties.joints, body), mortar = countOf(ties.mortar, body);
  if (joints + mortar == 0) return;
  const std::uint32_t index = registry.idOf(body).index;
  char text[128];
  std::snprintf(text, sizeof text, "body %u is destroyed: %d joints and %d faces of mortar went with it", index, joints,
                mortar);
  handler({NoteKind::tiesEnded, text, stepIndex, index, joints + mortar});
}

}  // namespace brickfall
