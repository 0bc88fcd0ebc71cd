// timeOfImpact of every two convex shapes against a slow method: the distance over time, in extended precision, is convex,
// so a golden-section search finds its least value and bisection the first time at which it is reached.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>

#include "geometry/queries.h"
#include "pair_families.h"
#include "support/validation_record.h"

namespace brickfall::oracle {
namespace {

using namespace test;

#ifndef BRICKFALL_PAIRS
#define BRICKFALL_PAIRS 5000
#endif
constexpr long kPairs = BRICKFALL_PAIRS / 50;

enum class Way { hit, miss, grazing, touching, inside, shortOf };
constexpr int kWays = 6;
constexpr const char* kWayNames[kWays] = {"hit", "miss", "grazing", "touching", "inside", "short of it"};

struct Moving {
  Pair pair;
  Vec3 motion;
  double target = 0;
};

Vec3 anyAcross(Random& random, Vec3 axis) {
  Vec3 side = cross(axis, randomDirection(random));
  return length(side) > 1e-3 ? normalized(side) : anyAcross(random, axis);
}

// b touches a, or nearly, and is moved back by a way that leads there.
Moving movingPair(PairSource& source, Way way, Random& random) {
  Moving out;
  out.pair = source.next(way == Way::inside ? Family::deep : random.below(4) ? Family::generic : Family::sizeRatio);
  Pair& pair = out.pair;
  double size = pair.size, thin = pair.smallest, reach = size * std::pow(10.0, random.between(0.5, 1.5));
  if (way == Way::inside) {
    out.motion = randomDirection(random) * reach;
    return out;
  }
  double apart = -random.between(0.01, 0.1) * thin;
  if (way == Way::miss || way == Way::shortOf) apart = random.between(0.01, 0.1) * thin;
  if (way == Way::grazing) apart = random.between(-1, 1) * std::pow(10.0, random.between(-10, -5)) * size;
  if (way == Way::touching) apart = random.between(-1e-9, 1e-9) * size;
  setSeparation(pair, apart);
  Vec3 axis = narrow(separationOf(solidOf(pair.a, {}), solidOf(pair.b, pair.bInA)).axis),
       side = anyAcross(random, axis);
  if (way == Way::touching) {
    out.motion = randomDirection(random) * reach;
    return out;
  }
  if (way == Way::hit || way == Way::miss) out.target = random.below(3) ? 0 : random.between(0, 0.005) * thin;
  Vec3 direction = way == Way::miss || way == Way::grazing ? side : normalized(axis + side * random.between(0, 2));
  pair.bInA.position += direction * reach;
  out.motion = direction * (-reach * (way == Way::shortOf ? random.between(0.1, 0.999) : random.between(1, 3)));
  return out;
}

class SlowImpact {
 public:
  explicit SlowImpact(const Moving& moving) : moving_(moving), a_(solidOf(moving.pair.a, {})) {}
  double separation(double time) const {
    Transform pose = moving_.pair.bInA;
    pose.position += moving_.motion * time;
    return double(separationOf(a_, solidOf(moving_.pair.b, pose)).value);
  }
  // Where the separation is least; stops at anything below `enough`.
  double nearestTime(double enough) const {
    constexpr double kGolden = 0.6180339887498949;
    double low = 0, high = 1, first = high - kGolden * (high - low), second = low + kGolden * (high - low);
    double atFirst = separation(first), atSecond = separation(second);
    if (separation(0) < enough) return 0;
    while (high - low > 1e-12) {
      if (atFirst < enough) return first;
      if (atSecond < enough) return second;
      if (atFirst < atSecond) {
        high = second, second = first, atSecond = atFirst;
        atFirst = separation(first = high - kGolden * (high - low));
      } else {
        low = first, first = second, atFirst = atSecond;
        atSecond = separation(second = low + kGolden * (high - low));
      }
    }
    double middle = 0.5 * (low + high);
    return separation(1) < separation(middle) ? 1 : middle;
  }
  // First time at which it comes to `value`, which it does by `by`.
  double firstTime(double value, double by) const {
    double low = 0, high = by;
    if (separation(0) <= value) return 0;
    while (high - low > 1e-14) {
      double middle = 0.5 * (low + high);
      if (middle <= low || middle >= high) break;
      (separation(middle) <= value ? high : low) = middle;
    }
    return high;
  }

 private:
  const Moving& moving_;
  Solid a_;
};

// The figures of one sweep.
struct Tally {
  std::map<std::string, long> seen;
  long wrong = 0;
  double early = 0, late = 0, shortBy = 0;  // worst; shares of the way, and of the tolerance
};

double toleranceOf(const Pair& pair) { return std::min(1e-6, 1e-5 * pair.smallest); }

void look(const Moving& moving, Way way, Tally& tally) {
  const Pair& pair = moving.pair;
  double reach = length(moving.motion), rounding = 1e-9 * pair.size + 1e-14 * reach;
  double tolerance = std::max(toleranceOf(pair), 4e-9 * pair.size);
  SlowImpact slow(moving);
  std::optional<double> found = timeOfImpact(pair.a, pair.b, pair.bInA, moving.motion, moving.target);
  double surely = moving.target - rounding, nearest = slow.nearestTime(surely), least = slow.separation(nearest);
  std::string verdict = least < surely ? "meets" : least > moving.target + tolerance + rounding ? "passes" : "either";
  tally.seen[verdict]++, tally.seen[kWayNames[int(way)]]++;
  if (verdict != "either" && found.has_value() != (verdict == "meets")) tally.wrong++;
  if (!found) return;
  double there = slow.separation(*found);
  tally.shortBy = std::max(tally.shortBy, (there - moving.target - rounding) / tolerance);
  if (*found > 0) tally.late = std::max(tally.late, moving.target - there - rounding);
  if (verdict != "meets") return;
  tally.seen[*found > 0 ? "meets on its way" : "meets at the start"]++;
  double first = slow.firstTime(moving.target + tolerance + rounding, nearest);
  tally.early = std::max(tally.early, first - *found);
  tally.late = std::max(tally.late, *found - slow.firstTime(surely, nearest));
}

TEST(Impacts, AgreeWithTheSlowMethod) {
  constexpr ShapeType kTypes[] = {ShapeType::plane, ShapeType::sphere, ShapeType::capsule, ShapeType::box,
                                  ShapeType::hull};
  Tally tally;
  long pairs = 0;
  for (int i = 0; i < 5; i++)
    for (int k = std::max(i, 1); k < 5; k++) {  // not two planes
      ShapeType first = kTypes[i], second = kTypes[k];
      PairSource source(first, second, 700 + std::uint64_t(first) * 10 + std::uint64_t(second));
      Random random(std::uint64_t(first) * 31 + std::uint64_t(second));
      for (long n = 0; n < kPairs; n++, pairs++) {
        Way way = Way(n % kWays);
        long wrong = tally.wrong;
        look(movingPair(source, way, random), way, tally);
        EXPECT_EQ(tally.wrong, wrong) << "types " << int(first) << " " << int(second) << ", number " << n << ", "
                                      << kWayNames[n % kWays];
      }
    }
  EXPECT_LE(tally.shortBy, 1);
  EXPECT_LE(tally.early, 1e-12);
  EXPECT_LE(tally.late, 1e-9);
  for (const char* way : kWayNames) EXPECT_GE(tally.seen[way], pairs / 7) << way;
  EXPECT_GT(tally.seen["meets on its way"], pairs / 6);
  EXPECT_GT(tally.seen["meets at the start"], pairs / 8);
  EXPECT_GT(tally.seen["passes"], pairs / 5);
  EXPECT_GT(tally.seen["either"], pairs / 50);
  if (pairs < 10000) return;
  for (const auto& [what, n] : tally.seen) std::printf("  %-30s %ld\n", what.c_str(), n);
  auto keep = [&](const char* name, double found, double limit, const char* unit) {
    ValidationRow row;
    row.section = "collision";
    row.name = name;
    row.expected = limit, row.found = found, row.atMost = true;
    row.unit = unit;
    row.pass = found <= limit;
    row.cases = int(pairs);
    record(row);
    std::printf("%s: %.3g %s\n", name, found, unit);
  };
  keep("time of impact: hit or miss, wrong", double(tally.wrong), 0, "");
  keep("time of impact: how far it stops short", tally.shortBy, 1, "of the tolerance");
  keep("time of impact: too early", tally.early, 1e-12, "of the way");
  keep("time of impact: too late", tally.late, 1e-9, "of the way, or m");
}

}  // namespace
}  // namespace brickfall::oracle
