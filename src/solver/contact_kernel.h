// The contact law and its derivatives, four points at a time.
//
//   fn = max(trialN - k Cn, -bond)
//   ft = (trial1 - k C1, trial2 - k C2), scaled back onto |ft| <= limit: scaled back = slides
//
#pragma once
#include "math/wide.h"
#include "solver/contact_record.h"

namespace brickfall::kernel {

using wide::M;
using wide::V;
using wide::load;
using wide::set;
using wide::store;
using wide::sums;

// Displacement u and turn w of B against A at the manifold's centre, in the manifold's frame.
struct RelativeMotion {
  float un, u1, u2, wn, w1, w2;
};

inline RelativeMotion relativeMotion(const ContactRecord& r, const SolveMotion* motion, Vec3f t2) {
  const SolveMotion &a = motion[r.bodyA], &b = motion[r.bodyB];
  Vec3f u = (b.d + cross(b.th, r.armB)) - (a.d + cross(a.th, r.armA));
  Vec3f w = b.th - a.th;
  return {dot(r.n, u), dot(r.t1, u), dot(t2, u), dot(r.n, w), dot(r.t1, w), dot(t2, w)};
}

// Displacements of the four points.
struct PointMotion {
  V n, t1, t2;
};
inline PointMotion pointMotion(const ContactRecord& r, const RelativeMotion& m) {
  V s1 = load(r.s1), s2 = load(r.s2);
  return {set(m.un) + set(m.w1) * s2 - set(m.w2) * s1, set(m.u1) - set(m.wn) * s2, set(m.u2) + set(m.wn) * s1};
}

struct PointForces {
  V trialN, n;            // N
  V trial1, trial2, t1, t2;
  V trialSquared;         // of the tangential trial force
  M slides;               // out of the friction cone
};

inline PointForces pointForces(const ContactRecord& r, const PointMotion& moved) {
  PointForces f;
  V k = load(r.k);
  f.trialN = load(r.trialN) - (k * moved.n);
  f.n = wide::max(f.trialN, -load(r.bond));
  f.trial1 = load(r.trial1) - (k * moved.t1);
  f.trial2 = load(r.trial2) - (k * moved.t2);
  V limit = load(r.limit);
  f.trialSquared = (f.trial1 * f.trial1) + (f.trial2 * f.trial2);
  f.slides = f.trialSquared > (limit * limit);
  f.t1 = f.trial1;
  f.t2 = f.trial2;
  if (wide::any(f.slides)) {
    V one = set(1);
    V root = wide::sqrt(wide::select(f.slides, f.trialSquared, one));
    V scale = wide::select(f.slides, (limit / root), one);
    f.t1 = f.trial1 * scale;
    f.t2 = f.trial2 * scale;
  }
  return f;
}

// Force and torque on B about the manifold's centre, world axes.
inline Wrench wrench(const ContactRecord& r, const PointForces& f, Vec3f t2) {
  V s1 = load(r.s1), s2 = load(r.s2);
  V turn = (s1 * f.t2) - (s2 * f.t1);
  alignas(16) float force[4], tilt[4];
  store(sums(f.n, f.t1, f.t2, turn), force);
  V m1 = (s2 * f.n), m2 = s1 * f.n;
  store(sums(m1, m2, m1, m2), tilt);
  return {r.n * force[0] + r.t1 * force[1] + t2 * force[2], r.n * force[3] + r.t1 * tilt[0] - t2 * tilt[1]};
}

inline bool needsLineSearch(const ContactRecord& r, const PointForces& f) {
  V bond = load(r.bond), zero = set(0);
  M sliding = (f.slides & (load(r.limit) > zero));
  M yielding = ((bond > zero) & (f.trialN <= -bond));
  return wide::any(sliding | yielding);
}

// Stiffness of the contact against its own relative motion (u, w) at the manifold's centre, world axes:
// [A B; B^T C], A and C symmetric. B by rows.
struct Stiffness {
  Mat3f A, B, C;
};

// Loaded points resist along the normal, and so do open ones that are nearer than `near` m: a Newton step must not run
// through them. Sticking points resist tangentially; sliding ones only across their slip.
inline Stiffness stiffness(const ContactRecord& r, const PointForces& f, Vec3f t2, float near) {
  V s1 = load(r.s1), s2 = load(r.s2), k = load(r.k), zero = set(0);
  M normalOn = (f.trialN > (-wide::max(load(r.bond), (k * set(near)))));
  V kn = wide::keepIf(normalOn, k);
  M frictional = load(r.limit) > zero;
  V kt = wide::keepIf(frictional, k);
  V t11 = kt, t22 = kt, t12 = zero;
  M sliding = f.slides & frictional;
  if (wide::any(sliding)) {  // k |f| / |trial| on the direction across the trial force
    V square = wide::select(sliding, f.trialSquared, set(1));
    V share = ((kt * load(r.limit)) / (square * wide::sqrt(square)));
    t11 = wide::select(sliding, (share * (f.trial2 * f.trial2)), t11);
    t22 = wide::select(sliding, (share * (f.trial1 * f.trial1)), t22);
    t12 = wide::select(sliding, (-(share * (f.trial1 * f.trial2))), t12);
  }
  V kn1 = (kn * s1), kn2 = kn * s2;
  V ta = (s1 * t12) - (s2 * t11);  // turning about n couples to t1 ...
  V tb = (s1 * t22) - (s2 * t12);  // ... and t2
  V tc = (s1 * tb) - (s2 * ta);
  alignas(16) float n[4], q[4], t[4];
  store(sums(kn, kn1, kn2, tc), n);
  store(sums(kn1 * s1, kn1 * s2, kn2 * s2, ta), q);
  store(sums(t11, t12, t22, tb), t);

  Stiffness out;
  // A = sum of k x (direction x direction)
  Vec3f a1 = r.t1 * t[0] + t2 * t[1], a2 = r.t1 * t[1] + t2 * t[2], an = r.n * n[0];
  for (int i = 0; i < 3; i++) out.A.row[i] = an * r.n[i] + a1 * r.t1[i] + a2 * t2[i];
  Vec3f bn = r.t1 * n[2] - t2 * n[1];  // normal force against tilt
  for (int i = 0; i < 3; i++) out.B.row[i] = bn * r.n[i] + r.n * (q[3] * r.t1[i] + t[3] * t2[i]);
  Vec3f c1 = r.t1 * q[2] - t2 * q[1], c2 = t2 * q[0] - r.t1 * q[1], cn = r.n * n[3];
  for (int i = 0; i < 3; i++) out.C.row[i] = cn * r.n[i] + c1 * r.t1[i] + c2 * t2[i];
  return out;
}

}  // namespace brickfall::kernel
