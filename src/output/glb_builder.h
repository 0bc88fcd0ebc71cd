// The container side of a glTF 2.0 binary: accessors over one growing buffer, and the two chunks around it.
#pragma once
#include <array>
#include <nlohmann/json.hpp>
#include <vector>

#include "record/atomic_file.h"
#include "record/byte_stream.h"

namespace brickfall {

class GlbBuilder {
 public:
  using json = nlohmann::json;
  static constexpr int kVertices = 34962, kIndices = 34963, kOther = 0;  // bufferView targets of the standard

  GlbBuilder();
  // Each returns the accessor's index. `components` 1 = SCALAR, 2 = VEC2, 3 = VEC3, 4 = VEC4.
  int addFloats(const std::vector<float>& values, int components, int target, bool withRange);
  int addIndices(const std::vector<std::uint32_t>& indices);

  // A PNG within the buffer. Returns the place of a texture that repeats it.
  int addTexture(const Bytes& png);

  json& root() { return root_; }
  int add(const char* list, json item);  // appends to root()[list]; returns the place
  // False: more than the 4 GiB that a GLB can hold.
  bool writeTo(AtomicFile& file);

 private:
  int addAccessor(json accessor, std::size_t start, int target);
  json root_;
  Bytes buffer_;
};

}  // namespace brickfall
