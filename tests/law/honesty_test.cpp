// Rows 9, 15a, 15b: a wall can be made to stand by glue; these find out.
#include "law/law.h"

namespace brickfall::law {
namespace {

void runScene(lab::Scene& s, double seconds, double dt) { run(s.world, seconds, dt); }

TEST(Law, Row9HarmonicOverhang) {
  // Block i from the top is shifted by L / (2 i) over the next: 99 % of it stands, 101 % falls.
  double L = 0.4, H = 0.1;
  for (int n : {4, 10})
    for (double share : {0.99, 1.01}) {
      World world = awakeWorld();
      BodyDef table = bodyOf(boxOf({1, 0.5, 0.5}, 1000, 1), {-1, -0.5, 0}, BodyType::fixed);
      add(world, table);
      std::vector<double> edge(std::size_t(n) + 1, 0);  // right end of block k from the bottom
      double right = 0;
      std::vector<BodyId> blocks;
      for (int k = 0; k < n; k++) {
        right += share * L / (2 * (n - k));
        blocks.push_back(add(world, bodyOf(boxOf({L / 2, H / 2, 0.1}, 1000, 1), {right - L / 2, H * (k + 0.5), 0})));
      }
      std::vector<Vec3> start;
      for (BodyId b : blocks) start.push_back(world.state(b)->position);
      if (share > 1)
        reached("overhang / L of " + std::to_string(n), right / L / share, n == 4 ? 1.04167 : 1.46448, 1e-4, "");
      run(world, 10);
      double moved = 0;
      for (std::size_t i = 0; i < blocks.size(); i++)
        moved = std::max(moved, length(world.state(blocks[i])->position - start[i]));
      if (share < 1)
        atMost(std::to_string(n) + " blocks at 99 %: moved", moved * 1e3, 2, "mm");
      else
        EXPECT_GT(moved, 0.05) << n << " blocks at 101 % did not fall";
    }
}

TEST(Law, Row15aWallInFreeFallIsNotHeld) {
  for (double dt : {1.0 / 60, 1.0 / 120}) {
    lab::Scene s = lab::make("fall");
    runScene(s, 0.5, dt);
    double low = 1e9, high = 0;
    for (std::size_t i = 0; i < s.boxes.size(); i++) {
      double fell = s.start[i].y - s.world.state(s.boxes[i])->position.y;
      low = std::min(low, fell);
      high = std::max(high, fell);
    }
    reached("fell" + at(dt), low, 1.22625, 1e-3 * 1.22625, "m");
    atMost("spread" + at(dt), (high - low) * 1e3, 0.1, "mm");
  }
}

TEST(Law, Row15aBallIntoAFloatingWallKeepsMomentum) {
  for (double dt : {1.0 / 60, 1.0 / 120})
    for (double e : {0.0, 0.5}) {
      lab::Options o;
      o.restitution = e;
      lab::Scene s = lab::make("hit0", o);
      double before = s.world.linearMomentum().z, energy = s.world.energy().kinetic;
      Vec3 spin = s.world.angularMomentum();
      runScene(s, 0.7, dt);
      std::string name = "e " + std::to_string(e).substr(0, 3) + at(dt);
      reached("momentum ratio " + name, s.world.linearMomentum().z / before, 1, 1e-3, "");
      atMost("angular momentum drift " + name, length(s.world.angularMomentum() - spin) / length(spin), 1e-2, "");
      atMost("energy ratio " + name, s.world.energy().kinetic / energy, 1.0001, "");
    }
}

TEST(Law, Row15aCorbelOf21mmStandsAnd22mmFalls) {
  for (double dt : {1.0 / 60, 1.0 / 120}) {
    lab::Scene stands = lab::make("cor21"), falls = lab::make("cor22");
    lab::Measured a = lab::run(stands, 5, dt), b = lab::run(falls, 3, dt);
    atMost("21 mm: moved" + at(dt), a.largestMove * 1e3, 1, "mm");
    EXPECT_GT(b.collapseTime, 0) << "22 mm stands";
    atMost("22 mm: fallen 50 mm after" + at(dt), b.collapseTime, 1.5, "s");
  }
}

TEST(Law, Row15aTiltedBlockFallsInItsTime) {
  for (double dt : {1.0 / 60, 1.0 / 120, 1.0 / 240}) {
    lab::Scene s = lab::make("topple");
    lab::Measured m = lab::run(s, 2, dt);
    reached("60 degrees after" + at(dt), m.toppleTime, 1.711, 0.02 + dt, "s");
  }
}

TEST(Law, Row15aBoxSlidesAsFarAsItMust) {
  for (double dt : {1.0 / 60, 1.0 / 240}) {
    lab::Scene s = lab::make("stop");
    lab::Measured m = lab::run(s, 2, dt);
    reached("way" + at(dt), m.slid, 9 / (2 * 0.6 * kG) - 1.5 * dt, 2e-3, "m");  // implicit Euler: v0 dt / 2 less
  }
}

TEST(Law, Row15bWallDroppedFlatLandsAndStands) {
  for (double dt : {1.0 / 60, 1.0 / 120}) {
    lab::Scene s = lab::make("drop");
    lab::Measured m = lab::run(s, 4, dt);
    double spread = m.fellMax - m.fellMin;
    atMost("disturbed" + at(dt), std::max(spread, m.outOfPlane) * 1e3, 5, "mm");
    atMost("energy rise" + at(dt), m.energyRise, 1e-3, "J");
    EXPECT_TRUE(m.finite);
    expectSound(s.world);
  }
}

}  // namespace
}  // namespace brickfall::law
