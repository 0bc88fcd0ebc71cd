// How contacts go through a step: only where they go on as they are may motions be made of second order in the time
// step (finish/finish.h).
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/contact/speeds.h"

namespace brickfall {

namespace {

// Point i neither lands nor leaves: it closes and parts by no more than small shocks do. `change`: m/s, of its speed.
bool isSteady(const ContactStart& start, int i, double change, const StepSpan& span) {
  const double most = kCalmShare * start.scale.gravity * std::max(span.dt, span.before);
  const double curves = span.arcs ? start.curves[i] : 0;
  return std::fabs(change - curves) <= most && std::fabs(start.approach[i]) <= most;
}

// An impact of this step threw it back, and what presses brings it back within the rest of the step: it ends where it
// began, not further by half of its change (finish/lone_body.cpp).
bool hops(const Contact& c, const ContactStart& start, int i, double dt) {
  return c.restitution > 0 && c.points.hitN[i] > 0 && 0.5 * dt * start.approach[i] > kNoGap * start.scale.length;
}

// m/s: how point i slides along the face, B against A.
Vec3 slipOf(const FaceRecord& row, int i, const EndChanges& by) {
  const Vec3 t1 = toDouble(row.t1), t2 = cross(toDouble(row.n), t1);
  const Vec3 place = t1 * double(row.s1[i]) + t2 * double(row.s2[i]);
  const Vec3 v = by.b.move + cross(by.b.turn, toDouble(row.armB) + place) - by.a.move -
                 cross(by.a.turn, toDouble(row.armA) + place);
  return t1 * dot(t1, v) + t2 * dot(t2, v);
}

// m/s: what slips no faster does not slide. Of points along a line, friction holds some and not others.
double settledSlip(const Scale& scale, double dt, const StepContext& context) {
  return context.settings.restSpeed * scale.speed + kCalmShare * scale.gravity * dt;
}

}  // namespace

RowCourse ContactRows::courseOf(std::size_t k, const EndChanges& change, const StepSpan& span,
                                const StepContext& context) const {
  const Contact& c = at(k, *context.ties);
  RowCourse course = RowCourse::idle;
  double changes[4];
  speedsOf(records[k], starts[k].points, change, changes);
  for (int i = 0; i < starts[k].points; i++) {
    if (!(c.points.forceN[i] > 0)) continue;
    course = RowCourse::goesOn;
    if (!isSteady(starts[k], i, changes[i], span) || hops(c, starts[k], i, span.dt)) return RowCourse::changes;
  }
  return course;
}

double ContactRows::slidesFor(std::size_t k, const EndChanges& now, const EndChanges& change, double dt,
                              const StepContext& context) const {
  const PointMemory& points = at(k, *context.ties).points;
  const double least = settledSlip(starts[k].scale, dt, context);
  double left = std::numeric_limits<double>::infinity();
  for (int i = 0; i < starts[k].points; i++) {
    if (!(starts[k].slid >> i & 1) || !(points.forceN[i] > 0)) continue;
    const Vec3 slip = slipOf(records[k], i, now), by = slipOf(records[k], i, change);
    if (std::max(length(slip), length(slip - by)) <= least) continue;
    if (points.sticks(i)) return 0;
    const double nearing = -dot(slip, by);
    if (nearing > 0) left = std::min(left, nearing / lengthSquared(by));
  }
  return left;
}

bool ContactRows::slips(std::size_t k, const EndChanges& now, double dt, const StepContext& context) const {
  const PointMemory& points = at(k, *context.ties).points;
  const double least = settledSlip(starts[k].scale, dt, context);
  bool any = false;
  for (int i = 0; i < starts[k].points; i++) {
    if (!(points.forceN[i] > 0)) continue;
    if (points.sticks(i) || !(length(slipOf(records[k], i, now)) > least)) return false;
    any = true;
  }
  return any;
}

bool ContactRows::keepsForces(std::size_t k, const EndChanges& back, double dt, const StepContext& context) const {
  const PointMemory& points = at(k, *context.ties).points;
  double speeds[4];
  speedsOf(records[k], starts[k].points, back, speeds);
  for (int i = 0; i < starts[k].points; i++) {
    const double force = points.forceN[i];
    if (force > 0 && !(0.5 * dt * std::fabs(speeds[i]) * double(records[k].k[i]) <= force)) return false;
  }
  return true;
}

double ContactRows::depth(std::size_t k) const {
  float deepest = 0;
  for (int i = 0; i < starts[k].points; i++) deepest = std::max(deepest, -starts[k].gap[i]);
  return deepest;
}

bool ContactRows::wouldMeet(std::size_t k, const EndChanges& nearer, const EndChanges& change, double dt) const {
  const ContactStart& start = starts[k];
  double nearing[4], changes[4];
  speedsOf(records[k], start.points, nearer, nearing);
  speedsOf(records[k], start.points, change, changes);
  for (int i = 0; i < start.points; i++) {
    const double by = 0.5 * dt * nearing[i];
    if (by <= kNoGap * start.scale.length) continue;
    const double speed = start.approach[i] + changes[i];
    if (start.gap[i] + speed * dt < by) return true;
  }
  return false;
}

void ContactRows::addFriction(std::size_t k, Vec3 along, bool onB, const VelocityChange& body,
                              const StepContext& context, FrictionAlong& sum) const {
  const Contact& c = at(k, *context.ties);
  const Vec3 arm = toDouble(onB ? records[k].armB : records[k].armA);
  const Vec3 n = toDouble(records[k].n), t1 = toDouble(records[k].t1), t2 = cross(n, t1);
  const Vec3 across = body.move - n * dot(n, body.move);
  for (int i = 0; i < c.count; i++) {
    if (!(c.points.forceN[i] > 0)) continue;
    const double limit = double(c.friction) * double(c.points.forceN[i]);
    sum.limit += limit;
    const Vec3 place = arm + t1 * double(records[k].s1[i]) + t2 * double(records[k].s2[i]);
    sum.goes += limit * dot(c.rolls ? across : body.move + cross(body.turn, place), along);
    Vec3 friction = t1 * double(c.points.force1[i]) + t2 * double(c.points.force2[i]);
    sum.given += dot(friction, along) * (onB ? 1 : -1);
  }
}

void ContactRows::letGo(Ties& ties) const {
  for (ContactIndex contact : tieOf) ties.contacts.contacts[contact].points.stickingMask = 0;
}

}  // namespace brickfall
