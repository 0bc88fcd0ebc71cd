// Snapshots: a restored world goes on bit for bit, from any moment; a damaged one is refused and changes nothing.
#include <cstring>

#include "base/hash.h"
#include "math/random.h"
#include "support/lab_scenes.h"
#include "support/snapshot_worlds.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

// Everything at once: a small wall that is hit, a compound, a hull, a capsule, a platform, forces between steps.
struct Busy {
  World world = makeWorld();
  std::vector<BodyId> bricks;
  BodyId ball, platform;

  Busy() {
    addGround(world);
    for (int row = 0; row < 6; row++)
      for (int i = 0; i < 4; i++)
        bricks.push_back(addBox(world, {0.1, 0.05, 0.06}, {0.2 * i + 0.1 * (row % 2), 0.05 + 0.1 * row, 0}));
    BodyDef d = bodyOf(sphereOf(0.12, 6000), {0.4, 0.3, 6});
    d.linearVelocity = {0, 1, -4};
    ball = add(world, d);
    BodyDef two;
    two.shapes = {boxOf({0.1, 0.1, 0.1}), capsuleOf(0.05, 0.2)};
    two.shapes[1].local.position = {0.15, 0, 0};
    two.position = {3, 1, 0};
    two.angularVelocity = {1, 2, 3};
    add(world, two);
    add(world, bodyOf(hullOf(0.2), {-2, 1, 0}));
    BodyDef lift = bodyOf(boxOf({0.5, 0.05, 0.5}), {6, 0.05, 0}, BodyType::kinematic);
    lift.linearVelocity = {0.05, 0.1, 0};
    platform = add(world, lift);
    addBox(world, {0.1, 0.1, 0.1}, {6, 0.2, 0});
  }
  void advance(int step) {
    if (step == 30) {
      ASSERT_TRUE(world.applyImpulseAtPoint(bricks[3], {1, 0.5, 0}, {0.6, 0.05, 0}).ok());
    }
    if (step == 100) {
      ASSERT_TRUE(world.destroyBody(bricks[0]).ok());
    }
    if (step == 101) addBox(world, {0.1, 0.1, 0.1}, {0, 2, 0.02});
    if (step == 150) {
      ASSERT_TRUE(world.setLinearVelocity(platform, {}).ok());
    }
    stepSound(world);
  }
};

TEST(Snapshot, GoesOnBitForBitFromAnyMoment) {
  constexpr int kSteps = 220;
  std::vector<std::uint64_t> wanted;
  std::vector<std::vector<std::byte>> kept;
  Busy first;
  for (int i = 0; i < kSteps; i++) {
    kept.push_back(i % 11 == 0 ? first.world.snapshot() : std::vector<std::byte>{});
    first.advance(i);
    wanted.push_back(first.world.stateHash());
  }
  for (int from = 0; from < kSteps; from += 11) {
    Busy again;
    ASSERT_TRUE(again.world.restore(kept[std::size_t(from)]).ok());
    expectSound(again.world);
    EXPECT_EQ(again.world.stepCount(), std::uint64_t(from));
    EXPECT_NEAR(again.world.time(), from * kDt, 1e-9);
    for (int i = from; i < std::min(kSteps, from + 60); i++) {
      again.advance(i);
      ASSERT_EQ(again.world.stateHash(), wanted[std::size_t(i)])
          << "restored at " << from << ", differs after step " << i;
    }
  }
}

TEST(Snapshot, OfASleepingWallWakesInTheSameWay) {
  auto hit = [](World& world) {
    BodyDef ball = bodyOf(sphereOf(0.1, 7800), {1, 0.35, 0.5});
    ball.linearVelocity = {0, 0, -8};
    add(world, ball);
    for (int i = 0; i < 60; i++) stepSound(world);
    return world.stateHash();
  };
  lab::Options o;
  o.sleep = true;
  lab::Scene s = lab::make("w10", o);
  run(s.world, 1.5);
  ASSERT_FALSE(s.world.state(s.boxes[0])->awake);
  std::vector<std::byte> bytes = s.world.snapshot();
  std::uint64_t wanted = hit(s.world);
  for (int i = 0; i < 2; i++) {
    World other = makeWorld();
    ASSERT_TRUE(other.restore(bytes).ok());
    EXPECT_EQ(other.stepCount(), 90u);
    EXPECT_EQ(hit(other), wanted);
  }
}

// The stiffness of joints is that of a time step long past; how long steps have been steady counts, too.
TEST(Snapshot, GoesOnWithUnevenTimeSteps) {
  auto dtOf = [](int k) { return k < 30 ? kDt * (1 + 0.3 * (k * 7 % 5)) : 1.5 * kDt; };
  auto goOn = [&](World& world) {
    for (int k = 45; k < 80; k++) stepSound(world, dtOf(k));
    return world.stateHash();
  };
  lab::Scene s = lab::make("w10");
  BodyDef ball = bodyOf(sphereOf(0.1, 7800), {1, 0.35, 0.5});
  ball.linearVelocity = {0, 0, -8};
  add(s.world, ball);
  for (int k = 0; k < 45; k++) stepSound(s.world, dtOf(k));
  std::vector<std::byte> bytes = s.world.snapshot();
  World other = makeWorld();
  ASSERT_TRUE(other.restore(bytes).ok());
  EXPECT_EQ(goOn(other), goOn(s.world));
}

TEST(Snapshot, BetweenChangesAndTheNextStepHoldsThem) {
  Busy busy;
  for (int i = 0; i < 40; i++) busy.advance(i);
  // A destroyed, a new, a pushed, a moved and a changed body, all not stepped yet.
  ASSERT_TRUE(busy.world.destroyBody(busy.bricks[5]).ok());
  addBox(busy.world, {0.1, 0.1, 0.1}, {0, 3, 0});
  ASSERT_TRUE(busy.world.applyForce(busy.bricks[20], {50, 0, 0}).ok());
  ASSERT_TRUE(busy.world.setTransform(busy.bricks[21], {0, 4, 0}, turn({1, 1, 0}, 30)).ok());
  ASSERT_TRUE(busy.world.setType(busy.bricks[22], BodyType::fixed).ok());
  std::vector<std::byte> bytes = busy.world.snapshot();
  std::uint64_t before = busy.world.stateHash();
  auto go = [](World& world) {
    for (int i = 0; i < 30; i++) stepSound(world);
    return world.stateHash();
  };
  std::uint64_t wanted = go(busy.world);
  ASSERT_TRUE(busy.world.restore(bytes).ok());
  EXPECT_EQ(busy.world.stateHash(), before);
  EXPECT_EQ(go(busy.world), wanted);
}

TEST(Snapshot, IdsStayValidInTheRestoredWorld) {
  Busy busy;
  for (int i = 0; i < 10; i++) busy.advance(i);
  std::vector<std::byte> bytes = busy.world.snapshot();
  BodyState before = *busy.world.state(busy.ball);
  for (int i = 10; i < 20; i++) busy.advance(i);
  BodyId later = addBox(busy.world, {0.1, 0.1, 0.1}, {9, 9, 9});
  ASSERT_TRUE(busy.world.restore(bytes).ok());
  EXPECT_EQ(busy.world.state(busy.ball)->position, before.position);
  EXPECT_FALSE(busy.world.isValid(later)) << "created after the snapshot";
}

TEST(Snapshot, QuarantineIsKept) {
  World world = makeWorld();
  addGround(world);
  BodyId lost = addBox(world, {0.1, 0.1, 0.1}, {5, 5, 0});
  BodyId box = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  for (int i = 0; i < 2000 && !world.state(lost)->quarantined; i++) {
    (void)world.applyForce(lost, {1e12, 0, 0});
    ASSERT_TRUE(world.step(0.1).ok());
  }
  ASSERT_TRUE(world.state(lost)->quarantined);
  std::vector<std::byte> bytes = world.snapshot();
  stepSound(world);
  std::uint64_t wanted = world.stateHash();
  ASSERT_TRUE(world.restore(bytes).ok());
  EXPECT_TRUE(world.state(lost)->quarantined);
  EXPECT_FALSE(world.state(box)->quarantined);
  stepSound(world);
  EXPECT_EQ(world.stateHash(), wanted);
}

TEST(Snapshot, CutOffOrDamagedIsRefusedAndChangesNothing) {
  Busy busy;
  for (int i = 0; i < 30; i++) busy.advance(i);
  std::vector<std::byte> bytes = busy.world.snapshot();
  busy.advance(31);
  std::uint64_t before = busy.world.stateHash();
  Random random(7);
  for (std::size_t length = 0; length < bytes.size();
       length += 1 + random.below(1 + std::uint32_t(bytes.size() / 200))) {
    Status status = busy.world.restore(std::span(bytes).first(length));
    ASSERT_FALSE(status.ok()) << length;
    ASSERT_EQ(status.error().code, ErrorCode::badFormat);
    ASSERT_FALSE(status.error().message.empty());
  }
  for (int i = 0; i < 300; i++) {
    std::vector<std::byte> bad = bytes;
    bad[random.below(std::uint32_t(bad.size()))] ^= std::byte(1 + random.below(255));
    ASSERT_FALSE(busy.world.restore(bad).ok()) << i;
  }
  std::vector<std::byte> longer = bytes;
  longer.push_back({});
  EXPECT_FALSE(busy.world.restore(longer).ok());
  EXPECT_FALSE(busy.world.restore({}).ok());
  EXPECT_EQ(busy.world.stateHash(), before);
  expectSound(busy.world);
  stepSound(busy.world);
}

// What an attacker does: bytes changed and the checksum made right again. Either it is refused, and nothing changed, or a
// sound world comes of it that steps. (tests/fuzz goes on from here.)
TEST(Snapshot, ForgedWithItsChecksumIsRefusedOrSound) {
  constexpr std::size_t kHashAt = 16, kHeader = 24;
  Random random(11);
  int refused = 0, sound = 0;
  for (const std::vector<std::byte>& bytes : snapshotsOfEachKind()) {
    World world = smallWorld();
    ASSERT_TRUE(world.restore(bytes).ok());
    for (int i = 0; i < 250; i++) {
      std::vector<std::byte> forged = bytes;
      for (std::uint32_t changes = 1 + random.below(3); changes > 0; changes--) {
        std::size_t at = kHeader + random.below(std::uint32_t(forged.size() - kHeader));
        forged[at] = std::byte(random.below(4) == 0 ? 0xff : random.below(256));
      }
      Hash hash;
      for (std::size_t k = kHeader; k < forged.size(); k++) hash.addByte(std::uint8_t(forged[k]));
      std::uint64_t value = hash.value();
      std::memcpy(forged.data() + kHashAt, &value, sizeof value);
      World target = smallWorld();
      std::uint64_t before = target.stateHash();
      if (target.restore(forged).ok()) {
        sound++;
        for (int step = 0; step < 3; step++) ASSERT_TRUE(target.step(kDt).ok());
        expectSound(target);
      } else {
        refused++;
        ASSERT_EQ(target.stateHash(), before);
      }
    }
  }
  EXPECT_GT(refused, 200);
  EXPECT_GT(sound, 200);
}

TEST(Snapshot, EveryPrefixOfEveryKindIsRefused) {
  for (const std::vector<std::byte>& bytes : snapshotsOfEachKind()) {
    World world = smallWorld();
    std::uint64_t before = world.stateHash();
    for (std::size_t length = 0; length < bytes.size(); length += length < 200 ? 1 : 7)
      ASSERT_EQ(world.restore(std::span(bytes).first(length)).error().code, ErrorCode::badFormat) << length;
    EXPECT_EQ(world.stateHash(), before);
    EXPECT_TRUE(world.restore(bytes).ok());
  }
}

}  // namespace
}  // namespace brickfall
