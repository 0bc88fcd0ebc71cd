// Linkages drawn at random, for laws that hold in all of them: two to fourteen bodies of any shape, 1:1000 in size, tied to a
// tree, a chain or a ring by joints of any type, with limits or without. They float, hang or fall on a ground, at time steps
// that resolve them: nothing goes further than a part of its size in one.
#pragma once
#include <string>
#include <vector>

#include "law/draw.h"

namespace brickfall::law {

// What holds a random linkage.
enum class LinkageKind { floats, hangs, falls };
constexpr int kLinkageKinds = 3;
const char* nameOf(LinkageKind kind);

struct RandomLinkage : DrawnWorld {
  std::vector<double> sizes;  // m: about half the extent of each body
  std::vector<JointId> joints;
  std::vector<double> spans;  // m: size of the smaller body of each joint
};
RandomLinkage drawLinkage(LinkageKind kind, int seed);

struct LinkageOutcome {
  double gain = 0;     // most energy above that of the start / the most that moved
  double gape = 0;     // largest error of a joint at the end / the size of its smaller body
  double linear = 0;   // change of linear momentum / sum of those of all bodies; of what floats
  double angular = 0;  // likewise, angular
  bool finite = true;
};
// Runs the linkage to its end. Springs count with what they hold. Energy is that at the end of a step or that of its middle,
// whichever is less: velocities are those of the middle of a step, places those of its end.
LinkageOutcome runLinkage(RandomLinkage& linkage);

}  // namespace brickfall::law
