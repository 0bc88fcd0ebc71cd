// A laboratory that can be turned, mirrored and carried away as a whole: gravity, ground, bodies and what is read off. A
// law that holds in one such world must hold in all of them, at any time step.
#pragma once
#include <cstdio>
#include <string>

#include "support/world_helpers.h"

namespace brickfall::law {

using namespace brickfall::test;

inline std::string label(const char* format, double value) {
  char out[64];
  std::snprintf(out, sizeof out, format, value);
  return out;
}

struct LabSetup {
  double dt = 1.0 / 60;
  int substeps = 1;
  Quat turned;            // of the whole laboratory
  bool mirrored = false;  // x to -x, before the turn
  Vec3 origin;            // m
  SolverSettings solver;
  double part() const { return dt / substeps; }
  std::string text() const;
};

inline std::string LabSetup::text() const {
  std::string s = label("dt 1/%.4g s", 1 / dt);
  if (substeps > 1) s += label(" in %g parts", substeps);
  if (!(turned == Quat{}))
    s += label(", turned (%.3f", turned.x) + label(" %.3f", turned.y) + label(" %.3f", turned.z) +
         label(" %.3f)", turned.w);
  if (mirrored) s += ", mirrored";
  if (length(origin) > 0) s += label(", %.0f m away", length(origin));
  return s;
}

class Lab {
 public:
  World world;
  StepReport report;  // of the last step

  // Gravity tilted by so much about -z: down a slope along +x.
  explicit Lab(const LabSetup& setup, double tiltDegrees = 0, double gravity = kG, double airDensity = 1.204)
      : world(makeWorld(definition(setup, tiltDegrees, gravity, airDensity))), setup_(setup) {}

  Vec3 direction(Vec3 v) const { return rotate(setup_.turned, mirror(v)); }
  Vec3 axial(Vec3 v) const {  // spins and torques keep the other components
    return rotate(setup_.turned, setup_.mirrored ? Vec3{v.x, -v.y, -v.z} : v);
  }
  BodyId add(BodyDef d) {
    for (ShapeDef& s : d.shapes) {
      s.local = {mirror(s.local.position), mirror(s.local.rotation)};
      for (Vec3& v : s.vertices) v = mirror(v);
    }
    d.position = direction(d.position) + setup_.origin;
    d.rotation = setup_.turned * mirror(d.rotation);
    d.linearVelocity = direction(d.linearVelocity);
    d.angularVelocity = axial(d.angularVelocity);
    return test::add(world, d);
  }
  BodyId addGround(double friction, double restitution = 0) {
    BodyDef d = bodyOf(planeOf(friction), {}, BodyType::fixed);
    d.shapes[0].material.restitution = restitution;
    return add(d);
  }
  // Seen from inside: position (of the centre of mass), rotation, velocities.
  BodyState state(BodyId body) const {
    BodyState s = *world.state(body);
    Quat back = conjugate(setup_.turned);
    s.position = mirror(rotate(back, s.position - setup_.origin));
    s.centreOfMass = mirror(rotate(back, s.centreOfMass - setup_.origin));
    s.rotation = mirror(back * s.rotation);
    s.linearVelocity = mirror(rotate(back, s.linearVelocity));
    Vec3 w = rotate(back, s.angularVelocity);
    s.angularVelocity = setup_.mirrored ? Vec3{w.x, -w.y, -w.z} : w;
    return s;
  }
  void tiltGravity(double degrees, double gravity = kG) {
    EXPECT_TRUE(world.setGravity(direction(tilted(degrees, gravity))).ok());
  }
  // False when anything is wrong with the step; the caller stops then.
  bool step() {
    Result<StepReport> made = world.step(setup_.dt, setup_.substeps);
    bool good = made.ok() && made->quarantined.empty();
    EXPECT_TRUE(good) << setup_.text() << ", step " << world.stepCount();
    if (made.ok()) report = *made;
    return good;
  }
  void run(double seconds) {
    for (long n = std::lround(seconds / setup_.dt); n > 0 && step(); n--) {
    }
  }
  const LabSetup& setup() const { return setup_; }

 private:
  static Vec3 tilted(double degrees, double gravity) {
    double angle = degrees * kPi / 180;
    return Vec3{std::sin(angle), -std::cos(angle), 0} * gravity;
  }
  static WorldDef definition(const LabSetup& setup, double tiltDegrees, double gravity, double airDensity) {
    WorldDef def;
    def.enableSleep = false;
    def.airDensity = airDensity;
    def.solver = setup.solver;
    Vec3 g = tilted(tiltDegrees, gravity);
    if (setup.mirrored) g.x = -g.x;
    def.gravity = rotate(setup.turned, g);
    return def;
  }
  Vec3 mirror(Vec3 v) const { return setup_.mirrored ? Vec3{-v.x, v.y, v.z} : v; }
  Quat mirror(Quat q) const { return setup_.mirrored ? Quat{q.x, -q.y, -q.z, q.w} : q; }

  LabSetup setup_;
};

}  // namespace brickfall::law
