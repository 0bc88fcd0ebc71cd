// A mortar joint between two bodies: its face in the frames of both, its strength, and its memory. The displacement of
// the one face against the other is measured from the bodies' poses in each step.
//
// All that happens to the face goes through four points. Intact, they are the corners of its kern: then the stress that
// a point carries is that at the face's corner, and the face cracks at its true moment. As damage grows they go to the
// corners of a rectangle with the face's radii of gyration, about which it rocks once it is broken.
#pragma once
#include <cstdint>

#include "brickfall/mortar.h"
#include "dynamics/body_set.h"

namespace brickfall {

using MortarIndex = std::uint32_t;

//! not of the method: a count
constexpr int kMortarPoints = 4;

// What a joint withstands (MortarStrength), in floats: a wall has three joints a brick. These differ from one joint to
// the next, where they scatter.
struct JointStrength {
  float tension = 0, cohesion = 0;           // Pa
  float tensionEnergy = 0, shearEnergy = 0;  // J/m2
};
// These do not: joints share them (MortarSet).
struct SharedStrength {
  float friction = 0;                         // 1
  float compression = 0, crushingEnergy = 0;  // Pa, J/m2
  float stiffness = 0;                        // N/m3
};

struct Mortar {
  std::uint16_t generation = 0;
  bool alive : 1 = false;
  bool born : 1 = true;      // made since the islands were built
  bool idle : 1 = false;     // neither body is dynamic, one takes no part, or it is broken
  bool cracked : 1 = false;  // its crack was told
  bool broken : 1 = false;
  bool opens : 1 = false;    // it took some of its energy in the last step; crushed, that nothing presses on it
  bool crushed : 1 = false;  // it is told as broken, and bears pressure until it opens
  bool ends : 1 = false;     // with this step: nothing is left that opens, or crushes, the face
  BodyIndex bodyA = kNoIndex, bodyB = kNoIndex;
  float area = 0;                          // m2
  std::uint64_t order = 0;                 // grows with creation
  double damage = 0;                       // 0 .. 1
  const SharedStrength* shared = nullptr;  // of the set; null: no joint
  JointStrength strength;
  float gyration[2] = {};  // m: along the second and the third axis

  // Floats round them; the points begin where that leaves them (keepForces).
  Vec3T<float> centreA, centreB;  // m, body frames: the face's centre
  QuatT<float> frameA, frameB;    // body frames: normal from A to B, and the face's principal axes
  float tensionWork = 0, shearWork = 0, crushingWork = 0;  // J, spent
  float tougher = 1;  // x its energy, as long as it opens after a blow that crushed
  float arm = 1;      // of the kern: how far out the points are
  // m, in the frame of A: displacement of each point at which it carries nothing.
  float opening[kMortarPoints] = {}, slip1[kMortarPoints] = {}, slip2[kMortarPoints] = {};
  Vec3T<float> force, torque;  // N, N m, from A on B, about the face's centre: in the last step

  bool gone() const { return broken; }
  bool endsNow() const { return ends; }
  bool collides() const { return broken; }
  bool names(BodyIndex body) const { return bodyA == body || bodyB == body; }
};

static_assert(sizeof(Mortar) <= 216);

inline Vec3 inDouble(Vec3T<float> v) { return {v.x, v.y, v.z}; }
inline Quat inDouble(QuatT<float> q) { return normalized(Quat{q.x, q.y, q.z, q.w}); }
// Where the face is on A, or on B.
void placeFace(Mortar& mortar, bool onA, Vec3 centre, Quat frame);

// That took most of its energy.
MortarMode modeOf(const Mortar& mortar);
// J, spent on it in all modes.
inline double workOn(const Mortar& m) { return double(m.tensionWork) + double(m.shearWork) + double(m.crushingWork); }

// Place i of the four: signs along the second and the third axis.
//! not of the method: the corners in turn
constexpr float kMortarSide1[kMortarPoints] = {1, 1, -1, -1}, kMortarSide2[kMortarPoints] = {1, -1, -1, 1};

// Where the face is.
struct MortarPose {
  MortarPose(const Mortar& mortar, const BodySet& bodies);
  Vec3 n, t1, t2;   // unit, world: axes of the face on A
  Vec3 armA, armB;  // m, from the centres of mass to the middle of the two faces' centres
  Vec3 centre;      // m, world
  // m, of B against A, along n, t1, t2: of the centre, and by metre along each of the face's axes.
  Vec3 displaced, along1, along2;
};

}  // namespace brickfall
