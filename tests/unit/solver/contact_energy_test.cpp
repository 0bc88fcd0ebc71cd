// No contact gives what it was not given: in every step of any motion, the work that a contact does and what it then holds is no more
// than what it held before (docs/contact-energy.md has the proof). Here for random points in every phase of their lives under random
// motions, and the closed forms of what is held.
#include "solver/contact/energy.h"

#include <gtest/gtest.h>

#include <cmath>

#include "math/random.h"
#include "support/test_island.h"

namespace brickfall {
namespace {

using test::kBrickWeight;
using test::OnGround;

double held(OnGround& lab) { return elasticEnergy(lab.contact(lab.face), lab.context); }

TEST(ContactEnergy, OfARestingPointIsThatOfItsSpringAndOfWhatDecays) {
  OnGround lab;
  double k = 1000 * lab.unit(lab.face), f = 40, gap = -f / k;
  lab.load(lab.face, 4 * f, k);
  EXPECT_NEAR(held(lab), 4 * f * f / (2 * k), 1e-6 * f * f / k) << "held in full: nothing decays";
  for (float& held : lab.points(lab.face).multiplierN) held = 0;
  double decays = k * gap;
  EXPECT_NEAR(held(lab), 4 * (0.5 * k * gap * gap + decays * decays / (6 * k)), 1e-6 * f * f / k);
  for (float& offset : lab.points(lab.face).offset) offset = float(gap);
  EXPECT_NEAR(held(lab), 0, 1e-12) << "plastic overlap holds nothing";
  lab.load(lab.face, 4 * f, k);
  for (float& offset : lab.points(lab.face).offset) offset = 0;
  for (float& drift : lab.points(lab.face).drift1) drift = 1e-5f;
  double shear = k * 1e-5;
  EXPECT_NEAR(held(lab), 4 * (f * f / (2 * k) + 0.5 * k * 1e-10 + shear * shear / (6 * k)), 1e-5 * f * f / k)
      << "an anchor that sticks";
}

TEST(ContactEnergy, WhatIsOpenOrFreshHoldsNothing) {
  OnGround lab;
  EXPECT_EQ(held(lab), 0);
  double k = 1000 * lab.unit(lab.face);
  lab.load(lab.face, 100, k);
  PointMemory& m = lab.points(lab.face);
  for (int i = 0; i < 4; i++) {
    m.gap[i] = 1e-4f;
    m.multiplierN[i] = m.forceN[i] = 0;
    m.drift1[i] = 1e-3f;
  }
  m.stickingMask = 0;
  EXPECT_EQ(held(lab), 0);
  // With a force left: it presses on below half of force / k, and further out it would have to come nearer first.
  for (double share : {0.4, 0.6, 1e6}) {
    for (int i = 0; i < 4; i++) {
      m.multiplierN[i] = m.forceN[i] = 25;
      m.gap[i] = float(share * 25 / k);
      m.drift1[i] = 0;
    }
    EXPECT_EQ(held(lab) > 0, share < 0.5) << share;
  }
}

TEST(ContactEnergy, AnImpactHoldsWhatARestingPointWouldUnderItsLastForce) {
  OnGround lab;
  double full = 1000 * lab.unit(lab.face), cap = 5 * kBrickWeight;
  for (double force : {0.5 * cap, cap, 20 * cap}) {
    lab.load(lab.face, 4 * force, 30 * lab.unit(lab.face));
    for (PointPhase& phase : lab.points(lab.face).phase) phase = PointPhase::impact;
    double left = std::min(force, cap);
    EXPECT_NEAR(held(lab), 4 * left * left / (2 * full), 1e-5 * left * left / full);
  }
}

enum class Start { resting, sliding, justOpened, open, closing, plastic };

// A step of the law from memory of every phase, the last force held in full, under any motion: the brick is moved by hand.
TEST(ContactEnergy, NoMotionDrawsMoreThanIsHeld) {
  Random random(71);
  double least = 1;  // gain / energy at work
  for (Start start : {Start::resting, Start::sliding, Start::justOpened, Start::open, Start::closing, Start::plastic})
    for (int n = 0; n < 400; n++) {
      OnGround lab({0.1, 0, 0});  // not calm: 1000 u
      double k = 1000 * lab.unit(lab.face), f = random.between(1, 200);
      lab.load(lab.face, 4 * f, k);
      PointMemory& m = lab.points(lab.face);
      for (int i = 0; i < 4; i++) {
        double angle = random.between(0, 6.28), size = random.between(0, 0.6) * f;
        if (start == Start::sliding) size = 0.6 * f;
        m.gap[i] *= float(random.between(0.2, 3));
        m.force1[i] = m.multiplier1[i] = float(size * std::cos(angle));
        m.force2[i] = m.multiplier2[i] = float(size * std::sin(angle));
        m.drift1[i] = float(-random.between(0, 1) * size * std::cos(angle) / k);
        m.drift2[i] = float(-random.between(0, 1) * size * std::sin(angle) / k);
        if (start == Start::sliding) {
          m.stickingMask = 0;
          m.slip1[i] = float(-double(m.force1[i]) / k);
          m.slip2[i] = float(-double(m.force2[i]) / k);
        }
        if (start == Start::justOpened) m.gap[i] = float(random.between(0, 2) * f / k);
        if (start == Start::open || start == Start::closing) {
          m.gap[i] = float(random.between(0, 2) * f / k);
          m.forceN[i] = m.multiplierN[i] = m.force1[i] = m.multiplier1[i] = m.force2[i] = m.multiplier2[i] = 0;
          m.drift1[i] = m.drift2[i] = 0;
          m.stickingMask = 0;
        }
        if (start == Start::plastic) m.offset[i] = m.gap[i] - float(f / k);
      }
      lab.prepare();  // return maps: what they renew is not the joint's work
      double before = held(lab);
      auto some = [&](double size) { return float(random.between(-size, size)); };
      float way = float(3 * f / k);
      SolveMotion& moved = lab.island().motion[0];
      moved.d = {some(double(way)), start == Start::closing ? -way : some(double(way)), some(double(way))};
      moved.th = {some(10.0 * double(way)), some(10.0 * double(way)), some(10.0 * double(way))};
      lab.island().ending = IslandEnding::balanced;
      storeRows(lab.island(), lab.ties(), lab.context);
      TieWork ofContacts = workOf(lab.island(), lab.context);
      double scale = before + std::fabs(ofContacts.work) + ofContacts.elastic,
             gain = ofContacts.work + ofContacts.elastic - before;
      EXPECT_LE(gain, 1e-5 * scale) << "start " << int(start) << ": held " << before << " J, then "
                                    << ofContacts.elastic << " J and " << ofContacts.work << " J of work";
      least = std::min(least, gain / scale);
    }
  EXPECT_LT(least, -0.5) << "most motions cost";
}

// While it neither opens nor slides, what is lost is (k C - m / 2)^2 / (2 k), m = h + k g: nothing at C = m / (2 k).
TEST(ContactEnergy, TheLossIsThatOfTheProof) {
  Random random(72);
  for (int n = 0; n < 200; n++) {
    OnGround lab({0.1, 0, 0});
    double k = 1000 * lab.unit(lab.face), f = random.between(50, 200);
    lab.load(lab.face, 4 * f, k);
    double more = random.between(0, 0.5) * f;  // deeper than its force says
    for (float& gap : lab.points(lab.face).gap) gap -= float(more / k);
    lab.prepare();
    double before = held(lab), m = -more;
    double C = n == 0 ? m / (2 * k) : random.between(-0.5, 0.5) * f / k;
    lab.island().motion[0].d = {0, float(C), 0};
    lab.island().ending = IslandEnding::balanced;
    storeRows(lab.island(), lab.ties(), lab.context);
    TieWork ofContacts = workOf(lab.island(), lab.context);
    EXPECT_NEAR(ofContacts.work, 4 * C * (f + more / 2 - k * C), 2e-5 * f * f / k);
    EXPECT_NEAR(ofContacts.work + ofContacts.elastic - before, -4 * (k * C - m / 2) * (k * C - m / 2) / (2 * k),
                2e-5 * f * f / k);
  }
}

}  // namespace
}  // namespace brickfall
