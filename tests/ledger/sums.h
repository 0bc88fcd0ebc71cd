// A run's ledger: steps added up, with the worst of each figure that should be nothing.
#pragma once
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>

#include "brickfall/world.h"
#include "support/input_list.h"

namespace brickfall::test {

inline double energyOf(const Balance& b) { return b.kinetic + b.potential; }

struct Causes {
  BalanceChange gravity, forces, damping, stopped, supports, contacts, solve, impacts, rebound, obstacles, balance,
      integrate, quarantine, remade, renewed;
};

struct Worst {
  double linear = 0, angular = 0, energy = 0;
  int step = 0;  // of the largest energy
};

struct Sums {
  int steps = 0;
  Causes total;
  BalanceChange outside;
  // |after - before - all causes|, of all momentum and energy there is.
  Worst worstGap;
  // What the solve left: momentum that no cause accounts for, in weights of all bodies x dt; angular about the origin with
  // the farthest centre of mass as lever, in the same.
  Worst unbalanced;
  // Energy that no input accounts for: J, and J/kg of all bodies.
  double joints = -1e300;    // J: what contacts ever gave in a step beyond what they held, less the rounding of floats
  double unsolved = -1e300;  // J: most that what the solve left ever gave in a step
  double renewed = 0;        // J: most that contacts were ever told to hold in a step without moving
  double withElastic = -1e300;  // J: largest rise in a step, of all energy with what contacts hold
  double largestRise = -1e300, largestRisePerMass = -1e300;
  int riseStep = 0;
  double supplied = 0;         // J: at the start and by inputs since, above the lowest energy
  double recovered = 0;        // J: largest return above an earlier low: what joints gave back of their elastic energy
  double above = -1e300;       // J: by how much the energy was ever higher than all that was put in
  double mass = 0, reach = 0;  // kg, m
  double energyStart = 0, inputs = 0;  // J

  void add(const World& world, const StepLedger& l) {
    measureBodies(world);
    if (steps == 0) energyStart = energyOf(l.before);
    steps++;
    BalanceChange all{};
    auto sum = [](BalanceChange& into, const BalanceChange& c) {
      into.linear += c.linear;
      into.angular += c.angular;
      into.energy += c.energy;
      into.elastic += c.elastic;
    };
    const BalanceChange* causes[] = {&l.gravity,  &l.forces,    &l.damping,    &l.stopped, &l.supports,
                                     &l.contacts, &l.solve,     &l.impacts,    &l.rebound, &l.obstacles,
                                     &l.balance,  &l.integrate, &l.quarantine, &l.remade,  &l.renewed};
    BalanceChange* totals[] = {&total.gravity,  &total.forces,    &total.damping,    &total.stopped, &total.supports,
                               &total.contacts, &total.solve,     &total.impacts,    &total.rebound, &total.obstacles,
                               &total.balance,  &total.integrate, &total.quarantine, &total.remade,  &total.renewed};
    for (std::size_t i = 0; i < std::size(causes); i++) {
      sum(all, *causes[i]);
      sum(*totals[i], *causes[i]);
    }
    sum(outside, l.outside);
    const double weight = mass * 9.81 / 60;  // N s: the scale of one step
    const double momentum = weight + length(l.before.linear), moment = weight * reach + length(l.before.angular);
    const double energy = 1 + std::fabs(l.before.kinetic) + std::fabs(l.before.potential);
    worstGap.linear = std::max(worstGap.linear, length(l.after.linear - l.before.linear - all.linear) / momentum);
    worstGap.angular = std::max(worstGap.angular, length(l.after.angular - l.before.angular - all.angular) / moment);
    worstGap.energy =
        std::max(worstGap.energy, std::fabs(energyOf(l.after) - energyOf(l.before) - all.energy) / energy);
    const Vec3 left = l.solve.linear + l.obstacles.linear + l.balance.linear + l.integrate.linear;
    const Vec3 leftAngular = l.solve.angular + l.obstacles.angular + l.balance.angular + l.integrate.angular;
    unbalanced.linear = std::max(unbalanced.linear, length(left) / weight);
    unbalanced.angular = std::max(unbalanced.angular, length(leftAngular) / (weight * reach));
    const double made = l.contacts.energy + l.contacts.elastic;
    // Known: what mortar holds together, falls, turns and touches something is given up to 1.4e-3 of its energy by its
    // ties, which the solve takes back (arch-load, one step of 300): forces act along the arms of the start.
    const double known = world.mortars().empty() ? 0 : 1.5e-3 * l.before.kinetic;
    joints = std::max(joints, made - known - 1e-7 * (mass + l.before.kinetic + l.before.elastic));
    unsolved = std::max(unsolved, l.solve.energy);
    renewed = std::max(renewed, l.renewed.elastic);
    moved_ = std::max({moved_, l.before.kinetic, l.after.kinetic});
    const double elastic = l.after.elastic - l.before.elastic;
    const double input = l.forces.energy + l.supports.energy, rise = energyOf(l.after) - energyOf(l.before) - input;
    if (rise > largestRise) {
      largestRise = rise;
      largestRisePerMass = rise / mass;
      riseStep = steps;
    }
    withElastic = std::max(withElastic, rise + elastic);
    inputs += l.outside.energy + input;
    const double net = energyOf(l.after) - energyStart - inputs;
    above = std::max(above, net);
    low_ = std::min(low_, net);
    recovered = std::max(recovered, net - low_);
  }
  // J: that moved, or was lost.
  double spent() const { return moved_ - low_; }

 private:
  double low_ = 0, moved_ = 0;

  void measureBodies(const World& world) {
    mass = reach = 0;
    for (BodyId body : world.bodies()) {
      const BodyState s = *world.state(body);
      if (s.type != BodyType::dynamic) continue;
      mass += s.mass;
      reach = std::max(reach, length(s.centreOfMass));
    }
  }
};

}  // namespace brickfall::test
