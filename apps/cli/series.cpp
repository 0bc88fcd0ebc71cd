#include "cli/series.h"

#include <fmt/core.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace brickfall::cli {
namespace {

constexpr std::size_t kMostRows = 40000;
constexpr double kMoves = 0.05;  // m/s
constexpr const char* kNames[] = {"time_s",
                                  "kinetic_way_j",
                                  "kinetic_turn_j",
                                  "potential_j",
                                  "lost_j",
                                  "momentum_x_kg_m_s",
                                  "momentum_y_kg_m_s",
                                  "momentum_z_kg_m_s",
                                  "angular_momentum_x_kg_m2_s",
                                  "angular_momentum_y_kg_m2_s",
                                  "angular_momentum_z_kg_m2_s",
                                  "moving_bodies",
                                  "awake_bodies",
                                  "bricks_moved_50mm",
                                  "broken_mortar",
                                  "broken_joints",
                                  "largest_force_n"};

// J, of the way of all dynamic bodies, and how many are faster than kMoves.
struct Motion {
  double way = 0, moving = 0, awake = 0;
};

Motion motionOf(const World& world) {
  Motion out;
  for (BodyId id : world.bodies()) {
    const Result<BodyState> state = world.state(id);
    if (!state || state->type != BodyType::dynamic) continue;
    out.way += 0.5 * state->mass * lengthSquared(state->linearVelocity);
    out.moving += length(state->linearVelocity) > kMoves;
    out.awake += state->awake;
  }
  return out;
}

// N: the sum of normal forces on the body that has most.
double largestForce(const World& world, std::vector<float>& forces) {
  std::fill(forces.begin(), forces.end(), 0.0f);
  world.forEachContact([&](const ContactView& contact) {
    float force = 0;
    for (int i = 0; i < contact.pointCount; i++) force += float(contact.points[i].normalForce);
    for (BodyId id : {contact.bodyA, contact.bodyB}) {
      if (id.index >= forces.size()) forces.resize(id.index + 1, 0.0f);
      forces[id.index] += force;
    }
  });
  return forces.empty() ? 0 : double(*std::max_element(forces.begin(), forces.end()));
}

}  // namespace

RunSeries::RunSeries(const SceneRun& run, const RunMetrics& metrics)
    : framesPerSecond_(std::min(run.scene().framesPerSecond, 1 / run.scene().timeStep)) {
  for (const char* name : kNames) columns_.push_back({name, {}});
  addRow(run, run.time(), metrics);
}

void RunSeries::countBreaks(const World& world) {
  for (const MortarEvent& event : world.events().mortar) brokenMortar_ += event.broken;
  brokenJoints_ += double(world.events().breaks.size());
}

void RunSeries::afterStep(const SceneRun& run, const StepReport& report, const RunMetrics& metrics) {
  countBreaks(run.world());
  const double frames = std::floor(report.time * framesPerSecond_ + 1e-6);
  if (frames < nextFrame_) return;
  nextFrame_ = frames + 1;
  if (++frame_ % every_ == 0) addRow(run, report.time, metrics);
  if (columns_[0].values.size() > kMostRows) halve();
}

void RunSeries::addRow(const SceneRun& run, double time, const RunMetrics& metrics) {
  const World& world = run.world();
  const Motion motion = motionOf(world);
  const Energy energy = world.energy();
  const Vec3 momentum = world.linearMomentum(), turning = world.angularMomentum();
  const double row[] = {time,
                        motion.way,
                        std::max(0.0, energy.kinetic - motion.way),
                        metrics.potentialNow(world),
                        metrics.lostNow(),
                        momentum.x,
                        momentum.y,
                        momentum.z,
                        turning.x,
                        turning.y,
                        turning.z,
                        motion.moving,
                        motion.awake,
                        double(metrics.movedNow(world)),
                        brokenMortar_,
                        brokenJoints_,
                        largestForce(world, forces_)};
  static_assert(std::size(row) == std::size(kNames));
  for (std::size_t k = 0; k < std::size(row); k++) columns_[k].values.push_back(row[k]);
}

void RunSeries::halve() {
  for (SeriesColumn& column : columns_) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < column.values.size(); i += 2) column.values[kept++] = column.values[i];
    column.values.resize(kept);
  }
  every_ *= 2;
}

std::string toCsv(const std::vector<SeriesColumn>& columns) {
  fmt::memory_buffer out;
  const auto add = [&out](std::string_view text) { out.append(text.data(), text.data() + text.size()); };
  for (std::size_t k = 0; k < columns.size(); k++) add((k > 0 ? "," : "") + columns[k].name);
  add("\n");
  const std::size_t rows = columns.empty() ? 0 : columns[0].values.size();
  for (std::size_t i = 0; i < rows; i++) {
    for (std::size_t k = 0; k < columns.size(); k++)
      fmt::format_to(std::back_inserter(out), "{}{:.8g}", k > 0 ? "," : "", columns[k].values[i]);
    add("\n");
  }
  return fmt::to_string(out);
}

}  // namespace brickfall::cli
