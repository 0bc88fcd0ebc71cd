#include "cli/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "brickfall/geometry/mesh_tree.h"

namespace brickfall::cli {
namespace {

constexpr int kSamples = 20;
constexpr double kMoved = 0.050;  // m

// Height along `up` of the highest point of a fixed shape: what bodies can fall onto. A plane's is its own.
double topOf(const ShapeDef& shape, const Transform& body, Vec3 up) {
  const Transform frame = body * shape.local;
  const double centre = dot(frame.position, up);
  const Vec3 upLocal = rotate(conjugate(frame.rotation), up);
  switch (shape.type) {
    case ShapeType::plane:
      return centre;
    case ShapeType::sphere:
      return centre + shape.radius;
    case ShapeType::capsule:
      return centre + shape.radius + std::fabs(upLocal.y) * shape.halfHeight;
    case ShapeType::cylinder:
    case ShapeType::cone: {
      const double across = std::sqrt(upLocal.x * upLocal.x + upLocal.z * upLocal.z);
      const double top = shape.type == ShapeType::cone ? shape.topRadius : shape.radius;
      return centre + std::max(upLocal.y * shape.halfHeight + across * top,
                               across * shape.radius - upLocal.y * shape.halfHeight);
    }
    case ShapeType::box:
      return centre + dot(abs(upLocal), shape.halfExtents);
    case ShapeType::hull: {
      double top = -std::numeric_limits<double>::infinity();
      for (Vec3 vertex : shape.vertices) top = std::max(top, dot(vertex, upLocal));
      return centre + top;
    }
    case ShapeType::mesh: {
      if (!shape.mesh) return centre;
      double top = -std::numeric_limits<double>::infinity();
      for (Vec3 vertex : shape.mesh->mesh().vertices()) top = std::max(top, dot(vertex, upLocal));
      return centre + top;
    }
  }
  return centre;
}

bool isBrick(const PlacedBody& body) { return body.role == BodyRole::brick; }

}  // namespace

RunMetrics::RunMetrics(const World& world, std::span<const PlacedBody> bodies, std::uint64_t plannedSteps)
    : sampleEvery_(std::max<std::uint64_t>(1, plannedSteps / kSamples)) {
  const Vec3 g = world.gravity();
  gravity_ = length(g);
  if (gravity_ > 0) up_ = g * (-1 / gravity_);
  findLowestPlace(world, bodies);

  const bool anyBrick = std::any_of(bodies.begin(), bodies.end(), isBrick);
  for (const PlacedBody& body : bodies) {
    if (body.def.type != BodyType::dynamic) continue;
    const Result<BodyState> state = world.state(body.id);
    if (!state) continue;
    figures_.bodies++;
    figures_.bricks += isBrick(body);
    if (anyBrick ? isBrick(body) : body.role == BodyRole::body)
      tracked_.push_back({body.id, state->centreOfMass, state->centreOfMass});
    if (state->type == BodyType::dynamic)
      countWeight(world, body.id, body.def.gravityScale);
    else
      pending_.push_back({body.id, body.def});
  }
  for (BodyId id : world.bodies()) know(id);
  energy_ = energyNow(world);
  ledger_.supply(energy_);
  ledger_.measure(energy_);
  figures_.kineticEnergyMax = figures_.kineticEnergyEnd = world.energy().kinetic;
  samples_.push_back(sample(world, world.time()));
}

void RunMetrics::findLowestPlace(const World& world, std::span<const PlacedBody> bodies) {
  lowestHeight_ = std::numeric_limits<double>::infinity();
  for (const PlacedBody& body : bodies) {
    const Result<BodyState> state = world.state(body.id);
    if (!state) continue;
    if (body.def.type == BodyType::dynamic) {
      lowestHeight_ = std::min(lowestHeight_, heightOf(state->centreOfMass));
    } else {
      for (const ShapeDef& shape : body.def.shapes)
        lowestHeight_ = std::min(lowestHeight_, topOf(shape, {state->position, state->rotation}, up_));
    }
  }
  if (!std::isfinite(lowestHeight_)) lowestHeight_ = 0;
}

double RunMetrics::countWeight(const World& world, BodyId id, double gravityScale) {
  const Result<MassProperties> mass = world.massProperties(id);
  if (!mass) return 0;
  weighed_.push_back({id, mass->mass * gravityScale * gravity_});
  weight_ += weighed_.back().weight;
  return weighed_.back().weight;
}

void RunMetrics::know(BodyId id) {
  if (id.index >= knownByIndex_.size()) knownByIndex_.resize(id.index + 1);
  knownByIndex_[id.index] = id;
}

bool RunMetrics::isKnown(BodyId id) const { return id.index < knownByIndex_.size() && knownByIndex_[id.index] == id; }

// The bodies that came since the start, and those that went. True if any did.
bool RunMetrics::followBodies(const World& world) {
  const std::size_t before = weighed_.size();
  std::erase_if(weighed_, [&](const Weighed& body) {
    if (world.isValid(body.id)) return false;
    weight_ -= body.weight;
    return true;
  });
  bool changed = weighed_.size() != before;
  for (BodyId id : world.bodies()) {
    if (isKnown(id)) continue;
    const Result<BodyState> state = world.state(id);
    if (!state || state->type != BodyType::dynamic) continue;  // it may become so
    know(id);
    countWeight(world, id, 1);
    figures_.bodies++;
    changed = true;
  }
  return changed;
}

double RunMetrics::energyNow(const World& world) const {
  const Energy energy = world.energy();
  return energy.kinetic + energy.potential - weight_ * lowestHeight_;
}

void RunMetrics::bookLaunches(const World& world) {
  std::erase_if(pending_, [&](const Pending& held) {
    const Result<BodyState> state = world.state(held.id);
    if (!state || state->type != BodyType::dynamic) return !state;
    const Result<MassProperties> mass = world.massProperties(held.id);
    if (!mass) return true;
    const Quat rotation = normalized(held.def.rotation);
    const Vec3 centre = rotate(rotation, mass->centre) + held.def.position;
    const Vec3 spin = rotate(conjugate(rotation), held.def.angularVelocity);
    const double kinetic =
        0.5 * mass->mass * lengthSquared(held.def.linearVelocity) + 0.5 * dot(spin, mass->inertia * spin);
    const double weight = countWeight(world, held.id, held.def.gravityScale);
    ledger_.supply(kinetic + weight * (heightOf(centre) - lowestHeight_));
    return true;
  });
}

void RunMetrics::measureCentres(const World& world) {
  for (Tracked& body : tracked_)
    if (const Result<BodyState> state = world.state(body.id)) body.last = state->centreOfMass;
}

RunMetrics::Sample RunMetrics::sample(const World& world, double time) {
  measureCentres(world);
  Sample out{time, {}};
  for (const Tracked& body : tracked_) out.centres.push_back(body.last);
  return out;
}

RunMetrics::Overlap RunMetrics::measureOverlap(const World& world) const {
  std::vector<std::pair<ShapeId, ShapeId>> touching;
  world.forEachContact([&](const ContactView& contact) {
    for (int i = 0; i < contact.pointCount; i++) {
      if (contact.points[i].normalForce > 0 || contact.points[i].separation < 0) {
        touching.emplace_back(contact.shapeA, contact.shapeB);
        return;
      }
    }
  });
  Overlap overlap;
  for (auto [a, b] : touching) {
    const Result<double> depth = world.penetration(a, b);
    if (!depth) continue;
    overlap.max = std::max(overlap.max, *depth);
    overlap.mean += *depth / double(touching.size());
  }
  return overlap;
}

void RunMetrics::afterStep(const World& world, const StepReport& report) {
  bookLaunches(world);
  const bool changed = followBodies(world);
  const double energy = energyNow(world);
  // What came or went took its energy along; in that step nothing can be told of what was made.
  if (changed) ledger_.supply(energy - energy_);
  ledger_.measure(energy);
  energy_ = energy;
  figures_.steps++;
  figures_.simulatedSeconds = report.time;
  figures_.kineticEnergyEnd = world.energy().kinetic;
  figures_.kineticEnergyMax = std::max(figures_.kineticEnergyMax, figures_.kineticEnergyEnd);
  figures_.asleepEnd = report.bodies - report.awakeBodies;
  figures_.quarantined += int(report.quarantined.size());
  contactPoints_ += report.touchingPoints;
  stepMilliseconds_.push_back(report.milliseconds);
  for (int i = 0; i < kStageCount; i++) figures_.stageMilliseconds[i] += report.stageMilliseconds[i];
  if (figures_.steps % sampleEvery_ == 0) {
    samples_.push_back(sample(world, report.time));
    figures_.penetrationMax = std::max(figures_.penetrationMax, measureOverlap(world).max);
  }
}

int RunMetrics::movedNow(const World& world) const {
  int moved = 0;
  for (const Tracked& body : tracked_) {
    const Result<BodyState> state = world.state(body.id);
    moved += length((state ? state->centreOfMass : body.last) - body.start) > kMoved;
  }
  return moved;
}

RunFigures RunMetrics::finish(const World& world) {
  RunFigures out = figures_;
  measureCentres(world);
  const double half = out.simulatedSeconds / 2;
  const auto nearer = [&](const Sample& a, const Sample& b) {
    return std::fabs(a.time - half) < std::fabs(b.time - half);
  };
  const Sample& middle = *std::min_element(samples_.begin(), samples_.end(), nearer);
  for (std::size_t i = 0; i < tracked_.size(); i++) {
    const Vec3 moved = tracked_[i].last - tracked_[i].start;
    out.displacementMax = std::max(out.displacementMax, length(moved));
    out.bricksMoved50mm += length(moved) > kMoved;
    out.sagMax = std::max(out.sagMax, -heightOf(moved));
    out.creepMax = std::max(out.creepMax, length(tracked_[i].last - middle.centres[i]));
  }
  const Overlap overlap = measureOverlap(world);
  out.penetrationMax = std::max(out.penetrationMax, overlap.max);
  out.penetrationMean = overlap.mean;
  out.energyRatioMax = ledger_.ratioMax();
  out.stepMilliseconds = distributionOf(stepMilliseconds_);
  if (out.steps > 0) {
    out.contactsMean = contactPoints_ / double(out.steps);
    for (double& stage : out.stageMilliseconds) stage /= double(out.steps);
  }
  return out;
}

}  // namespace brickfall::cli
