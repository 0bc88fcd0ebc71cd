// Numbers and poses over time.
#include <algorithm>
#include <cmath>

#include "brickfall/machines.h"

namespace brickfall {

namespace {

// The slope at a key from those on both sides of it: 0 at a turning point, and never so steep that the curve leaves the range of
// its two keys (the harmonic mean is at most twice the smaller).
double slopeAtKey(double before, double after) {
  return before * after > 0 ? 2 * before * after / (before + after) : 0;
}

// The cubic of given ends and slopes; s: share of the span.
double cubic(double from, double to, double slopeFrom, double slopeTo, double span, double s) {
  const double s2 = s * s, s3 = s2 * s;
  return from * (2 * s3 - 3 * s2 + 1) + to * (3 * s2 - 2 * s3) + slopeFrom * ((s3 - 2 * s2 + s) * span) +
         slopeTo * ((s3 - s2) * span);
}

// Where a time lies between ascending keys.
struct Place {
  std::size_t from = 0;
  bool inside = false;  // else: before the first, or after the last
};
template <class Keys, class TimeOf> Place placeIn(const Keys& keys, double time, TimeOf timeOf) {
  const auto next = std::upper_bound(keys.begin(), keys.end(), time,
                                     [&](double moment, const auto& key) { return moment < timeOf(key); });
  if (next == keys.begin()) return {0, false};
  if (next == keys.end()) return {keys.size() - 1, false};
  return {std::size_t(next - keys.begin()) - 1, true};
}

// What changes from one key to the next, as a vector: moves, or turns in the world's axes.
Vec3 wayOf(const MotionPath& path, std::size_t k, bool turns) {
  const MotionKey &from = path.keys[k], &to = path.keys[k + 1];
  return turns ? rotationVector(normalized(to.rotation * conjugate(from.rotation))) : to.position - from.position;
}

// How much of the way from key k to the next is done at a share s of its time.
Vec3 doneOf(const MotionPath& path, std::size_t k, double s, bool turns) {
  const Vec3 way = wayOf(path, k, turns);
  if (path.interpolation == Interpolation::linear) return way * s;
  const auto spanOf = [&](std::size_t i) { return path.keys[i + 1].time - path.keys[i].time; };
  const double span = spanOf(k);
  Vec3 before, after, done;
  if (k > 0) before = wayOf(path, k - 1, turns) * (1 / spanOf(k - 1));
  if (k + 2 < path.keys.size()) after = wayOf(path, k + 1, turns) * (1 / spanOf(k + 1));
  for (int i = 0; i < 3; i++)
    done[i] = cubic(0, way[i], slopeAtKey(before[i], way[i] / span), slopeAtKey(way[i] / span, after[i]), span, s);
  return done;
}

}  // namespace

double Track::at(double time) const {
  if (keys.empty()) return 0;
  const Place place = placeIn(keys, time, [](const auto& key) { return key.first; });
  const std::size_t k = place.from;
  if (!place.inside) return keys[k].second;
  const auto slopeOf = [&](std::size_t i) {
    return (keys[i + 1].second - keys[i].second) / (keys[i + 1].first - keys[i].first);
  };
  const double span = keys[k + 1].first - keys[k].first, s = (time - keys[k].first) / span;
  if (interpolation == Interpolation::linear) return keys[k].second + (keys[k + 1].second - keys[k].second) * s;
  const double here = slopeOf(k), before = k > 0 ? slopeOf(k - 1) : 0, after = k + 2 < keys.size() ? slopeOf(k + 1) : 0;
  return cubic(keys[k].second, keys[k + 1].second, slopeAtKey(before, here), slopeAtKey(here, after), span, s);
}

Transform MotionPath::at(double time) const {
  if (keys.empty()) return {};
  const Place place = placeIn(keys, time, [](const auto& key) { return key.time; });
  const MotionKey& from = keys[place.from];
  if (!place.inside) return {from.position, normalized(from.rotation)};
  const double s = (time - from.time) / (keys[place.from + 1].time - from.time);
  return {from.position + doneOf(*this, place.from, s, false),
          normalized(quatFromRotationVector(doneOf(*this, place.from, s, true)) * from.rotation)};
}

}  // namespace brickfall
