// A plate that lay on one edge had no points at the other while that was further away than the margin. It fell through the ground
// with it within a step. Worlds of law 18u; the last is a capsule that turns and rolls: its end was pressed in by the arc of both.
#include "law/random_world.h"

namespace brickfall {
namespace {

using law::RandomKind;

void expectWorldSound(RandomKind kind, int seed) {
  law::RandomWorld random = law::drawWorld(kind, seed);
  const law::RandomOutcome found = law::runWorld(random);
  EXPECT_LE(found.deep, 1) << random.text;
  EXPECT_EQ(found.through, 0) << random.text;
  EXPECT_LE(found.gain, 1e-6) << random.text;
}

TEST(Regression, FarEndOfAPlateStaysAboveGround) {
  for (int seed : {703, 3047, 6855, 7484, 8809, 9745}) expectWorldSound(RandomKind::ground, seed);
}

// Grains that gravity moved by more than their size in a step were found by nothing but the cores of the obstacles.
TEST(Regression, GrainsThatFallFarStayAboveGround) {
  for (int seed : {5664, 6100, 9149}) expectWorldSound(RandomKind::ground, seed);
}

// Ties of a solve that failed gave more than they held, or bodies had gone where no energy could have taken them: up to three
// times what there was.
TEST(Regression, FailedSolvesGainNothing) {
  for (int seed : {2606, 3836}) expectWorldSound(RandomKind::ground, seed);
  for (int seed : {668, 1179}) expectWorldSound(RandomKind::plate, seed);
  expectWorldSound(RandomKind::space, 1280);
}

// Bodies that turned by radians in a step ended deep in the ground, which lets go of a tenth in each step. On a belt grains won 14 %
// of their energy: it was found from afar, and its ties were taken to work.
TEST(Regression, BodiesThatTurnFarEndAboveGround) {
  for (int seed : {414, 1170, 3506, 3905}) expectWorldSound(RandomKind::ground, seed);
  for (int seed : {83, 1465, 20472}) expectWorldSound(RandomKind::belt, seed);
}

// Grains over hills flew ahead along the straight of their velocity. It led away from the slope below, and gravity into it: they
// were through before anybody looked.
TEST(Regression, WhatFallsOnItsWayStaysAboveHills) {
  for (int seed : {1063, 1726, 2581, 4198, 4703, 9127, 11362, 13752}) expectWorldSound(RandomKind::terrain, seed);
}

}  // namespace
}  // namespace brickfall
