// The system of the report itself: boxes in, their motion a step later out. It knows no world.
#pragma once
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "brickfall/geometry/obb.h"
#include "brickfall/geometry/obb_motion.h"
#include "brickfall/report.h"

namespace brickfall {

class ReadArchive;
class WriteArchive;

// A box as the system sees it. Not dynamic: mass 0.
struct ReportBody {
  std::uint64_t id = 0;  // unique, stays with the body
  RigidState state;
  RigidMass mass;  // mass 0: does not move
  Vec3 halfExtents{0.5, 0.5, 0.5};
  double friction = 0.6, restitution = 0;
};

// What it remembers of pairs from step to step, and a step.
class ReportSystem {
 public:
  explicit ReportSystem(const ReportSettings& settings) : settings_(settings) {}
  // Moves all bodies by dt under gravity, then tests all pairs and lets colliding ones push each other off.
  void step(std::vector<ReportBody>& bodies, Vec3 gravity, double dt);

  int pairsTested() const { return pairsTested_; }          // in the last step: pairs whose bounding spheres met
  int collisions() const { return int(collided_.size()); }  // pairs that overlapped
  const std::vector<std::pair<std::size_t, std::size_t>>& collided() const { return collided_; }  // places in `bodies`

  // What it remembers, as bytes and back.
  void write(WriteArchive& archive) const;
  bool read(ReadArchive& archive);  // false: these are none; it is as before then

 private:
  struct Point {
    Vec3 position;
    double depth = 0;                               // m, negative: still apart
    double normal = 0, tangent1 = 0, tangent2 = 0;  // impulses so far, N s
    double wantedSpeed = 0;                         // m/s, along the normal
  };
  using Key = std::pair<std::uint64_t, std::uint64_t>;  // ids of bodies
  struct Memory {
    int row = -1;  // that separated the two when they were last apart
    std::vector<Point> points;
    bool seen = false;  // in this step
  };
  struct Collision {
    std::size_t a = 0, b = 0;  // in the list of bodies
    Vec3 normal;               // unit, from a to b
    Vec3 tangent1, tangent2;   // unit, across it
    std::vector<Point> points;
    Memory* memory = nullptr;
  };

  void move(std::vector<ReportBody>& bodies, Vec3 gravity, double dt) const;
  void stepBack(const std::vector<ReportBody>& before, const std::vector<Collision>& collisions,
                std::vector<ReportBody>& bodies) const;
  void findCollisions(const std::vector<ReportBody>& bodies, double dt, std::vector<Collision>& out);
  int contactRow(const ObbMotion& before, const ObbMotion& now, const Memory& memory, double dt) const;
  void makePoints(const ObbMotion& now, int row, Collision& collision) const;
  void rememberGap(const ObbMotion& now, Memory& memory) const;
  void takeOver(const Memory& memory, Collision& collision) const;
  void respond(std::vector<ReportBody>& bodies, std::vector<Collision>& collisions, double dt) const;
  void chooseSpeeds(const ReportBody& a, const ReportBody& b, Collision& collision, double dt) const;
  void pushApart(ReportBody& a, ReportBody& b, const Collision& collision, Point& point) const;
  void holdBack(ReportBody& a, ReportBody& b, const Collision& collision, Point& point) const;

  ReportSettings settings_;
  std::map<Key, Memory> memory_;
  int pairsTested_ = 0;
  std::vector<std::pair<std::size_t, std::size_t>> collided_;
};

}  // namespace brickfall
