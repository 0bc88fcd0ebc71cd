// Pairs of shapes that pass each other in the coming step, if other contacts let both go straight before that; and how
// deep bodies roll, which says what they pass.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "dynamics/body_set.h"
#include "dynamics/contact_set.h"
#include "dynamics/shape_set.h"

namespace brickfall {

struct PassedPair {
  std::uint32_t pair = 0;  // in ContactSet::pairs
  double time = 0;         // s, when they are past
  double apart = 0;        // m, by which they clear each other until then
};

// How the contacts of a body in the step turn the body aside from its way.
struct Course {
  double straightUntil = 0;  // s: until then the body strays by no more than `slack`
  double aside = 0;          // m/s: and then at this speed at most
  double slack = 0;          // m
};

// How far a body has sunk into what bears it: contacts are springs, softer the longer the step and the lighter the
// bodies.
struct Sinking {
  bool bears = false;  // something rolls on the body
  double faces = 0;    // m: of such a body
  double rolling = 0;  // m: of one that rolls, with what it rolls on. So far it lies below what nothing presses on
};

// By body.
void findSinking(const BodySet& bodies, const ShapeSet& shapes, const ContactSet& contacts,
                 std::vector<Sinking>& sinking);

// Courses by body. They say nothing of a body that passes no other.
void findCourses(const BodySet& bodies, const ContactSet& contacts, std::span<const PassedPair> passed,
                 std::vector<Course>& courses);

// Whether the contacts of two bodies on these courses bring them, in a step of dt, no nearer than they are apart.
bool staysPassed(const PassedPair& passed, const Course& a, const Course& b, double dt);

}  // namespace brickfall
