// What a sound file can still get wrong: bodies that overlap at the start, launches that never come.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "brickfall/scene.h"
#include "scene/body_bounds.h"
#include "scene/node.h"

namespace brickfall {

namespace {

constexpr double kDeepest = 1e-4;  // m: overlap up to this is no mistake
constexpr std::size_t kMaxWarnings = 20;

struct Overlap {
  std::size_t a, b;  // positions in SceneRun::bodies, a < b
  double depth;      // m
};

// Sweep along x over the bounds, then the exact depth of each pair of shapes.
class OverlapFinder {
 public:
  explicit OverlapFinder(const SceneRun& run) : run_(run) {
    for (const PlacedBody& body : run.bodies()) boxes_.push_back(scene::bodyBounds(body.def));
  }

  std::vector<Overlap> find() {
    std::vector<std::size_t> order(boxes_.size()), active;
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return boxes_[a].lower.x < boxes_[b].lower.x; });
    for (std::size_t next : order) {
      std::erase_if(active, [&](std::size_t other) { return boxes_[other].upper.x < boxes_[next].lower.x; });
      for (std::size_t other : active) test(std::min(next, other), std::max(next, other));
      active.push_back(next);
    }
    std::sort(overlaps_.begin(), overlaps_.end(),
              [](const Overlap& x, const Overlap& y) { return x.a != y.a ? x.a < y.a : x.b < y.b; });
    return std::move(overlaps_);
  }

 private:
  void test(std::size_t a, std::size_t b) {
    const PlacedBody &bodyA = run_.bodies()[a], &bodyB = run_.bodies()[b];
    bool moves = bodyA.def.type == BodyType::dynamic || bodyB.def.type == BodyType::dynamic;
    if (!moves || !overlaps(boxes_[a], boxes_[b]) || joined(bodyA.id, bodyB.id)) return;
    double depth = 0;
    for (ShapeId shapeA : run_.world().shapes(bodyA.id))
      for (ShapeId shapeB : run_.world().shapes(bodyB.id)) {
        Result<double> found = run_.world().penetration(shapeA, shapeB);
        if (found) depth = std::max(depth, *found);
      }
    if (depth > kDeepest) overlaps_.push_back({a, b, depth});
  }

  // Joined bodies may lie in each other, unless their joint lets them touch.
  bool joined(BodyId a, BodyId b) const {
    for (JointId id : run_.world().joints(a)) {
      const Result<JointDef> joint = run_.world().definition(id);
      if (joint && !joint->collide && (joint->bodyA == b || joint->bodyB == b)) return true;
    }
    return false;
  }

  const SceneRun& run_;
  std::vector<Aabb> boxes_;
  std::vector<Overlap> overlaps_;
};

Diagnostic warning(const SceneDescription& scene, SourcePlace at, std::string key, std::string message) {
  return {Severity::warning, scene.file, at.line, at.column, std::move(key), std::move(message)};
}

// "wall/3/1" (line 12)
std::string nameAndLine(const PlacedBody& body) {
  std::string line = body.place.line > 0 ? " (line " + std::to_string(body.place.line) + ")" : std::string();
  return "\"" + body.name + "\"" + line;
}

// The node that a body belongs to: a brick to its wall, all else to itself.
std::string ownerOf(const SceneDescription& scene, const PlacedBody& body) {
  if (body.course < 0) return body.name;
  const std::string wall = body.name.substr(0, body.name.find_last_of('/', body.name.find_last_of('/') - 1));
  for (const SceneWall& one : scene.walls)
    if (one.wall.name == wall) return wall;
  return body.name;
}

double millimetres(double metres) { return std::floor(metres * 1e4 + 0.5) / 10; }

// Two walls, or a wall and a body, that lie in each other.
struct OwnersOverlap {
  const PlacedBody *late, *early;  // the deepest
  std::string lateOwner, earlyOwner;
  int pairs = 0;
  double depth = 0;
};

std::string overlapWords(const OwnersOverlap& one) {
  const bool lateWall = one.lateOwner != one.late->name, earlyWall = one.earlyOwner != one.early->name;
  const std::string depth = scene::numberText(millimetres(one.depth)) + " mm";
  if (!lateWall && !earlyWall)
    return "found it " + depth + " inside " + nameAndLine(*one.early) +
           " at the start, expected bodies that touch at most";
  const std::string line = one.early->place.line > 0 ? " (line " + std::to_string(one.early->place.line) + ")" : "";
  const std::string other = (earlyWall ? "wall \"" : "\"") + one.earlyOwner + "\"" + line;
  const std::string pairs =
      std::to_string(one.pairs) + (one.pairs == 1 ? " pair" : " pairs") + " of bodies, up to " + depth;
  const char* mend = lateWall && earlyWall && one.lateOwner != one.earlyOwner
                         ? "; two walls that meet are bonded by tied_to, or by one wall with a path"
                         : "; move one of them by as much";
  return "found it inside " + other + " at the start (" + pairs + "), expected bodies that touch at most" + mend;
}

void warnOfOverlaps(const SceneDescription& scene, const SceneRun& run, std::vector<Diagnostic>& out) {
  std::vector<OwnersOverlap> all;
  std::map<std::pair<std::string, std::string>, std::size_t> known;
  for (const Overlap& overlap : OverlapFinder(run).find()) {
    // At the one that stands later in the file: it was put where the other already was.
    const PlacedBody *late = &run.bodies()[overlap.a], *early = &run.bodies()[overlap.b];
    if (late->place.line < early->place.line) std::swap(late, early);
    std::string lateOwner = ownerOf(scene, *late), earlyOwner = ownerOf(scene, *early);
    const auto key = std::minmax(lateOwner, earlyOwner);
    const auto [at, fresh] = known.emplace(key, all.size());
    if (fresh) all.push_back({late, early, lateOwner, earlyOwner, 0, 0});
    OwnersOverlap& one = all[at->second];
    one.pairs++;
    if (overlap.depth > one.depth) one.depth = overlap.depth, one.late = late, one.early = early;
    one.lateOwner = ownerOf(scene, *one.late), one.earlyOwner = ownerOf(scene, *one.early);
  }
  for (std::size_t i = 0; i < std::min(all.size(), kMaxWarnings); i++)
    out.push_back(warning(scene, all[i].late->place, all[i].lateOwner, overlapWords(all[i])));
  if (all.size() > kMaxWarnings)
    out.push_back(warning(
        scene, {}, "",
        "found " + std::to_string(all.size() - kMaxWarnings) + " more pairs of bodies that overlap at the start"));
}

void warnOfLaunches(const SceneDescription& scene, std::vector<Diagnostic>& out) {
  for (const SceneBody& body : scene.bodies)
    if (body.launchTime >= scene.seconds)
      out.push_back(warning(scene, body.place, body.name,
                            "found launch_time " + scene::numberText(body.launchTime) +
                                ", expected it before the end of the run at " + scene::numberText(scene.seconds) +
                                " s"));
}

// Whether an opening goes on above in another, or something stands in it as an arch does: of straight walls.
bool isFilledAbove(const SceneDescription& scene, const WallDef& wall, const Opening& opening) {
  if (!wall.path.empty() || wall.radius > 0) return false;
  const double head = opening.sill + opening.height;
  for (const Opening& other : wall.openings)
    if (std::fabs(other.sill - head) < 0.5 * wall.brick.size.y && other.from <= opening.from &&
        other.from + other.width >= opening.from + opening.width)
      return true;
  const Quat back = conjugate(quatFromAxisAngle({0, 1, 0}, wall.yawDegrees * scene::kRadians));
  return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const SceneBody& body) {
    const Vec3 at = rotate(back, body.def.position - wall.position);
    return body.def.type == BodyType::dynamic && at.x > opening.from && at.x < opening.from + opening.width &&
           at.y > opening.sill && at.y < head && std::fabs(at.z) < 0.5 * wallThickness(wall);
  });
}

void warnOfBareOpenings(const SceneDescription& scene, std::vector<Diagnostic>& out) {
  for (const SceneWall& wall : scene.walls)
    for (std::size_t i = 0; !wall.mortar && i < wall.wall.openings.size(); i++) {  // mortar may hold them
      const Opening& opening = wall.wall.openings[i];
      double height = wall.wall.courses * (wall.wall.brick.size.y + wall.wall.bedJoint);
      bool bricksAbove = opening.sill + opening.height < height - wall.wall.brick.size.y;
      if (bricksAbove && opening.lintelHeight == 0 && !isFilledAbove(scene, wall.wall, opening))
        out.push_back(
            warning(scene, i < wall.openingPlaces.size() ? wall.openingPlaces[i] : wall.place,
                    wall.wall.name + ".opening[" + std::to_string(i) + "]",
                    "found bricks above an opening without a lintel, expected lintel_height > 0: they will fall"));
    }
}

}  // namespace

std::vector<Diagnostic> checkScene(const SceneDescription& scene) {
  std::vector<Diagnostic> out;
  warnOfLaunches(scene, out);
  warnOfBareOpenings(scene, out);
  Result<SceneRun> run = SceneRun::create(scene);
  if (run)
    warnOfOverlaps(scene, *run, out);
  else
    out.push_back({Severity::error, scene.file, 0, 0, "", run.error().message});
  return out;
}

}  // namespace brickfall
