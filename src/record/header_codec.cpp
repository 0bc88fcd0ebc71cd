#include "record/header_codec.h"

#include <cmath>

#include "brickfall/geometry/mesh_tree.h"

namespace brickfall {
namespace {

// The least bytes each of these takes, so that a count can be checked before room is made for it.
constexpr std::size_t kLeastShapeBytes = 1 + 7 * 8, kLeastBodyBytes = 1 + 1 + 3 + 8 + 1, kLeastCameraBytes = 1 + 7 * 8;
constexpr double kMostSize = 1e9;  // m

Error bad(ErrorCode code, const std::string& what) { return {code, what}; }

std::string bodyText(const TakeHeader& header, std::size_t k) {
  return "body " + std::to_string(k) + " \"" + header.bodies[k].name + "\"";
}

bool inRange(double v) { return std::fabs(v) <= kMostSize; }
bool inRange(Vec3 v) { return inRange(v.x) && inRange(v.y) && inRange(v.z); }
bool isUnit(Quat q) { return std::fabs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) <= 1e-3; }

// Empty: fine. Only the fields of the shape's type are looked at, as everywhere.
std::string shapeFault(const ShapeDef& shape) {
  if (!inRange(shape.local.position)) return "local position is not a finite number of metres";
  if (!isUnit(shape.local.rotation)) return "local rotation is not a unit quaternion";
  auto positive = [](double v) { return v > 0 && v <= kMostSize; };
  switch (shape.type) {
    case ShapeType::box:
      if (!positive(shape.halfExtents.x) || !positive(shape.halfExtents.y) || !positive(shape.halfExtents.z)) {
        return "halfExtents are not all positive";
      }
      return {};
    case ShapeType::capsule:
      if (!positive(shape.halfHeight)) return "halfHeight is not positive";
      [[fallthrough]];
    case ShapeType::sphere:
      return positive(shape.radius) ? std::string() : "radius is not positive";
    case ShapeType::hull:
      if (shape.vertices.size() < 4 || shape.vertices.size() > std::size_t(kMaxHullVertices)) {
        return "a hull of " + std::to_string(shape.vertices.size()) + " vertices, expected 4 to " +
               std::to_string(kMaxHullVertices);
      }
      for (Vec3 v : shape.vertices) {
        if (!inRange(v)) return "a hull vertex is not finite";
      }
      return {};
    case ShapeType::plane:
      return {};
    case ShapeType::mesh:
      return shape.mesh ? std::string() : "a mesh without sound triangles";
  }
  return "unknown shape type " + std::to_string(int(shape.type));
}

std::string headerFault(const TakeHeader& header) {
  if (!(header.framesPerSecond > 0 && header.framesPerSecond <= 1e6)) {
    return "framesPerSecond is " + std::to_string(header.framesPerSecond) + ", expected a number above 0, at most 1e6";
  }
  for (std::size_t k = 0; k < header.bodies.size(); k++) {
    const TakeBody& body = header.bodies[k];
    if (int(body.role) >= kBodyRoleCount) return bodyText(header, k) + ": unknown role";
    if (!(body.mass >= 0 && body.mass <= 1e15)) return bodyText(header, k) + ": mass is not 0 or a positive number";
    for (const ShapeDef& shape : body.shapes) {
      if (std::string fault = shapeFault(shape); !fault.empty()) return bodyText(header, k) + ": " + fault;
    }
  }
  for (const Camera& camera : header.cameras) {
    if (!inRange(camera.position) || !inRange(camera.target)) {
      return "camera \"" + camera.name + "\": position or target is not finite";
    }
    if (!(camera.fieldOfViewDegrees > 0 && camera.fieldOfViewDegrees < 180)) {
      return "camera \"" + camera.name + "\": fieldOfViewDegrees is not between 0 and 180";
    }
  }
  return {};
}

void put(ByteWriter& out, Vec3 v) {
  out.f64(v.x);
  out.f64(v.y);
  out.f64(v.z);
}

Vec3 getVec3(ByteReader& in) {
  Vec3 v;
  for (int k = 0; k < 3; k++) v[k] = in.f64();
  return v;
}

static_assert(kShapeTypeCount == 6, "a new shape: put() and getShape(), and docs/take-format.md");
void put(ByteWriter& out, const ShapeDef& shape) {
  out.u8(std::uint8_t(shape.type));
  put(out, shape.local.position);
  out.f64(shape.local.rotation.x);
  out.f64(shape.local.rotation.y);
  out.f64(shape.local.rotation.z);
  out.f64(shape.local.rotation.w);
  if (shape.type == ShapeType::box) put(out, shape.halfExtents);
  if (shape.type == ShapeType::sphere || shape.type == ShapeType::capsule) out.f64(shape.radius);
  if (shape.type == ShapeType::capsule) out.f64(shape.halfHeight);
  if (shape.type == ShapeType::hull) {
    out.varint(shape.vertices.size());
    for (Vec3 v : shape.vertices) put(out, v);
  }
  if (shape.type == ShapeType::mesh) {
    const TriangleMesh& mesh = shape.mesh->mesh();
    out.varint(mesh.vertices().size());
    for (Vec3 v : mesh.vertices()) put(out, v);
    out.varint(mesh.count());
    for (const TriangleMesh::Face& face : mesh.faces())
      for (std::uint32_t vertex : face.vertex) out.varint(vertex);
  }
}

// Null if the triangles make no mesh; headerFault() tells.
std::shared_ptr<const MeshTree> getMesh(ByteReader& in, bool& sound) {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> indices;
  std::uint64_t count = in.varint();
  sound = sound && in.canHold(count, 24);
  for (std::uint64_t k = 0; sound && k < count; k++) vertices.push_back(getVec3(in));
  std::uint64_t faces = sound ? in.varint() : 0;
  sound = sound && in.canHold(faces, 3);
  for (std::uint64_t k = 0; sound && k < 3 * faces; k++) {
    std::uint64_t vertex = in.varint();
    indices.push_back(vertex < count ? std::uint32_t(vertex) : kNoTriangle);
  }
  if (!sound || in.failed()) return nullptr;
  Result<TriangleMesh> mesh = TriangleMesh::create(vertices, indices);
  return mesh ? std::make_shared<MeshTree>(MeshTree::build(std::move(mesh).value())) : nullptr;
}

ShapeDef getShape(ByteReader& in, bool& sound) {
  ShapeDef shape;
  shape.type = ShapeType(in.u8());
  shape.local.position = getVec3(in);
  shape.local.rotation.x = in.f64();
  shape.local.rotation.y = in.f64();
  shape.local.rotation.z = in.f64();
  shape.local.rotation.w = in.f64();
  if (shape.type == ShapeType::box) shape.halfExtents = getVec3(in);
  if (shape.type == ShapeType::sphere || shape.type == ShapeType::capsule) shape.radius = in.f64();
  if (shape.type == ShapeType::capsule) shape.halfHeight = in.f64();
  if (shape.type == ShapeType::hull) {
    std::uint64_t count = in.varint();
    sound = sound && in.canHold(count, 24);
    for (std::uint64_t k = 0; sound && k < count; k++) shape.vertices.push_back(getVec3(in));
  }
  if (shape.type == ShapeType::mesh) shape.mesh = getMesh(in, sound);
  return shape;
}

TakeBody getBody(ByteReader& in, bool& sound) {
  TakeBody body;
  body.name = in.text();
  body.role = BodyRole(in.u8());
  body.colour = in.u8();
  body.colour |= std::uint32_t(in.u8()) << 8;
  body.colour |= std::uint32_t(in.u8()) << 16;
  body.mass = in.f64();
  std::uint64_t shapes = in.varint();
  sound = sound && in.canHold(shapes, kLeastShapeBytes);
  for (std::uint64_t k = 0; sound && k < shapes; k++) body.shapes.push_back(getShape(in, sound));
  return body;
}

}  // namespace

Status checkHeader(const TakeHeader& header) {
  std::string fault = headerFault(header);
  return fault.empty() ? Status() : bad(ErrorCode::invalidArgument, fault);
}

Bytes encodeHeader(const TakeHeader& header) {
  ByteWriter out;
  out.text(header.scene);
  out.text(header.title);
  out.text(header.engineVersion);
  out.u64(header.seed);
  out.f64(header.framesPerSecond);
  out.varint(header.bodies.size());
  for (const TakeBody& body : header.bodies) {
    out.text(body.name);
    out.u8(std::uint8_t(body.role));
    for (int k = 0; k < 3; k++) out.u8(std::uint8_t(body.colour >> (8 * k)));
    out.f64(body.mass);
    out.varint(body.shapes.size());
    for (const ShapeDef& shape : body.shapes) put(out, shape);
  }
  out.varint(header.cameras.size());
  for (const Camera& camera : header.cameras) {
    out.text(camera.name);
    put(out, camera.position);
    put(out, camera.target);
    out.f64(camera.fieldOfViewDegrees);
  }
  return out.bytes();
}

Result<TakeHeader> decodeHeader(std::span<const std::uint8_t> bytes) {
  ByteReader in(bytes);
  TakeHeader header;
  header.scene = in.text();
  header.title = in.text();
  header.engineVersion = in.text();
  header.seed = in.u64();
  header.framesPerSecond = in.f64();
  bool sound = true;
  std::uint64_t bodies = in.varint();
  if (!in.canHold(bodies, kLeastBodyBytes)) {
    return bad(ErrorCode::badFormat, "header: " + std::to_string(bodies) + " bodies announced, which cannot fit");
  }
  for (std::uint64_t k = 0; sound && !in.failed() && k < bodies; k++) header.bodies.push_back(getBody(in, sound));
  std::uint64_t cameras = sound ? in.varint() : 0;
  sound = sound && in.canHold(cameras, kLeastCameraBytes);
  for (std::uint64_t k = 0; sound && k < cameras; k++) {
    Camera camera;
    camera.name = in.text();
    camera.position = getVec3(in);
    camera.target = getVec3(in);
    camera.fieldOfViewDegrees = in.f64();
    header.cameras.push_back(std::move(camera));
  }
  if (!sound || in.failed() || in.left() != 0) {
    return bad(ErrorCode::badFormat, "header: its lengths do not add up");
  }
  if (std::string fault = headerFault(header); !fault.empty()) return bad(ErrorCode::badFormat, "header: " + fault);
  return header;
}

}  // namespace brickfall
