#include "support/mesh_samples.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "support/random_geometry.h"

namespace brickfall::test {

namespace {

constexpr double kPi = 3.14159265358979323846;

// Quads of a grid that closes up in u, in v, or in both; point(u, v) with u, v in 0..1.
template <class Point> MeshData surface(int nu, int nv, bool closedU, bool closedV, Point point) {
  MeshData mesh;
  int rowsU = closedU ? nu : nu + 1, rowsV = closedV ? nv : nv + 1;
  for (int i = 0; i < rowsU; i++)
    for (int j = 0; j < rowsV; j++) mesh.vertices.push_back(point(double(i) / nu, double(j) / nv));
  auto at = [&](int i, int j) { return std::uint32_t((i % rowsU) * rowsV + j % rowsV); };
  for (int i = 0; i < nu; i++)
    for (int j = 0; j < nv; j++)
      for (std::uint32_t v : {at(i, j), at(i, j + 1), at(i + 1, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)})
        mesh.indices.push_back(v);
  return mesh;
}

double ridges(double x, double z) {
  return 0.12 * std::sin(2.1 * x + 0.3) * std::cos(1.7 * z) + 0.06 * std::sin(5.3 * x + 2.2 * z) +
         0.03 * std::sin(11 * z - 4 * x) + 0.02 * std::sin(23 * x) * std::sin(19 * z);
}

}  // namespace

MeshData sphereMesh(int triangles) {
  int n = std::max(3, int(std::sqrt(triangles / 4.0)));
  return surface(2 * n, n, true, false, [](double u, double v) {
    double a = 2 * kPi * u, b = kPi * v;
    if (v == 0 || v == 1) return Vec3{0, v == 0 ? 1.0 : -1.0, 0};
    return Vec3{std::sin(b) * std::cos(a), std::cos(b), -std::sin(b) * std::sin(a)};
  });
}

MeshData torusMesh(int triangles) {
  int n = std::max(3, int(std::sqrt(triangles / 4.0)));
  return surface(2 * n, n, true, true, [](double u, double v) {
    double a = 2 * kPi * u, b = 2 * kPi * v, r = 0.75 + 0.25 * std::cos(b);
    return Vec3{r * std::cos(a), -0.25 * std::sin(b), -r * std::sin(a)};
  });
}

MeshData terrainMesh(int triangles) {
  int n = int(std::sqrt(triangles / 2.0));
  return surface(n, n, false, false, [](double u, double v) {
    double x = 2 * u - 1, z = 2 * v - 1;
    return Vec3{x, ridges(x, z), z};
  });
}

MeshData statueMesh(int triangles) {
  int n = std::max(3, int(std::sqrt(triangles / 4.0)));
  return surface(2 * n, n, true, false, [](double u, double v) {
    double a = 2 * kPi * u, b = kPi * v;
    if (v == 0 || v == 1) return Vec3{0, v == 0 ? 1.2 : -1.1, 0};
    double limbs = 0.35 * std::pow(0.5 + 0.5 * std::cos(3 * a), 3) * std::exp(-20 * (v - 0.4) * (v - 0.4));
    double waist = 0.35 + 0.15 * std::cos(5 * b) + limbs;
    double folds = 0.03 * std::sin(9 * a + 6 * b) + 0.01 * std::sin(31 * a) * std::sin(37 * b);
    double r = std::sin(b) * (waist + folds) + 0.1 * std::sin(b);
    return Vec3{r * std::cos(a) + 0.1 * std::sin(3 * v), 1.15 * std::cos(b), -r * std::sin(a)};
  });
}

MeshData cubeMesh(double h) {
  MeshData mesh;
  for (int k = 0; k < 8; k++) mesh.vertices.push_back({k & 1 ? h : -h, k & 2 ? h : -h, k & 4 ? h : -h});
  constexpr std::uint32_t faces[6][4] = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                         {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  for (auto& f : faces)
    for (std::uint32_t v : {f[0], f[1], f[2], f[0], f[2], f[3]}) mesh.indices.push_back(v);
  return mesh;
}

MeshData gridMesh(int cellsX, int cellsZ, double cell) {
  return surface(cellsX, cellsZ, false, false, [&](double u, double v) {
    return Vec3{(u - 0.5) * cellsX * cell, 0, (v - 0.5) * cellsZ * cell};
  });
}

MeshData soupMesh(int triangles, std::uint64_t seed) {
  Random random(seed);
  MeshData mesh;
  for (int i = 0; i < triangles; i++) {
    Vec3 middle = randomVector(random, 1);
    double size = random.between(0.01, 0.3), thin = i % 5 == 0 ? 1e-6 : 1;
    Vec3 along = randomDirection(random), across = randomDirection(random);
    for (Vec3 corner : {middle, middle + along * size, middle + along * (0.4 * size) + across * (size * thin)}) {
      mesh.indices.push_back(std::uint32_t(mesh.vertices.size()));
      mesh.vertices.push_back(corner);
    }
  }
  return mesh;
}

MeshTree treeOf(const MeshData& data) {
  Result<TriangleMesh> mesh = TriangleMesh::create(data.vertices, data.indices);
  if (!mesh) {
    std::fprintf(stderr, "%s\n", mesh.error().message.c_str());
    std::abort();
  }
  return MeshTree::build(std::move(mesh).value());
}

std::vector<NamedMesh> sampleMeshes(int triangles) {
  return {{"sphere", sphereMesh(triangles)},
          {"torus", torusMesh(triangles)},
          {"terrain", terrainMesh(triangles)},
          {"statue", statueMesh(triangles)}};
}

}  // namespace brickfall::test
