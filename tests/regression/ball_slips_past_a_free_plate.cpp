// A ball of 4 g at 200 to 400 m/s met a free plate of 1 m, 2 mm thick, after several metres within the step. The line of the
// contact force serves both bodies and ran half way between them, so friction had an arm of metres. The ball got as little as 3 %
// of the impulse of a plastic hit, was carried sideways and went past the plate's edge.
#include "law/draw.h"

namespace brickfall {
namespace {

using namespace law;

// The impulse that a ball gave a free plate, against that of a plastic hit without friction.
double shareOfPlasticHit(int seed, double dt) {
  constexpr double kRadius = 0.005, kSide = 1, kDensity = 1900;
  Draw draw(seed);
  WorldDef def;
  def.enableSleep = false;
  def.gravity = {};
  def.airDensity = 0;
  World world = makeWorld(def);
  auto shaped = [](ShapeDef s) {
    s.material.restitution = 0.5;
    s.material.friction = 0.4;
    return s;
  };
  BodyDef p = bodyOf(shaped(boxOf({kSide / 2, 0.001, kSide / 2}, kDensity)), {});
  const double degrees = draw.between(0, 28);  // one draw a statement: compilers may draw arguments in any order
  p.rotation = turn(draw.direction(), degrees);
  const BodyId plate = add(world, p);
  const Vec3 aim{draw.between(-.3, .3), 0, draw.between(-.3, .3)};
  const Vec3 way = normalized(Vec3{draw.between(-.3, .3), -1, draw.between(-.3, .3)});
  const double speed = draw.between(200, 400);
  BodyDef b = bodyOf(shaped(sphereOf(kRadius, 7800)), aim - way * (1 + speed * dt * draw.between(0, 3)));
  b.linearVelocity = way * speed;
  const Vec3 axis = draw.direction();
  b.angularVelocity = axis * draw.scale(1, 400);
  const BodyId ball = add(world, b);
  const Vec3 normal = rotate(p.rotation, Vec3{0, 1, 0});
  const Vec3 met = aim - way * (dot(aim, normal) / dot(way, normal));
  const double ballMass = world.state(ball)->mass, plateMass = world.state(plate)->mass;
  const double give = 1 / ballMass + 1 / plateMass + 12 * lengthSquared(met) / (plateMass * kSide * kSide);
  for (int i = 0; i < 8; i++) stepSound(world, dt);
  return ballMass * dot(world.state(ball)->linearVelocity - b.linearVelocity, normal) * give /
         (speed * -dot(way, normal));
}

TEST(Regression, BallHitsAFreePlate) {
  for (double dt : {1.0 / 30, 1.0 / 60, 1.0 / 120, 1.0 / 240, 1.0 / 480})
    for (int seed = 0; seed < 40; seed++)
      EXPECT_NEAR(shareOfPlasticHit(seed, dt), 1.5, 0.02) << "1/" << 1 / dt << " s, seed " << seed;
}

}  // namespace
}  // namespace brickfall
