// Runs one of the solver's scenes and prints one line of figures.
//   walls SCENE [seconds=S] [dt=S] [gap_mm=G] [seed=N] [e=E] [yaw=DEG] [shift=S] [whole=1] [joint_mm=J] [headers=1]
//         [shuffle=1] [sleep=1] [kmax=U] [maxCycles=N] [threads=N] [stages=1] [print=S]
#include <cstdio>
#include <cstring>

#include "support/lab_measure.h"

using namespace brickfall;

namespace {

struct Call {
  lab::Options options;
  double seconds = 0, print = 0;  // s; 0: what the scene says, never
  bool stages = false;
};

// One key=value; false if there is no such key.
bool take(const char* argument, Call& call) {
  const char* eq = std::strchr(argument, '=');
  std::string key = eq ? std::string(argument, std::size_t(eq - argument)) : "";
  double v = eq ? std::atof(eq + 1) : 0;
  if (key == "seconds")
    call.seconds = v;
  else if (key == "dt")
    call.options.dt = v;
  else if (key == "gap_mm")
    call.options.gap = v * 1e-3;
  else if (key == "seed")
    call.options.seed = int(v);
  else if (key == "e")
    call.options.restitution = v;
  else if (key == "yaw")
    call.options.yawDegrees = v;
  else if (key == "shift")
    call.options.bondShift = v;
  else if (key == "whole")
    call.options.wholeBricks = v != 0;
  else if (key == "joint_mm")
    call.options.headJoint = v * 1e-3;
  else if (key == "headers")
    call.options.headers = v != 0;
  else if (key == "shuffle")
    call.options.shuffle = v != 0;
  else if (key == "sleep")
    call.options.sleep = v != 0;
  else if (key == "kmax")
    call.options.solver.restingStiffness = v;
  else if (key == "minCycles")
    call.options.solver.minCycles = int(v);
  else if (key == "maxCycles")
    call.options.solver.maxCycles = int(v);
  else if (key == "maxCyclesSmall")
    call.options.solver.maxCyclesSmall = int(v);
  else if (key == "margin_mm")
    call.options.solver.contactMargin = v * 1e-3;
  else if (key == "restSpeed")
    call.options.solver.restSpeed = v;
  else if (key == "threads")
    call.options.threads = int(v);
  else if (key == "print")
    call.print = v;
  else if (key == "stages")
    call.stages = v != 0;
  else
    return false;
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::printf("usage: walls SCENE [key=value]...\n");
    return 2;
  }
  Call call;
  for (int i = 2; i < argc; i++)
    if (!take(argv[i], call)) {
      std::printf("unknown option %s\n", argv[i]);
      return 2;
    }
  const lab::Options& o = call.options;
  lab::Scene s = lab::make(argv[1], o);
  if (call.seconds <= 0) call.seconds = s.seconds;
  std::array<double, kStageCount> stage{};
  double steps = 0;
  lab::Measured r = lab::run(s, call.seconds, o.dt, [&](int step, const StepReport& report) {
    for (int k = 0; k < kStageCount; k++) stage[std::size_t(k)] += report.stageMilliseconds[std::size_t(k)];
    steps++;
    if (call.print > 0 && step % std::max(1, int(std::lround(call.print / o.dt))) == 0)
      std::printf("  t %7.3f points %d touching %d islands %d rest %d cycles %d residual %.2e ms %.3f\n", report.time,
                  report.contactPoints, report.touchingPoints, report.islands, report.restingIslands, report.cycles,
                  report.residualRms, report.milliseconds);
  });
  std::printf(
      "%-8s %s max %.3f sag %.3f creep %.4f out %.3f mm | moved>50mm %d of %d | collapse %.2f s | rise %.3g jump %.3g J"
      " | fell %.5f..%.5f slid %.4f apex %.4f topple %.4f rest %.2f momentum %.6f | visits %.2f light %.2f rest %.3f"
      " cycles %.2f | %.3f ms | hash %016llx\n",
      s.name.c_str(), r.finite ? (r.collapseTime > 0 ? "MOVES" : "stands") : "NOT FINITE", r.largestMove * 1e3,
      r.sag * 1e3, r.creep * 1e3, r.outOfPlane * 1e3, r.moved50, int(s.boxes.size()), r.collapseTime, r.energyRise,
      r.largestJump, r.fellMin, r.fellMax, r.slid, r.apex, r.toppleTime, r.restTime, r.momentumRatio, r.solveVisits,
      r.lightVisits, r.restShare, r.cycles, r.milliseconds, (unsigned long long)s.world.stateHash());
  if (call.stages) {
    for (int k = 0; k < kStageCount; k++)
      std::printf("  %-12s %.4f ms\n", std::string(kStageNames[std::size_t(k)]).c_str(), stage[std::size_t(k)] / steps);
  }
  for (const std::string& text : s.world.validate()) std::printf("  INVALID: %s\n", text.c_str());
  return 0;
}
