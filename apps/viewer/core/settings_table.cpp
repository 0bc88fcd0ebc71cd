#include "viewer_core/settings_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "brickfall/limits.h"

namespace brickfall::viewer {

namespace {

using Scene = SceneDescription;
using Choices = std::span<const std::string_view>;

// A row, and where its value stands in a scene.
struct Entry {
  SettingRow row;
  double (*get)(const Scene&);
  void (*set)(Scene&, double);
};

constexpr std::array<std::string_view, kIntegratorCount> kIntegrators = {
    "splitting", "explicit Euler", "semi-implicit Euler", "implicit Euler (turns)", "velocity Verlet", "Runge-Kutta 4"};
constexpr std::array<std::string_view, kBroadPhaseMethodCount> kBroadPhases = {"tree of boxes", "sweep and prune",
                                                                               "bounding spheres", "all pairs"};
constexpr std::array<std::string_view, 2> kMethods = {"Brickfall's", "the report's"};

// The value as the field has it.
template <class T> T fromNumber(double value) {
  if constexpr (std::is_same_v<T, bool>)
    return value != 0;
  else if constexpr (std::is_floating_point_v<T>)
    return value;
  else
    return T(int(value));
}

#define BRICKFALL_FIELD(path)                    \
  [](const Scene& s) { return double(s.path); }, \
      [](Scene& s, double v) { s.path = fromNumber<std::remove_cvref_t<decltype(s.path)>>(v); }

SettingRow real(std::string_view key, std::string_view group, std::string_view label, std::string_view unit,
                double least, double most, double usualLeast, double usualMost, std::string_view help) {
  SettingRow row;
  row.key = key;
  row.group = group;
  row.label = label;
  row.unit = unit;
  row.least = least;
  row.most = most;
  row.usualLeast = usualLeast;
  row.usualMost = usualMost;
  row.help = help;
  return row;
}

SettingRow whole(std::string_view key, std::string_view group, std::string_view label, double least, double most,
                 double usualMost, std::string_view help) {
  SettingRow row = real(key, group, label, "", least, most, least, usualMost, help);
  row.kind = SettingKind::whole;
  return row;
}

SettingRow onOff(std::string_view key, std::string_view group, std::string_view label, std::string_view help) {
  SettingRow row = real(key, group, label, "", 0, 1, 0, 1, help);
  row.kind = SettingKind::onOff;
  return row;
}

SettingRow choice(std::string_view key, std::string_view group, std::string_view label, Choices choices,
                  std::string_view help) {
  SettingRow row = real(key, group, label, "", 0, double(choices.size() - 1), 0, double(choices.size() - 1), help);
  row.kind = SettingKind::choice;
  row.choices = choices;
  return row;
}

SettingRow logarithmic(SettingRow row) {
  row.logarithmic = true;
  return row;
}

SettingRow fromRestart(SettingRow row) {
  row.live = false;
  return row;
}

void addTime(std::vector<Entry>& out) {
  using namespace limits;
  out.push_back(
      {logarithmic(real("timeStep", "Time", "Time step", "s", kShortestTimeStep, kLongestTimeStep, 1.0 / 480, 1.0 / 30,
                        "Simulated time of one step; 1/60 s is what all figures were measured with")),
       BRICKFALL_FIELD(timeStep)});
  out.push_back({whole("substeps", "Time", "Substeps", 1, kMostSubsteps, 8, "Equal parts that each step is made in"),
                 BRICKFALL_FIELD(substeps)});
}

void addWorld(std::vector<Entry>& out) {
  using namespace limits;
  const double g = kLargestGravity;
  out.push_back({real("gravity.x", "World", "Gravity, x", "m/s2", -g, g, -10, 10, "To the right"),
                 BRICKFALL_FIELD(world.gravity.x)});
  out.push_back({real("gravity.y", "World", "Gravity, up", "m/s2", -g, g, -20, 5, "-9.81 on Earth, -1.62 on the Moon"),
                 BRICKFALL_FIELD(world.gravity.y)});
  out.push_back({real("gravity.z", "World", "Gravity, z", "m/s2", -g, g, -10, 10, "Towards the first camera"),
                 BRICKFALL_FIELD(world.gravity.z)});
  out.push_back(
      {real("airDensity", "World", "Air density", "kg/m3", 0, kLargestAirDensity, 0, 5, "For bodies with a drag area"),
       BRICKFALL_FIELD(world.airDensity)});
  out.push_back({onOff("sleep", "World", "Sleeping", "What rests for a while costs nothing until something touches it"),
                 BRICKFALL_FIELD(world.enableSleep)});
  out.push_back(
      {real("sleepDelay", "World", "Sleeps after", "s", 1e-3, kLongestDelay, 0.1, 5, "Time at rest before that"),
       BRICKFALL_FIELD(world.sleepDelay)});
  out.push_back({real("hitEventSpeed", "World", "Hits from", "m/s", 0, lost::kSpeed, 0, 10,
                      "Slower impacts are not counted as hits"),
                 BRICKFALL_FIELD(world.hitEventSpeed)});
  out.push_back({real("hitEventImpulse", "World", "Hits from (impulse)", "N s", 0, kLargestPush, 0, 10,
                      "Weaker impacts are not counted as hits"),
                 BRICKFALL_FIELD(world.hitEventImpulse)});
  out.push_back({whole("threads", "World", "Threads", 1, kMostThreads, 16,
                       "Islands are solved side by side; results do not depend on it"),
                 BRICKFALL_FIELD(world.threads)});
  out.push_back({choice("integrator", "World", "Integrator", kIntegrators, "Of bodies that touch nothing"),
                 BRICKFALL_FIELD(world.integrator)});
  out.push_back({fromRestart(choice("broadPhase", "World", "Broad phase", kBroadPhases,
                                    "How pairs that may touch are found; changes time only")),
                 BRICKFALL_FIELD(world.broadPhase)});
  out.push_back(
      {fromRestart(whole("maxBodies", "World", "Most bodies", 1, kMostBodies, 1e6, "No body can be added beyond")),
       BRICKFALL_FIELD(world.maxBodies)});
}

// Ranges as World::create takes them; where one depends on another setting, the world has the last word.
void addSolver(std::vector<Entry>& out) {
  out.push_back({logarithmic(real("restingStiffness", "Solver", "Stiffness at rest", "m/dt2", 10, 1e5, 10, 1e5,
                                  "Elastic sag of what rests goes with 1 over this")),
                 BRICKFALL_FIELD(world.solver.restingStiffness)});
  out.push_back({logarithmic(real("impactStiffness", "Solver", "Stiffness in impacts", "m/dt2", 1, 1e5, 1, 1000,
                                  "Smaller: deeper overlap in hits; larger: more of a wall is shaken")),
                 BRICKFALL_FIELD(world.solver.impactStiffness)});
  out.push_back({real("restingApproachSpeed", "Solver", "Rest below", "m/s", 0, 100, 0, 2,
                      "Contacts that begin slower are no impacts"),
                 BRICKFALL_FIELD(world.solver.restingApproachSpeed)});
  out.push_back(
      {real("restitutionSpeed", "Solver", "Rebound from", "m/s", 0, 100, 0, 3, "Slower impacts do not rebound"),
       BRICKFALL_FIELD(world.solver.restitutionSpeed)});
  out.push_back({fromRestart(logarithmic(real("contactMargin", "Solver", "Contact margin", "m", 1e-5, 1, 1e-3, 0.1,
                                              "Contacts are made this early"))),
                 BRICKFALL_FIELD(world.solver.contactMargin)});
  out.push_back({real("restSpeed", "Solver", "Rest speed", "m/s", 0, 1, 0, 0.1,
                      "Only what is slower may be stopped or put to rest"),
                 BRICKFALL_FIELD(world.solver.restSpeed)});
  out.push_back({real("restTolerance", "Solver", "Rest tolerance", "weights", 0, 1, 0, 0.01,
                      "Force left over that counts as \"nothing moves\""),
                 BRICKFALL_FIELD(world.solver.restTolerance)});
  out.push_back({logarithmic(real("cycleTolerance", "Solver", "Cycle tolerance", "loads", 1e-6, 10, 1e-3, 1,
                                  "Force left over under which a moving body is left alone")),
                 BRICKFALL_FIELD(world.solver.cycleTolerance)});
  out.push_back({whole("minCycles", "Solver", "Fewest cycles", 1, 64, 16, "Fewer than 4 hang bodies in the air"),
                 BRICKFALL_FIELD(world.solver.minCycles)});
  out.push_back({whole("maxCycles", "Solver", "Most cycles", 1, 256, 64, "Of islands of 25 bodies and more"),
                 BRICKFALL_FIELD(world.solver.maxCycles)});
  out.push_back({whole("maxCyclesSmall", "Solver", "Most cycles, a body alone", 1, 256, 256, "Of a body alone"),
                 BRICKFALL_FIELD(world.solver.maxCyclesSmall)});
  out.push_back(
      {whole("maxHitParts", "Solver", "Most parts of a hit", 1, 64, 16, "Of a step in which something heavy hits"),
       BRICKFALL_FIELD(world.solver.maxHitParts)});
}

void addReport(std::vector<Entry>& out) {
  const auto add = [&](SettingRow row, double (*get)(const Scene&), void (*set)(Scene&, double)) {
    out.push_back({fromRestart(row), get, set});
  };
  add(choice("method", "Report", "Moved by", kMethods, "Brickfall's engine, or the report's own system for comparison"),
      BRICKFALL_FIELD(method));
  add(onOff("report.allAxes", "Report", "All axes", "All 15 rows at every test, not the first that separates"),
      BRICKFALL_FIELD(report.allAxes));
  add(onOff("report.lastAxis", "Report", "Last axis", "The contact's row is the last to stop separating"),
      BRICKFALL_FIELD(report.lastAxis));
  add(onOff("report.restitution", "Report", "Restitution", "Impulses from masses, inertia and restitution"),
      BRICKFALL_FIELD(report.restitution));
  add(onOff("report.friction", "Report", "Friction", "Coulomb's law instead of damping"),
      BRICKFALL_FIELD(report.friction));
  add(onOff("report.manifold", "Report", "Manifold", "All points in which two boxes touch, not one"),
      BRICKFALL_FIELD(report.manifold));
  add(onOff("report.warmStarting", "Report", "Warm starting", "Impulses are remembered from step to step"),
      BRICKFALL_FIELD(report.warmStarting));
  add(real("report.impulseFactor", "Report", "Impulse factor", "", 0, 100, 0, 3, "Of reduced mass x speed"),
      BRICKFALL_FIELD(report.impulseFactor));
  add(real("report.damping", "Report", "Damping", "1/s", 0, 1e6, 0, 2, "Of all velocities, without friction"),
      BRICKFALL_FIELD(report.damping));
  add(whole("report.sweeps", "Report", "Sweeps", 1, 1000, 50, "Over all contacts, with warm starting"),
      BRICKFALL_FIELD(report.sweeps));
  add(choice("report.integrator", "Report", "Integrator", kIntegrators, "Of the report's system"),
      BRICKFALL_FIELD(report.integrator));
}

#undef BRICKFALL_FIELD

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = [] {
    std::vector<Entry> out;
    addTime(out);
    addWorld(out);
    addSolver(out);
    addReport(out);
    return out;
  }();
  return all;
}

const Entry* entryOf(std::string_view key) {
  for (const Entry& entry : entries())
    if (entry.row.key == key) return &entry;
  return nullptr;
}

}  // namespace

std::span<const SettingRow> settingRows() {
  static const std::vector<SettingRow> rows = [] {
    std::vector<SettingRow> out;
    for (const Entry& entry : entries()) out.push_back(entry.row);
    return out;
  }();
  return rows;
}

const SettingRow* findSetting(std::string_view key) {
  const Entry* entry = entryOf(key);
  return entry ? &entry->row : nullptr;
}

double settingOf(const SceneDescription& scene, const SettingRow& row) {
  const Entry* entry = entryOf(row.key);
  return entry ? entry->get(scene) : 0;
}

bool setSetting(SceneDescription& scene, const SettingRow& row, double value) {
  const Entry* entry = entryOf(row.key);
  if (!entry || !(value >= row.least && value <= row.most)) return false;
  if (row.kind != SettingKind::real && value != std::floor(value)) return false;
  entry->set(scene, value);
  return true;
}

}  // namespace brickfall::viewer
