// The step of the report: everything moves; every pair is tested; of a pair that separates the axis is remembered; a pair
// that no longer does collides, and is pushed apart at one point. Nothing holds what rests: each step gravity pulls it in
// again, and the push answers with what the report takes for an impulse.
#include <algorithm>
#include <cmath>

#include "report/report_system.h"

namespace brickfall {

namespace {

// With the manifold two boxes count as touching from 5 mm on, as engines have it: each is larger by half of that.
constexpr double kSkin = 2.5e-3;  // m

Obb boxOf(const ReportBody& body, double skin) {
  return makeObb(Transform{body.state.position, body.state.rotation}, body.halfExtents + Vec3{skin, skin, skin});
}

// Bounding spheres first, in the order of their left ends: pairs that are far apart are not even looked at.
template <class Visit> void forEachNearPair(const std::vector<ReportBody>& bodies, const Visit& visit) {
  std::vector<std::size_t> order(bodies.size());
  for (std::size_t i = 0; i < order.size(); i++) order[i] = i;
  auto left = [&](std::size_t i) { return bodies[i].state.position.x - length(bodies[i].halfExtents); };
  std::sort(order.begin(), order.end(), [&](std::size_t i, std::size_t j) {
    return std::pair{left(i), i} < std::pair{left(j), j};
  });
  for (std::size_t m = 0; m < order.size(); m++) {
    const ReportBody& a = bodies[order[m]];
    double radius = length(a.halfExtents), right = a.state.position.x + radius;
    for (std::size_t n = m + 1; n < order.size() && left(order[n]) <= right; n++) {
      const ReportBody& b = bodies[order[n]];
      if (!(a.mass.mass > 0) && !(b.mass.mass > 0)) continue;
      double reach = radius + length(b.halfExtents);
      if (lengthSquared(b.state.position - a.state.position) <= reach * reach)
        visit(std::min(order[m], order[n]), std::max(order[m], order[n]));
    }
  }
}

// Where the two were a step ago, as far as their velocities tell.
ObbMotion aStepAgo(const ObbMotion& now, double dt) {
  ObbMotion before = now;
  before.a = advanced(now.a, -now.velocityA, -now.spinA, dt);
  before.b = advanced(now.b, -now.velocityB, -now.spinB, dt);
  return before;
}

int widestGap(const ObbGapsT<double>& gaps) {
  int best = -1;
  for (int row = 0; row < kObbRows; row++)
    if ((gaps.used >> row & 1) && (best < 0 || gaps.gap[std::size_t(row)] > gaps.gap[std::size_t(best)])) best = row;
  return best;
}

}  // namespace

void ReportSystem::step(std::vector<ReportBody>& bodies, Vec3 gravity, double dt) {
  std::vector<Collision> collisions;
  if (settings_.manifold) {
    // Contacts are there before they are needed: what gravity gives is taken back before anything moves by it.
    for (ReportBody& body : bodies)
      if (body.mass.mass > 0) body.state.velocity += gravity * dt;
    findCollisions(bodies, dt, collisions);
    respond(bodies, collisions, dt);
    move(bodies, {}, dt);
  } else {
    std::vector<ReportBody> before = bodies;
    move(bodies, gravity, dt);
    findCollisions(bodies, dt, collisions);
    stepBack(before, collisions, bodies);
    respond(bodies, collisions, dt);
  }
  for (Collision& c : collisions) c.memory->points = std::move(c.points);
}

void ReportSystem::move(std::vector<ReportBody>& bodies, Vec3 gravity, double dt) const {
  for (ReportBody& body : bodies) {
    if (!(body.mass.mass > 0)) continue;
    // The report has no gyroscopic torque: this takes it out of the integrator.
    LoadFunction weight = [&](const RigidState& s, double) {
      return RigidLoad{gravity * body.mass.mass, cross(s.angularVelocity, spinMomentum(s, body.mass))};
    };
    body.state = integrated(settings_.integrator, body.state, body.mass, weight, dt);
    if (settings_.friction) continue;
    double kept = 1 / (1 + settings_.damping * dt);
    body.state.velocity *= kept;
    body.state.angularVelocity *= kept;
  }
}

void ReportSystem::findCollisions(const std::vector<ReportBody>& bodies, double dt, std::vector<Collision>& out) {
  pairsTested_ = 0;
  double skin = settings_.manifold ? kSkin : 0;
  for (auto& entry : memory_) entry.second.seen = false;
  forEachNearPair(bodies, [&](std::size_t i, std::size_t j) {
    const ReportBody &a = bodies[i], &b = bodies[j];
    pairsTested_++;
    Memory& memory = memory_[{a.id, b.id}];
    memory.seen = true;
    ObbMotion now{boxOf(a, skin),   boxOf(b, skin),          a.state.velocity,
                  b.state.velocity, a.state.angularVelocity, b.state.angularVelocity};
    if (!overlaps(now.a, now.b)) {
      rememberGap(now, memory);
      memory.points.clear();
      return;
    }
    Collision c;
    c.a = i;
    c.b = j;
    c.memory = &memory;
    makePoints(now, contactRow(aStepAgo(now, dt), now, memory, dt), c);
    takeOver(memory, c);
    out.push_back(std::move(c));
  });
  std::erase_if(memory_, [](const auto& entry) { return !entry.second.seen; });
  std::sort(out.begin(), out.end(), [](const Collision& x, const Collision& y) {
    return std::pair{x.a, x.b} < std::pair{y.a, y.b};
  });
  collided_.clear();
  for (const Collision& c : out) collided_.push_back({c.a, c.b});
}

void ReportSystem::rememberGap(const ObbMotion& now, Memory& memory) const {
  memory.row = settings_.allAxes ? widestGap(rowGaps(now.a, now.b)) : firstSeparatingRow(now.a, now.b);
}

// What collides goes back to where it was before the step, with its new velocity.
void ReportSystem::stepBack(const std::vector<ReportBody>& before, const std::vector<Collision>& collisions,
                            std::vector<ReportBody>& bodies) const {
  for (const Collision& c : collisions)
    for (std::size_t i : {c.a, c.b}) {
      bodies[i].state.position = before[i].state.position;
      bodies[i].state.rotation = before[i].state.rotation;
    }
}

// Boxes that overlapped before, so that nothing is known of them, take the row of least depth.
int ReportSystem::contactRow(const ObbMotion& before, const ObbMotion& now, const Memory& memory, double dt) const {
  if (settings_.lastAxis) {
    Result<ObbImpact> impact = firstContact(before, dt);
    if (impact && impact->hit == ObbHit::contact) return impact->row;
  } else if (memory.row >= 0 && (rowGaps(now.a, now.b).used >> memory.row & 1)) {
    return memory.row;
  }
  auto least = leastPenetration(now.a, now.b);
  return least ? least->row : 0;
}

void ReportSystem::makePoints(const ObbMotion& now, int row, Collision& collision) const {
  int sigma = rowGaps(now.a, now.b).sigma[std::size_t(row)];
  Vec3 n = collision.normal = normalized(obbRowAxis(now.a, now.b, row)) * double(sigma);
  collision.tangent1 = normalized(cross(n, std::fabs(n.x) < 0.6 ? Vec3{1, 0, 0} : Vec3{0, 1, 0}));
  collision.tangent2 = cross(n, collision.tangent1);
  if (!settings_.manifold) {
    collision.points.push_back({tablePoint(now.a, now.b, row, sigma).point});
    return;
  }
  ObbContactSetT<double> set = contactSet(now.a, now.b, row, sigma, {0, 0.02});
  for (int k = 0; k < set.count; k++)
    collision.points.push_back({set.points[std::size_t(k)].position, set.points[std::size_t(k)].depth - 2 * kSkin});
}

// Impulses of the points that are still there, each from the nearest one of the last step.
void ReportSystem::takeOver(const Memory& memory, Collision& collision) const {
  if (!settings_.warmStarting) return;
  for (Point& point : collision.points) {
    double nearest = 0.02 * 0.02;  // m2: further apart they are not the same
    for (const Point& old : memory.points) {
      double d = lengthSquared(old.position - point.position);
      if (d >= nearest) continue;
      nearest = d;
      point.normal = old.normal;
      point.tangent1 = old.tangent1;
      point.tangent2 = old.tangent2;
    }
  }
}

}  // namespace brickfall
