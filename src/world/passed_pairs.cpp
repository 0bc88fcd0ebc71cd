#include "world/passed_pairs.h"

#include <algorithm>
#include <limits>

#include "geometry/core.h"
#include "solver/scale.h"
#include "world/look_ahead.h"

namespace brickfall {

namespace {

// Closing speed (m/s) at the middle of a contact's points.
double closingSpeed(const BodyMotion& a, const BodyMotion& b, const ContactGeometry& g) {
  const Vec3 n = a.orientation * g.normal, at = a.position + a.orientation * g.centre;
  return dot(n, velocityAgainst(b, a, at - b.position, at - a.position));
}

// How far (m) a body of the pair may have drifted sideways by the end of the step if a contact deflects it before
// `time`; 0 if it goes straight until then. Taken to the end of the step, since it is then not yet past.
double asideAfter(double time, const Course& course, double dt) {
  return time <= course.straightUntil ? 0 : course.slack + course.aside * (dt - course.straightUntil);
}

// m, of the points that carry force and whose impact is over: a ball that is still being stopped has not sunk in.
double deepestLoaded(const Contact& c) {
  double deepest = 0;
  for (int i = 0; i < c.count; i++)
    if (c.points.forceN[i] > 0 && c.points.phase[i] == PointPhase::resting)
      deepest = std::max(deepest, -double(c.points.gap[i]));
  return deepest;
}

}  // namespace

void findSinking(const BodySet& bodies, const ShapeSet& shapes, const ContactSet& contacts,
                 std::vector<Sinking>& sinking) {
  sinking.assign(bodies.slots(), {});
  auto eachRolling = [&](auto&& visit) {
    for (const CandidatePair& pair : contacts.pairs) {
      if (pair.contact == kNoIndex || (bodies.still[pair.bodyA] && bodies.still[pair.bodyB])) continue;
      const Contact& c = contacts.contacts[pair.contact];
      if (!c.rolls || !c.touching) continue;
      if (isRound(shapes.data[c.shapeA].geometry.type)) visit(c, c.bodyA, c.bodyB);
      if (isRound(shapes.data[c.shapeB].geometry.type)) visit(c, c.bodyB, c.bodyA);
    }
  };
  bool any = false;
  eachRolling([&](const Contact&, BodyIndex, BodyIndex on) {
    if (bodies.mass[on].invMass > 0) any = sinking[on].bears = true;
  });
  if (any)
    for (const CandidatePair& pair : contacts.pairs) {
      if (pair.contact == kNoIndex || (!sinking[pair.bodyA].bears && !sinking[pair.bodyB].bears)) continue;
      const Contact& c = contacts.contacts[pair.contact];
      if (c.rolls || !c.touching) continue;
      for (BodyIndex body : {c.bodyA, c.bodyB})
        if (sinking[body].bears) sinking[body].faces = std::max(sinking[body].faces, deepestLoaded(c));
    }
  eachRolling([&](const Contact& c, BodyIndex body, BodyIndex on) {
    const double deep = deepestLoaded(c);
    if (deep > 0) sinking[body].rolling = std::max(sinking[body].rolling, deep + sinking[on].faces);
  });
}

void findCourses(const BodySet& bodies, const ContactSet& contacts, std::span<const PassedPair> passed,
                 std::vector<Course>& courses) {
  constexpr double kPassesNothing = -1;
  courses.assign(bodies.slots(), {kPassesNothing});
  for (const PassedPair& one : passed) {
    const CandidatePair& pair = contacts.pairs[one.pair];
    courses[pair.bodyA].straightUntil = courses[pair.bodyB].straightUntil = std::numeric_limits<double>::infinity();
  }
  auto passes = [&](BodyIndex body) { return courses[body].straightUntil != kPassesNothing; };
  for (const CandidatePair& pair : contacts.pairs) {
    if (pair.contact == kNoIndex || (!passes(pair.bodyA) && !passes(pair.bodyB))) continue;
    const double closing =
        closingSpeed(bodies.motion[pair.bodyA], bodies.motion[pair.bodyB], contacts.geometry[pair.contact]);
    if (!(closing > 0)) continue;
    const Contact& c = contacts.contacts[pair.contact];
    const double gap = double(*std::min_element(c.points.gap, c.points.gap + c.count));
    const double slack =
        kLittleWay * lengthScale(bodies.mass[pair.bodyA].innerRadius, bodies.mass[pair.bodyB].innerRadius);
    const double until = (std::max(0.0, gap) + slack) / closing;
    for (BodyIndex body : {pair.bodyA, pair.bodyB}) {
      if (!(bodies.mass[body].invMass > 0)) continue;
      Course& course = courses[body];
      course = {std::min(course.straightUntil, until), std::max(course.aside, closing), std::max(course.slack, slack)};
    }
  }
}

bool staysPassed(const PassedPair& passed, const Course& a, const Course& b, double dt) {
  return asideAfter(passed.time, a, dt) + asideAfter(passed.time, b, dt) <= passed.apart;
}

}  // namespace brickfall
