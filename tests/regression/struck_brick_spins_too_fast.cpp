// A fast ball hits a brick in empty space beside its middle. In a step in which the brick turned by 0.5 to 3 rad it got
// up to 2.2 times its spin, and all of the energy that the impact had cost: where it pointed at the end was not on a
// free turn's way, on which energy stays.
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

TEST(Regression, StruckBrickKeepsTheEnergyOfTheHit) {
  for (double restitution : {0.0, 0.5})
    for (double speed : {20.0, 60.0})
      for (int rate : {60, 240})
        for (double when : {0.1, 0.5, 0.95}) {  // of the step in which they meet
          World world = emptySpace();
          ShapeDef box = boxOf({0.1075, 0.0325, 0.05125}, 1900, 0), ball = sphereOf(0.04, 7800, 0);
          box.material.restitution = ball.material.restitution = restitution;
          const BodyId brick = add(world, bodyOf(box, {}));
          const Vec3 place{0.08, 0.01, 0.05125}, normal{0, 0, -1};
          BodyDef shot = bodyOf(ball, place + Vec3{0, 0, 0.04 + speed * (3 + when) / rate});
          shot.linearVelocity = normal * speed;
          const BodyId shooter = add(world, shot);
          const MassProperties mass = *world.massProperties(brick);
          const double m = world.state(shooter)->mass, before = world.energy().kinetic;
          const Vec3 arm = cross(place, normal);
          const Vec3 spin{arm.x / mass.inertia.row[0].x, arm.y / mass.inertia.row[1].y, arm.z / mass.inertia.row[2].z};
          const double give = 1 / m + 1 / mass.mass + dot(arm, spin);
          const double kept = before - 0.5 * (1 - restitution * restitution) * speed * speed / give;
          for (int i = 0; i < 4; i++) stepSound(world, 1.0 / rate);
          const double energy = world.energy().kinetic;
          EXPECT_LT(length(world.state(shooter)->linearVelocity), 0.95 * speed) << "they met";
          EXPECT_LE(energy, kept + 0.01 * before)
              << restitution << ", " << speed << " m/s at 1/" << rate << " s, " << when;
        }
}

}  // namespace
}  // namespace brickfall
