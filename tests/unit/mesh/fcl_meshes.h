// Meshes as FCL sees them (OBBRSS trees). In a file of its own: its headers are slow to compile.
#pragma once
#include <memory>
#include <vector>

#include "brickfall/geometry/mesh_tree.h"

namespace brickfall::test {

class FclMesh {
 public:
  explicit FclMesh(const TriangleMesh& mesh);
  ~FclMesh();

  static std::vector<FacePair> overlappingFaces(const FclMesh& a, const FclMesh& b, const Transform& bInA);
  static double distance(const FclMesh& a, const FclMesh& b, const Transform& bInA);

 private:
  struct Model;
  std::unique_ptr<Model> model_;
};

}  // namespace brickfall::test
