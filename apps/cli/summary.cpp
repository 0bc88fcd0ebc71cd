#include "cli/summary.h"

#include <fmt/core.h>

#include <algorithm>
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

namespace {

using Json = nlohmann::ordered_json;
constexpr const char* kCostKeys[] = {"wall_clock_s", "step_ms", "stage_ms", "realtime_factor", "threads"};

// Names may hold any bytes; what is not UTF-8 is replaced.
std::string textOf(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

Json jsonOf(const Summary& s) {
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
  return json;
}

}  // namespace

std::string toJson(const Summary& summary) { return textOf(jsonOf(summary)); }

std::string toTakeJson(const Summary& summary, const std::vector<SeriesColumn>& series) {
  Json json = jsonOf(summary);
  for (const char* key : kCostKeys) json.erase(key);
  Json columns;
  for (const SeriesColumn& column : series) {
    Json values = Json::array();
    for (double value : column.values) values.push_back(rounded(value));
    columns[column.name] = std::move(values);
  }
  json["series"] = std::move(columns);
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

TakeSummary readTakeSummary(const std::string& text) {
  TakeSummary out;
  Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return {text, {}};
  out.series = seriesOf(text);
  json.erase("series");
  out.summary = textOf(json);
  return out;
}

bool hasCostOf(const std::string& summaryJson, const std::string& takeSummary) {
  Json whole = Json::parse(summaryJson, nullptr, false), part = Json::parse(takeSummary, nullptr, false);
  if (!whole.is_object() || !part.is_object()) return false;
  for (const char* key : kCostKeys)
    if (whole.erase(key) == 0) return false;
  return whole == part;
}

}  // namespace brickfall::cli
