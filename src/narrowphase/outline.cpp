#include "narrowphase/outline.h"

#include "geometry/frustum.h"
#include "narrowphase/features.h"
#include "narrowphase/hull_view.h"

namespace brickfall {

namespace {

constexpr int kRimPoints = 32;
constexpr double kFlushCap = 0.02;  // sine of the tilt up to which a cap stands on fixed points of its rim
constexpr double kAcross = 0.0632;  // sine of 3.6 degrees: a line lies across a direction

// A quarter of a right angle: as far from the lowest point are those that a coin may come down on within the step.
constexpr double kCosineBeside = 0.92387953251128675613, kSineBeside = 0.38268343236508977173;

// Numbers of corners: 0 .. 63 fixed points of the two rims, then those that wander.
constexpr int kLowestOnRim = 2 * kRimPoints, kEndOfSide = kLowestOnRim + 8;

// Direction of a fixed point, from multiples of 11.25 degrees: counter-clockwise seen from above.
Vec3 rimDirection(int k) {
  constexpr double kCosine[9] = {1,
                                 0.98078528040323044913,
                                 0.92387953251128675613,
                                 0.83146961230254523708,
                                 0.70710678118654752440,
                                 0.55557023301960222474,
                                 0.38268343236508977173,
                                 0.19509032201612826785,
                                 0};
  const int quarter = k / 8, part = k % 8;
  const double c = kCosine[part], s = kCosine[8 - part];
  switch (quarter) {
    case 0:
      return {c, 0, -s};
    case 1:
      return {-s, 0, -c};
    case 2:
      return {-c, 0, s};
    default:
      return {s, 0, c};
  }
}

struct FrustumOutline {
  const Frustum f;
  const Transform& pose;
  const std::uint32_t names;
  Mat3 turn{};
  Vec3 local{}, towards{};  // the direction; its part across the axis, unit
  double across = 0, sideOut = 0, sideUp = 0;

  FrustumOutline(const Shape& shape, const Transform& place, Vec3 direction, std::uint32_t name)
      : f(frustumOf(shape)), pose(place), names(name), turn(toMatrix(place.rotation)) {
    local = transposeTimes(turn, direction);
    across = std::sqrt(local.x * local.x + local.z * local.z);
    towards = across > 0 ? Vec3{local.x / across, 0, local.z / across} : Vec3{1, 0, 0};
    f.sideNormal(sideOut, sideUp);
  }

  Vec3 place(Vec3 onRim, int end) const {
    return turn * (onRim * f.radius(end) + Vec3{0, f.height(end), 0}) + pose.position;
  }
  double alongSide() const { return sideOut * across + sideUp * local.y; }

  Outline cap(int end) const {
    Outline out;
    out.face = true;
    out.normal = turn.column(1) * (end == 1 ? 1.0 : -1.0);
    out.wanders = !(across < kFlushCap);
    const Vec3 beside{towards.z, 0, -towards.x};  // a quarter turn counter-clockwise
    const Vec3 lowest[4] = {towards, towards * kCosineBeside + beside * kSineBeside, -towards,
                            towards * kCosineBeside - beside * kSineBeside};
    const int count = out.wanders ? 4 : kRimPoints;
    for (int i = 0; i < count; i++) {
      const int k = end == 1 ? i : count - 1 - i;
      if (out.wanders)
        out.add(place(lowest[k], end), names | std::uint32_t(kLowestOnRim + 4 * end + k));
      else
        out.add(place(rimDirection(k), end), names | std::uint32_t(kRimPoints * end + k));
    }
    return out;
  }
  Outline side() const {
    Outline out;
    out.wanders = true;
    for (int end = 0; end < 2; end++) out.add(place(towards, end), names | std::uint32_t(kEndOfSide + end));
    return out;
  }
  Outline outline() const {
    const int end = local.y > 0 ? 1 : 0;
    return f.radius(end) > 0 && std::fabs(local.y) > alongSide() ? cap(end) : side();
  }
};

Outline capsuleLine(const Shape& shape, const Transform& pose, std::uint32_t names) {
  Outline out;
  out.wanders = true;
  out.radius = shape.radius;
  const Vec3 half = rotate(pose.rotation, Vec3{0, shape.halfHeight, 0});
  out.add(pose.position - half, names | std::uint32_t(kEndOfSide));
  out.add(pose.position + half, names | std::uint32_t(kEndOfSide + 1));
  return out;
}

int faceTowards(const HullView& hull, Vec3 direction) {
  int best = 0;
  for (int f = 1; f < hull.faceCount; f++)
    if (dot(hull.planes[f].normal, direction) > dot(hull.planes[best].normal, direction) + 1e-9) best = f;
  return best;
}

// Of the face that looks along the direction most, the edge that reaches furthest among those across it.
Outline edgeAcross(const HullView& hull, Vec3 direction, std::uint32_t names) {
  Outline out;
  double furthest = -1e300;
  const int start = hull.firstEdge[faceTowards(hull, direction)];
  int e = start;
  do {
    const int from = hull.edges[e].origin, next = hull.edges[e].next, to = hull.edges[next].origin;
    const Vec3 a = hull.vertices[from], b = hull.vertices[to];
    const double reach = dot(a + b, direction);
    if (std::fabs(dot(b - a, direction)) < kAcross * length(b - a) && reach > furthest) {
      furthest = reach, out.count = 0;
      out.add(a, names | std::uint32_t(from)), out.add(b, names | std::uint32_t(to));
    }
    e = next;
  } while (e != start);
  return out;
}

}  // namespace

Outline outlineOf(const Shape& shape, const Transform& pose, Vec3 direction, std::uint32_t names) {
  if (isFrustum(shape.type)) return FrustumOutline(shape, pose, direction, names).outline();
  if (shape.type == ShapeType::capsule) return capsuleLine(shape, pose, names);
  HullStorage storage;
  const HullView hull = viewOf(shape, pose, storage);
  Outline out;
  const int face = faceTowards(hull, direction);
  out.face = true;
  out.normal = hull.planes[face].normal;
  int e = hull.firstEdge[face];
  do {
    out.add(hull.vertices[hull.edges[e].origin], names | hull.edges[e].origin);
    e = hull.edges[e].next;
  } while (e != hull.firstEdge[face]);
  return out;
}

Outline lineOf(const Shape& shape, const Transform& pose, Vec3 direction, std::uint32_t names) {
  if (isFrustum(shape.type)) {
    const FrustumOutline round(shape, pose, direction, names);
    return 1 - round.alongSide() < 0.5 * kAcross * kAcross ? round.side() : Outline{};
  }
  if (shape.type == ShapeType::capsule) {
    const Vec3 axis = rotate(pose.rotation, Vec3{0, 1, 0});
    return std::fabs(dot(axis, direction)) < kAcross ? capsuleLine(shape, pose, names) : Outline{};
  }
  HullStorage storage;
  return edgeAcross(viewOf(shape, pose, storage), direction, names);
}

void cutToSide(Outline& outline, Vec3 outward, double offset, double slack, std::uint32_t name) {
  OutlineCorner kept[Outline::kMost];
  int count = 0;
  for (int i = 0; i < outline.count && count < Outline::kMost - 1; i++) {
    const OutlineCorner& c = outline.corner[i];
    const bool last = i + 1 == outline.count;
    const double above = dot(outward, c.p) - offset;
    if (above <= slack) kept[count++] = c;
    if (last && outline.count <= 2) break;  // a line ends
    const OutlineCorner& next = outline.corner[last ? 0 : i + 1];
    const double nextAbove = dot(outward, next.p) - offset;
    if ((above <= slack) == (nextAbove <= slack)) continue;
    double f = above / (above - nextAbove);
    f = f < 0 ? 0 : f > 1 ? 1 : f;
    const std::uint32_t low = c.feature < next.feature ? c.feature : next.feature,
                        high = c.feature < next.feature ? next.feature : c.feature;
    const std::uint32_t mixed = (low * 2654435761u) ^ (high * 40503u) ^ (name * 2246822519u);
    kept[count++] = {c.p + (next.p - c.p) * f, 0x30000000u | (mixed & 0x0fffffffu)};
  }
  for (int i = 0; i < count; i++) outline.corner[i] = kept[i];
  outline.count = count;
}

void cutToFace(Outline& outline, const Outline& face, double slack) {
  for (int i = 0; i < face.count && outline.count > 0; i++) {
    const OutlineCorner &a = face.corner[i], &b = face.corner[i + 1 == face.count ? 0 : i + 1];
    const Vec3 outward = normalized(cross(b.p - a.p, face.normal));
    cutToSide(outline, outward, dot(outward, a.p), slack, a.feature);
  }
}

}  // namespace brickfall
