// A cube falls two metres to the ground and comes to rest. Shows the engine alone, as an installed library: a world, two
// bodies, the step, events, and how errors arrive.
#include <cmath>
#include <cstdio>

#include "brickfall/brickfall.h"

using namespace brickfall;

int main() {
  Result<World> created = World::create({});
  if (!created) {
    std::fprintf(stderr, "%s\n", created.error().message.c_str());
    return 1;
  }
  World& world = *created;

  BodyDef ground;
  ground.type = BodyType::fixed;
  ground.shapes.resize(1);
  ground.shapes[0].type = ShapeType::plane;  // everything below y = 0

  BodyDef cube;
  cube.shapes.resize(1);
  cube.shapes[0].halfExtents = {0.1, 0.1, 0.1};  // a box, as a shape is by default
  cube.position = {0, 2, 0};

  Result<BodyId> groundId = world.createBody(ground);
  Result<BodyId> cubeId = world.createBody(cube);
  if (!groundId || !cubeId) {
    std::fprintf(stderr, "%s\n", (groundId ? cubeId : groundId).error().message.c_str());
    return 1;
  }

  const double dt = 1.0 / 60;
  for (int i = 0; i < 180; i++) {
    Result<StepReport> report = world.step(dt);
    if (!report) {
      std::fprintf(stderr, "%s\n", report.error().message.c_str());
      return 1;
    }
    for (const HitEvent& hit : world.events().hits)
      std::printf("%.2f s: hits the ground at %.2f m/s, impulse %.1f N s\n", report->time, hit.approachSpeed,
                  hit.impulse);
    if (i % 30 == 0) std::printf("%.2f s: height %.3f m\n", report->time, world.state(*cubeId)->position.y);
  }
  Result<BodyState> end = world.state(*cubeId);
  std::printf("%.2f s: at rest at height %.3f m\n", world.time(), end->position.y);
  // It must lie on its side on the ground: its centre half a side above.
  return std::fabs(end->position.y - 0.1) < 0.005 ? 0 : 1;
}
