// What a solve takes from mortar: its caps fall until no joint takes more than its fracture energy has left, and what
// it took is damage.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "solver/face/point_forces.h"
#include "solver/finish/motion.h"
#include "solver/island.h"
#include "solver/mortar/rows.h"

namespace brickfall {

namespace {

//! - | too small: passes for the last of the energy | too large: joints take more than their energy
constexpr double kMoreThanLeft = 0.02;  // of the energy left, that a joint may take besides; a cap falls by no less
//! of the tension stiffness | too small: hits leave no trace | too large: shear within its strength counts as damage
constexpr double kShearStiffness = 0.44;  // of mortar, ks / kn

// Forces and ways at the present motion, arcs and all.
PointForces stateAt(const FaceRecord& r, const MortarStart& start, const SolveMotion* motion) {
  PointForces out = pointForcesAt(r, motion);
  const float arcN = dot(r.n, start.arc), arc1 = dot(r.t1, start.arc), arc2 = dot(cross(r.n, r.t1), start.arc);
  for (int i = 0; i < 4; i++) {
    out.way[i] += arcN;
    out.way1[i] += arc1;
    out.way2[i] += arc2;
  }
  return out;
}

// m: how far a point yields to pressure.
float crushedBy(const FaceRecord& r, const PointForces& now, int i) {
  const float more = now.trialN[i] - mostOf(r);
  return more > 0 ? std::min(more, yieldOf(r)) / r.k[i] : 0.0f;
}

struct Taken {
  double pull = 0, shear = 0, crush = 0;  // J
  double use = 0;                         // largest force of a point over that of intact mortar
  double standing = 0;                    // of `use`: in balance before the step
  bool yields = false;
  bool loads = false;  // its forces are overcome
};

// Of a joint's forces in one mode, J.
struct Work {
  double start = 0, found = 0;  // over the ways by the start velocities, and over those that were found
  double held = 0;              // that its springs hold more

  void add(double byStart, double byFound, double more) {
    start += byStart;
    found += byFound;
    held += more;
  }
  // Over the mean of the two: by the way found alone a hit is over before it has begun, and takes nothing. But no less
  // than over the way found, which is what the solve takes: a joint may close at the start and part within the step.
  bool stops() const { return start > found; }
  double taken() const { return std::max(0.0, 0.5 * (std::max(start, found) + found) - held); }
};

// Of what slides the cohesive share only, since the rest is friction. Over the ways by the velocities at the start
// works what stops these: not a force that stood there before, in balance with others. In joints that press against
// each other a trace of speed would else cost as much as if it drove the standing force.
Taken takenBy(const Mortar& m, const FaceRecord& r, const MortarStart& start, const PointForces& now) {
  Taken out;
  const double k = mortar::stiffnessOf(m), rubs = std::max(0.0, double(m.shared->friction) * double(start.pressure));
  auto held = [&](double force, double before) { return 0.5 * (force * force - before * before) / k; };
  Work pull, shear;
  const double stood = m.opens ? 0 : 1;
  for (int i = 0; i < 4; i++) {
    out.yields = out.yields || now.trialN[i] < r.leastN[i] || (now.slides >> i & 1);
    out.crush += double(crushedBy(r, now, i)) * double(mostOf(r));
    const double pulls = std::min(0.0, double(now.n[i])), before = std::min(0.0, double(start.heldN[i]));
    pull.add((stood * before - pulls) * double(start.opens[i]), -pulls * double(now.way[i]), held(pulls, before));
    const double f1 = now.t1[i], f2 = now.t2[i], along = std::sqrt(f1 * f1 + f2 * f2);
    const double cohesive = along > 0 ? std::max(0.0, along - rubs) / along : 0;
    const double more1 = f1 - stood * double(start.held1[i]), more2 = f2 - stood * double(start.held2[i]);
    shear.add(cohesive * (-more1 * double(start.goes1[i]) - more2 * double(start.goes2[i])),
              cohesive * (-f1 * double(now.way1[i]) - f2 * double(now.way2[i])),
              cohesive * (held(f1, start.held1[i]) + held(f2, start.held2[i])));
    out.use = std::max({out.use, -pulls / mortar::pullOf(m), cohesive * along / mortar::shearOf(m)});
    const double hold1 = start.held1[i], hold2 = start.held2[i];
    out.standing = std::max({out.standing, -before / mortar::pullOf(m),
                             cohesive * std::sqrt(hold1 * hold1 + hold2 * hold2) / mortar::shearOf(m)});
  }
  out.standing = pull.stops() || shear.stops() ? stood * std::min(out.standing, out.use) : 0;
  out.loads = pull.found + shear.found > 0;
  out.pull = pull.taken();
  out.shear = shear.taken();
  if (out.yields) return out;
  // Within its strength mortar takes no more than a spring of its stiffness holds.
  const double tension = m.strength.tension, cohesion = m.strength.cohesion, stiffness = m.shared->stiffness;
  const double pulled = 0.5 * tension * tension / stiffness * m.area;
  const double sheared = 0.5 * cohesion * cohesion / (kShearStiffness * stiffness) * m.area;
  const double share = out.pull / pulled + out.shear / sheared, more = share > 1 ? 1 - 1 / share : 0;
  out.pull *= more;
  out.shear *= more;
  return out;
}

// Whether takenBy can find more than is left of the energy, by the most that its points bear: most joints of a wall are
// far from it.
bool mayTakeAll(const Mortar& m, const FaceRecord& r, const MortarStart& start, const SolveMotion* motion) {
  using wide::V;
  auto most = [](V a, V b) { return wide::max(a, b); };
  auto size = [&](V a) { return most(a, -a); };
  const V zero{}, half = wide::all<V>(0.5f / start.stiffness);
  const auto moved = kernel::pointMotion(r, kernel::frame(r), motion);
  const V arcN = wide::all<V>(dot(r.n, start.arc)), arc1 = wide::all<V>(dot(r.t1, start.arc)),
          arc2 = wide::all<V>(dot(cross(r.n, r.t1), start.arc));
  const V pulls = most(zero, -wide::loadAnywhere(start.heldN)), held1 = wide::loadAnywhere(start.held1),
          held2 = wide::loadAnywhere(start.held2);
  const V opens = most(size(wide::loadAnywhere(start.opens)), size(moved.n + arcN));
  const V goes = most(size(wide::loadAnywhere(start.goes1)) + size(wide::loadAnywhere(start.goes2)),
                      size(moved.t1 + arc1) + size(moved.t2 + arc2));
  const V pull = most(-wide::load(r.leastN), pulls) * opens + pulls * pulls * half;
  const V shear = (wide::load(r.limit) + size(held1) + size(held2)) * goes + (held1 * held1 + held2 * held2) * half;
  auto total = [](V v) { return double((v[0] + v[2]) + (v[1] + v[3])); };
  return total(pull) / mortar::pullEnergy(m) + total(shear) / mortar::shearEnergy(m) >
         mortar::energyLeft(m.damage, double(start.tougher));
}

// N, of a point.
double meanPressure(const PointForces& now) {
  return 0.25 * (double(now.n[0]) + double(now.n[1]) + double(now.n[2]) + double(now.n[3]));
}

// The joint is bent open under so much pressure that it bears the more the further it opens (law.h).
bool stiffens(const Mortar& m, const MortarStart& start, const Taken& taken, const PointForces& now) {
  return start.arm < mortar::kBroadest && 2 * meanPressure(now) > mortar::pullOf(m) &&
         taken.pull * mortar::shearEnergy(m) > taken.shear * mortar::pullEnergy(m);
}

// The damage with which the face just bears what it is bent by: (mean - least) arm = mean (1 + 2 D) + pull (1 - D).
double damageBy(const Mortar& m, const MortarStart& start, const PointForces& now) {
  const double mean = meanPressure(now);
  const double least = std::min({now.n[0], now.n[1], now.n[2], now.n[3]}), pull = mortar::pullOf(m);
  if (!(2 * mean > pull)) return 0;
  return std::clamp(((mean - least) * double(start.arm) - mean - pull) / (2 * mean - pull), 0.0, 1.0);
}

// The points went out within the step: where they carry nothing now.
void placeWidened(Mortar& m, const MortarStart& start) {
  if (start.arm == m.arm) return;
  const double by = double(start.arm) / double(m.arm), k = mortar::stiffnessOf(m);
  auto widen = [&](float* places, const float* held) {
    double mean = 0, gap[4], middle = 0;
    for (int i = 0; i < 4; i++) mean += 0.25 * double(held[i]);
    for (int i = 0; i < 4; i++) {
      gap[i] = double(places[i]) - (mean + (double(held[i]) - mean) * by) / k;
      middle += 0.25 * gap[i];
    }
    for (int i = 0; i < 4; i++) places[i] = float(middle + (gap[i] - middle) * by + double(held[i]) / k);
  };
  widen(m.opening, start.heldN);
  widen(m.slip1, start.held1);
  widen(m.slip2, start.held2);
  m.arm = start.arm;
}

// The middle of the face went so far that its whole strength, falling evenly to nothing, would have taken more than is
// left to it.
bool wentTooFar(const Mortar& m, const MortarStart& start, const PointForces& now) {
  double pulled = 0, sheared = 0;  // m, sums over its points
  for (int i = 0; i < 4; i++) {
    pulled += double(now.way[i]);
    sheared += std::sqrt(double(now.way1[i]) * now.way1[i] + double(now.way2[i]) * now.way2[i]);
  }
  const double share = std::max(0.0, pulled) * mortar::pullOf(m) / mortar::pullEnergy(m) +
                       sheared * mortar::shearOf(m) / mortar::shearEnergy(m);
  return 0.5 * mortar::strengthOf(m) * share > mortar::energyLeft(m.damage, double(start.tougher));
}

// Of what caps on pull and shear take, and S makes less.
double shareOf(const Taken& taken, const Mortar& m) {
  return taken.pull / mortar::pullEnergy(m) + taken.shear / mortar::shearEnergy(m);
}

}  // namespace

bool MortarRows::renewFrozen(const Island& island, const StepContext& context, Renewal) {
  bool fell = false;
  for (std::size_t k = 0; k < size(); k++) {
    const Mortar& m = at(k, *context.ties);
    if (renewArc(k, m, island, *context.bodies)) {
      fell = true;
      continue;
    }
    if (m.crushed) continue;
    MortarStart& start = starts[k];
    if (!mayTakeAll(m, records[k], start, island.motion.data())) continue;
    const PointForces now = stateAt(records[k], start, island.motion.data());
    const Taken taken = takenBy(m, records[k], start, now);
    const double share = shareOf(taken, m), left = mortar::energyLeft(m.damage, double(start.tougher));
    if (!(share > (1 + kMoreThanLeft) * left)) continue;
    if (stiffens(m, start, taken, now)) {
      widen(k, m);
      fell = true;
      continue;
    }
    const float lower = float(taken.standing + (taken.use - taken.standing) * left / share);
    if (!(lower < (1 - kMoreThanLeft) * start.left)) continue;
    start.left = lower;
    writeCaps(k, m);
    fell = true;
  }
  return fell;
}

bool MortarRows::store(Island& island, Ties& ties, StepContext&) {
  if (island.resting()) return false;
  for (std::size_t k = 0; k < size(); k++) {
    Mortar& m = at(k, ties);
    const FaceRecord& r = records[k];
    MortarStart& start = starts[k];
    const PointForces now = stateAt(r, start, island.motion.data());
    const Taken taken = takenBy(m, r, start, now);
    const double opened = shareOf(taken, m), hurt = mortar::damageFor(m.damage, double(start.tougher), opened);
    const double share = m.crushed ? 0 : hurt + taken.crush / mortar::crushEnergy(m),
                 most = share > 1 - m.damage ? (1 - m.damage) / share : 1, paid = opened > 0 ? most * hurt / opened : 0;
    m.damage = wentTooFar(m, start, now) ? 1 : std::min(1.0, m.damage + share * most);
    if (start.arm > m.arm) m.damage = std::max(m.damage, damageBy(m, start, now));
    m.opens = m.crushed ? !(std::max({now.n[0], now.n[1], now.n[2], now.n[3]}) > 0) : share > 0;
    m.ends = m.crushed ? m.opens : m.damage >= (m.opens ? mortar::kBroken : mortar::kThread);
    m.tougher = m.opens || taken.loads ? start.tougher : 1;
    start.pull = float(taken.pull * paid);
    start.shear = float(taken.shear * paid);
    start.crush = float(taken.crush * most);
    m.tensionWork += start.pull;
    m.shearWork += start.shear;
    m.crushingWork += start.crush;
    placeWidened(m, start);
    const double stiffness = mortar::stiffnessOf(m);
    const bool soft = r.k[0] < 0.999f * float(stiffness);
    for (int i = 0; i < 4; i++) {
      const bool opens = soft || now.trialN[i] < r.leastN[i] || now.trialN[i] > mostOf(r),
                 slips = soft || (now.slides >> i & 1);
      auto give = [&](float way, float force, float before, float& place) {
        place = float(double(place) + double(way) + (double(force) - double(before)) / stiffness);
      };
      if (opens) give(now.way[i], now.n[i], start.heldN[i], m.opening[i]);
      if (slips) give(now.way1[i], now.t1[i], start.held1[i], m.slip1[i]);
      if (slips) give(now.way2[i], now.t2[i], start.held2[i], m.slip2[i]);
    }
    const Reaction told = react(k, island.motion.data());
    start.before = m.force;
    m.force = wide::store3(told.force);
    m.torque = wide::store3(told.torque);
  }
  return true;
}

// Arms are frozen in the solve. A body that began to turn in the step, or whose motion was finished otherwise than it
// was solved, ends where the joint would carry forces that nobody solved. The joint takes such a place as its own.
void MortarRows::advance(const Island& island, Ties& ties, const StepContext& context) const {
  if (size() == 0) return;
  const BodySet& bodies = *context.bodies;
  std::pmr::vector<std::optional<Mat3>> turns(island.bodies.size() + island.partners.size(), island.memory);
  for (std::size_t k = 0; k < size(); k++) {
    Mortar& m = at(k, ties);
    const FaceRecord& r = records[k];
    const MortarStart& start = starts[k];
    const PointForces now = stateAt(r, start, island.motion.data());
    auto wayOf = [&](std::uint32_t local, BodyIndex body) {
      return local < island.bodies.size() ? context.solved[body].d : bodies.motion[body].linearVelocity * island.dt;
    };
    auto turnOf = [&](std::uint32_t local, BodyIndex body) {
      const BodyMotion& from = bodies.motion[body];
      if (local >= island.bodies.size()) return toMatrix(quatFromRotationVector(from.angularVelocity * island.dt));
      return toMatrix(rotationAtEnd(body, context)) * transpose(from.orientation);
    };
    for (auto [local, body] : {std::pair{r.bodyA, m.bodyA}, std::pair{r.bodyB, m.bodyB}})
      if (!turns[local]) turns[local] = turnOf(local, body);
    const Mat3 &turnA = *turns[r.bodyA], &turnB = *turns[r.bodyB];
    const Vec3 n = toDouble(r.n), t1 = toDouble(r.t1), t2 = cross(n, t1);
    const Vec3 moved = wayOf(r.bodyB, m.bodyB) - wayOf(r.bodyA, m.bodyA);
    const double stiffness = start.stiffness, unseen = kLeftOver * mortar::pullOf(m);
    // At the start of the step: after its way a point is from its place by its force.
    auto startOf = [&](float place, float force, float way) {
      return double(place) - double(force) / stiffness - double(way);
    };
    auto gapAt = [&](int i) {
      return n * startOf(m.opening[i], now.n[i], now.way[i]) + t1 * startOf(m.slip1[i], now.t1[i], now.way1[i]) +
             t2 * startOf(m.slip2[i], now.t2[i], now.way2[i]);
    };
    // The arms end in the middle between the two faces.
    const Vec3 gaps[4] = {gapAt(0), gapAt(1), gapAt(2), gapAt(3)};
    const Vec3 half = (gaps[0] + gaps[1] + gaps[2] + gaps[3]) * 0.125;
    const Vec3 turnedN = turnA * n, turned1 = turnA * t1, turned2 = turnA * t2;
    for (int i = 0; i < 4; i++) {
      const Vec3 pointA = toDouble(r.armA) - half + t1 * double(r.s1[i]) + t2 * double(r.s2[i]);
      const Vec3 pointB = pointA + gaps[i] + toDouble(r.armB) - toDouble(r.armA);
      const Vec3 gap = gaps[i] + moved + (turnB * pointB - pointB) - (turnA * pointA - pointA);
      auto take = [&](Vec3 axis, float force, float& place) {
        const double ends = dot(axis, gap);
        if (std::fabs(stiffness * (ends - double(place)) + double(force)) > unseen)
          place = float(ends + double(force) / stiffness);
      };
      take(turnedN, now.n[i], m.opening[i]);
      take(turned1, now.t1[i], m.slip1[i]);
      take(turned2, now.t2[i], m.slip2[i]);
    }
  }
}

}  // namespace brickfall
