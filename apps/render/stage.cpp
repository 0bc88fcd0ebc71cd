// The only file that sees Embree.
#include "render/stage.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <string>

#include "appearance/draw_mesh.h"

namespace brickfall::render {

namespace {

constexpr RoundDetail kRound{64, 128};  // the outline of a ball is 0.03 % off
// A ray starts so far from where it last was, or it would meet the same place again.
constexpr float kNear = 2e-4f;  // m

Vec3f toFloat(Vec3 v) { return {float(v.x), float(v.y), float(v.z)}; }
Mat3f toFloat(const Mat3& m) { return {{toFloat(m.row[0]), toFloat(m.row[1]), toFloat(m.row[2])}}; }

// Equal shapes have equal keys.
static_assert(kShapeTypeCount == 8, "a new shape: what tells two of its kind apart");
std::string keyOf(const ShapeDef& shape) {
  std::string key(1, char(shape.type));
  const auto add = [&](const void* bytes, std::size_t size) { key.append(static_cast<const char*>(bytes), size); };
  if (shape.type == ShapeType::box) add(&shape.halfExtents, sizeof shape.halfExtents);
  const bool cone = shape.type == ShapeType::cone;
  const bool high = shape.type == ShapeType::capsule || shape.type == ShapeType::cylinder || cone;
  if (shape.type == ShapeType::sphere || high) add(&shape.radius, sizeof shape.radius);
  if (high) add(&shape.halfHeight, sizeof shape.halfHeight);
  if (cone) add(&shape.topRadius, sizeof shape.topRadius);
  for (const Vec3& v : shape.type == ShapeType::hull ? shape.vertices : std::vector<Vec3>()) add(&v, sizeof v);
  const MeshTree* mesh = shape.mesh.get();
  if (shape.type == ShapeType::mesh) add(&mesh, sizeof mesh);
  return key;
}

struct Shape {
  ShapeMesh mesh;
  RTCScene scene = nullptr;
};

struct Placed {  // what there is of a part besides Part
  std::size_t shape = 0;
  Transform local;                 // in the body's frame
  RTCGeometry instance = nullptr;  // none of a plane
  bool shown = false;
  Transform open, close;  // of the last picture
  double radius = 0;      // m, about the shape's origin
};

struct Plane {  // the half space below it is solid
  std::size_t part = 0;
  Vec3f normal;
  float height = 0;  // m, along the normal
  bool shown = false;
};

void setTransform(RTCGeometry instance, unsigned step, const Transform& pose) {
  const Mat3 m = toMatrix(pose.rotation);
  float columns[12];
  for (int k = 0; k < 3; k++) {
    const Vec3 c = m.column(k);
    columns[3 * k] = float(c.x);
    columns[3 * k + 1] = float(c.y);
    columns[3 * k + 2] = float(c.z);
  }
  columns[9] = float(pose.position.x);
  columns[10] = float(pose.position.y);
  columns[11] = float(pose.position.z);
  rtcSetGeometryTransform(instance, step, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns);
}

RTCRay toEmbree(const Ray& ray) {
  RTCRay out;
  out.org_x = ray.origin.x;
  out.org_y = ray.origin.y;
  out.org_z = ray.origin.z;
  out.tnear = kNear;
  out.dir_x = ray.direction.x;
  out.dir_y = ray.direction.y;
  out.dir_z = ray.direction.z;
  out.time = ray.time;
  out.tfar = ray.far;
  out.mask = 0xffffffffu;
  out.id = 0;
  out.flags = 0;
  return out;
}

}  // namespace

struct Stage::Impl {
  RTCDevice device = nullptr;
  RTCScene scene = nullptr;
  std::vector<Shape> shapes;
  std::map<std::string, std::size_t> shapeByKey;
  std::vector<Part> parts;     // by number: also that of the instance in Embree's scene
  std::vector<Placed> placed;  // by part
  std::vector<Plane> planes;
  bool built = false;
  Vec3f low, high;  // of all but planes

  // The scene is built by one thread, so that what it finds does not depend on their number.
  Impl() : device(rtcNewDevice("threads=1,set_affinity=0")), scene(rtcNewScene(device)) {
    rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_MEDIUM);
  }
  ~Impl() {
    for (const Placed& one : placed)
      if (one.instance) rtcReleaseGeometry(one.instance);
    for (const Shape& shape : shapes) rtcReleaseScene(shape.scene);
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  Result<std::size_t> shapeOf(const ShapeDef& def);
  Status add(const TakeBody& body, std::size_t shape, std::uint32_t number);
  void findBounds();
  bool passesBounds(const Ray& ray) const;
  int nearestPlane(const Ray& ray, float& distance) const;  // -1 = none nearer than `distance`, which it shortens
  void finishPlane(const Ray& ray, int plane, Hit& hit) const;
  void finish(const RTCHit& found, const Ray& ray, Hit& hit) const;
};

Result<std::size_t> Stage::Impl::shapeOf(const ShapeDef& def) {
  const auto [known, added] = shapeByKey.try_emplace(keyOf(def), shapes.size());
  if (!added) return known->second;
  Result<ShapeMesh> mesh = appearance::makeDrawMesh(def, kRound);
  if (!mesh) return mesh.error();
  shapes.push_back({std::move(mesh).value(), rtcNewScene(device)});
  Shape& shape = shapes.back();
  const RTCGeometry triangles = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  void* positions =
      rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, shape.mesh.positions.size());
  std::memcpy(positions, shape.mesh.positions.data(), 12 * shape.mesh.positions.size());
  void* indices =
      rtcSetNewGeometryBuffer(triangles, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, shape.mesh.indices.size() / 3);
  std::memcpy(indices, shape.mesh.indices.data(), 4 * shape.mesh.indices.size());
  rtcCommitGeometry(triangles);
  rtcAttachGeometry(shape.scene, triangles);
  rtcReleaseGeometry(triangles);
  rtcSetSceneBuildQuality(shape.scene, RTC_BUILD_QUALITY_HIGH);  // once, and used by many
  rtcCommitScene(shape.scene);
  return known->second;
}

Status Stage::Impl::add(const TakeBody& body, std::size_t shape, std::uint32_t number) {
  const ShapeDef& def = body.shapes[shape];
  Part part;
  part.body = number;
  part.look = appearance::lookOf(body, shape, number);
  if (def.type == ShapeType::box) part.halfExtents = toFloat(def.halfExtents);
  Placed one;
  one.local = def.local;
  if (def.type == ShapeType::plane) {
    part.radius = kNoEnd;
    planes.push_back({parts.size(), {}, 0, false});
  } else {
    Result<std::size_t> known = shapeOf(def);
    if (!known) return Error{known.error().code, "body \"" + body.name + "\": " + known.error().message};
    one.shape = *known;
    for (const auto& p : shapes[*known].mesh.positions)
      one.radius = std::max(one.radius, double(std::hypot(p[0], p[1], p[2])));
    part.radius = float(one.radius);
    one.instance = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(one.instance, shapes[one.shape].scene);
  }
  parts.push_back(part);
  placed.push_back(one);
  return {};
}

Stage::Stage(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Stage::Stage(Stage&&) noexcept = default;
Stage& Stage::operator=(Stage&&) noexcept = default;
Stage::~Stage() = default;
const std::vector<Part>& Stage::parts() const { return impl_->parts; }

Result<Stage> Stage::create(const TakeReader& take) {
  auto impl = std::make_unique<Impl>();
  for (std::uint32_t body = 0; body < take.bodies().size(); body++)
    for (std::size_t shape = 0; shape < take.bodies()[body].shapes.size(); shape++)
      if (Status added = impl->add(take.bodies()[body], shape, body); !added) return added.error();
  return Stage(std::move(impl));
}

namespace {

constexpr float kStill = 2e-5f;  // m: what moves less is drawn where it is

float sweepOf(const Transform& open, const Transform& close, double radius) {
  const Quat turn = conjugate(open.rotation) * close.rotation;
  const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
  return float(length(close.position - open.position) + 2 * std::min(sine, 1.0) * radius);
}

bool same(const Transform& a, const Transform& b) { return a.position == b.position && a.rotation == b.rotation; }

}  // namespace

// What did not change since the last picture stays as it is; if nothing did, nothing is built.
bool Stage::place(const Motion::Shutter& shutter) {
  Impl& s = *impl_;
  bool changed = false, elsewhere = !s.built;
  for (std::size_t k = 0; k < s.parts.size(); k++) {
    Part& part = s.parts[k];
    Placed& one = s.placed[k];
    const bool there = shutter.open.there[part.body];
    elsewhere = elsewhere || there != one.shown;
    if (!there) {
      if (one.shown && one.instance) {
        rtcDetachGeometry(s.scene, unsigned(k));
        changed = true;
      }
      one.shown = false;
      part.moves = false;  // or it would count as motion in all pictures to come
      part.sweep = 0;
      continue;
    }
    const Transform open = shutter.open.poses[part.body] * one.local,
                    close = shutter.close.poses[part.body] * one.local;
    if (one.shown && same(open, one.open) && same(close, one.close)) continue;
    elsewhere = true;
    one.open = open;
    one.close = close;
    part.sweep = sweepOf(open, close, one.radius);
    part.moves = part.sweep > kStill;
    part.open = toFloat(toMatrix(open.rotation));
    part.close = toFloat(toMatrix(close.rotation));
    part.origin = toFloat(open.position);
    if (one.instance) {
      rtcSetGeometryTimeStepCount(one.instance, part.moves ? 2 : 1);
      setTransform(one.instance, 0, open);
      if (part.moves) setTransform(one.instance, 1, close);
      rtcCommitGeometry(one.instance);
      if (!one.shown) rtcAttachGeometryByID(s.scene, one.instance, unsigned(k));
      changed = true;
    }
    one.shown = true;
  }
  for (Plane& plane : s.planes) {
    plane.normal = s.parts[plane.part].open * Vec3f{0, 1, 0};
    plane.height = dot(s.parts[plane.part].origin, plane.normal);
    plane.shown = s.placed[plane.part].shown;
  }
  if (changed || !s.built) {
    s.findBounds();
    rtcCommitScene(s.scene);
  }
  s.built = true;
  return elsewhere;
}

void Stage::Impl::findBounds() {
  low = {1e30f, 1e30f, 1e30f};
  high = -low;
  for (const Placed& one : placed) {
    if (!one.instance || !one.shown) continue;
    const float radius = float(one.radius) * 1.0001f + 1e-4f;
    const Vec3f reach{radius, radius, radius};
    for (const Transform* pose : {&one.open, &one.close}) {
      low = min(low, toFloat(pose->position) - reach);
      high = max(high, toFloat(pose->position) + reach);
    }
  }
}

// Most rays from the ground meet nothing: this tells at a tenth of the time.
bool Stage::Impl::passesBounds(const Ray& ray) const {
  float from = 0, to = ray.far;
  for (int k = 0; k < 3; k++) {
    // Not infinite, or on the bound itself 0 times it would be no number.
    const float inverse = std::fabs(ray.direction[k]) > 1e-30f ? 1 / ray.direction[k] : 1e30f;
    const float a = (low[k] - ray.origin[k]) * inverse, b = (high[k] - ray.origin[k]) * inverse;
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return !(from > to);
}

// Planes first: they cost next to nothing, and what lies behind them need not be looked for.
int Stage::Impl::nearestPlane(const Ray& ray, float& distance) const {
  int found = -1;
  for (const Plane& plane : planes) {
    const float towards = dot(ray.direction, plane.normal);
    if (towards > -1e-6f || !plane.shown) continue;  // seen from above only
    const float at = (plane.height - dot(ray.origin, plane.normal)) / towards;
    if (at > kNear && at < distance) {
      distance = at;
      found = int(plane.part);
    }
  }
  return found;
}

void Stage::Impl::finishPlane(const Ray& ray, int plane, Hit& hit) const {
  const Part& part = parts[std::size_t(plane)];
  hit.part = plane;
  hit.normal = part.open * Vec3f{0, 1, 0};
  hit.localNormal = {0, 1, 0};
  hit.local = transposeTimes(part.open, ray.origin + ray.direction * hit.distance - part.origin);
}

void Stage::Impl::finish(const RTCHit& found, const Ray& ray, Hit& hit) const {
  hit.part = int(found.instID[0]);
  const Part& part = parts[found.instID[0]];
  const ShapeMesh& mesh = shapes[placed[found.instID[0]].shape].mesh;
  const float weights[3] = {1 - found.u - found.v, found.u, found.v};
  hit.local = hit.localNormal = {};
  for (int k = 0; k < 3; k++) {
    const std::uint32_t vertex = mesh.indices[3 * std::size_t(found.primID) + std::size_t(k)];
    const auto &p = mesh.positions[vertex], &n = mesh.normals[vertex];
    hit.local += Vec3f{p[0], p[1], p[2]} * weights[k];
    hit.localNormal += Vec3f{n[0], n[1], n[2]} * weights[k];
  }
  hit.localNormal = normalized(hit.localNormal);
  hit.normal = part.toWorld(normalized(Vec3f{found.Ng_x, found.Ng_y, found.Ng_z}), ray.time);
  if (dot(hit.normal, ray.direction) > 0) {  // the back of a surface
    hit.normal = -hit.normal;
    hit.localNormal = -hit.localNormal;
  }
}

Hit Stage::firstHit(const Ray& ray) const {
  Hit hit;
  hit.distance = ray.far;
  const int plane = impl_->nearestPlane(ray, hit.distance);
  if (!impl_->passesBounds(ray)) {
    if (plane >= 0) impl_->finishPlane(ray, plane, hit);
    return hit;
  }
  RTCRayHit query;
  query.ray = toEmbree(ray);
  query.ray.tfar = hit.distance;
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID != RTC_INVALID_GEOMETRY_ID) {
    hit.distance = query.ray.tfar;
    impl_->finish(query.hit, ray, hit);
  } else if (plane >= 0) {
    impl_->finishPlane(ray, plane, hit);
  }
  return hit;
}

bool Stage::isBlocked(const Ray& ray) const {
  float far = ray.far;
  if (impl_->nearestPlane(ray, far) >= 0) return true;
  if (!impl_->passesBounds(ray)) return false;
  RTCRay query = toEmbree(ray);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(impl_->scene, &context, &query);
  return query.tfar < 0;
}

}  // namespace brickfall::render
