// Accelerations summed up: the sums are those of the accelerations, and end as they are said to.
#include "brickfall/machines.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

Shake odd(ShakeSignal signal) {
  Shake shake;
  shake.signal = signal;
  shake.start = 0.3;
  shake.amplitude = 4;
  shake.frequency = 3;
  shake.seconds = 2;
  shake.ramp = 0.4;
  double t = 7;
  for (double a : {0.0, 2.0, -1.0, 4.0, 0.5, -3.0, 0.0, 1.0}) {
    shake.record.times.push_back(t);
    shake.record.values.push_back(a);
    t += 0.05 + 0.02 * std::fabs(a);
  }
  return shake;
}

TEST(Shake, VelocityAndWayAreTheSumsOfTheAcceleration) {
  for (ShakeSignal signal : {ShakeSignal::record, ShakeSignal::sine, ShakeSignal::fullPulse, ShakeSignal::halfPulse,
                             ShakeSignal::squarePulse}) {
    const ShakeMotion motion = *ShakeMotion::create(odd(signal));
    double velocity = motion.at(0).velocity, way = 0;
    const double h = 1e-4;
    int k = 0;
    for (; k * h < 2.6; k++) {
      way += (motion.at(k * h).velocity + motion.at((k + 1) * h).velocity) * h / 2;
      velocity += motion.at((k + 0.5) * h).acceleration * h;
      if (k % 500 != 0) continue;
      EXPECT_NEAR(motion.at((k + 1) * h).velocity, velocity, 2e-3) << int(signal) << " at " << k * h;
      EXPECT_NEAR(motion.at((k + 1) * h).displacement, way, 1e-5) << int(signal) << " at " << k * h;
    }
    EXPECT_EQ(motion.at(0.3).displacement, 0);
  }
}

TEST(Shake, EndsAtRestWhereItIsSaidTo) {
  for (ShakeSignal signal : {ShakeSignal::record, ShakeSignal::sine, ShakeSignal::fullPulse}) {
    const ShakeMotion motion = *ShakeMotion::create(odd(signal));
    EXPECT_TRUE(motion.endsAtRest()) << int(signal);
    EXPECT_NEAR(motion.at(motion.end() - 1e-9).velocity, 0, 1e-6) << int(signal);
    EXPECT_NEAR(motion.at(motion.end() - 1e-9).displacement, motion.at(100).displacement, 1e-6) << int(signal);
  }
  EXPECT_EQ(ShakeMotion::create(odd(ShakeSignal::record))->at(100).displacement, 0);
  EXPECT_GT(ShakeMotion::create(odd(ShakeSignal::record))->correction(), 0.1);
  EXPECT_FALSE(ShakeMotion::create(odd(ShakeSignal::halfPulse))->endsAtRest());
  Shake raw = odd(ShakeSignal::record);
  raw.baseline = Baseline::none;
  const ShakeMotion motion = *ShakeMotion::create(raw);
  EXPECT_EQ(motion.correction(), 0);
  EXPECT_NE(motion.at(50).velocity, 0);
  EXPECT_EQ(motion.at(motion.start() + 0.05).acceleration, 8) << "a sample as it is, times the factor";
}

TEST(Shake, RefusesWhatIsNoShake) {
  const auto fault = [](auto change) {
    Shake shake = odd(ShakeSignal::sine);
    change(shake);
    const auto motion = ShakeMotion::create(shake);
    return motion.ok() ? std::string() : motion.error().message;
  };
  EXPECT_NE(fault([](Shake& s) { s.direction = {}; }), "");
  EXPECT_NE(fault([](Shake& s) { s.direction.y = NAN; }), "");
  EXPECT_NE(fault([](Shake& s) { s.amplitude = NAN; }), "");
  EXPECT_NE(fault([](Shake& s) { s.frequency = 0; }), "");
  EXPECT_NE(fault([](Shake& s) { s.ramp = 0; }), "");
  EXPECT_NE(fault([](Shake& s) { s.ramp = 1.5; }), "");
  EXPECT_NE(fault([](Shake& s) { s.seconds = -1; }), "");
  EXPECT_NE(fault([](Shake& s) { s.signal = ShakeSignal::record, s.record.values[2] = NAN; }), "");
  EXPECT_NE(fault([](Shake& s) { s.signal = ShakeSignal::record, s.record.times[2] = 0; }), "");
  EXPECT_NE(fault([](Shake& s) { s.signal = ShakeSignal::record, s.record.times.pop_back(); }), "");
  EXPECT_EQ(fault([](Shake&) {}), "");
}

}  // namespace
}  // namespace brickfall
