#include "contact_audit.h"

#include <algorithm>
#include <cmath>

#include "ccd_verdict.h"
#include "geometry/queries.h"
#include "narrowphase/clipping.h"
#include "narrowphase/collide.h"

namespace brickfall::oracle {

using namespace test;

namespace {

bool isFlat(const Shape& s) { return s.type == ShapeType::box || s.type == ShapeType::hull; }

Manifold manifoldOf(const Shape& a, const Shape& b, const Transform& bInA, double margin,
                    const LoadedPoints& loaded = {}) {
  Manifold m;
  collide(a, b, bInA, margin, m, loaded);
  return m;
}
LoadedPoints allOf(const Manifold& m) {
  LoadedPoints out;
  for (int i = 0; i < m.count; i++) out.add(m.points[i].feature);
  return out;
}

constexpr double kLies = 0.994;  // cosine of 6.3 degrees

double deepestOf(const Manifold& m) {
  double least = 1e30;
  for (int i = 0; i < m.count; i++) least = std::min(least, m.points[i].separation);
  return least;
}

// Largest distance of a point of one from the nearest of the other.
double apartness(const Manifold& a, const Manifold& b) {
  double worst = 0;
  for (auto [from, to] : {std::pair{&a, &b}, {&b, &a}})
    for (int i = 0; i < from->count; i++) {
      double nearest = 1e30;
      for (int k = 0; k < to->count; k++) nearest = std::min(nearest, length(from->points[i].onA - to->points[k].onA));
      worst = std::max(worst, nearest);
    }
  return worst;
}

std::string text(Vec3 v) {
  char out[120];
  std::snprintf(out, sizeof out, "(%.17g %.17g %.17g)", v.x, v.y, v.z);
  return out;
}
std::string text(const Shape& s) {
  switch (s.type) {
    case ShapeType::box:
      return "box " + text(s.halfExtents);
    case ShapeType::sphere:
      return "sphere " + std::to_string(s.radius);
    case ShapeType::capsule:
      return "capsule " + std::to_string(s.radius) + " " + std::to_string(s.halfHeight);
    case ShapeType::plane:
    case ShapeType::mesh:  // not in these sweeps
    case ShapeType::cylinder:
    case ShapeType::cone:
      return "plane";
    case ShapeType::hull:
      return "hull of " + std::to_string(s.hull->vertices.size());
  }
  return "";
}

}  // namespace

double allowedBias(const Pair& pair) {
  ContactTolerances t = contactTolerances(pair.smallest);
  bool plane = pair.a.type == ShapeType::plane || pair.b.type == ShapeType::plane;
  if (plane && (pair.a.type == ShapeType::hull || pair.b.type == ShapeType::hull)) return t.slack;  // corners as one
  if (plane || pair.a.type == ShapeType::sphere || pair.b.type == ShapeType::sphere) return 0;
  if (isFlat(pair.a) && isFlat(pair.b)) return t.edge + t.otherFace;
  return t.edge + 0.02 * pair.smallest;
}

long ContactAudit::seen(const std::string& what) const {
  auto it = counts_.find(what);
  return it == counts_.end() ? 0 : it->second;
}

void ContactAudit::note(const std::string& what, double value, double limit) {
  Finding& f = findings_[what];
  f.asked++;
  f.limit = std::max(f.limit, limit);
  double share = limit > 0 ? value / limit : value > 0 ? 1e9 : 0;
  if (!(share <= 1)) f.over++;
  if (!(share <= f.worst)) f.worst = share, f.example = where_;
}

void ContactAudit::look(const Pair& pair, Family family, long number) {
  pair_ = &pair;
  Random random(std::uint64_t(number) * 977 + 5);
  Solid a = solidOf(pair.a, {}), b = solidOf(pair.b, pair.bInA);
  Separation truth = separationOf(a, b);
  bias_ = allowedBias(pair);
  slack_ = contactTolerances(pair.smallest).slack;
  bool hulls = pair.a.type == ShapeType::hull || pair.b.type == ShapeType::hull;
  rounding_ = (hulls ? 1e-6 : 1e-12) * pair.size;  // corners stick out of a hull's faces by that much
  where_ = std::string(nameOf(family)) + " " + std::to_string(number) + ": separation " +
           std::to_string(double(truth.value)) + " margin " + std::to_string(pair.margin) + " smallest " +
           std::to_string(pair.smallest) + " size " + std::to_string(pair.size) + "; " + text(pair.a) + ", " +
           text(pair.b) + " at " + text(pair.bInA.position) + "";
  count(nameOf(family));
  count(truth.value < -1e-9L * Real(pair.size)  ? "overlapping"
        : truth.value < 1e-9L * Real(pair.size) ? "touching (1e-9 of the size)"
                                                : "not overlapping");
  if (truth.value > 0 && truth.value < Real(pair.margin)) count("within the margin");
  Manifold m = manifoldOf(pair.a, pair.b, pair.bInA, pair.margin);
  if (number % 3 == 0) queries(truth);
  if (!found(m, truth)) return;
  count("points: " + std::to_string(m.count));
  if (m.points[0].feature >> 28 == 3 && m.count == 1) count("edge crossings");
  shape(m, a, b, truth);
  depth(m, a, b, truth);
  symmetry(m, truth);
  frames(m, random);
  continuity(m, a, b, random);
}

// A contact is there if the two overlap, and not if they are further apart than the margin.
bool ContactAudit::found(const Manifold& m, const Separation& truth) {
  bool flat = isFlat(pair_->a) && isFlat(pair_->b);
  // Bricks that meet in a line only, by rounding, make no contact on purpose.
  double mayMiss = flat ? slack_ + rounding_ : 1e-12 * pair_->size;
  if (truth.value < 0) note("overlap without contact, m", m.count == 0 ? -double(truth.value) : 0, mayMiss);
  if (truth.value > Real(pair_->margin))
    note("contact beyond the margin, m", m.count > 0 ? double(truth.value) - pair_->margin : 0, rounding_);
  bool within = truth.value >= 0 && truth.value <= Real(pair_->margin - rounding_);
  if (within && m.count == 0) {
    count("within the margin, unseen");
    if (!flat) note("within the margin, unseen, m", pair_->margin - double(truth.value), 1e-9 * pair_->size);
  }
  return m.count > 0;
}

// Unit normal, points along it, on both surfaces, of different names, and no further apart than the margin.
void ContactAudit::shape(const Manifold& m, const Solid& a, const Solid& b, const Separation& truth) {
  note("length of normal - 1", std::fabs(length(m.normal) - 1), 1e-12);
  double along = 0, over = 0, outA = 0, outB = 0, in = 0;
  int same = 0;
  for (int i = 0; i < m.count; i++) {
    const ManifoldPoint& p = m.points[i];
    along = std::max(along, length(p.onB - p.onA - m.normal * p.separation));
    over = std::max(over, p.separation - pair_->margin);
    double heightA = double(heightOver(a, wide(p.onA))), heightB = double(heightOver(b, wide(p.onB)));
    outA = std::max(outA, heightA), outB = std::max(outB, heightB);
    in = std::max({in, -heightA, -heightB});
    for (int k = 0; k < i; k++) same += m.points[k].feature == p.feature;
  }
  note("points off the line along the normal, m", along, 1e-12 * pair_->size);
  note("points beyond the margin, m", over, 1e-12 * pair_->size);
  note("points of one name", same, 0);
  bool flat = isFlat(pair_->a) && isFlat(pair_->b);
  double off = (flat ? contactTolerances(pair_->smallest).same : bias_) + 2 * rounding_;
  // The one axis that a capsule through a hull is pushed out along may have no point of the hull's surface on it.
  bool through = !flat && truth.deep && m.count == 1;
  if (through && std::max(outA, outB) > off) count("capsule through a hull: point beside the face");
  if (!through) note("points outside a, m", outA, off);
  if (!through) note("points outside b, m", outB, off);
  // A capsule's points are those of balls around its axis: of one that stands or is tilted, some lie inside it.
  if (pair_->a.type == ShapeType::capsule || pair_->b.type == ShapeType::capsule) return;
  note("points inside a or b, deeper than the overlap, m", in, off + std::max(0.0, -double(truth.value)));
}

// The normal is (nearly) the axis of least overlap, and the deepest point shows (nearly) that depth.
void ContactAudit::depth(const Manifold& m, const Solid& a, const Solid& b, const Separation& truth) {
  double real = double(truth.value), shown = deepestOf(m);
  if (real < 0) {
    double along = double(separationAlong(a, b, wide(m.normal)));
    // A capsule that lies on a face or along another takes that direction if it is within a few degrees.
    bool lies = bias_ > 0 && (!isFlat(pair_->a) || !isFlat(pair_->b)) && dot(m.normal, narrow(truth.axis)) > kLies;
    if (lies && real - along > bias_ + rounding_) count("capsule lies: normal turned a little");
    double turned = truth.deep && bias_ > 0 ? -0.2 * real : 0;  // through: several axes are about as good
    if (isFlat(pair_->a) && isFlat(pair_->b)) turned = 0;
    note("overlap along the normal over the least, m", lies ? 0 : real - along, bias_ + rounding_ + turned);
    note("depth shown over the true one, m", real - shown, bias_ + rounding_);
    // Needles and plates through each other: the deepest corner may be beside the face, and nothing of it is over it.
    bool capsules = !isFlat(pair_->a) || !isFlat(pair_->b);
    bool through = bias_ > 0 && (capsules ? truth.deep : -real > pair_->smallest);
    if (through && shown - real > bias_ + rounding_) count("deep: less than the depth shown");
    if (!through) note("depth shown under the true one, m", shown - real, bias_ + rounding_);
  } else {
    note("overlap shown where there is none, m", -shown,
         (isFlat(pair_->a) && isFlat(pair_->b) ? slack_ : bias_) + 10 * rounding_);
    note("gap shown under the true one, m", real - shown, bias_ + rounding_);
    if (!isFlat(pair_->a) || !isFlat(pair_->b)) note("gap shown over the true one, m", shown - real, bias_ + rounding_);
  }
}

void ContactAudit::symmetry(const Manifold& m, const Separation& truth) {
  Manifold back = manifoldOf(pair_->b, pair_->a, inverse(pair_->bInA), pair_->margin);
  if (back.count == 0) {
    bool decided = truth.value < Real(-slack_ - rounding_);
    if (decided || !isFlat(pair_->a) || !isFlat(pair_->b))
      note("no contact the other way round, m", std::fabs(pair_->margin - double(truth.value)), 1e-9 * pair_->size);
    else
      count("contact one way round only");
    return;
  }
  if (truth.value < 0)
    note("depth the other way round, m", std::fabs(deepestOf(m) - deepestOf(back)), bias_ + rounding_);
  Vec3 normal = rotate(pair_->bInA.rotation, back.normal) * -1.0;
  if (length(normal - m.normal) > 1e-6) count("another normal the other way round");
}

// The same two seen from elsewhere: in a world in which both are turned and up to 10 km away.
void ContactAudit::frames(const Manifold& m, Random& random) {
  Transform world = randomPose(random, 1e4);
  Transform pose = inverse(world) * (world * pair_->bInA);
  Manifold moved = manifoldOf(pair_->a, pair_->b, pose, pair_->margin);
  double moves = length(pose.position - pair_->bInA.position) + 1e-15 * pair_->size;
  double shown = deepestOf(m);
  if (moved.count == 0) {
    if (shown < -slack_ - 2 * moves) note("contact lost in another frame, m", -shown, 0);
    return;
  }
  // Of flat shapes that are apart, which points are within the margin is decided by slack.
  if (isFlat(pair_->a) && isFlat(pair_->b) && shown > 0) return;
  bool same = length(moved.normal - m.normal) < 1e-6;
  note("depth in another frame, m", std::fabs(deepestOf(moved) - shown), (same ? 0 : bias_) + 10 * moves + slack_);
}

// A motion a million times smaller than the shapes changes depth by as much, and normal and points not by leaps, unless
// another axis is as good within the bias. All points carry: else four of more that are as good are chosen by rounding.
void ContactAudit::continuity(const Manifold& m, const Solid& a, const Solid& b, Random& random) {
  double step = 1e-6 * pair_->smallest;
  Transform pose = pair_->bInA;
  pose.position += randomDirection(random) * step;
  pose.rotation = normalized(quatFromRotationVector(randomDirection(random) * (step / pair_->size)) * pose.rotation);
  Manifold moved = manifoldOf(pair_->a, pair_->b, pose, pair_->margin, allOf(m));
  double shown = deepestOf(m), limit = 5 * step;
  if (moved.count == 0) {
    bool edge = pair_->margin - shown < limit;
    if (!edge && shown < -slack_ - rounding_) note("contact lost by a small motion, m", -shown, 0);
    if (!edge) count("contact lost by a small motion");
    return;
  }
  count("small motions");
  double turned = length(moved.normal - m.normal), jump = std::fabs(deepestOf(moved) - shown);
  if (turned < 1e-3) {
    bool gap = isFlat(pair_->a) && isFlat(pair_->b) && shown > 0;
    if (gap && jump > limit) count("gap jumps with the normal kept");
    if (!gap) note("depth jumps with the normal kept, m", jump, limit + (bias_ > 0 ? slack_ : 0));
    double set = apartness(m, moved);
    if (set > 1e-3 * pair_->smallest) count("points jump with the normal kept");
    if (m.count != moved.count) count("number of points changes");
    return;
  }
  count("normal jumps");
  double first = double(separationAlong(a, b, wide(m.normal)));
  double second = double(separationAlong(a, solidOf(pair_->b, pose), wide(moved.normal)));
  bool overlap = separationOf(a, b).value < 0 && separationOf(a, solidOf(pair_->b, pose)).value < 0;
  if (!overlap) return;
  count("normal jumps while overlapping");
  note("normal jumps between axes that differ by, m", std::fabs(first - second), bias_ + limit);
  note("depth jumps with the normal, m", jump, bias_ + limit);
}

void ContactAudit::queries(const Separation& truth) {
  double distance = shapeDistance(pair_->a, pair_->b, pair_->bInA).distance;
  double depth = penetrationDepth(pair_->a, pair_->b, pair_->bInA), real = double(truth.value);
  double tolerance = 1e-9 * pair_->size + rounding_;
  note("shapeDistance, error, m", std::fabs(distance - std::max(0.0, real)), tolerance);
  note("penetrationDepth, error, m", std::fabs(depth - std::max(0.0, -real)), tolerance);
  if (pair_->a.type == ShapeType::plane || pair_->b.type == ShapeType::plane) return;
  // libccd walks round shapes in small steps and gives up near touching.
  bool round = !isFlat(pair_->a) || !isFlat(pair_->b);
  if (std::fabs(real) < (round ? 0.1 * pair_->smallest : 1e-5 * pair_->size) || pair_->size > 50 * pair_->smallest)
    return;
  note("overlap that libccd sees otherwise", ccdOverlap(pair_->a, pair_->b, pair_->bInA) != (real < 0), 0);
}

}  // namespace brickfall::oracle
