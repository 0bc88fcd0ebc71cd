// An island that a test makes in three lines and takes through a step by the solver's own functions, stage by stage, without a
// World: what a test wants to look at lies open between any two of them.
//
//   TestIsland lab;
//   auto ground = lab.ground(), brick = lab.brick({0, 0.0325, 0});
//   lab.touch(ground, brick);
//   lab.step();   // or prepare(), rest(), solve(), store(), move()
#pragma once
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/shape.h"
#include "narrowphase/collide.h"
#include "solver/island_builder.h"
#include "solver/island_step.h"
#include "solver/store.h"

namespace brickfall::test {

constexpr double kG = 9.81;                       // m/s2
constexpr Vec3 kBrick{0.12, 0.0325, 0.0575};      // m, half extents
constexpr double kBrickMass = 2.7;                // kg
constexpr double kBrickWeight = kBrickMass * kG;  // N
constexpr double kCap = 5 * kBrickWeight;         // N, what an impact may hand on

class TestIsland {
 public:
  explicit TestIsland(double dt = 1.0 / 60) {
    context.dt = dt;
    context.gravity = {0, -kG, 0};
    context.bodies = &bodies;
    context.ties = &allTies;
  }
  TestIsland(const TestIsland&) = delete;
  TestIsland& operator=(const TestIsland&) = delete;

  // --- bodies
  BodyIndex ground() {  // y = 0
    Shape plane;
    plane.type = ShapeType::plane;
    return add(BodyType::fixed, plane, {}, {});
  }
  BodyIndex block(Vec3 half, Vec3 at, BodyType type = BodyType::fixed, Quat rotation = {}) {
    return add(type, boxOf(half), at, rotation);
  }
  BodyIndex brick(Vec3 at, double mass = kBrickMass, Vec3 half = kBrick, Quat rotation = {}) {
    BodyIndex body = add(BodyType::dynamic, boxOf(half), at, rotation);
    BodyMass& m = bodies.mass[body];
    Vec3 squares = scaled(half, half) * (mass / 3);
    m.mass = mass;
    m.invMass = 1 / mass;
    m.inertia = diagonal(Vec3{squares.y + squares.z, squares.z + squares.x, squares.x + squares.y});
    m.invInertia = inverse(m.inertia);
    m.principalInvInertia = {m.invInertia.row[0].x, m.invInertia.row[1].y, m.invInertia.row[2].z};
    m.isotropic = half.x == half.y && half.y == half.z;
    return body;
  }
  // A pile of bricks on `under`, whose top is at y = bottom: bricks in order, each touching the one below it.
  std::vector<BodyIndex> pile(BodyIndex under, int count, double bottom = 0, Vec3 shift = {}, float friction = 0.6f) {
    std::vector<BodyIndex> out;
    for (int i = 0; i < count; i++) {
      out.push_back(brick(Vec3{0, bottom + (2 * i + 1) * kBrick.y, 0} + shift * double(i)));
      touch(i == 0 ? under : out[std::size_t(i) - 1], out.back(), friction);
    }
    return out;
  }
  BodyMotion& at(BodyIndex body) { return bodies.motion[body]; }

  // --- contacts: where the two bodies are nearer than the contact margin, with the gaps that they have
  ContactIndex touch(BodyIndex a, BodyIndex b, float friction = 0.6f) {
    if (b < a) std::swap(a, b);
    Transform relative = inverse(bodies.pose(a)) * bodies.pose(b);
    Manifold m;
    collide(shapes_[a], shapes_[b], relative, context.settings.contactMargin, m);
    EXPECT_GT(m.count, 0) << "bodies " << a << " and " << b << " are nowhere near each other";
    return add(a, b, m, relative, friction);
  }
  // At the corners of a face of this middle and these half sides (world axes, across each other), whatever the shapes are
  // (wedges): gap 0, normal from a to b along the cross product of the sides.
  ContactIndex join(BodyIndex a, BodyIndex b, Vec3 middle, Vec3 side1, Vec3 side2, float friction = 0.6f) {
    EXPECT_LT(a, b);
    Transform toA = inverse(bodies.pose(a));
    Manifold m;
    m.normal = rotate(toA.rotation, normalized(cross(side1, side2)));
    m.count = 4;
    for (int i = 0; i < 4; i++) {
      Vec3 corner = middle + side1 * (i & 1 ? 1.0 : -1.0) + side2 * (i & 2 ? 1.0 : -1.0);
      m.points[i].onA = m.points[i].onB = transformPoint(toA, corner);
    }
    return add(a, b, m, toA * bodies.pose(b), friction);
  }
  Ties& ties() { return allTies; }
  Contact& contact(ContactIndex index) { return contacts.contacts[index]; }
  PointMemory& points(ContactIndex index) { return contacts.contacts[index].points; }
  // u, N/m: of the pair's effective mass and this time step
  double unit(ContactIndex index) const {
    return double(contacts.contacts[index].effectiveMass) / (context.dt * context.dt);
  }
  // N, sum of the normal forces that the contact remembers
  double pressure(ContactIndex index) const {
    const Contact& c = contacts.contacts[index];
    double sum = 0;
    for (int i = 0; i < c.count; i++) sum += double(c.points.forceN[i]);
    return sum;
  }
  // The points have long rested under this load, shared alike: no motion at all balances it.
  void load(ContactIndex index, double load, double stiffness) {
    Contact& c = contact(index);
    for (int i = 0; i < c.count; i++) {
      c.points.phase[i] = PointPhase::resting;
      c.points.stiffness[i] = float(stiffness);
      c.points.forceN[i] = c.points.multiplierN[i] = float(load / c.count);
      c.points.gap[i] = -float(load / c.count / stiffness);
      c.points.stickingMask |= 1u << i;
    }
    c.touching = true;
  }

  // --- the step
  Island& island() {
    link();
    EXPECT_EQ(islands.awake.size(), 1u) << "not one island";
    return *islands.awake.front();
  }
  const FaceRecord& record(std::size_t row = 0) { return island().rows.contacts.records[row]; }
  void link() {
    if (contacts.changed) buildIslands(islands, ties(), context, awake);
    contacts.changed = false;
    context.free.resize(bodies.slots());
    context.solved.resize(bodies.slots());
  }
  void prepare() {
    island().dt = context.dt;
    prepareIsland(island(), ties(), bodies, context);
  }
  void checkRest() { restIsland(island(), context); }
  SolveStatistics solve() {
    SolveStatistics statistics;
    solveIsland(island(), context, statistics);
    return statistics;
  }
  // True if any force of the contacts changed, or if the island does not rest.
  bool store() {
    storeIsland(island(), ties(), context);
    return !island().settled();
  }
  void balance() { balanceIsland(island(), ties(), context); }
  // Velocities, poses, gaps.
  void move() {
    advanceRows(island(), ties(), context);
    for (BodyIndex body : island().bodies) {
      const SolvedMotion& s = context.solved[body];
      BodyMotion& m = bodies.motion[body];
      bodies.still[body] = s.rest;
      m.linearVelocity = m.angularVelocity = {};
      bodies.data[body].steady = s.steady;
      bodies.data[body].impactLoss = s.impactLoss;
      if (s.rest) continue;
      m.position += s.d;
      bodies.setRotation(
          body, s.freeTurn ? context.free[body].rotation : normalized(quatFromRotationVector(s.th) * m.rotation));
      m.linearVelocity = s.velocity;
      m.angularVelocity = bodies.worldInvInertia(body) * s.angularMomentum;
    }
  }
  void step() {
    stepIsland(island(), IslandPart::last, context.dt, ties(), bodies, context, context.statistics);
    move();
  }
  void run(int steps) {
    for (int i = 0; i < steps; i++) step();
  }

  BodySet bodies;
  Ties allTies;
  ContactSet& contacts = allTies.contacts;
  StepContext context;
  IslandSet islands;
  std::vector<BodyIndex> awake;

 private:
  static Shape boxOf(Vec3 half) {
    Shape box;
    box.halfExtents = half;
    return box;
  }
  BodyIndex add(BodyType type, const Shape& shape, Vec3 at, Quat rotation) {
    BodyIndex body = bodies.create();
    bodies.data[body].type = type;
    bodies.motion[body].position = at;
    bodies.setRotation(body, rotation);
    bodies.mass[body].innerRadius = innerRadius(shape);
    bodies.mass[body].outerRadius = outerRadius(shape, {});
    shapes_.push_back(shape);
    if (type == BodyType::dynamic) awake.push_back(body);
    return body;
  }
  ContactIndex add(BodyIndex a, BodyIndex b, const Manifold& m, const Transform& relative, float friction) {
    CandidatePair pair{a, b, a, b, contacts.create()};  // each body's one shape has its number
    fill(pair, m, relative, friction);
    contacts.insert({pair});
    return pair.contact;
  }
  // A new contact: points midway between the two surfaces, memory of nothing.
  void fill(const CandidatePair& pair, const Manifold& m, const Transform& relative, float friction) {
    Contact& c = contacts.contacts[pair.contact];
    ContactGeometry& g = contacts.geometry[pair.contact];
    c.shapeA = c.bodyA = pair.bodyA;
    c.shapeB = c.bodyB = pair.bodyB;
    c.count = m.count;
    c.friction = friction;
    c.effectiveMass = float(1 / (bodies.mass[pair.bodyA].invMass + bodies.mass[pair.bodyB].invMass));
    g.normal = m.normal;
    g.tangent1 = normalized(cross(m.normal, std::fabs(m.normal.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
    g.centre = {};
    for (int i = 0; i < m.count; i++) g.centre += (m.points[i].onA + m.points[i].onB) * (0.5 / m.count);
    for (int i = 0; i < m.count; i++) {
      Vec3 place = (m.points[i].onA + m.points[i].onB) * 0.5 - g.centre;
      g.anchorA[i] = m.points[i].onA;
      g.anchorB[i] = transformPoint(inverse(relative), m.points[i].onB);
      c.points.gap[i] = float(m.points[i].separation);
      c.points.s1[i] = float(dot(g.tangent1, place));
      c.points.s2[i] = float(dot(cross(g.normal, g.tangent1), place));
    }
  }
  std::vector<Shape> shapes_;  // by body
};

// A brick on the ground, `gap` m above it, falling or sliding.
struct OnGround : TestIsland {
  explicit OnGround(Vec3 velocity = {}, double gap = 0, double dt = 1.0 / 60)
      : TestIsland(dt), under(ground()), body(brick({0, kBrick.y + gap, 0})), face(touch(under, body)) {
    at(body).linearVelocity = velocity;
  }
  // A point as an earlier step left it.
  void remember(PointPhase phase, double stiffness, double gap, double offset, double force) {
    PointMemory& m = points(face);
    for (int i = 0; i < 4; i++) {
      m.phase[i] = phase;
      m.stiffness[i] = float(stiffness);
      m.gap[i] = float(gap);
      m.offset[i] = float(offset);
      m.forceN[i] = m.multiplierN[i] = float(force);
      m.stickingMask = 15;
    }
  }
  // Stiffness of the first point in u.
  double stiffness() { return double(points(face).stiffness[0]) / unit(face); }
  PointPhase phase() { return points(face).phase[0]; }
  SolveMotion& motion() { return island().motion[0]; }
  BodyIndex under, body;
  ContactIndex face;
};

}  // namespace brickfall::test
