// A body is replaced by several, and its mortar holds those on which its faces are. Where a face is gone, or is cut in
// two, the joint ends.
#pragma once
#include <vector>

#include "dynamics/ties.h"
#include "world/diary.h"
#include "world/registry.h"

namespace brickfall {

class MortarSuccession {
 public:
  // Takes all mortar that holds off the body: to be called before the body is taken out.
  MortarSuccession(const Registry& registry, BodyIndex body, MortarSet& set);
  // Puts it on the pieces, with all that it remembers; tells what ends.
  void pass(const Registry& registry, const std::vector<BodyIndex>& pieces, MortarSet& set, Diary& diary) const;

 private:
  struct Face {
    explicit Face(const MortarPose& at) : pose(at) {}
    MortarPose pose;
    MortarIndex mortar = kNoIndex;
    bool ofA = false;          // the body was the joint's A
    BodyId was;                // the body
    Vec3 centre, normal;       // m, unit, world; the normal out of the body
    Quat axes;                 // world
    double size = 0;           // m: smaller radius of gyration
    std::vector<Vec3> places;  // m, world: of the face on the body's surface
  };

  static bool bears(const Registry& registry, BodyIndex piece, const Face& face);

  std::vector<Face> faces_;
};

}  // namespace brickfall
