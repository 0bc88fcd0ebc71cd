// Calls from inside callbacks: reading is fine, changing the world is refused, and the walk goes on as if nothing had been.
#include "refusal.h"

namespace brickfall {
namespace {

using namespace test;

// Everything that changes a world. Returns how many calls there were.
int expectAllRefused(LivedIn& s, const std::vector<std::byte>& snapshot) {
  World& w = s.world;
  int calls = 0;
  auto refused = [&](const auto& answer) {
    calls++;
    ASSERT_FALSE(answer.ok()) << "call " << calls;
    EXPECT_EQ(answer.error().code, ErrorCode::wrongState) << answer.error().message;
    EXPECT_NE(answer.error().message.find("callback"), std::string::npos) << answer.error().message;
  };
  refused(w.createBody(bodyOf(boxOf({1, 1, 1}), {})));
  refused(w.destroyBody(s.box));
  refused(w.setType(s.box, BodyType::fixed));
  refused(w.setTransform(s.box, {}, {}));
  refused(w.setLinearVelocity(s.box, {}));
  refused(w.setAngularVelocity(s.box, {}));
  refused(w.setGravityScale(s.box, 1));
  refused(w.setDamping(s.box, 1, 1));
  refused(w.setDragArea(s.box, 1));
  refused(w.setMassProperties(s.box, {}));
  refused(w.setContactFilter({}));
  refused(w.setGravity({}));
  refused(w.wake(s.sleeper));
  refused(w.sleep(s.box));
  refused(w.applyForce(s.box, {1, 0, 0}));
  refused(w.applyForceAtPoint(s.box, {1, 0, 0}, {}));
  refused(w.applyTorque(s.box, {1, 0, 0}));
  refused(w.applyImpulse(s.box, {1, 0, 0}));
  refused(w.applyImpulseAtPoint(s.box, {1, 0, 0}, {}));
  refused(w.applyAngularImpulse(s.box, {1, 0, 0}));
  refused(w.step(kDt));
  refused(w.restore(snapshot));
  return calls;
}

void expectReadable(const LivedIn& s) {
  const World& w = s.world;
  EXPECT_TRUE(w.state(s.box).ok());
  EXPECT_EQ(w.bodies().size(), 6u);
  EXPECT_TRUE(w.castRay({0, 5, 0}, {0, -1, 0}, 10).ok());
  EXPECT_GT(w.energy().kinetic, 0);
}

TEST(Callbacks, ForEachContactAllowsNoChange) {
  LivedIn s;
  std::vector<std::byte> snapshot = s.world.snapshot();
  Unchanged unchanged(s.world);
  int visits = 0, expected = 0;
  s.world.forEachContact([&](const ContactView&) { expected++; });
  s.world.forEachContact([&](const ContactView&) {
    visits++;
    EXPECT_EQ(expectAllRefused(s, snapshot), 22);
    expectReadable(s);
    int inner = 0;
    s.world.forEachContact([&](const ContactView&) { inner++; });
    EXPECT_EQ(inner, expected);
  });
  EXPECT_EQ(visits, expected);
  EXPECT_GE(visits, 2);
  unchanged.expectSame("after the walk");
  EXPECT_TRUE(s.world.applyForce(s.box, {1, 0, 0}).ok()) << "open again";
  stepSound(s.world);
}

TEST(Callbacks, DrawAllowsNoChange) {
  LivedIn s;
  std::vector<std::byte> snapshot = s.world.snapshot();
  Unchanged unchanged(s.world);
  int shapes = 0, points = 0, boxes = 0, lines = 0;
  DebugDraw draw;
  draw.shape = [&](BodyId, const ShapeDef&, const Transform&, std::uint32_t) {
    shapes++;
    expectAllRefused(s, snapshot);
    expectReadable(s);
  };
  draw.contact = [&](Vec3, Vec3, double) {
    points++;
    expectAllRefused(s, snapshot);
  };
  draw.bounds = [&](const Aabb&) {
    boxes++;
    expectAllRefused(s, snapshot);
  };
  draw.line = [&](Vec3, Vec3, std::uint32_t) {
    lines++;
    expectAllRefused(s, snapshot);
  };
  s.world.draw(draw);
  EXPECT_EQ(shapes, 6);
  EXPECT_EQ(boxes, 6);
  EXPECT_GT(points, 0);
  EXPECT_GT(lines, 0);
  unchanged.expectSame("after drawing");
  stepSound(s.world);
}

TEST(Callbacks, EmptyOnesAreSkipped) {
  LivedIn s;
  Unchanged unchanged(s.world);
  s.world.draw({});
  s.world.forEachContact({});
  unchanged.expectSame("nothing to call");
}

}  // namespace
}  // namespace brickfall
