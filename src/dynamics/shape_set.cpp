#include "dynamics/shape_set.h"

#include <algorithm>
#include <cmath>

#include "geometry/frustum.h"

namespace brickfall {

ShapeIndex ShapeSet::create() {
  ShapeIndex shape;
  if (free_.empty()) {
    shape = ShapeIndex(data.size());
    data.emplace_back();
  } else {
    shape = free_.back();
    free_.pop_back();
    std::uint16_t generation = data[shape].generation;
    data[shape] = {};
    data[shape].generation = generation;
  }
  data[shape].alive = true;
  data[shape].generation++;
  if (data[shape].generation == 0) data[shape].generation = 1;
  return shape;
}

void ShapeSet::destroy(ShapeIndex shape) {
  data[shape].alive = false;
  data[shape].hull.reset();
  // A generation that begins anew would make ids of long ago valid again: such a slot is never used again.
  if (data[shape].generation < 0xffff) free_.push_back(shape);
}

namespace {

double mix(double a, double b, CombineRule ruleA, CombineRule ruleB) {
  switch (std::max(ruleA, ruleB)) {
    case CombineRule::geometricMean:
      return std::sqrt(a * b);
    case CombineRule::average:
      return 0.5 * (a + b);
    case CombineRule::minimum:
      return std::min(a, b);
    case CombineRule::multiply:
      return a * b;
    case CombineRule::maximum:
      return std::max(a, b);
  }
  return a;
}

}  // namespace

double mixFriction(const Material& a, const Material& b) {
  return mix(a.friction, b.friction, a.frictionRule, b.frictionRule);
}
double mixRestitution(const Material& a, const Material& b) {
  return mix(a.restitution, b.restitution, a.restitutionRule, b.restitutionRule);
}
namespace {

double curvature(const ShapeDef& s) {  // 1/m, across the direction in which it is straight
  if (!isRound(s.type) && !isFrustum(s.type)) return 0;
  return 1 / (s.type == ShapeType::cone ? 0.5 * (s.radius + s.topRadius) : s.radius);
}

}  // namespace

double rollingRadius(const ShapeDef& a, const ShapeDef& b) {
  const double sum = curvature(a) + curvature(b);
  return sum > 0 ? 1 / sum : 0;
}
const PairEdit* ShapeSet::editOf(ShapeIndex a, ShapeIndex b) const {
  if (edits.empty()) return nullptr;
  const std::pair<ShapeIndex, ShapeIndex> wanted{std::min(a, b), std::max(a, b)};
  const auto place = std::lower_bound(edits.begin(), edits.end(), wanted, [](const PairEdit& edit, const auto& pair) {
    return std::pair{edit.shapeA, edit.shapeB} < pair;
  });
  return place != edits.end() && std::pair{place->shapeA, place->shapeB} == wanted ? &*place : nullptr;
}

bool ShapeSet::mayTouch(ShapeIndex a, ShapeIndex b) const {
  const ShapeDef &first = data[a].def, &second = data[b].def;
  if (first.sensor || second.sensor || !filtersAllow(first.filter, second.filter)) return false;
  if (const PairEdit* edit = editOf(a, b); edit && !edit->enabled) return false;
  return !asked || asked(a < b ? a : b, a < b ? b : a);
}

bool filtersAllow(const CollisionFilter& a, const CollisionFilter& b) {
  if (a.group == b.group && a.group != 0) return a.group > 0;
  return (a.category & b.mask) != 0 && (b.category & a.mask) != 0;
}

}  // namespace brickfall
