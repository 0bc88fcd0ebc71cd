// Numbers out of buffers: accessor -> bufferView -> buffer, with every range checked against the bytes there are.
#include <cstring>

#include "mesh_file/gltf.h"

namespace brickfall::gltf {

namespace {

constexpr std::size_t kMost = std::size_t(1) << 32;
enum : std::size_t { kByte = 5121, kShort = 5123, kInt = 5125, kFloat = 5126 };

struct View {
  const std::byte* first = nullptr;
  std::size_t count = 0, stride = 0;
  std::size_t component = 0;  // kByte ...
};

std::size_t sizeOf(std::size_t component) { return component == kByte ? 1 : component == kShort ? 2 : 4; }

// `components`: numbers an element.
View viewOf(Document& d, std::size_t index, const char* type, std::size_t components, const std::string& from) {
  View view;
  const Json* accessor = d.item("accessors", index, from);
  if (!accessor) return view;
  std::string field = at("accessors", index);
  if (accessor->contains("sparse")) d.fail(field + ".sparse", "found a sparse accessor, expected a plain one");
  auto found = accessor->find("type");
  if (found == accessor->end() || !found->is_string() || found->get_ref<const std::string&>() != type)
    d.fail(field + ".type", std::string("expected \"") + type + "\"");
  std::size_t component = d.whole(*accessor, "componentType", field, {}, kMost);
  std::size_t count = d.whole(*accessor, "count", field, {}, kMost);
  std::size_t offset = d.whole(*accessor, "byteOffset", field, 0, kMost);
  std::size_t viewIndex = d.whole(*accessor, "bufferView", field, {}, kMost);
  if (d.failed()) return view;
  bool known = components == 3 ? component == kFloat : component == kByte || component == kShort || component == kInt;
  if (!known)
    d.fail(field + ".componentType", "found " + std::to_string(component) + ", expected " +
                                         (components == 3 ? "5126 (float)" : "5121, 5123 or 5125"));
  const Json* part = d.item("bufferViews", viewIndex, field + ".bufferView");
  if (!part || d.failed()) return view;
  std::string where = at("bufferViews", viewIndex);
  std::size_t buffer = d.whole(*part, "buffer", where, {}, kMost);
  std::size_t start = d.whole(*part, "byteOffset", where, 0, kMost);
  std::size_t length = d.whole(*part, "byteLength", where, {}, kMost);
  std::size_t element = sizeOf(component) * components;
  std::size_t stride = d.whole(*part, "byteStride", where, element, 252);
  if (d.failed()) return view;
  if (buffer >= d.buffers.size()) {
    d.fail(where + ".buffer", "found " + std::to_string(buffer) + ", expected one of buffers");
  } else if (start > d.buffers[buffer].size() || length > d.buffers[buffer].size() - start) {
    d.fail(where + ".byteLength",
           "found more than the buffer's " + std::to_string(d.buffers[buffer].size()) + " bytes");
  } else if (stride < element) {
    d.fail(where + ".byteStride", "found " + std::to_string(stride) + ", expected at least " + std::to_string(element));
  } else if (count > 0 &&
             (offset > length || element > length - offset || count - 1 > (length - offset - element) / stride)) {
    d.fail(field + ".count", "found " + std::to_string(count) + ", expected no more than the bufferView holds");
  } else {
    view = {d.buffers[buffer].data() + start + offset, count, stride, component};
  }
  return view;
}

}  // namespace

std::vector<Vec3> positions(Document& d, std::size_t accessor, const std::string& from) {
  View view = viewOf(d, accessor, "VEC3", 3, from);
  std::vector<Vec3> out(view.count);
  for (std::size_t i = 0; i < view.count; i++) {
    float p[3];
    std::memcpy(p, view.first + i * view.stride, sizeof p);
    out[i] = {p[0], p[1], p[2]};
  }
  return out;
}

std::vector<std::uint32_t> wholeNumbers(Document& d, std::size_t accessor, const std::string& from) {
  View view = viewOf(d, accessor, "SCALAR", 1, from);
  std::vector<std::uint32_t> out(view.count);
  for (std::size_t i = 0; i < view.count; i++) {
    const std::byte* at = view.first + i * view.stride;
    for (std::size_t k = sizeOf(view.component); k > 0; k--) out[i] = out[i] << 8 | std::uint32_t(at[k - 1]);
  }
  return out;
}

}  // namespace brickfall::gltf
