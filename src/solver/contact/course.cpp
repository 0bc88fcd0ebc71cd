// How contacts go through a step: only where they go on as they are may motions be made of second order in the time
// step (finish/finish.h).
#include <algorithm>
#include <cmath>

#include "solver/contact/rows.h"

namespace brickfall {

namespace {

// m/s, along the normal: by how much the velocity of point i of a contact, of B against A, changes.
double changeAtPoint(const FaceRecord& row, int i, const EndChanges& by) {
  Vec3 n = toDouble(row.n), t1 = toDouble(row.t1);
  Vec3 off = t1 * double(row.s1[i]) + cross(n, t1) * double(row.s2[i]);
  return dot(n, by.b.move + cross(by.b.turn, toDouble(row.armB) + off) - by.a.move -
                    cross(by.a.turn, toDouble(row.armA) + off));
}

// Point i neither lands nor leaves: it closes and parts by no more than small shocks do.
bool isSteady(const FaceRecord& row, const ContactStart& start, int i, const EndChanges& change, const StepSpan& span) {
  const double most = kCalmShare * start.scale.gravity * std::max(span.dt, span.before);
  // m/s: the change that the arc of a turning body makes.
  const double arc = span.arcs ? double(dot(row.n, start.bend)) / (0.5 * span.before - span.dt) : 0;
  return std::fabs(changeAtPoint(row, i, change) - arc) <= most && std::fabs(start.approach[i]) <= most;
}

}  // namespace

RowCourse ContactRows::courseOf(std::size_t k, const EndChanges& change, const StepSpan& span,
                                const StepContext& context) const {
  const PointMemory& points = context.ties->contacts.contacts[contactOf[k]].points;
  RowCourse course = RowCourse::idle;
  for (int i = 0; i < starts[k].points; i++) {
    if (!(points.forceN[i] > 0)) continue;
    course = RowCourse::goesOn;
    if (!isSteady(records[k], starts[k], i, change, span)) return RowCourse::changes;
  }
  return course;
}

bool ContactRows::wouldMeet(std::size_t k, const EndChanges& nearer, const EndChanges& change, double dt) const {
  const FaceRecord& row = records[k];
  const ContactStart& start = starts[k];
  for (int i = 0; i < start.points; i++) {
    const double by = 0.5 * dt * changeAtPoint(row, i, nearer);
    if (by <= kNoGap * start.scale.length) continue;
    const double speed = start.approach[i] + changeAtPoint(row, i, change);
    if (start.gap[i] + speed * dt < by) return true;
  }
  return false;
}

void ContactRows::addFriction(std::size_t k, Vec3 along, bool onB, const StepContext& context,
                              FrictionAlong& sum) const {
  const Contact& c = context.ties->contacts.contacts[contactOf[k]];
  Vec3 t1 = toDouble(records[k].t1), t2 = cross(toDouble(records[k].n), t1);
  for (int i = 0; i < c.count; i++) {
    if (!(c.points.forceN[i] > 0)) continue;
    sum.limit += double(c.friction) * double(c.points.forceN[i]);
    Vec3 friction = t1 * double(c.points.force1[i]) + t2 * double(c.points.force2[i]);
    sum.given += dot(friction, along) * (onB ? 1 : -1);
  }
}

void ContactRows::letGo(Ties& ties) const {
  for (ContactIndex contact : contactOf) ties.contacts.contacts[contact].points.stickingMask = 0;
}

}  // namespace brickfall
