// Runs a scene of lab_scenes.h and reads off its figures: who moved, how far, when, at what cost.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "support/lab_scenes.h"

namespace brickfall::lab {

struct Measured {
  double collapseTime = -1;                                    // s, first time a box is more than 50 mm from its start
  double largestMove = 0, sag = 0, creep = 0, outOfPlane = 0;  // m
  int moved50 = 0;
  double energyStart = 0, energyRise = 0, largestJump = 0;  // J
  double momentumRatio = 0;                                 // along z
  double apex = 0, toppleTime = -1,
         restTime = -1;  // m, s; restTime: first time from which every island rested to the end
  double lowest = 0;     // m, lowest centre of any body
  double solveVisits = 0, lightVisits = 0, restShare = 0,
         cycles = 0;        // per point and step; share of island-steps; mean
  double milliseconds = 0;  // per step
  double fellMin = 0, fellMax = 0, slid = 0;
  bool finite = true;
  std::vector<double> boxMove;  // m, at the end
};

inline double boxMove(const Scene& s, std::size_t i, Vec3* at = nullptr) {
  Vec3 p = s.world.state(s.boxes[i])->position;
  if (at) *at = p;
  return length(p - s.start[i]);
}

template <class EachStep> Measured run(Scene& s, double seconds, double dt, EachStep each) {
  Measured r;
  int steps = int(std::lround(seconds / dt)), half = int(std::lround(std::min(10.0, seconds / 2) / dt));
  Energy e = s.world.energy();
  double previous = e.kinetic + e.potential, previousVy = 0;
  r.energyStart = previous;
  Vec3 startMomentum = s.world.linearMomentum();
  std::vector<Vec3> halfway;
  double points = 0, islands = 0, resting = 0, ms = 0;
  bool bounced = false;
  BodyId first = s.boxes.empty() ? s.others.front() : s.boxes.front();
  double firstHalfHeight = 0.25;
  for (int step = 0; step < steps; step++) {
    Result<StepReport> report = s.world.step(dt);
    if (!report || !report->quarantined.empty()) {
      r.finite = false;
      break;
    }
    e = s.world.energy();
    double now = e.kinetic + e.potential, time = s.world.time();
    r.energyRise = std::max(r.energyRise, now - r.energyStart);
    r.largestJump = std::max(r.largestJump, now - previous);
    previous = now;
    points += report->contactPoints;
    islands += report->islands;
    resting += report->restingIslands;
    r.cycles += report->cycles;
    r.solveVisits += report->solveVisits;
    r.lightVisits += report->lightVisits;
    ms += report->milliseconds;
    if (report->islands == report->restingIslands) {
      if (r.restTime < 0) r.restTime = time;
    } else {
      r.restTime = -1;
    }
    if (r.collapseTime < 0 || step == half || step == steps - 1)
      for (std::size_t i = 0; i < s.boxes.size(); i++) {
        Vec3 p;
        if (boxMove(s, i, &p) > 0.05 && r.collapseTime < 0) r.collapseTime = time;
        if (step == half) halfway.push_back(p);
      }
    BodyState b = *s.world.state(first);
    bounced = bounced || (previousVy < 0 && b.linearVelocity.y > 0);
    previousVy = b.linearVelocity.y;
    if (bounced) r.apex = std::max(r.apex, b.position.y - firstHalfHeight);
    if (r.toppleTime < 0 && toMatrix(b.rotation).row[1].y < 0.5) r.toppleTime = time;
    each(step, *report);
  }
  r.fellMin = 1e9;
  r.fellMax = -1e9;
  for (std::size_t i = 0; i < s.boxes.size(); i++) {
    Vec3 p;
    double move = boxMove(s, i, &p);
    r.boxMove.push_back(move);
    r.largestMove = std::max(r.largestMove, move);
    r.sag = std::max(r.sag, s.start[i].y - p.y);
    r.fellMin = std::min(r.fellMin, s.start[i].y - p.y);
    r.fellMax = std::max(r.fellMax, s.start[i].y - p.y);
    r.outOfPlane = std::max(r.outOfPlane, std::fabs(p.z - s.start[i].z));
    r.moved50 += move > 0.05;
    r.lowest = std::min(r.lowest, p.y);
    if (i < halfway.size()) r.creep = std::max(r.creep, length(p - halfway[i]));
  }
  if (!s.boxes.empty()) r.slid = s.world.state(s.boxes[0])->position.x - s.start[0].x;
  if (startMomentum.z != 0) r.momentumRatio = s.world.linearMomentum().z / startMomentum.z;
  double perPoint = 1 / std::max(1.0, points);
  r.solveVisits *= perPoint;
  r.lightVisits *= perPoint;
  r.restShare = resting / std::max(1.0, islands);
  r.cycles /= std::max(1.0, islands - resting);
  r.milliseconds = ms / std::max(1, steps);
  return r;
}
inline Measured run(Scene& s, double seconds, double dt) {
  return run(s, seconds, dt, [](int, const StepReport&) {});
}

}  // namespace brickfall::lab
