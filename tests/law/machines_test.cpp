// Row 20: what machines do to what stands: tables that tilt and shake, and arches against limit analysis.
#include "brickfall/machines.h"
#include "law/law.h"
#include "law/motion.h"

namespace brickfall::law {
namespace {

constexpr double kRadian = kPi / 180;

// The degrees at which a column of blocks on a table that tilts by a degree a second has slid by 1 mm, and how long that takes
// from the angle of friction on: x = g rate t^3 / (6 cos) at first.
double angleOfSliding(bool loads, double friction, double dt) {
  World world = makeWorld();
  const BodyId table = add(
      world, bodyOf(boxOf({2, 0.1, 2}, 1000, friction), {0, -0.1, 0}, loads ? BodyType::fixed : BodyType::kinematic));
  const BodyId block = add(world, bodyOf(boxOf({0.1, 0.0325, 0.05}, 1900, friction), {1.5, 0.0325, 0}));
  add(world, bodyOf(boxOf({0.1, 0.0325, 0.05}, 1900, friction), {1.5, 0.0975, 0}));
  Machines machines;
  const Tilt tilt{.angle = {{{1, 0}, {91, 90 * kRadian}}, Interpolation::linear}};
  EXPECT_TRUE((loads ? machines.tiltAll(world, tilt) : machines.tilt(world, table, tilt)).ok());
  double slid = 0;
  while (slid < 1e-3 && world.time() < 90) {
    EXPECT_TRUE(machines.act(world, world.time(), dt).ok());
    EXPECT_TRUE(world.step(dt).ok());
    const BodyState t = *world.state(table);
    slid = std::fabs(rotate(conjugate(t.rotation), world.state(block)->position - t.position).x - 1.5);
  }
  const double limit = std::atan(friction);
  const double late = std::cbrt(6e-3 * std::cos(limit) / (kG * kRadian));  // s
  return tilt.angle.at(world.time()) / kRadian - late;
}

TEST(Law, Row20aBlocksOnATiltTableSlideAtTheAngleOfFriction) {
  for (bool loads : {false, true})
    for (double friction : {0.3, 0.65})
      for (double dt : stepsOfLongCase({kDt})) {
        const double limit = std::atan(friction) / kRadian;
        reached({std::string(loads ? "gravity turned" : "table turned") + ", mu " + text(friction, 2) +
                     ": angle of sliding",
                 dt, angleOfSliding(loads, friction, dt), limit, 0.01 * limit, "degrees"});
      }
}

// A rigid block on a table: rocking about its edges, integrated finely (Housner's model, nothing made small).
struct Rocking {
  double tan = 0.15, height = 1;
  bool overturns(const ShakeMotion& table) const {
    const double b = height * tan / 2, h = height / 2, radius = std::sqrt(b * b + h * h), slant = std::atan2(b, h);
    const double p2 = 3 * kG / (4 * radius), dt = 2e-4;
    double angle = 0, spin = 0;
    const auto pull = [&](double at, double t) {
      return -p2 * (std::sin(slant - at) - table.at(t).acceleration / kG * std::cos(slant - at));
    };
    for (double t = 0; t < 4; t += dt) {
      if (angle <= 0 && pull(0, t) <= 0) {  // rests; pulses that end in one direction do not rock it back
        angle = spin = 0;
        if (t > table.end()) return false;
        continue;
      }
      const double k1 = pull(angle, t), k2 = pull(angle + spin * dt / 2, t + dt / 2),
                   k3 = pull(angle + (spin + k1 * dt / 2) * dt / 2, t + dt / 2),
                   k4 = pull(angle + (spin + k2 * dt) * dt, t + dt);
      angle += spin * dt + (k1 + k2 + k3) * dt * dt / 6;
      spin += (k1 + 2 * k2 + 2 * k3 + k4) * dt / 6;
      if (angle > 0.6) return true;
    }
    return false;
  }
};

bool engineOverturns(const Rocking& rocking, Shake pulse, double dt) {
  World world = makeWorld();
  const BodyId table = add(world, bodyOf(boxOf({20, 0.5, 20}, 1000, 2), {0, -0.5, 0}, BodyType::kinematic));
  const Vec3 half{rocking.height * rocking.tan / 2, rocking.height / 2, rocking.height / 4};
  const BodyId block = add(world, bodyOf(boxOf(half, 2000, 2), {0, half.y, 0}));
  Machines machines;
  pulse.start = 0.2;
  EXPECT_TRUE(machines.shake(world, table, pulse).ok());
  while (world.time() < 4) {
    EXPECT_TRUE(machines.act(world, world.time(), dt).ok());
    EXPECT_TRUE(world.step(dt).ok());
    const double up = toMatrix(world.state(block)->rotation).row[1].y;
    if (up < 0.8) return true;
    if (up > 0.99999 && world.time() > pulse.start + pulse.seconds + 0.2) return false;
  }
  return false;
}

template <class Overturns> double leastAmplitude(Overturns overturns) {
  double low = 1, high = 8;
  for (int i = 0; i < 10; i++) (overturns((low + high) / 2) ? high : low) = (low + high) / 2;
  return (low + high) / 2;
}

TEST(Law, Row20bPulsesOverturnASingleBlock) {
  const Rocking rocking;
  for (ShakeSignal signal : {ShakeSignal::halfPulse, ShakeSignal::squarePulse})
    for (double seconds : {0.3, 0.6}) {
      const auto pulse = [&](double amplitude) {
        return Shake{.signal = signal, .amplitude = amplitude, .seconds = seconds};
      };
      const double right = leastAmplitude([&](double a) { return rocking.overturns(*ShakeMotion::create(pulse(a))); });
      for (double dt : stepsOfLongCase({kDt})) {
        const double found = leastAmplitude([&](double a) { return engineOverturns(rocking, pulse(a), dt); });
        reached({std::string(signal == ShakeSignal::halfPulse ? "half a sine" : "square") + " of " + text(seconds, 1) +
                     " s: least acceleration that overturns",
                 dt, found, right, 0.03 * right, "m/s2"});
      }
    }
}

// Half a circle of `stones` stones of radius 1: does it stand for 5 s?
bool archStands(int stones, double thickness, double dt) {
  World world = makeWorld();
  addGround(world, 0.7);
  ShapeDef wedge = boxOf({}, 2400, 0.7);
  wedge.type = ShapeType::hull;
  const double half = kPi / stones / 2;
  for (double r : {1 - thickness / 2, 1 + thickness / 2})
    for (double side : {-1.0, 1.0})
      for (double z : {-0.15, 0.15}) wedge.vertices.push_back({side * r * std::sin(half), r * std::cos(half) - 1, z});
  std::vector<BodyId> all;
  for (int k = 0; k < stones; k++) {
    const Quat turn = quatFromAxisAngle({0, 0, 1}, kPi * (0.5 - (k + 0.5) / stones));
    BodyDef stone = bodyOf(wedge, rotate(turn, Vec3{0, 1, 0}));
    stone.rotation = turn;
    all.push_back(add(world, stone));
  }
  while (world.time() < 5 - dt / 2) EXPECT_TRUE(world.step(dt).ok());
  return world.state(all[std::size_t(stones / 2)])->position.y > 0.99;
}

TEST(Law, Row20cAnArchStandsFromItsLeastThicknessOn) {
  for (double dt : stepsOfLongCase({kDt})) {
    double low = 0.095, high = 0.12;
    for (int i = 0; i < 6; i++) (archStands(21, (low + high) / 2, dt) ? high : low) = (low + high) / 2;
    reached({"21 stones, half a circle: least thickness over radius", dt, (low + high) / 2, 0.1068, 0.01 * 0.1068, ""});
    reached({"27 stones, .115: stands (1 = yes)", dt, archStands(27, 0.115, dt) ? 1.0 : 0.0, 1, 0, ""});
    reached({"27 stones, .100: stands (1 = yes)", dt, archStands(27, 0.1, dt) ? 1.0 : 0.0, 0, 0, ""});
  }
}

}  // namespace
}  // namespace brickfall::law
