// Pairs of shapes that pass each other in the coming step, if what both touch before that lets them go on straight.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "dynamics/body_set.h"
#include "dynamics/contact_set.h"

namespace brickfall {

struct PassedPair {
  std::uint32_t pair = 0;  // in ContactSet::pairs
  double time = 0;         // s, when they are past
  double apart = 0;        // m, by which they clear each other until then
};

// How what a body touches in the step turns it aside from its way.
struct Course {
  double straightUntil = 0;  // s: until then by no more than `slack`
  double aside = 0;          // m/s: and then at this speed at most
  double slack = 0;          // m
};

// By body. Of what passes nothing it says nothing.
void findCourses(const BodySet& bodies, const ContactSet& contacts, std::span<const PassedPair> passed,
                 std::vector<Course>& courses);

// What two bodies on these courses touch does not bring them as near in a step of dt as they are apart.
bool staysPassed(const PassedPair& passed, const Course& a, const Course& b, double dt);

}  // namespace brickfall
