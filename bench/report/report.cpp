// What the report's wall and the integrators do, as JSON: tools/report-page draws docs/report.md and docs/integrators.md
// from it. No timing: the figures are the same on every machine.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "brickfall/brickfall.h"
#include "brickfall/report.h"
#include "support/lab_scenes.h"

namespace {

using namespace brickfall;

constexpr double kSeconds = 10;

// JSON without a library: `separator` before every entry but the first.
class Json {
 public:
  void open(const char* bracket) { std::printf("%s%s", separator_, bracket), separator_ = ""; }
  void close(const char* bracket) { std::printf("%s", bracket), separator_ = ",\n"; }
  void name(const char* text) { std::printf("%s\"%s\": ", separator_, text), separator_ = ""; }
  void text(const std::string& value) { std::printf("%s\"%s\"", separator_, value.c_str()), separator_ = ", "; }
  void number(double value) {
    if (std::isfinite(value))
      std::printf("%s%.6g", separator_, value);
    else
      std::printf("%snull", separator_);
    separator_ = ", ";
  }
  void field(const char* key, double value) { name(key), number(value); }

 private:
  const char* separator_ = "";
};

struct Outcome {
  double to5mm = -1, to50mm = -1,
         toHalf = -1;  // s until a brick, or half of them, are so far from their places; -1: never
  double highest = 0;  // J, of kinetic energy
  double ofSpin = 0;   // share of spins in that
  double gained = 0;   // J: most that there was beyond the start, kinetic and potential
  int fallen = 0;      // bricks further than 50 mm at the end
  std::vector<double> time, kinetic, total;  // J, total: above the start
};

// J, of the motion of all centres of mass.
double wayEnergy(const lab::Scene& scene) {
  double sum = 0;
  for (BodyId box : scene.boxes)
    sum += 0.5 * scene.world.massProperties(box)->mass * lengthSquared(scene.world.state(box)->linearVelocity);
  return sum;
}

// A wall of ten courses of ten bricks, left to itself, under the report's system or (null) ours.
Outcome standOrFall(const WorldDef& def, ReportRun* reported, double seconds) {
  lab::Builder builder("report", {});
  builder.def = def;
  builder.open();
  builder.addWall(10, 10);
  lab::Scene scene = builder.take(seconds);
  Outcome out;
  double start = scene.world.energy().potential;
  int steps = int(std::lround(seconds * 60));
  for (int i = 0; i <= steps; i++) {
    double time = i / 60.0;
    if (i > 0 && !(reported ? reported->step(scene.world, 1.0 / 60) : scene.world.step(1.0 / 60)).ok()) break;
    double worst = 0;
    out.fallen = 0;
    for (std::size_t k = 0; k < scene.boxes.size(); k++) {
      double way = length(scene.world.state(scene.boxes[k])->position - scene.start[k]);
      worst = std::max(worst, way);
      out.fallen += !(way < 0.05);
    }
    if (worst > 5e-3 && out.to5mm < 0) out.to5mm = time;
    if (worst > 5e-2 && out.to50mm < 0) out.to50mm = time;
    if (2 * out.fallen > int(scene.boxes.size()) && out.toHalf < 0) out.toHalf = time;
    Energy energy = scene.world.energy();
    if (energy.kinetic > out.highest) {
      out.highest = energy.kinetic;
      out.ofSpin = 1 - wayEnergy(scene) / energy.kinetic;
    }
    out.gained = std::max(out.gained, energy.kinetic + energy.potential - start);
    if (i % 6 != 0) continue;
    out.time.push_back(time);
    out.kinetic.push_back(energy.kinetic);
    out.total.push_back(energy.kinetic + energy.potential - start);
  }
  return out;
}

void list(Json& json, const char* name, const std::vector<double>& values) {
  json.name(name);
  json.open("[");
  for (double v : values) json.number(v);
  json.close("]");
}

void print(Json& json, const std::string& name, const Outcome& o, bool curves) {
  json.open("{");
  json.name("name");
  json.text(name);
  json.field("to5mm", o.to5mm);
  json.field("to50mm", o.to50mm);
  json.field("toHalf", o.toHalf);
  json.field("highest", o.highest);
  json.field("gained", o.gained);
  json.field("ofSpin", o.ofSpin);
  json.field("fallen", o.fallen);
  if (curves) {
    list(json, "time", o.time);
    list(json, "kinetic", o.kinetic);
    list(json, "total", o.total);
  }
  json.close("}");
}

Outcome reported(const ReportSettings& settings) {
  Result<ReportRun> run = ReportRun::create(settings);
  return standOrFall({}, &run.value(), kSeconds);
}

struct Part {
  const char* name;
  bool ReportSettings::*flag;
};
constexpr Part kParts[] = {{"all 15 axes", &ReportSettings::allAxes},
                           {"last axis instead of first", &ReportSettings::lastAxis},
                           {"real restitution", &ReportSettings::restitution},
                           {"friction", &ReportSettings::friction},
                           {"manifold", &ReportSettings::manifold},
                           {"warm starting, 10 sweeps", &ReportSettings::warmStarting}};

void walls(Json& json) {
  json.name("added");
  json.open("[");
  ReportSettings settings;
  print(json, "the report", reported(settings), true);
  for (const Part& part : kParts) {
    settings.*part.flag = true;
    print(json, part.name, reported(settings), true);
  }
  settings.sweeps = 100;
  print(json, "100 sweeps", reported(settings), true);
  WorldDef ours;
  ours.enableSleep = false;
  print(json, "ours", standOrFall(ours, nullptr, kSeconds), true);
  json.close("]");
  json.name("alone");
  json.open("[");
  for (const Part& part : kParts) {
    ReportSettings one;
    one.*part.flag = true;
    print(json, part.name, reported(one), false);
  }
  json.close("]");
  json.name("constants");
  json.open("[");
  for (double factor : {0.5, 1.0, 1.5, 2.0})
    for (double damping : {0.0, 0.3, 1.0, 3.0, 10.0}) {
      ReportSettings s;
      s.impulseFactor = factor;
      s.damping = damping;
      Outcome o = reported(s);
      json.open("{");
      json.field("factor", factor);
      json.field("damping", damping);
      json.field("to5mm", o.to5mm);
      json.field("to50mm", o.to50mm);
      json.field("toHalf", o.toHalf);
      json.close("}");
    }
  json.close("]");
}

// --- integrators: the systems of tests/unit/math/integrators_test.cpp

constexpr double kSpring = 400, kGravity = 9.81;  // N/m, m/s2

RigidLoad pendulumLoad(const RigidState& s, double) {
  double l = length(s.position);
  return {Vec3{0, -kGravity, 0} - s.position * (kSpring * (l - 1) / l), {}};
}
double pendulumEnergy(const RigidState& s, const RigidMass& mass) {
  double stretch = length(s.position) - 1;
  return kineticEnergy(s, mass) + kGravity * (s.position.y + 1) + 0.5 * kSpring * stretch * stretch +
         0.5 * kGravity * kGravity / kSpring;
}

// Energy over time, as a share of the start's.
template <class Load, class EnergyOf>
void energyCurve(Json& json, Integrator integrator, int rate, RigidState s, const RigidMass& mass, double seconds,
                 const Load& load, const EnergyOf& energyOf) {
  double start = energyOf(s, mass), momentum = length(spinMomentum(s, mass)), most = 0, drift = 0;
  std::vector<double> time, energy;
  int steps = int(seconds * rate), every = steps / 200;
  for (int i = 0; i <= steps; i++) {
    if (i > 0) s = integrated(integrator, s, mass, load, 1.0 / rate);
    double now = energyOf(s, mass) / start;
    most = std::max(most, std::fabs(now - 1));
    if (momentum > 0) drift = std::max(drift, std::fabs(length(spinMomentum(s, mass)) / momentum - 1));
    if (i % every != 0) continue;
    time.push_back(double(i) / rate);
    energy.push_back(now);
  }
  json.open("{");
  json.name("integrator");
  json.text(std::string(integratorName(integrator)));
  json.field("rate", rate);
  json.field("end", energyOf(s, mass) / start - 1);
  json.field("most", most);
  json.field("momentum", drift);
  list(json, "time", time);
  list(json, "energy", energy);
  json.close("}");
}

void integrators(Json& json) {
  RigidMass unit{1, diagonal(Vec3{1, 1, 1})};
  RigidMass box{1, diagonal(Vec3{0.05, 0.10, 0.13} * (1.0 / 12))};  // 0.3 x 0.2 x 0.1 m
  RigidState pendulum, spin;
  double l = 1 + kGravity / kSpring;
  pendulum.position = {l * std::sin(0.5), -l * std::cos(0.5), 0};
  spin.angularVelocity = {0.1, 10, 0.05};
  auto noLoad = [](const RigidState&, double) { return RigidLoad{}; };
  for (bool swings : {true, false}) {
    json.name(swings ? "pendulum" : "spin");
    json.open("[");
    for (int rate : {60, 240})
      for (int i = 0; i < kIntegratorCount; i++) {
        if (swings)
          energyCurve(json, Integrator(i), rate, pendulum, unit, 10, pendulumLoad, pendulumEnergy);
        else
          energyCurve(json, Integrator(i), rate, spin, box, 10, noLoad, kineticEnergy);
      }
    json.close("]");
  }
}

}  // namespace

int main() {
  Json json;
  json.open("{");
  json.field("seconds", kSeconds);
  walls(json);
  integrators(json);
  json.close("}\n");
}
