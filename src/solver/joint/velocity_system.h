// Equations of velocities of the bodies of an island that hang together by joints, where a step ends: what each joint
// holds, and the matrix of all of them.
#pragma once
#include <memory_resource>
#include <vector>

#include "solver/body_matrix.h"
#include "solver/island.h"
#include "solver/joint/equations.h"
#include "solver/numbering.h"

namespace brickfall {

//! - | too small: joints keep a part of their velocity | too large: cost
constexpr int kHoldRounds = 2;  // each leaves a part of what the last left

// By its number in an island, partners last.
inline BodyIndex bodyOf(const Island& island, std::uint32_t local) {
  return local < island.bodies.size() ? island.bodies[local] : island.partners[local - island.bodies.size()];
}
// Where the step ends.
JointPlace placeAtEnd(const Island& island, std::uint32_t local, const StepContext& context);

class VelocitySystem {
 protected:
  VelocitySystem(Island& island, StepContext& context);

  // At the end of the step.
  struct Body {
    BodyIndex body = 0;
    JointPlace place;
    Vec3 startMove, startSpin, move, spin;  // m/s, rad/s
    Mat3 inertia, invInertia;
    double mass = 0;
    Vec3 impulse, turning;  // N s, N m s: sums
  };
  struct Equation {
    std::uint32_t row = 0;
    bool turn = false, oneSided = false;
    float sign = 0;  // of a one-sided force
    Vec3 axis, armA, armB;
    double stiffness = 0, impulse = 0;
    double wanted = 0;  // m/s or rad/s: the change of speed that it asks for
    bool open = false;
  };

  // Those that joints tie; with `loads`, also those that other ties press on them.
  void findBodies(bool loads = false);
  // What joints hold at the poses of the end. Limits and ropes hold if they did in the step.
  void findEquations(const Ties& ties);
  // N s/m, or N m s/rad: of a joint's equation.
  double firmness(std::size_t row, bool turn) const;
  // Poses, arms and equations of a joint at the end.
  struct Posed {
    JointPose pose;
    JointSystem system;
    Vec3 armA, armB;  // m, to where impulses act on each; of what flies, one place for both
  };
  Posed posed(std::size_t row, const Joint& joint) const;

  bool moves(std::uint32_t local) const { return local < island_.bodies.size(); }
  std::uint32_t placeOf(std::uint32_t local) const { return moves(local) ? place_[local] : kNoPlace; }
  const Body& at(std::uint32_t local) const { return moves(local) ? bodies_[place_[local]] : partners_[place_[local]]; }

  // m/s and rad/s: of B against A, where its impulses act.
  struct Speeds {
    Vec3 way, turn;
  };
  Speeds speedsOf(const Equation& e) const;
  // N s, N m s: along its axis, for what is left of what it asks.
  static double missing(const Equation& e, const Speeds& now) {
    return e.stiffness * (e.wanted - dot(e.axis, e.turn ? now.turn : now.way));
  }
  // visit(first, end) for the equations of each row, of the first `count`.
  template <class Visit> void eachRow(std::size_t count, Visit visit) const {
    for (std::size_t first = 0, end = 0; first < count; first = end) {
      for (end = first; end < count && equations_[end].row == equations_[first].row;) end++;
      visit(first, end);
    }
  }

  // The matrix of all equations, of inertia, and of what `addTo(row, block)` adds to a joint's block.
  template <class AddTo> void assemble(AddTo addTo) {
    clearToInertia();
    for (std::size_t first = 0, end = 0; first < equations_.size(); first = end) {
      BodyBlock K = {};
      end = sumOfRow(first, K);
      addTo(equations_[first].row, K);
      addRow(equations_[first], K);
    }
  }
  bool factor() { return matrix_.factor(); }
  // What the equations of a row ask of the speeds of now: told with give, or added to their impulses, and those told.
  template <class Give> void give(std::size_t first, std::size_t end, Give giveTo) const {
    const Speeds now = speedsOf(equations_[first]);
    Vec3 linear, angular;
    for (std::size_t i = first; i < end; i++) {
      const Equation& e = equations_[i];
      if (!e.open) (e.turn ? angular : linear) += e.axis * missing(e, now);
    }
    giveBoth(equations_[first], linear, angular, giveTo);
  }
  template <class Give> void take(std::size_t first, std::size_t end, Give giveTo) {
    const Speeds now = speedsOf(equations_[first]);
    Vec3 linear, angular;
    for (std::size_t i = first; i < end; i++) {
      Equation& e = equations_[i];
      if (!e.open) e.impulse += missing(e, now);
      (e.turn ? angular : linear) += e.axis * e.impulse;
    }
    giveBoth(equations_[first], linear, angular, giveTo);
  }
  // On B and back on A.
  template <class Give> void giveBoth(const Equation& at, Vec3 linear, Vec3 angular, Give giveTo) const {
    const JointRecord& r = island_.rows.joints.records[at.row];
    if (moves(r.bodyA)) giveTo(place_[r.bodyA], -linear, -angular - cross(at.armA, linear));
    if (moves(r.bodyB)) giveTo(place_[r.bodyB], linear, angular + cross(at.armB, linear));
  }

  // Of the right side.
  void clear() { std::fill(step_.begin(), step_.end(), 0.0); }
  void push(std::uint32_t place, Vec3 linear, Vec3 angular) {
    for (int k = 0; k < 3; k++) {
      step_[6 * place + std::size_t(k)] += linear[k];
      step_[6 * place + 3 + std::size_t(k)] += angular[k];
    }
  }
  // Solves, and adds the velocities found to those of the bodies.
  void solveMore();

  Island& island_;
  StepContext& context_;
  std::pmr::vector<std::uint32_t> place_;  // of a body in the matrix, of a partner in its list
  std::pmr::vector<Body> bodies_;          // by place
  std::pmr::vector<Body> partners_;
  std::pmr::vector<Equation> equations_;  // by row
  BlockEnvelope matrix_;

 private:
  Body bodyAt(std::uint32_t local) const;
  void enterLoads(std::pmr::vector<std::uint32_t>& found);
  void clearToInertia();
  std::size_t sumOfRow(std::size_t first, BodyBlock& K) const;
  void addRow(const Equation& of, const BodyBlock& K);

  std::pmr::vector<double> step_;
};

}  // namespace brickfall
