// Rays, overlaps and closest points of a whole world against a loop over its shapes.
#include "geometry/queries.h"
#include "geometry/hull.h"
#include "math/random.h"
#include "support/world_helpers.h"

namespace brickfall {
namespace {

using namespace test;

struct Placed {
  ShapeId id;
  BodyId body;
  Shape shape;
  Transform pose;
  std::uint32_t category;
};

// A world of all shapes in free motion, and the same shapes in a plain list.
class Crowd {
 public:
  explicit Crowd(std::uint64_t seed) : world(makeWorld()), random(seed) {
    addGround(world);
    for (int i = 0; i < 60; i++) {
      ShapeDef shapes[] = {boxOf({random.between(.05, .5), random.between(.05, .5), random.between(.05, .5)}),
                           sphereOf(random.between(.05, .5)),
                           capsuleOf(random.between(.05, .3), random.between(.05, .5)), hullOf(random.between(.1, .5))};
      BodyDef d = bodyOf(shapes[i % 4], {random.between(-4, 4), random.between(1, 6), random.between(-4, 4)});
      d.shapes[0].filter.category = 1u << (i % 3);
      d.rotation = {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), random.between(0.1, 1)};
      d.linearVelocity = {random.between(-5, 5), random.between(-5, 5), random.between(-5, 5)};
      d.angularVelocity = {random.between(-5, 5), random.between(-5, 5), random.between(-5, 5)};
      if (i % 5 == 0) {
        d.shapes.push_back(boxOf({.1, .1, .4}));
        d.shapes[1].local = {{.3, 0, .2}, normalized(Quat{.1, .5, 0, 1})};
      }
      add(world, d);
    }
    for (int i = 0; i < 40; i++) stepSound(world);
  }
  std::vector<Placed> list() {
    std::vector<Placed> out;
    hulls.clear();
    for (BodyId body : world.bodies())
      for (ShapeId id : world.shapes(body)) {
        ShapeDef def = *world.shape(id);
        Shape shape;
        shape.type = def.type;
        shape.halfExtents = def.halfExtents;
        shape.radius = def.radius;
        shape.halfHeight = def.halfHeight;
        if (def.type == ShapeType::hull) {
          hulls.push_back(std::make_unique<Hull>(std::move(buildHull(std::span<const Vec3>(def.vertices))).value()));
          shape.hull = hulls.back().get();
        }
        BodyState s = *world.state(body);
        out.push_back({id, body, shape, Transform{s.position, s.rotation} * def.local, def.filter.category});
      }
    return out;
  }
  Vec3 point() { return {random.between(-6, 6), random.between(-1, 6), random.between(-6, 6)}; }

  World world;
  Random random;
  std::vector<std::unique_ptr<Hull>> hulls;
};

TEST(Queries, RayFindsWhatALoopOverAllShapesFinds) {
  int hits = 0;
  for (std::uint64_t seed : {1, 2, 3}) {
    Crowd crowd(seed);
    std::vector<Placed> all = crowd.list();
    for (int i = 0; i < 400; i++) {
      Vec3 from = crowd.point(), along = crowd.point() - from;
      double reach = crowd.random.between(0.1, 12);
      std::uint32_t mask = i % 4 == 0 ? 2u : 0xffffffffu;
      double best = 1e30;
      for (const Placed& p : all) {
        if (!(p.category & mask)) continue;
        Transform back = inverse(p.pose);
        auto hit = castRay(p.shape, transformPoint(back, from), rotate(back.rotation, normalized(along)), reach);
        if (hit) best = std::min(best, hit->distance);
      }
      auto found = *crowd.world.castRay(from, along, reach, mask);
      ASSERT_EQ(found.has_value(), best < 1e30) << "seed " << seed << " ray " << i << " wanted " << best;
      if (!found) continue;
      hits++;
      EXPECT_NEAR(found->distance, best, 1e-9);
      expectNear(found->pointWorld, from + normalized(along) * found->distance, 1e-9);
      EXPECT_NEAR(length(found->normalWorld), 1, 1e-9);
      EXPECT_LE(dot(found->normalWorld, along), 1e-9);
    }
  }
  EXPECT_GT(hits, 200) << "too few rays hit anything";
}

TEST(Queries, ClosestFindsWhatALoopOverAllShapesFinds) {
  int found = 0, missed = 0;
  Crowd crowd(4);
  std::vector<Placed> all = crowd.list();
  for (int i = 0; i < 600; i++) {
    Vec3 at = crowd.point();
    at.y += 1;
    double reach = crowd.random.between(0.05, 2);
    double best = 1e30;
    for (const Placed& p : all) {
      Vec3 local = transformPoint(inverse(p.pose), at);
      best = std::min(best, length(closestPoint(p.shape, local) - local));
    }
    auto near = *crowd.world.closest(at, reach);
    ASSERT_EQ(near.has_value(), best <= reach) << i;
    if (!near) {
      missed++;
      continue;
    }
    found++;
    EXPECT_NEAR(near->distance, best, 1e-9);
    EXPECT_NEAR(length(near->pointWorld - at), best, 1e-9);
  }
  EXPECT_GT(found, 100);
  EXPECT_GT(missed, 50);
}

TEST(Queries, OverlapsFindWhatALoopOverAllShapesFinds) {
  int found = 0;
  Crowd crowd(5);
  std::vector<Placed> all = crowd.list();
  auto sorted = [](std::vector<BodyId> ids) {
    std::sort(ids.begin(), ids.end());
    ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
    return ids;
  };
  for (int i = 0; i < 300; i++) {
    Vec3 at = crowd.point();
    double radius = crowd.random.between(0.01, 1.5);
    std::vector<BodyId> sphere, box;
    Aabb region{at - Vec3{radius, radius, radius}, at + Vec3{radius, radius, radius} * 0.7};
    Shape regionShape;
    regionShape.halfExtents = (region.upper - region.lower) * 0.5;
    Transform regionPose{(region.upper + region.lower) * 0.5, {}};
    for (const Placed& p : all) {
      Vec3 local = transformPoint(inverse(p.pose), at);
      if (length(closestPoint(p.shape, local) - local) <= radius) sphere.push_back(p.body);
      if (penetrationDepth(regionShape, p.shape, inverse(regionPose) * p.pose) > 0) box.push_back(p.body);
    }
    std::vector<BodyId> gotSphere = *crowd.world.overlapSphere(at, radius), gotBox = *crowd.world.overlapBox(region);
    EXPECT_EQ(sorted(gotSphere), sorted(sphere)) << "sphere " << i;
    EXPECT_EQ(sorted(gotBox), sorted(box)) << "box " << i;
    EXPECT_EQ(gotSphere.size(), sorted(gotSphere).size()) << "a body twice";
    found += int(sphere.size() + box.size());
  }
  EXPECT_GT(found, 300);
}

// A body that an impact threw far within one step must be found where it is, not where it was.
TEST(Queries, SeeTheStateAfterTheStepEvenOfWhatWasJustStruck) {
  World world = emptySpace();
  BodyDef ball = bodyOf(sphereOf(0.3, 8000), {-1, 0, 0});
  ball.linearVelocity = {90, 0, 0};
  add(world, ball);
  BodyId brick = addBox(world, {0.1, 0.1, 0.1}, {0, 0, 0});
  for (int i = 0; i < 4; i++) {
    stepSound(world);
    Vec3 at = world.state(brick)->position;
    auto hit = *world.castRay(at + Vec3{0, 5, 0}, {0, -1, 0}, 10);
    ASSERT_TRUE(hit.has_value()) << "step " << i;
    EXPECT_EQ(hit->body, brick);
    std::vector<BodyId> inside = *world.overlapSphere(at, 0.01);
    ASSERT_EQ(inside.size(), 1u) << "step " << i;
    EXPECT_EQ(inside[0], brick);
    EXPECT_EQ((*world.closest(at, 0.01))->body, brick);
  }
  EXPECT_GT(world.state(brick)->position.x, 1);
}

TEST(Queries, AnyFiniteDirectionLengthIsFine) {
  World world = emptySpace();
  BodyId box = add(world, bodyOf(boxOf({1, 1, 1}), {}, BodyType::fixed));
  for (double scale : {1e-9, 1.0, 1e9, 1e160, 1e300}) {
    auto hit = world.castRay({0, 5, 0}, {0, -scale, 0}, 10);
    ASSERT_TRUE(hit.ok()) << scale << hit.error().message;
    ASSERT_TRUE(hit->has_value()) << scale;
    EXPECT_EQ((*hit)->body, box);
    EXPECT_NEAR((*hit)->distance, 4, 1e-12);
  }
}

TEST(Queries, APointInsideIsAtNoDistance) {
  World world = makeWorld();
  BodyDef def = bodyOf(boxOf({0.3, 0.2, 0.1}), {1.1, 0.7, -0.3});
  def.rotation = turn({1, 2, 3}, 40);
  const BodyId box = add(world, def);
  for (int i = -5; i <= 5; i++) {
    const Vec3 at = def.position + rotate(normalized(def.rotation), Vec3{0.05, 0.03, 0.01} * double(i));
    const auto near = *world.closest(at, 0);
    ASSERT_TRUE(near.has_value()) << i;
    EXPECT_EQ(near->body, box);
    EXPECT_EQ(near->distance, 0);
    EXPECT_EQ(near->pointWorld, at);
  }
}

TEST(Queries, RefuseWhatIsNotFinite) {
  World world = emptySpace();
  double nan = std::nan("");
  double inf = HUGE_VAL;
  EXPECT_EQ(world.castRay({nan, 0, 0}, {0, 1, 0}, 1).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.castRay({}, {0, 0, 0}, 1).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.castRay({}, {0, nan, 0}, 1).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.castRay({}, {0, 1, 0}, nan).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.castRay({}, {0, 1, 0}, -1).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.overlapSphere({0, inf, 0}, 1).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.overlapSphere({}, -1).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.overlapBox({{1, 0, 0}, {0, 1, 1}}).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.overlapBox({{nan, 0, 0}, {0, 1, 1}}).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.closest({0, 0, nan}, 1).error().code, ErrorCode::invalidArgument);
  EXPECT_EQ(world.closest({}, nan).error().code, ErrorCode::invalidArgument);
}

TEST(Queries, PenetrationIsExact) {
  World world = emptySpace();
  BodyId a = add(world, bodyOf(boxOf({1, 1, 1}), {}, BodyType::fixed));
  BodyId b = add(world, bodyOf(boxOf({1, 1, 1}), {1.75, 0, 0}, BodyType::fixed));
  BodyId c = add(world, bodyOf(sphereOf(1), {0, 3, 0}, BodyType::fixed));
  EXPECT_NEAR(*world.penetration(world.shapes(a)[0], world.shapes(b)[0]), 0.25, 1e-12);
  EXPECT_EQ(*world.penetration(world.shapes(a)[0], world.shapes(c)[0]), 0);
  EXPECT_EQ(world.penetration(world.shapes(a)[0], {}).error().code, ErrorCode::staleId);
}

TEST(Queries, ContactsShowTheForcesThatCarryABody) {
  World world = awakeWorld();
  BodyId ground = addGround(world);
  BodyId lower = addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0}), upper = addBox(world, {0.1, 0.1, 0.1}, {0.05, 0.5, 0});
  run(world, 2);
  double onGround = 0, between = 0;
  world.forEachContact([&](const ContactView& c) {
    ASSERT_LE(c.pointCount, 4);
    for (int i = 0; i < c.pointCount; i++) {
      EXPECT_GE(c.points[i].normalForce, 0);
      EXPECT_NEAR(std::fabs(c.normalWorld.y), 1, 1e-6);
      if (c.bodyA == ground || c.bodyB == ground) onGround += c.points[i].normalForce;
      if (c.bodyA == lower && c.bodyB == upper) {
        between += c.points[i].normalForce;
        EXPECT_GT(c.normalWorld.y, 0) << "from A to B";
        EXPECT_NEAR(c.points[i].pointWorld.y, 0.4, 1e-3);
      }
    }
  });
  EXPECT_NEAR(onGround, (64 + 8) * kG, 1);
  EXPECT_NEAR(between, 8 * kG, 0.1);
}

TEST(Queries, DebugDrawShowsEveryShapeContactAndBound) {
  World world = awakeWorld();
  addGround(world);
  addBox(world, {0.2, 0.2, 0.2}, {0, 0.2, 0});
  BodyId flying = addBox(world, {0.2, 0.2, 0.2}, {5, 5, 0}, {1, 0, 0});
  stepSound(world);
  int shapes = 0, bounds = 0, contacts = 0, lines = 0;
  DebugDraw draw;
  draw.shape = [&](BodyId body, const ShapeDef&, const Transform& pose, std::uint32_t) {
    shapes++;
    if (body == flying) expectNear(pose.position, world.state(flying)->position, 1e-12);
  };
  draw.bounds = [&](const Aabb& box) {
    bounds++;
    EXPECT_LE(box.lower.x, box.upper.x);
  };
  draw.contact = [&](Vec3, Vec3 normal, double) {
    contacts++;
    EXPECT_NEAR(length(normal), 1, 1e-6);
  };
  draw.line = [&](Vec3, Vec3, std::uint32_t) { lines++; };
  world.draw(draw);
  EXPECT_EQ(shapes, 3);
  EXPECT_EQ(bounds, 3);
  EXPECT_EQ(contacts, 4);
  EXPECT_GE(lines, 1);
  world.draw({});  // nothing asked for
}

}  // namespace
}  // namespace brickfall
