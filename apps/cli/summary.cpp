#include "cli/summary.h"

#include <fmt/core.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace brickfall::cli {
namespace {

// Measured values carry six digits: more is noise to read.
double rounded(double value) {
  return std::isfinite(value) ? std::strtod(fmt::format("{:.6g}", value).c_str(), nullptr) : value;
}

}  // namespace

std::string toJson(const Summary& s) {
  const RunFigures& f = s.figures;
  nlohmann::ordered_json json;
  json["scene"] = s.scene;
  json["file"] = s.file;
  json["version"] = versionString();
  json["seed"] = s.seed;
  json["state_hash"] = fmt::format("{:016x}", s.stateHash);
  json["bodies"] = f.bodies;
  json["bricks"] = f.bricks;
  json["steps"] = f.steps;
  json["dt_s"] = s.timeStep;
  json["simulated_s"] = rounded(f.simulatedSeconds);
  json["wall_clock_s"] = rounded(s.wallClockSeconds);
  const Distribution& step = f.stepMilliseconds;
  json["step_ms"] = {{"mean", rounded(step.mean)},
                     {"median", rounded(step.median)},
                     {"p95", rounded(step.p95)},
                     {"max", rounded(step.max)}};
  nlohmann::ordered_json stages;
  for (int i = 0; i < kStageCount; i++) stages[std::string(kStageNames[i])] = rounded(f.stageMilliseconds[i]);
  json["stage_ms"] = stages;
  const double stepping = step.mean * double(f.steps) / 1000;
  json["realtime_factor"] = stepping > 0 ? rounded(f.simulatedSeconds / stepping) : 0;
  json["threads"] = s.threads;
  json["displacement_max_m"] = rounded(f.displacementMax);
  json["bricks_moved_50mm"] = f.bricksMoved50mm;
  json["sag_max_m"] = rounded(f.sagMax);
  json["creep_max_m"] = rounded(f.creepMax);
  json["penetration_max_m"] = rounded(f.penetrationMax);
  json["penetration_mean_m"] = rounded(f.penetrationMean);
  json["kinetic_energy_max_j"] = rounded(f.kineticEnergyMax);
  json["kinetic_energy_end_j"] = rounded(f.kineticEnergyEnd);
  json["energy_ratio_max"] = rounded(f.energyRatioMax);
  json["contacts_mean"] = rounded(f.contactsMean);
  json["asleep_end"] = f.asleepEnd;
  json["quarantined"] = f.quarantined;
  // Names may hold any bytes; what is not UTF-8 is replaced.
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace brickfall::cli
