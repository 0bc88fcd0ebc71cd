// The triangles of a glTF file's scene: nodes with their transforms, meshes, primitives. Skins, morphs and animations are passed
// over: what is read stands still.
#include <cmath>

#include "mesh_file/gltf.h"

namespace brickfall {

namespace gltf {

namespace {

constexpr int kMaxDepth = 256;
constexpr std::size_t kMaxVisits = 100'000, kMaxIndices = 3u << 23, kMaxVertices = 1u << 24;
enum : std::size_t { kTriangles = 4, kStrip = 5, kFan = 6 };

// point -> turn * point + position; turn may scale.
struct Affine {
  Mat3 turn;
  Vec3 position;
};
Affine operator*(const Affine& a, const Affine& b) { return {a.turn * b.turn, a.turn * b.position + a.position}; }

class SceneReader {
 public:
  explicit SceneReader(Document& document) : d_(document) {}

  MeshFileData read() {
    const Json* roots = rootNodes();
    if (roots) {
      for (std::size_t i = 0; i < roots->size() && !d_.failed(); i++) visit((*roots)[i], "scene.nodes", {}, 0);
    } else if (!d_.failed()) {
      readWithoutScene();
    }
    if (!d_.failed() && out_.indices.empty()) d_.fail("scene", "found no triangles, expected at least one");
    return std::move(out_);
  }

 private:
  // Those of the default scene, or of the first; null if there are no scenes.
  const Json* rootNodes() {
    if (!d_.json.contains("scenes")) return nullptr;
    const Json* scene = d_.item("scenes", d_.whole(d_.json, "scene", "", 0, 1u << 30), "scene");
    if (!scene) return nullptr;
    auto nodes = scene->find("nodes");
    if (nodes == scene->end() || !nodes->is_array()) {
      d_.fail("scene.nodes", "not given, expected the nodes of the scene");
      return nullptr;
    }
    return &*nodes;
  }

  // All meshes, each where it is.
  void readWithoutScene() {
    auto meshes = d_.json.find("meshes");
    if (meshes == d_.json.end() || !meshes->is_array()) return;
    for (std::size_t i = 0; i < meshes->size() && !d_.failed(); i++) addMesh(i, at("meshes", i), {});
  }

  Affine placed(const Json& node, const std::string& field) {
    double m[16], t[3] = {0, 0, 0}, r[4] = {0, 0, 0, 1}, s[3] = {1, 1, 1};
    if (d_.numbers(node, "matrix", field, 16, m))
      return {{{{m[0], m[4], m[8]}, {m[1], m[5], m[9]}, {m[2], m[6], m[10]}}}, {m[12], m[13], m[14]}};
    d_.numbers(node, "translation", field, 3, t);
    d_.numbers(node, "rotation", field, 4, r);
    d_.numbers(node, "scale", field, 3, s);
    double square = r[0] * r[0] + r[1] * r[1] + r[2] * r[2] + r[3] * r[3];
    if (!(std::fabs(square - 1) < 0.01)) {
      d_.fail(field + ".rotation", "expected a quaternion of length 1");
      return {};
    }
    Mat3 turn = toMatrix(normalized(Quat{r[0], r[1], r[2], r[3]}));
    return {turn * diagonal(Vec3{s[0], s[1], s[2]}), {t[0], t[1], t[2]}};
  }

  // Nodes make a tree; a file in which they do not is found out by its depth or its number of visits.
  void visit(const Json& number, const std::string& from, const Affine& parent, int depth) {
    if (!number.is_number_unsigned() || depth > kMaxDepth || ++visits_ > kMaxVisits)
      return d_.fail(from, "expected a tree of nodes, named by their numbers");
    std::size_t index = number.get<std::size_t>();
    const Json* node = d_.item("nodes", index, from);
    if (!node) return;
    std::string field = at("nodes", index);
    Affine here = parent * placed(*node, field);
    if (node->contains("mesh") && !d_.failed())
      addMesh(d_.whole(*node, "mesh", field, {}, 1u << 30), field + ".mesh", here);
    auto children = node->find("children");
    if (children == node->end() || d_.failed()) return;
    if (!children->is_array()) return d_.fail(field + ".children", "expected an array");
    for (std::size_t i = 0; i < children->size() && !d_.failed(); i++)
      visit((*children)[i], field + ".children", here, depth + 1);
  }

  void addMesh(std::size_t index, const std::string& from, const Affine& place) {
    if (d_.failed()) return;
    const Json* mesh = d_.item("meshes", index, from);
    if (!mesh) return;
    std::string field = at("meshes", index);
    auto primitives = mesh->find("primitives");
    if (primitives == mesh->end() || !primitives->is_array())
      return d_.fail(field + ".primitives", "expected an array");
    for (std::size_t i = 0; i < primitives->size() && !d_.failed(); i++)
      addPrimitive((*primitives)[i], field + "." + at("primitives", i), place);
  }

  // Points and lines are passed over.
  void addPrimitive(const Json& primitive, const std::string& field, const Affine& place) {
    if (!primitive.is_object()) return d_.fail(field, "expected an object");
    std::size_t mode = d_.whole(primitive, "mode", field, kTriangles, 6);
    if (d_.failed() || mode < kTriangles) return;
    auto attributes = primitive.find("attributes");
    if (attributes == primitive.end() || !attributes->is_object())
      return d_.fail(field + ".attributes", "expected an object");
    std::string where = field + ".attributes.POSITION";
    std::size_t accessor = d_.whole(*attributes, "POSITION", field + ".attributes", {}, 1u << 30);
    if (d_.failed()) return;
    std::vector<Vec3> points = positions(d_, accessor, where);
    std::vector<std::uint32_t> order;
    if (primitive.contains("indices")) {
      std::size_t indices = d_.whole(primitive, "indices", field, {}, 1u << 30);
      if (!d_.failed()) order = wholeNumbers(d_, indices, field + ".indices");
    } else {
      for (std::size_t i = 0; i < points.size(); i++) order.push_back(std::uint32_t(i));
    }
    if (d_.failed()) return;
    for (std::uint32_t i : order)
      if (i >= points.size())
        return d_.fail(field + ".indices", "found " + std::to_string(i) + ", expected less than the " +
                                               std::to_string(points.size()) + " positions");
    if (mode == kTriangles && order.size() % 3 != 0)
      return d_.fail(field + ".indices", "found " + std::to_string(order.size()) + ", expected three a triangle");
    if (out_.vertices.size() + points.size() > kMaxVertices || out_.indices.size() + 3 * order.size() > kMaxIndices)
      return d_.fail(field, "found too many triangles in all");
    append(points, order, mode, place);
  }

  void append(const std::vector<Vec3>& points, const std::vector<std::uint32_t>& order, std::size_t mode,
              const Affine& place) {
    std::uint32_t base = std::uint32_t(out_.vertices.size());
    for (Vec3 p : points) out_.vertices.push_back(place.turn * p + place.position);
    bool mirrored = determinant(place.turn) < 0;  // keeps the front in front
    auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      out_.indices.insert(out_.indices.end(), {base + a, base + (mirrored ? c : b), base + (mirrored ? b : c)});
    };
    std::size_t step = mode == kTriangles ? 3 : 1;
    for (std::size_t i = 0; i + 2 < order.size(); i += step) {
      if (mode == kFan)
        add(order[0], order[i + 1], order[i + 2]);
      else if (mode == kStrip && i % 2 == 1)
        add(order[i + 1], order[i], order[i + 2]);
      else
        add(order[i], order[i + 1], order[i + 2]);
    }
  }

  Document& d_;
  MeshFileData out_;
  std::size_t visits_ = 0;
};

}  // namespace

}  // namespace gltf

Result<MeshFileData> readGltf(std::span<const std::byte> bytes, const std::string& name, const MeshFileOpener& opener) {
  gltf::Document document(name);
  if (!gltf::open(document, bytes, opener)) return document.error();
  MeshFileData data = gltf::SceneReader(document).read();
  if (document.failed()) return document.error();
  return data;
}

}  // namespace brickfall
