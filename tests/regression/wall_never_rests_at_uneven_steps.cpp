// Joints gave in a longer time step and grew firm in the next shorter one: walls moved for ever, at the cost of a hit, where steps
// were as long as a program's last picture took.
#include "law/motion.h"
#include "support/lab_scenes.h"

namespace brickfall {
namespace {

using namespace law;

// Ways in which steps vary.
struct Steps {
  double spread = 0;  // of 1/60 s, at random
  int dropped = 0;    // every so many is twice as long
};
// s, of step k.
double timeStep(const Steps& steps, int k, lab::LabRandom& random) {
  if (steps.dropped > 0) return k % steps.dropped == 0 ? 2 * kDt : kDt;
  return kDt * (1 + steps.spread * (2 * random.unit() - 1));
}

TEST(Regression, WallRestsWhereTimeStepsVary) {
  for (const Steps& steps :
       {Steps{0.01, 0}, Steps{0.1, 0}, Steps{0.3, 0}, Steps{0.5, 0}, Steps{0, 10}, Steps{0, 3}, Steps{0, 2}})
    for (int size : {1, 4, 8, 20}) {
      WallOf w;
      w.courses = w.bricks = size;
      BuiltWall wall = buildWall(w);
      lab::LabRandom random(size);
      double visits = 0, fastest = 0;
      for (int k = 0; k < 200; k++) {
        StepReport report = *wall.world.step(timeStep(steps, k, random));
        if (k < 120) continue;
        visits += report.solveVisits;
        for (BodyId brick : wall.bricks) fastest = std::max(fastest, length(wall.world.state(brick)->linearVelocity));
      }
      EXPECT_EQ(visits, 0) << size << " courses, spread " << steps.spread << ", dropped " << steps.dropped;
      EXPECT_EQ(fastest, 0) << size << " courses, spread " << steps.spread << ", dropped " << steps.dropped;
    }
}

// What was hit comes to rest, too, for about the visits that it takes at even steps, with as many bricks moved.
TEST(Regression, HitWallComesToRestWhereTimeStepsVary) {
  double even = 0;  // visits
  int evenMoved = 0;
  for (const Steps& steps : {Steps{}, Steps{0.1, 0}, Steps{0.3, 0}, Steps{0, 10}}) {
    WallOf w;
    w.bricks = 25;
    w.courses = 20;
    BuiltWall wall = buildWall(w);
    BodyDef ball = bodyOf(sphereOf(0.08, 7800), {wall.middle + 0.03, 0.8, 0.5});
    ball.linearVelocity = {0, 0, -5};
    add(wall.world, ball);
    lab::LabRandom random(3);
    double visits = 0, time = 0, fastest = 0;
    for (int k = 0; time < 4; k++) {
      double dt = timeStep(steps, k, random);
      visits += wall.world.step(dt)->solveVisits;
      time += dt;
    }
    for (BodyId brick : wall.bricks) fastest = std::max(fastest, length(wall.world.state(brick)->linearVelocity));
    EXPECT_EQ(fastest, 0) << "spread " << steps.spread << ", dropped " << steps.dropped;
    int moved = movedOver(wall, 0.05);
    if (even == 0) even = visits, evenMoved = moved;
    EXPECT_LT(visits, 2 * even) << "spread " << steps.spread << ", dropped " << steps.dropped;
    EXPECT_NEAR(moved, evenMoved, 3) << "spread " << steps.spread << ", dropped " << steps.dropped;
    EXPECT_GT(moved, 2) << "it must have been hit";
  }
}

}  // namespace
}  // namespace brickfall
