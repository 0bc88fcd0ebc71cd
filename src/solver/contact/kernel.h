// The contact law and its derivatives, four points at a time.
//
//   fn = max(trialN - k Cn, -cap)
//   ft = (trial1 - k C1, trial2 - k C2), scaled back onto |ft| <= limit: scaled back = slides
//
#pragma once
#include "math/wide.h"
#include "solver/contact/record.h"
#include "solver/reaction.h"
#include "solver/solve_body.h"

namespace brickfall::kernel {

using wide::load;
using wide::M;
using wide::set;
using wide::store;
using wide::sums;
using wide::V;

// The manifold's frame and arms, unpacked.
struct Frame {
  V n, t1, t2, armA, armB;
};
inline Frame frame(const ContactRecord& r) {
  Frame f;
  f.n = wide::load3Padded(r.n);
  f.t1 = wide::load3Padded(r.t1);
  f.t2 = wide::cross3(f.n, f.t1);
  f.armA = wide::load3Padded(r.armA);
  f.armB = wide::load3Padded(r.armB);
  return f;
}

// Displacements of the four points.
struct PointMotion {
  V n, t1, t2;
};
inline PointMotion pointMotion(const ContactRecord& r, const Frame& f, const SolveMotion* motion) {
  const SolveMotion &a = motion[r.bodyA], &b = motion[r.bodyB];
  V thA = load(&a.th.x), thB = load(&b.th.x);
  V u = (load(&b.d.x) + wide::cross3(thB, f.armB)) - (load(&a.d.x) + wide::cross3(thA, f.armA));
  V w = thB - thA;
  V along = sums(u * f.n, u * f.t1, u * f.t2, w * f.n);  // un u1 u2 wn
  V tilt = sums(w * f.t1, w * f.t2, set(0), set(0));     // w1 w2
  V s1 = load(r.s1), s2 = load(r.s2);
  V wn = wide::spread<3>(along);
  return {wide::spread<0>(along) + wide::spread<0>(tilt) * s2 - wide::spread<1>(tilt) * s1,
          wide::spread<1>(along) - wn * s2, wide::spread<2>(along) + wn * s1};
}

struct PointForces {
  V trialN, n;  // N
  V trial1, trial2, t1, t2;
  V trialSquared, root;  // of the tangential trial force; its length where it slides, else 1
  M slides;              // out of the friction cone
};

inline PointForces pointForces(const ContactRecord& r, const PointMotion& moved) {
  PointForces f;
  V k = load(r.k);
  f.trialN = load(r.trialN) - (k * moved.n);
  f.n = wide::max(f.trialN, -load(r.tensionCap));
  f.trial1 = load(r.trial1) - (k * moved.t1);
  f.trial2 = load(r.trial2) - (k * moved.t2);
  V limit = load(r.limit);
  f.trialSquared = (f.trial1 * f.trial1) + (f.trial2 * f.trial2);
  f.slides = f.trialSquared > (limit * limit);
  V one = set(1);  // no branch: which points slide is hard to foresee, a root and a division are not dear
  f.root = wide::sqrt(wide::select(f.slides, f.trialSquared, one));
  V scale = wide::select(f.slides, limit / f.root, one);
  f.t1 = f.trial1 * scale;
  f.t2 = f.trial2 * scale;
  return f;
}

// Force and torque on B about the manifold's centre, world axes.
struct WideWrench {
  V force, torque;
};
inline WideWrench wrench(const ContactRecord& r, const Frame& frame, const PointForces& f) {
  V s1 = load(r.s1), s2 = load(r.s2);
  V force = sums(f.n, f.t1, f.t2, s1 * f.t2 - s2 * f.t1);  // Fn F1 F2 Mn
  V tilt = sums(s2 * f.n, s1 * f.n, set(0), set(0));       // M1 -M2
  return {frame.n * wide::spread<0>(force) + frame.t1 * wide::spread<1>(force) + frame.t2 * wide::spread<2>(force),
          frame.n * wide::spread<3>(force) + frame.t1 * wide::spread<0>(tilt) - frame.t2 * wide::spread<1>(tilt)};
}

// N: points count as closed up to this tension, open ones that are nearer than `near` m among them. What a rebound pushes
// apart does not.
inline V closedReach(const ContactRecord& r, float near) {
  V cap = load(r.tensionCap);
  return wide::select(set(0) > cap, cap, wide::max(cap, load(r.k) * set(near)));
}

// Loaded points resist along the normal, and so do open ones that are nearer than `near` m: a Newton step must not run
// through them. Sticking points resist tangentially; sliding ones only across their slip.
inline Stiffness stiffness(const ContactRecord& r, const Frame& frame, const PointForces& f, float near) {
  V s1 = load(r.s1), s2 = load(r.s2), k = load(r.k), zero = set(0);
  M normalOn = f.trialN > -closedReach(r, near);
  V kn = wide::keepIf(normalOn, k);
  M frictional = load(r.limit) > zero;
  V kt = wide::keepIf(frictional, k);
  V t11 = kt, t22 = kt, t12 = zero;
  M sliding = f.slides & frictional;
  // Sliding: k |f| / |trial| on the direction across the trial force.
  V share = (kt * load(r.limit)) / (wide::select(sliding, f.trialSquared, set(1)) * f.root);
  t11 = wide::select(sliding, share * (f.trial2 * f.trial2), t11);
  t22 = wide::select(sliding, share * (f.trial1 * f.trial1), t22);
  t12 = wide::select(sliding, -(share * (f.trial1 * f.trial2)), t12);
  V kn1 = kn * s1, kn2 = kn * s2;
  V ta = s1 * t12 - s2 * t11;  // turning about n couples to t1 ...
  V tb = s1 * t22 - s2 * t12;  // ... and t2
  V n = sums(kn, kn1, kn2, s1 * tb - s2 * ta);
  V q = sums(kn1 * s1, kn1 * s2, kn2 * s2, ta);
  V t = sums(t11, t12, t22, tb);

  Stiffness out;
  using wide::spread;
  V an = frame.n * spread<0>(n), a1 = frame.t1 * spread<0>(t) + frame.t2 * spread<1>(t),
    a2 = frame.t1 * spread<1>(t) + frame.t2 * spread<2>(t);
  V bn = frame.t1 * spread<2>(n) - frame.t2 * spread<1>(n);  // normal force against tilt
  V bt = frame.t1 * spread<3>(q) + frame.t2 * spread<3>(t);  // tangential force against the turn about n
  V cn = frame.n * spread<3>(n), c1 = frame.t1 * spread<2>(q) - frame.t2 * spread<1>(q),
    c2 = frame.t2 * spread<0>(q) - frame.t1 * spread<1>(q);
  auto row = [&](V ni, V t1i, V t2i, V bti, int i) {
    out.A[i] = an * ni + a1 * t1i + a2 * t2i;
    out.B[i] = bn * ni + frame.n * bti;
    out.C[i] = cn * ni + c1 * t1i + c2 * t2i;
  };
  row(spread<0>(frame.n), spread<0>(frame.t1), spread<0>(frame.t2), spread<0>(bt), 0);
  row(spread<1>(frame.n), spread<1>(frame.t1), spread<1>(frame.t2), spread<1>(bt), 1);
  row(spread<2>(frame.n), spread<2>(frame.t1), spread<2>(frame.t2), spread<2>(bt), 2);
  return out;
}

}  // namespace brickfall::kernel
