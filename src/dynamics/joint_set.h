// All joints of a world.
#pragma once
#include "dynamics/joint.h"
#include "dynamics/lasting_ties.h"

namespace brickfall {

class JointSet : public LastingTies<Joint, LinkKind::joint> {
 public:
  // --- functions of every kind of tie (contact_set.h)
  void displace(BodyIndex) {}  // a joint pulls its bodies together again, wherever they are put
  void renewConstants(BodyIndex body, const ShapeSet& shapes, const BodySet& bodies);
  void beginStep();
  void hash(Mix& h, JointIndex joint) const;
  void archive(WriteArchive& a) const;
  void archive(ReadArchive& a);
  void checkStructure(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const;
  void checkRanges(Findings& f) const;
  void check(Findings& f, const BodySet& bodies, const ShapeSet& shapes) const;
};

}  // namespace brickfall
