// What finding pairs costs by number of boxes, for each broad phase, as JSON: tools/report-page draws docs/broad-phases.md
// from it. Processor time, the least of three rounds. The n^2 ones stop at 10,000 boxes.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

#include "broadphase/broad_phase.h"
#include "math/random.h"

namespace {

using namespace brickfall;

const auto kWanted = [](std::uint32_t, std::uint32_t) { return true; };
constexpr double kMargin = 0.01;  // m

Aabb brickAt(Vec3 centre) {
  Vec3 half{0.1075, 0.0325, 0.05125};
  return {centre - half, centre + half};
}

// Bricks strewn so that each meets some few others, whatever their number.
std::vector<Aabb> heap(int n) {
  Random random(5);
  double side = 0.22 * std::cbrt(double(n));
  std::vector<Aabb> out;
  for (int i = 0; i < n; i++)
    out.push_back(brickAt({random.between(0, side), random.between(0, side), random.between(0, side)}));
  return out;
}

// A wall twice as long as high.
std::vector<Aabb> wall(int n) {
  int bricks = std::max(1, int(std::lround(std::sqrt(n * 2 * 0.065 / 0.215))));
  std::vector<Aabb> out;
  for (int i = 0; i < n; i++) {
    int course = i / bricks, place = i % bricks;
    out.push_back(brickAt({0.215 * (place + 0.5 * (course % 2)), 0.065 * (course + 0.5), 0}));
  }
  return out;
}

double seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

struct Costs {
  double first = 1e9, step = 1e9;  // s
  std::size_t pairs = 0, newPairs = 0;
};

// One box in ten moves by 0.1 m in a step.
void measure(BroadPhaseMethod method, const std::vector<Aabb>& boxes, Costs& costs) {
  Random random(9);
  std::unique_ptr<BroadPhase> phase = makeBroadPhase(method);
  std::vector<ProxyIndex> proxies;
  BroadPhase::Pairs pairs;
  double start = seconds();
  for (std::uint32_t i = 0; i < boxes.size(); i++) proxies.push_back(phase->add(boxes[i], kMargin, i));
  phase->newPairs(kWanted, pairs);
  costs.first = std::min(costs.first, seconds() - start);
  costs.pairs = pairs.size();
  std::vector<Aabb> now = boxes;
  int steps = std::max(1, 2000 / int(boxes.size()));
  costs.newPairs = 0;
  start = seconds();
  for (int s = 0; s < steps; s++) {
    for (std::size_t i = 0; i < now.size(); i++) {
      if (i % 10 == 0) {
        double angle = random.between(-1, 1);
        Vec3 by{0.1 * angle, 0.05 * (1 - std::fabs(angle)), 0.1 * (1 - std::fabs(angle))};
        now[i] = {boxes[i].lower + by, boxes[i].upper + by};
      }
      phase->update(proxies[i], now[i], kMargin);
    }
    phase->newPairs(kWanted, pairs);
    costs.newPairs += pairs.size();
  }
  costs.step = std::min(costs.step, (seconds() - start) / steps);
}

}  // namespace

int main() {
  const char* separator = "[\n";
  for (bool stacked : {false, true})
    for (int n : {100, 300, 1000, 3000, 10'000, 30'000, 100'000}) {
      std::vector<Aabb> boxes = stacked ? wall(n) : heap(n);
      Costs expected;
      for (int m = 0; m < kBroadPhaseMethodCount; m++) {
        BroadPhaseMethod method = BroadPhaseMethod(m);
        bool squared = method == BroadPhaseMethod::allPairs || method == BroadPhaseMethod::boundingSpheres;
        if (squared && n > 10'000) continue;
        Costs costs;
        for (int round = 0; round < 3; round++) measure(method, boxes, costs);
        if (m == 0) expected = costs;
        if (costs.pairs != expected.pairs || costs.newPairs != expected.newPairs) {
          std::fprintf(stderr, "%s finds other pairs than the tree\n", broadPhaseName(method).data());
          return 1;
        }
        std::printf(
            "%s{\"scene\": \"%s\", \"method\": \"%s\", \"n\": %d, \"first\": %.4g, \"step\": %.4g, \"pairs\": %zu}",
            separator, stacked ? "wall" : "heap", broadPhaseName(method).data(), n, costs.first, costs.step,
            costs.pairs);
        separator = ",\n";
        std::fflush(stdout);
      }
    }
  std::printf("\n]\n");
}
