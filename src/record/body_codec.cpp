#include "record/body_codec.h"

#include <cmath>

#include "brickfall/geometry/mesh_tree.h"

namespace brickfall {
namespace {

constexpr std::size_t kLeastShapeBytes = 1 + 7 * 8;

Error bad(std::string what) { return {ErrorCode::badFormat, std::move(what)}; }

bool isUnit(Quat q) { return std::fabs(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w - 1) <= 1e-3; }

// Empty: fine. Only the fields of the shape's type are looked at, as everywhere.
std::string shapeFault(const ShapeDef& shape) {
  if (!withinTakeSize(shape.local.position)) return "local position is not a finite number of metres";
  if (!isUnit(shape.local.rotation)) return "local rotation is not a unit quaternion";
  auto positive = [](double v) { return v > 0 && v <= kMostTakeSize; };
  switch (shape.type) {
    case ShapeType::box:
      if (!positive(shape.halfExtents.x) || !positive(shape.halfExtents.y) || !positive(shape.halfExtents.z)) {
        return "halfExtents are not all positive";
      }
      return {};
    case ShapeType::cone:
      if (!(shape.topRadius >= 0 && shape.topRadius <= kMostTakeSize)) return "topRadius is not 0 or positive";
      [[fallthrough]];
    case ShapeType::cylinder:
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
        if (!withinTakeSize(v)) return "a hull vertex is not finite";
      }
      return {};
    case ShapeType::plane:
      return {};
    case ShapeType::mesh:
      return shape.mesh ? std::string() : "a mesh without sound triangles";
  }
  return "unknown shape type " + std::to_string(int(shape.type));
}

static_assert(kShapeTypeCount == 8, "a new shape: put() and getShape(), and docs/take-format.md");

bool hasHeight(ShapeType type) {
  return type == ShapeType::capsule || type == ShapeType::cylinder || type == ShapeType::cone;
}

bool hasRadius(ShapeType type) { return type == ShapeType::sphere || hasHeight(type); }

void put(ByteWriter& out, const ShapeDef& shape) {
  out.u8(std::uint8_t(shape.type));
  put(out, shape.local.position);
  out.f64(shape.local.rotation.x);
  out.f64(shape.local.rotation.y);
  out.f64(shape.local.rotation.z);
  out.f64(shape.local.rotation.w);
  if (shape.type == ShapeType::box) put(out, shape.halfExtents);
  if (hasRadius(shape.type)) out.f64(shape.radius);
  if (hasHeight(shape.type)) out.f64(shape.halfHeight);
  if (shape.type == ShapeType::cone) out.f64(shape.topRadius);
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
  if (hasRadius(shape.type)) shape.radius = in.f64();
  if (hasHeight(shape.type)) shape.halfHeight = in.f64();
  if (shape.type == ShapeType::cone) shape.topRadius = in.f64();
  if (shape.type == ShapeType::hull) {
    std::uint64_t count = in.varint();
    sound = sound && in.canHold(count, 24);
    for (std::uint64_t k = 0; sound && k < count; k++) shape.vertices.push_back(getVec3(in));
  }
  if (shape.type == ShapeType::mesh) shape.mesh = getMesh(in, sound);
  return shape;
}

}  // namespace

bool withinTakeSize(Vec3 v) {
  return std::fabs(v.x) <= kMostTakeSize && std::fabs(v.y) <= kMostTakeSize && std::fabs(v.z) <= kMostTakeSize;
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

std::string bodyFault(const TakeBody& body) {
  if (int(body.role) >= kBodyRoleCount) return "unknown role";
  if (!(body.mass >= 0 && body.mass <= 1e15)) return "mass is not 0 or a positive number";
  for (const ShapeDef& shape : body.shapes)
    if (std::string fault = shapeFault(shape); !fault.empty()) return fault;
  if (!body.shapeMaterials.empty() && body.shapeMaterials.size() != body.shapes.size())
    return std::to_string(body.shapeMaterials.size()) + " shapeMaterials, expected none or one for each of its " +
           std::to_string(body.shapes.size()) + " shapes";
  if (!body.shapeColours.empty() && body.shapeColours.size() != body.shapes.size())
    return std::to_string(body.shapeColours.size()) + " shapeColours, expected none or one for each of its " +
           std::to_string(body.shapes.size()) + " shapes";
  return {};
}

namespace {

constexpr std::uint64_t kColourBytes = 3;

void putColour(ByteWriter& out, std::uint32_t colour) {
  for (int k = 0; k < 3; k++) out.u8(std::uint8_t(colour >> (8 * k)));
}

std::uint32_t getColour(ByteReader& in) {
  std::uint32_t colour = 0;
  for (int k = 0; k < 3; k++) colour |= std::uint32_t(in.u8()) << (8 * k);
  return colour;
}

}  // namespace

void put(ByteWriter& out, const TakeBody& body) {
  out.text(body.name);
  out.u8(std::uint8_t(body.role));
  putColour(out, body.colour);
  out.f64(body.mass);
  out.varint(body.shapes.size());
  for (const ShapeDef& shape : body.shapes) put(out, shape);
  out.text(body.material);
  out.varint(body.shapeMaterials.size());
  for (const std::string& material : body.shapeMaterials) out.text(material);
  out.varint(body.look ? std::uint64_t(*body.look) + 1 : 0);
  out.varint(body.shapeColours.size());
  for (std::uint32_t colour : body.shapeColours) putColour(out, colour);
}

TakeBody getBody(ByteReader& in, std::uint32_t version, bool& sound) {
  TakeBody body;
  body.name = in.text();
  body.role = BodyRole(in.u8());
  body.colour = getColour(in);
  body.mass = in.f64();
  std::uint64_t shapes = in.varint();
  sound = sound && in.canHold(shapes, kLeastShapeBytes);
  for (std::uint64_t k = 0; sound && k < shapes; k++) body.shapes.push_back(getShape(in, sound));
  if (!sound || version < kVersion3) return body;
  body.material = in.text();
  std::uint64_t materials = in.varint();
  sound = in.canHold(materials, 1);
  for (std::uint64_t k = 0; sound && k < materials; k++) body.shapeMaterials.push_back(in.text());
  const std::uint64_t look = sound && version >= kVersion5 ? in.varint() : 0;
  sound = sound && look <= std::uint64_t(UINT32_MAX) + 1;
  if (look > 0) body.look = std::uint32_t(look - 1);
  const std::uint64_t colours = sound && version >= kVersion7 ? in.varint() : 0;
  sound = sound && in.canHold(colours, kColourBytes);
  for (std::uint64_t k = 0; sound && k < colours; k++) body.shapeColours.push_back(getColour(in));
  return body;
}

std::string mortarFault(const TakeMortar& mortar, std::size_t bodies) {
  if (mortar.bodyA >= bodies || mortar.bodyB >= bodies || mortar.bodyA == mortar.bodyB)
    return "a joint of bodies " + std::to_string(mortar.bodyA) + " and " + std::to_string(mortar.bodyB) +
           ", expected two below " + std::to_string(bodies);
  for (Vec3 v : {mortar.centre, mortar.along1, mortar.along2})
    if (!withinTakeSize(v)) return "a joint's place is not a finite number of metres";
  return {};
}

namespace {

void put(ByteWriter& out, const TakeMortar& mortar) {
  out.varint(mortar.bodyA);
  out.varint(mortar.bodyB);
  for (Vec3 v : {mortar.centre, mortar.along1, mortar.along2})
    for (int k = 0; k < 3; k++) out.f32(float(v[k]));
}

TakeMortar getMortar(ByteReader& in, bool& sound) {
  const std::uint64_t a = in.varint(), b = in.varint();
  sound = sound && a <= UINT32_MAX && b <= UINT32_MAX;
  TakeMortar mortar{std::uint32_t(a), std::uint32_t(b), {}, {}, {}};
  for (Vec3* v : {&mortar.centre, &mortar.along1, &mortar.along2})
    for (int k = 0; k < 3; k++) (*v)[k] = double(in.f32());
  return mortar;
}

void putNumbers(ByteWriter& out, const std::vector<std::uint32_t>& numbers) {
  out.varint(numbers.size());
  std::uint32_t last = 0;
  for (std::uint32_t number : numbers) {
    out.varint(number - last);
    last = number;
  }
}

// Ascending; the message says what ends (`noun`).
Status getNumbers(ByteReader& in, const std::string& noun, std::vector<std::uint32_t>& numbers) {
  const std::uint64_t count = in.varint();
  if (!in.canHold(count, 1)) return bad(std::to_string(count) + " ends announced, which cannot fit");
  std::uint64_t number = 0;
  for (std::uint64_t k = 0; !in.failed() && k < count; k++) {
    const std::uint64_t step = in.varint();
    if (k > 0 && step == 0) return bad(noun + " ends twice");
    if (step > UINT32_MAX || number + step > UINT32_MAX) return bad(noun + " ends that never was there");
    number += step;
    numbers.push_back(std::uint32_t(number));
  }
  return {};
}

}  // namespace

Bytes encodeChange(const TakeChange& change) {
  ByteWriter out;
  out.varint(change.births.size());
  for (const TakeBody& body : change.births) put(out, body);
  putNumbers(out, change.ends);
  out.varint(change.mortar.size());
  for (const TakeMortar& mortar : change.mortar) put(out, mortar);
  putNumbers(out, change.mortarEnds);
  return out.bytes();
}

Result<TakeChange> decodeChange(std::span<const std::uint8_t> bytes, std::uint32_t version) {
  ByteReader in(bytes);
  TakeChange change;
  bool sound = true;
  std::uint64_t births = in.varint();
  if (!in.canHold(births, kLeastBodyBytes)) return bad(std::to_string(births) + " bodies announced, which cannot fit");
  for (std::uint64_t k = 0; sound && !in.failed() && k < births; k++) {
    change.births.push_back(getBody(in, version, sound));
    if (!sound || in.failed()) break;
    if (std::string fault = bodyFault(change.births.back()); !fault.empty())
      return bad("body \"" + change.births.back().name + "\": " + fault);
  }
  if (sound)
    if (Status ended = getNumbers(in, "a body", change.ends); !ended) return ended.error();
  if (sound && version >= kVersion4) {
    const std::uint64_t joints = in.varint();
    if (!in.canHold(joints, kLeastMortarBytes))
      return bad(std::to_string(joints) + " joints announced, which cannot fit");
    for (std::uint64_t k = 0; sound && k < joints; k++) change.mortar.push_back(getMortar(in, sound));
    if (Status ended = getNumbers(in, "a joint", change.mortarEnds); !ended) return ended.error();
  }
  if (!sound || in.failed() || in.left() != 0) return bad("its lengths do not add up");
  return change;
}

}  // namespace brickfall
