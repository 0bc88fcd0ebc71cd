// The law of a face and its derivatives, four points at a time, or the points of two faces side by side.
//
//   fn = max(trialN - k Cn, leastN)      of a face that crushes: max(min(fn, most), trialN - k Cn - yield)
//   ft = (trial1 - k C1, trial2 - k C2), scaled back onto |ft| <= limit: scaled back = slides
//
// Resistance to rolling is the same law for (C1, C2) = radius x (turn about t1, turn about t2): a torque radius x ft.
// It is in the last lane of faces that have no fourth point (FaceRecord::rolls); others pass it by.
#pragma once
#include "math/wide.h"
#include "solver/face/record.h"
#include "solver/reaction.h"
#include "solver/solve_body.h"

namespace brickfall::kernel {

using wide::cross3;
using wide::keepIf;
using wide::load;
using wide::M;
using wide::max;
using wide::select;
using wide::spread;
using wide::sqrt;
using wide::store;
using wide::sums;
using wide::V;

// Two faces, in lanes of two halves: L is one of math/wide_pair.h.
template <class L> struct RecordPair { const FaceRecord &first, &second; };

// The result of `read` for a record, in its lanes; for a pair of records, in the halves.
template <class Read> BRICKFALL_LANES V lanesOf(const FaceRecord& r, Read read) { return read(r); }
template <class L, class Read> BRICKFALL_LANES L lanesOf(const RecordPair<L>& r, Read read) {
  return L(read(r.first), read(r.second));
}
// A number of each point, and a vector.
using PointField = float (FaceRecord::*)[4];
template <class R> BRICKFALL_LANES auto pointsOf(const R& r, PointField field) {
  return lanesOf(r, [field](const FaceRecord& one) { return load(one.*field); });
}
template <class R> BRICKFALL_LANES auto vectorOf(const R& r, Vec3f FaceRecord::*field) {
  return lanesOf(r, [field](const FaceRecord& one) { return wide::load3Padded(one.*field); });
}

// The face's frame and arms, unpacked.
template <class L> struct Frame { L n, t1, t2, armA, armB; };
template <class R> BRICKFALL_LANES auto frame(const R& r) {
  auto n = vectorOf(r, &FaceRecord::n), t1 = vectorOf(r, &FaceRecord::t1);
  return Frame<decltype(n)>{n, t1, cross3(n, t1), vectorOf(r, &FaceRecord::armA), vectorOf(r, &FaceRecord::armB)};
}

// Whether a lane resists rolling, in any of the records; the lanes that do.
BRICKFALL_LANES bool anyRolls(const FaceRecord& r) { return r.rolls != 0; }
template <class L> BRICKFALL_LANES bool anyRolls(const RecordPair<L>& r) {
  return (r.first.rolls | r.second.rolls) != 0;
}
template <class R> BRICKFALL_LANES auto rollingLanes(const R& r) {
  auto marks = lanesOf(r, [](const FaceRecord& one) { return V{0, 0, 0, float(one.rolls)}; });
  return marks > decltype(marks){};
}

// Whether any of the records is a face that crushes; what its points bear at most, below 0; what they yield by.
BRICKFALL_LANES bool anyCrushes(const FaceRecord& r) { return r.near < 0; }
template <class L> BRICKFALL_LANES bool anyCrushes(const RecordPair<L>& r) {
  return (r.first.near < 0) | (r.second.near < 0);
}
template <class R> BRICKFALL_LANES auto mostInLanes(const R& r) {
  return lanesOf(r, [](const FaceRecord& one) { return wide::all<V>(mostOf(one)); });
}
template <class R> BRICKFALL_LANES auto yieldInLanes(const R& r) {
  return lanesOf(r, [](const FaceRecord& one) { return wide::all<V>(yieldOf(one)); });
}

// Displacements of the four points.
template <class L> struct PointMotion { L n, t1, t2; };
template <class R, class L>
BRICKFALL_LANES PointMotion<L> pointMotion(const R& r, const Frame<L>& f, const SolveMotion* motion) {
  L dA = lanesOf(r, [motion](const FaceRecord& one) { return load(&motion[one.bodyA].d.x); });
  L dB = lanesOf(r, [motion](const FaceRecord& one) { return load(&motion[one.bodyB].d.x); });
  L thA = lanesOf(r, [motion](const FaceRecord& one) { return load(&motion[one.bodyA].th.x); });
  L thB = lanesOf(r, [motion](const FaceRecord& one) { return load(&motion[one.bodyB].th.x); });
  L u = (dB + cross3(thB, f.armB)) - (dA + cross3(thA, f.armA));
  L w = thB - thA;
  L along = sums(u * f.n, u * f.t1, u * f.t2, w * f.n);  // un u1 u2 wn
  L tilt = sums(w * f.t1, w * f.t2, L{}, L{});           // w1 w2
  L s1 = pointsOf(r, &FaceRecord::s1), s2 = pointsOf(r, &FaceRecord::s2);
  L wn = spread<3>(along);
  PointMotion<L> moved{spread<0>(along) + spread<0>(tilt) * s2 - spread<1>(tilt) * s1, spread<1>(along) - wn * s2,
                       spread<2>(along) + wn * s1};
  if (anyRolls(r)) {
    auto rolling = rollingLanes(r);
    moved.t1 = select(rolling, spread<0>(tilt) * s1, moved.t1);
    moved.t2 = select(rolling, spread<1>(tilt) * s1, moved.t2);
  }
  return moved;
}

template <class L> struct PointForces {
  L trialN, n;  // N
  L trial1, trial2, t1, t2;
  L inverse;                   // 1/N: of the tangential trial force's length, where the point slides
  decltype(L{} > L{}) slides;  // outside the friction cone
};

template <class R, class L> BRICKFALL_LANES PointForces<L> pointForces(const R& r, const PointMotion<L>& moved) {
  PointForces<L> f;
  L k = pointsOf(r, &FaceRecord::k);
  f.trialN = pointsOf(r, &FaceRecord::trialN) - (k * moved.n);
  f.n = max(f.trialN, pointsOf(r, &FaceRecord::leastN));
  if (anyCrushes(r)) f.n = max(-max(-f.n, -mostInLanes(r)), f.trialN - yieldInLanes(r));
  f.trial1 = pointsOf(r, &FaceRecord::trial1) - (k * moved.t1);
  f.trial2 = pointsOf(r, &FaceRecord::trial2) - (k * moved.t2);
  L limit = pointsOf(r, &FaceRecord::limit);
  L trialSquared = (f.trial1 * f.trial1) + (f.trial2 * f.trial2);
  f.slides = trialSquared > (limit * limit);
  // No branch: which points slide is hard to foresee, and a root and a division are cheap. For sticking points they may
  // give any number.
  f.inverse = wide::all<L>(1) / sqrt(trialSquared);
  L scale = select(f.slides, limit * f.inverse, wide::all<L>(1));
  f.t1 = f.trial1 * scale;
  f.t2 = f.trial2 * scale;
  return f;
}

// Force and torque on B about the face's centre, world axes.
template <class L> struct WideWrench { L force, torque; };
template <class R, class L>
BRICKFALL_LANES WideWrench<L> wrench(const R& r, const Frame<L>& frame, const PointForces<L>& f) {
  L s1 = pointsOf(r, &FaceRecord::s1), s2 = pointsOf(r, &FaceRecord::s2), t1 = f.t1, t2 = f.t2;
  L roll1{}, roll2{};  // N m, about t1 and t2
  const bool rolls = anyRolls(r);
  if (rolls) {
    auto rolling = rollingLanes(r);
    roll1 = keepIf(rolling, s1 * t1);
    roll2 = keepIf(rolling, s1 * t2);
    t1 = select(rolling, L{}, t1);
    t2 = select(rolling, L{}, t2);
  }
  L force = sums(f.n, t1, t2, s1 * t2 - s2 * t1);  // Fn F1 F2 Mn
  L tilt = sums(s2 * f.n, s1 * f.n, L{}, L{});     // M1 -M2
  if (rolls) tilt = tilt + sums(roll1, -roll2, L{}, L{});
  return {frame.n * spread<0>(force) + frame.t1 * spread<1>(force) + frame.t2 * spread<2>(force),
          frame.n * spread<3>(force) + frame.t1 * spread<0>(tilt) - frame.t2 * spread<1>(tilt)};
}

// N: points count as closed above this normal force. Open points that are near may count as closed, too. A point that a
// rebound pushes apart does not.
template <class R> BRICKFALL_LANES auto closedAbove(const R& r, Resist how) {
  auto least = pointsOf(r, &FaceRecord::leastN);
  using L = decltype(least);
  L reach{};
  if (how == Resist::nearly)
    reach = pointsOf(r, &FaceRecord::k) * lanesOf(r, [](const FaceRecord& one) { return wide::all<V>(one.near); });
  return select(least > L{}, least, -max(-least, reach));
}

// Loaded points resist along the normal, and near open points may, too: a Newton step must not run through them. Nor
// through points of mortar at a cap, which are firm as soon as they turn back: they resist by their secant, with which
// a step still lowers the energy. Sticking points resist tangentially; sliding ones only across their slip, or by their
// secant in all directions.
template <class R, class L>
BRICKFALL_LANES StiffnessOf<L> stiffness(const R& r, const Frame<L>& frame, const PointForces<L>& f, Resist how) {
  L s1 = pointsOf(r, &FaceRecord::s1), s2 = pointsOf(r, &FaceRecord::s2), k = pointsOf(r, &FaceRecord::k);
  L limit = pointsOf(r, &FaceRecord::limit), zero{};
  auto normalOn = f.trialN > closedAbove(r, how);
  L kn = keepIf(normalOn, k);
  if (anyCrushes(r)) {
    L most = mostInLanes(r), pull = pointsOf(r, &FaceRecord::leastN);
    auto crushing = (f.trialN > most) & (most > f.trialN - yieldInLanes(r)), opening = pull > f.trialN;
    const bool exact = how == Resist::exactly;
    kn = select(crushing, exact ? zero : k * (most / f.trialN), kn);
    if (!exact) kn = select(opening & (zero > pull), k * (pull / f.trialN), kn);
  }
  auto frictional = limit > zero;
  L kt = keepIf(frictional, k);
  auto sliding = f.slides & frictional;
  // Sliding: k |f| / |trial|, on the direction across the trial force alone or on all.
  L share = kt * (limit * f.inverse), along1 = f.trial1 * f.inverse, along2 = f.trial2 * f.inverse;
  L t11 = select(sliding, share * (along2 * along2), kt);
  L t22 = select(sliding, share * (along1 * along1), kt);
  L t12 = select(sliding, -(share * (along1 * along2)), zero);
  if (how == Resist::bySecants) {
    t11 = t22 = select(sliding, share, kt);
    t12 = zero;
  }
  L roll11{}, roll12{}, roll22{};  // torque against turns about t1 and t2
  const bool rolls = anyRolls(r);
  if (rolls) {
    auto rolling = rollingLanes(r);
    roll11 = keepIf(rolling, t11 * s1 * s1);
    roll12 = keepIf(rolling, t12 * s1 * s1);
    roll22 = keepIf(rolling, t22 * s1 * s1);
    t11 = select(rolling, zero, t11);
    t12 = select(rolling, zero, t12);
    t22 = select(rolling, zero, t22);
  }
  L kn1 = kn * s1, kn2 = kn * s2;
  L ta = s1 * t12 - s2 * t11;  // turning about n couples to t1 ...
  L tb = s1 * t22 - s2 * t12;  // ... and t2
  L n = sums(kn, kn1, kn2, s1 * tb - s2 * ta);
  L q = sums(kn1 * s1, kn1 * s2, kn2 * s2, ta);
  L t = sums(t11, t12, t22, tb);

  StiffnessOf<L> out;
  L an = frame.n * spread<0>(n), a1 = frame.t1 * spread<0>(t) + frame.t2 * spread<1>(t),
    a2 = frame.t1 * spread<1>(t) + frame.t2 * spread<2>(t);
  L bn = frame.t1 * spread<2>(n) - frame.t2 * spread<1>(n);  // normal force against tilt
  L bt = frame.t1 * spread<3>(q) + frame.t2 * spread<3>(t);  // tangential force against the turn about n
  L cn = frame.n * spread<3>(n), c1 = frame.t1 * spread<2>(q) - frame.t2 * spread<1>(q),
    c2 = frame.t2 * spread<0>(q) - frame.t1 * spread<1>(q);
  if (rolls) {
    L roll = sums(roll11, roll12, roll22, zero);
    c1 = c1 + frame.t1 * spread<0>(roll) + frame.t2 * spread<1>(roll);
    c2 = c2 + frame.t1 * spread<1>(roll) + frame.t2 * spread<2>(roll);
  }
  auto row = [&](L ni, L t1i, L t2i, L bti, int i) {
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
