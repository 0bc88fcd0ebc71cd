// Time per pair of boxes: early exit, all rows, four at a time, distance, first contact. Half of the pairs overlap.
#include <benchmark/benchmark.h>

#include <vector>

#include "brickfall/geometry/obb_motion.h"
#include "math/random.h"

namespace {

using namespace brickfall;

constexpr std::size_t kPairs = 4096;

template <class T> struct Pairs {
  std::vector<ObbT<T>> a, b;

  Pairs() {
    Random random(1);
    auto box = [&](double spread) {
      auto one = [&] { return random.between(-1, 1); };
      QuatT<T> q = normalized(QuatT<T>{T(one()), T(one()), T(one()), T(one())});
      Vec3T<T> centre{T(spread * one()), T(spread * one()), T(spread * one())};
      Vec3T<T> half{T(random.between(0.2, 1)), T(random.between(0.2, 1)), T(random.between(0.2, 1))};
      return makeObb(TransformT<T>{centre, q}, half);
    };
    for (std::size_t k = 0; k < kPairs; k++) {
      a.push_back(box(0));
      b.push_back(box(1.4));
    }
  }
};

template <class T, class F> void each(benchmark::State& state, F&& look) {
  const Pairs<T> pairs;
  for (auto _ : state) {
    for (std::size_t k = 0; k < kPairs; k++) look(pairs.a[k], pairs.b[k]);
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(kPairs));
  int overlapping = 0;
  for (std::size_t k = 0; k < kPairs; k++) overlapping += overlaps(pairs.a[k], pairs.b[k]);
  state.counters["overlapping"] = double(overlapping) / double(kPairs);
}

template <class T> void earlyExit(benchmark::State& state) {
  each<T>(state, [](const auto& a, const auto& b) { benchmark::DoNotOptimize(overlaps(a, b)); });
}
template <class T> void allRows(benchmark::State& state) {
  each<T>(state, [](const auto& a, const auto& b) { benchmark::DoNotOptimize(rowGaps(a, b)); });
}
template <class T> void closestPoints(benchmark::State& state) {
  each<T>(state, [](const auto& a, const auto& b) { benchmark::DoNotOptimize(distance(a, b)); });
}
template <class T> void moving(benchmark::State& state) {
  each<T>(state, [](const auto& a, const auto& b) {
    ObbMotionT<T> motion{a, b, {}, {T(0.3), T(-1), T(0.2)}, {}, {}};
    benchmark::DoNotOptimize(firstContact(motion, T(1)));
  });
}
void fourAtATime(benchmark::State& state) {
  const Pairs<float> pairs;
  std::vector<std::uint8_t> out(kPairs);
  for (auto _ : state) {
    overlaps(pairs.a, pairs.b, out);
    benchmark::DoNotOptimize(out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(kPairs));
}

BENCHMARK(earlyExit<float>);
BENCHMARK(earlyExit<double>);
BENCHMARK(fourAtATime);
BENCHMARK(allRows<float>);
BENCHMARK(allRows<double>);
BENCHMARK(closestPoints<double>);
BENCHMARK(moving<double>);

}  // namespace

BENCHMARK_MAIN();
