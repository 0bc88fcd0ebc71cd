// Shadow volumes: from meshes and their places to the sides and caps of the space that the sun does not reach. Plain geometry;
// the drawing of it is in shadow_volumes.h.
//
// The sun is infinitely far away, so all of a volume's far corners are one point at infinity (vertex 0, w = 0), and an edge of
// the silhouette gives one triangle instead of two.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "brickfall/math.h"
#include "viewer_window/draw_mesh.h"

namespace brickfall::viewer {

// A mesh as its shadow sees it: corners at one place are one.
class ShadowShape {
 public:
  explicit ShadowShape(const DrawMesh& mesh);
  // False for a surface with a rim: it has no inside, so no volume.
  bool closed() const { return closed_; }
  Vec3 half() const { return half_; }  // m: of the box around its middle

  struct Face {
    Vec3 normal;  // not unit: its length is twice the area
    std::uint32_t corners[3];
  };
  // Between two faces; runs counter-clockwise about the first.
  struct Edge {
    std::uint32_t from, to, faceA, faceB;
  };
  const std::vector<Vec3>& corners() const { return corners_; }
  const std::vector<Face>& faces() const { return faces_; }
  const std::vector<Edge>& edges() const { return edges_; }

 private:
  void addFaces(const DrawMesh& mesh, const std::vector<std::uint32_t>& cornerOf);
  void findEdges();

  std::vector<Vec3> corners_;
  std::vector<Face> faces_;
  std::vector<Edge> edges_;
  bool closed_ = true;
  Vec3 half_;
};

struct VolumeVertex {
  float x = 0, y = 0, z = 0, w = 1;
};

// Of many bodies together, so that they are drawn at once.
class ShadowGeometry {
 public:
  void clear();
  // towardsSun: unit, world. scale: of the mesh before it is turned.
  // sharpened: m by which the cut edges of a box are drawn out again, as body.vert does from afar.
  void add(const ShadowShape& shape, const Transform& pose, Vec3 scale, Vec3 towardsSun, double sharpened = 0);
  // A ball has no corners: light ends on it in the plane across the sun's rays through its middle, exactly where its shading does.
  void addBall(Vec3 middle, double radius, Vec3 towardsSun);

  std::span<const VolumeVertex> vertices() const { return vertices_; }
  std::span<const std::uint32_t> sides() const { return sides_; }
  std::span<const std::uint32_t> caps() const { return caps_; }  // the lit faces

 private:
  std::vector<VolumeVertex> vertices_;
  std::vector<std::uint32_t> sides_, caps_;
  std::vector<char> lit_;
};

}  // namespace brickfall::viewer
