#include "world/look_ahead.h"

#include <algorithm>

#include "dynamics/point_matcher.h"
#include "geometry/core.h"
#include "geometry/frustum.h"
#include "narrowphase/collide.h"
#include "solver/step_context.h"
#include "world/core_sweep.h"

namespace brickfall {

namespace {

//! m | too small: cost of glancing bodies | too large: round bodies are turned aside before they touch
constexpr double kTouches = 1e-5;  // a gap this small is a touch

//! m | too small: balls lose speed at the seams that they roll over
//! | too large: balls pass edges that they should glance off
constexpr double kGrazes = 2e-4;  // by which a round body may overlap what it goes past, besides what it has sunk in

// The shapes at a moment of the step.
struct Moment {
  double time = 0;     // s
  Manifold manifold;   // frame of shape A
  Transform place;     // centre frame of B in that of A, both then
  double apart = 0;    // m, least separation
  double closing = 0;  // m/s, of the point there
};

class LookAhead {
 public:
  LookAhead(const ShapeData& a, const ShapeData& b, const RelativeMotion& motion, const LookRoom& room)
      : a_(a), b_(b), motion_(motion), room_(room), scale_(lengthScale(a.innerRadius, b.innerRadius)) {}

  double touches() const { return kTouches * scale_; }  // m
  bool isBorne() const { return room_.sunk > 0; }
  double grazes() const { return kGrazes * scale_ + room_.sunk; }  // m

  Moment start(const Manifold& m) const { return measured(0, m); }
  // Without points the shapes are out of reach.
  Moment at(double time) const {
    Manifold m;
    collide(a_.geometry, b_.geometry, inverse(a_.inCentreFrame) * placeAt(time) * b_.inCentreFrame, room_.reach, m);
    return measured(time, m);
  }
  // Where the manifold lies at the start of the step, seen from the round body. A round shape touches with whatever
  // side it then has there: its core goes back, the side does not turn. Faces turn back with their body.
  Manifold atStart(const Moment& then) const {
    const bool roundA = isRound(a_.geometry.type), roundB = isRound(b_.geometry.type);
    const Transform back = inverse(a_.inCentreFrame) * motion_.pose * inverse(then.place) * a_.inCentreFrame;
    const Quat turnedA =
        quatFromRotationVector(rotate(conjugate(a_.inCentreFrame.rotation), motion_.spinA * then.time));
    Manifold out = then.manifold;
    if (roundA) out.normal = rotate(roundB ? turnedA : back.rotation, out.normal);
    const double radiusA = coreRadius(a_.geometry), radiusB = coreRadius(b_.geometry);
    for (int i = 0; i < out.count; i++) {
      ManifoldPoint& p = out.points[i];
      const Vec3 normal = then.manifold.normal;
      p.onA = (p.onA - normal * radiusA) + out.normal * radiusA;
      p.onB = transformPoint(back, p.onB + normal * radiusB) - out.normal * radiusB;
      p.separation = dot(out.normal, p.onB - p.onA);
      if (roundB)
        p.onA = p.onB - out.normal * p.separation;
      else
        p.onB = p.onA + out.normal * p.separation;
    }
    return out;
  }

 private:
  Transform placeAt(double time) const {
    Quat back = conjugate(quatFromRotationVector(motion_.spinA * time));
    return {rotate(back, motion_.pose.position + motion_.velocity * time),
            back * (quatFromRotationVector(motion_.spinB * time) * motion_.pose.rotation)};
  }
  Moment measured(double time, const Manifold& m) const {
    Moment out{time, m, placeAt(time)};
    if (m.count == 0) return out;
    const ManifoldPoint* nearest = std::min_element(
        m.points, m.points + m.count, [](const auto& p, const auto& q) { return p.separation < q.separation; });
    out.apart = nearest->separation;
    Quat back = conjugate(quatFromRotationVector(motion_.spinA * time));
    Vec3 onA = transformPoint(a_.inCentreFrame, nearest->onA), onB = transformPoint(a_.inCentreFrame, nearest->onB);
    Vec3 v = rotate(back, motion_.velocity) + cross(rotate(back, motion_.spinB), onB - out.place.position) -
             cross(motion_.spinA, onA);
    out.closing = -dot(rotate(a_.inCentreFrame.rotation, m.normal), v);
    return out;
  }

  const ShapeData &a_, &b_;
  const RelativeMotion& motion_;
  const LookRoom& room_;
  double scale_;
};

// The moment between two at which the shapes cease to come nearer.
Moment nearest(const LookAhead& ahead, Moment closes, Moment parts, double apart) {
  for (int k = 0; k < kMostLooks && parts.manifold.count > 0 && parts.apart > apart && !(parts.closing > 0); k++) {
    Moment middle = ahead.at(0.5 * (closes.time + parts.time));
    (middle.closing > 0 ? closes : parts) = middle;
  }
  return parts;
}

// The plane between two convex shapes keeps them apart until the nearest points would have met along its normal: steps
// of that length pass over nothing. Ends where the shapes touch, where they are nearest, or with the step.
Moment advance(const LookAhead& ahead, Moment now, double dt) {
  Moment before = now;
  for (int k = 0; k < kMostLooks; k++) {
    if (now.manifold.count == 0 || now.apart <= ahead.touches() || now.time >= dt) return now;
    if (!(now.closing > 0)) break;
    before = now;
    now = ahead.at(std::min(dt, now.time + now.apart / now.closing));
  }
  return nearest(ahead, before, now, ahead.touches());
}

// Whether touching shapes overlap by no more than grazes() before they are past each other. What a slow ball passes
// after the step is foretold: its edge turns away evenly. A ball that lands closes as fast at the end of the step, so
// it does not pass; one that nothing else bears would fall.
bool grazes(const LookAhead& ahead, Moment now, double dt) {
  const double past = kOver * now.closing;
  if (!(now.closing * dt > ahead.touches())) return false;
  for (int k = 0; k < kMostLooks && now.closing > past && now.apart > -ahead.grazes(); k++) {
    const double until = now.time + (now.apart + 1.1 * ahead.grazes()) / now.closing;
    if (until >= dt) {
      const Moment end = ahead.at(dt);
      const double slows = (now.closing - end.closing) / (dt - now.time);  // m/s2
      if (end.closing > past) {
        const bool passes = now.closing * now.closing <= 2 * slows * (now.apart + ahead.grazes());
        return ahead.isBorne() && passes;
      }
      now = nearest(ahead, now, end, -ahead.grazes());
      break;
    }
    now = ahead.at(until);
  }
  return now.manifold.count > 0 && now.apart > -ahead.grazes() && !(now.closing > past);
}

// Turns bring shapes nearer that planes keep apart. The other shape is not passed if the step would end inside it.
bool endsIn(const LookAhead& ahead, double dt, double deep) {
  const Moment end = ahead.at(dt);
  return end.manifold.count > 0 && end.apart < -deep;
}

// Passed at the moment when the shapes are nearest. Without points they are apart by more than `margin`.
Ahead passesAt(const Moment& then, double margin) {
  return {AheadFound::passes, then.time, then.manifold.count > 0 ? then.apart : margin};
}

Ahead lookAheadRound(const LookAhead& ahead, const Moment& now, double dt, double margin, Manifold& m) {
  if (!(now.closing > 0) || now.apart < -ahead.grazes()) return {};
  const Moment touch = advance(ahead, now, dt);
  const bool far = touch.manifold.count == 0 || (touch.apart > margin && (touch.time >= dt || !(touch.closing > 0)));
  const bool passes = far || (touch.apart <= ahead.touches() && grazes(ahead, touch, dt));
  if (passes && !endsIn(ahead, dt, ahead.grazes())) return far ? passesAt(touch, margin) : Ahead{AheadFound::passes};
  if (far || touch.time == 0) return {};
  m = ahead.atStart(touch);
  return {AheadFound::meets};
}

// The box slides over the edge if this holds: `overlap` further on, its edge overlaps another face, by less than half
// of `overlap`, and comes no nearer. A normal that is turned over says that the shapes have passed through each other.
bool slidesOver(const LookAhead& ahead, const Moment& now, double dt, double overlap) {
  const double until = now.time + (now.apart + overlap) / now.closing;
  if (until >= dt) return false;
  const Moment then = ahead.at(until);
  const double turned = dot(then.manifold.normal, now.manifold.normal);
  return then.manifold.count > 0 && turned < kSameFace && turned > -kSameFace && then.apart > -0.5 * overlap &&
         then.closing * dt < overlap;
}

// Shapes without points may yet meet: where they are, no face lies over the other's. If the step would end with one in
// the other, they have the points of the moment at which they touch.
Ahead meetsLater(const LookAhead& ahead, double dt, Manifold& m) {
  Moment touch = ahead.at(dt);
  if (touch.manifold.count == 0 || touch.apart > -ahead.grazes()) return {};
  double apart = 0;  // s
  for (int k = 0; k < kMostLooks && touch.apart <= -ahead.touches(); k++) {
    const Moment middle = ahead.at(0.5 * (apart + touch.time));
    if (middle.manifold.count > 0 && middle.apart <= ahead.touches())
      touch = middle;
    else
      apart = middle.time;
  }
  m = ahead.atStart(touch);
  return {AheadFound::meets};
}

// The axis of a cylinder or cone goes through the body's centre.
bool isOnAxis(const ShapeData& shape) {
  const Vec3 centre = transformPoint(inverse(shape.inCentreFrame), Vec3{});
  return centre.x == 0 && centre.z == 0;
}

// `spin` in the body's own frame. A shape that is round about an axis through its centre turns into itself.
bool turnsTooFar(const ShapeData& shape, Vec3 spin, double dt) {
  const bool centred = lengthSquared(shape.inCentreFrame.position) == 0;
  if (centred && shape.geometry.type == ShapeType::sphere) return false;
  if (shape.geometry.type == ShapeType::capsule ? centred : isFrustum(shape.geometry.type) && isOnAxis(shape)) {
    const Vec3 axis = rotate(shape.inCentreFrame.rotation, Vec3{0, 1, 0});
    spin -= axis * dot(axis, spin);
  }
  return !(length(spin) * dt < kMostTurn);
}

}  // namespace

Ahead lookAhead(const ShapeData& a, const ShapeData& b, const RelativeMotion& motion, double dt, const LookRoom& room,
                Manifold& m) {
  const double scale = lengthScale(a.innerRadius, b.innerRadius), most = kLittleWay * scale / dt;
  if (a.geometry.type == ShapeType::plane || b.geometry.type == ShapeType::plane) return {};  // a plane has one normal
  if (lengthSquared(motion.velocity) < most * most) return {};
  const Vec3 spinB = rotate(conjugate(motion.pose.rotation), motion.spinB);
  if (turnsTooFar(a, motion.spinA, dt) || turnsTooFar(b, spinB, dt)) return {};
  const LookAhead ahead(a, b, motion, room);
  if (m.count == 0) return meetsLater(ahead, dt, m);
  const Moment now = ahead.start(m);
  if (isRound(a.geometry.type) || isRound(b.geometry.type)) return lookAheadRound(ahead, now, dt, room.margin, m);
  const double overlap = 2 * kLittleWay * scale;  // by which a hit is told from an edge that slides over a face
  if (!(now.closing > most) || now.apart < -overlap || !slidesOver(ahead, now, dt, overlap)) return {};
  return {AheadFound::passes};
}

}  // namespace brickfall
