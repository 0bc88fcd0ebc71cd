// Row 30g, limits: a bound that is reached within a step holds where the step ends, as a contact does that is met within it,
// whichever of its two bounds it is and however many joints in a row reach theirs. Whatever way all of it is turned: what
// lies in a plane of the axes stays in it, and cones that only held there passed their bounds by .4 rad.
#include <algorithm>
#include <functional>

#include "law/joint_parts.h"

namespace brickfall::law {
namespace {

struct Bounded {
  explicit Bounded(Quat turned) : turn(turned) { EXPECT_TRUE(world.setGravity(rotate(turn, world.gravity())).ok()); }
  World world = makeWorld();
  Quat turn;
  std::vector<JointId> joints;
  std::vector<BodyId> bodies;
  double bound = 0;  // m or rad: of positions, either way; 0: only what the joints tell
  BodyId add(const ShapeDef& shape, Vec3 position, BodyType type = BodyType::dynamic) {
    BodyDef def = bodyOf(shape, rotate(turn, position), type);
    def.rotation = turn;
    return law::add(world, def);
  }
  BodyId addFixed(Vec3 position) { return add(boxOf({0.1, 0.1, 0.1}), position, BodyType::fixed); }
  void tie(JointDef def, BodyId a, BodyId b) {
    def.anchor = rotate(turn, def.anchor);
    if (def.anchorB) def.anchorB = rotate(turn, *def.anchorB);
    def.axis = rotate(turn, def.axis);
    joints.push_back(join(world, def, a, b));
    bodies.push_back(b);
  }
  BodyId last() const { return bodies.back(); }
};

// Fourteen rods of steel and a ball of 1.4 t on slides, which fall from the middle of their range.
void slidesInARow(Bounded& s, double bound) {
  s.bound = bound;
  s.tie(at(JointType::spherical, {0, 20, 0}), s.addFixed({0, 20, 0}),
        s.add(cylinderOf(0.02, 0.125, 7850), {0, 19.875, 0}));
  for (int i = 1; i <= 14; i++) {
    const ShapeDef shape = i < 14 ? cylinderOf(0.02, 0.125, 7850) : sphereOf(0.35, 7850);
    JointDef def = at(JointType::prismatic, {0, 20 - 0.25 * i, 0}, {0, -1, 0});
    def.limit = JointDef::Limit{-bound, bound};
    s.tie(def, s.last(), s.add(shape, {0, 20 - 0.25 * i - (i < 14 ? 0.125 : 0.35), 0}));
  }
}
// Ten boards that stand out level and fall: on hinges, or on ball joints with a cone and a twist.
void boardsInARow(Bounded& s, JointType type, double bound) {
  s.bound = type == JointType::revolute ? bound : 0;
  for (int i = 0; i < 10; i++) {
    JointDef def = at(type, {0.09 + 0.22 * i, 20, 0}, type == JointType::revolute ? Vec3{0, 0, 1} : Vec3{1, 0, 0});
    def.limit = JointDef::Limit{-bound, bound};
    if (type == JointType::spherical) def.cone = bound;
    const BodyId from = i == 0 ? s.addFixed({0, 20, 0}) : s.last();
    s.tie(def, from, s.add(boxOf({0.1, 0.02, 0.05}), {0.2 + 0.22 * i, 20, 0}));
  }
}
// A block on a slide along a rod that swings.
void slideOnARod(Bounded& s) {
  const BodyId rod = s.add(boxOf({1, 0.05, 0.05}), {1.1, 20, 0});
  s.tie(at(JointType::revolute, {0, 20, 0}), s.addFixed({0, 20, 0}), rod);
  JointDef def = at(JointType::prismatic, {1, 20.3, 0}, {1, 0, 0});
  def.limit = JointDef::Limit{-0.5, 0.5};
  s.tie(def, rod, s.add(boxOf({0.1, 0.1, 0.1}), {1, 20.3, 0}));
}
void ropesInARow(Bounded& s) {
  for (int i = 0; i < 10; i++) {
    const double low = i < 9 ? 0.25 : 0.55, top = 20 - 0.25 * i;
    JointDef def = at(JointType::rope, {0, top, 0});
    def.anchorB = Vec3{0, top - low, 0};
    def.length = low + 0.05;
    const BodyId from = i == 0 ? s.addFixed({0, 20, 0}) : s.last();
    s.tie(def, from, s.add(sphereOf(i < 9 ? 0.03 : 0.3, 7850), {0, top - low, 0}));
  }
}

void holds(const std::string& name, double dt, const std::function<void(Bounded&)>& make) {
  double beyond = 0, gained = 0;
  for (double degrees : {0.0, 0.01, 40.0}) {
    Bounded s(quatFromAxisAngle(normalized(Vec3{1, 2, 3}), degrees * kPi / 180));
    make(s);
    const double start = energyOf(s.world);
    double before = start, most = 0;
    for (int i = 0; i < std::lround(1 / dt); i++) {
      ASSERT_TRUE(s.world.step(dt).ok());
      for (JointId joint : s.joints) {
        const JointState state = *s.world.state(joint);
        beyond = std::max({beyond, state.error, state.turnError});
        if (s.bound > 0) beyond = std::max(beyond, std::fabs(state.position) - s.bound);
      }
      const double now = energyOf(s.world);
      most = std::max(most, now - before);
      before = now;
    }
    expectSound(s.world);
    EXPECT_GT(start - before, 0.1) << name;
    gained = std::max(gained, most / (start - before));
  }
  atMost(name + ": beyond a bound", dt, 1e3 * beyond, 0.1, "mm or mrad");
  atMost(name + ": gained in a step", dt, 1e3 * gained, 2, "thousandths of what fell");
}

}  // namespace

TEST(Law, Row30gABoundReachedWithinAStepHolds) {
  for (double dt : kSteps) {
    holds("fourteen slides of 5 mm", dt, [](Bounded& s) { slidesInARow(s, 0.005); });
    holds("fourteen slides of 20 mm", dt, [](Bounded& s) { slidesInARow(s, 0.02); });
    holds("ten hinges of 0.02 rad", dt, [](Bounded& s) { boardsInARow(s, JointType::revolute, 0.02); });
    holds("ten hinges of 0.1 rad", dt, [](Bounded& s) { boardsInARow(s, JointType::revolute, 0.1); });
    holds("ten cones of 0.1 rad", dt, [](Bounded& s) { boardsInARow(s, JointType::spherical, 0.1); });
    holds("a slide on a rod that swings", dt, slideOnARod);
    holds("ten ropes, 50 mm slack", dt, ropesInARow);
  }
}

}  // namespace brickfall::law
