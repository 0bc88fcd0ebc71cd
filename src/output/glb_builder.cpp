#include "output/glb_builder.h"

#include <algorithm>
#include <bit>

namespace brickfall {
namespace {

void put32(Bytes& out, std::uint32_t v) {
  for (int k = 0; k < 4; k++) out.push_back(std::uint8_t(v >> (8 * k)));
}

}  // namespace

GlbBuilder::GlbBuilder() {
  root_["asset"] = {{"version", "2.0"}, {"generator", "Brickfall"}};
  root_["buffers"] = nlohmann::json::array({{{"byteLength", 0}}});
}

int GlbBuilder::add(const char* list, json item) {
  json& items = root_[list];
  if (!items.is_array()) items = json::array();
  items.push_back(std::move(item));
  return int(items.size()) - 1;
}

int GlbBuilder::addAccessor(json accessor, std::size_t start, int target) {
  json view = {{"buffer", 0}, {"byteOffset", start}, {"byteLength", buffer_.size() - start}};
  if (target != kOther) view["target"] = target;
  accessor["bufferView"] = add("bufferViews", std::move(view));
  return add("accessors", std::move(accessor));
}

int GlbBuilder::addFloats(const std::vector<float>& values, int components, int target, bool withRange) {
  static constexpr const char* kTypes[] = {"SCALAR", "VEC2", "VEC3", "VEC4"};
  std::size_t start = buffer_.size(), width = std::size_t(components);
  for (float v : values) put32(buffer_, std::bit_cast<std::uint32_t>(v));
  json accessor = {{"componentType", 5126}, {"count", values.size() / width}, {"type", kTypes[components - 1]}};
  if (withRange) {
    std::vector<float> low(values.begin(), values.begin() + components), high = low;
    for (std::size_t k = 0; k < values.size(); k++) {
      low[k % width] = std::min(low[k % width], values[k]);
      high[k % width] = std::max(high[k % width], values[k]);
    }
    accessor["min"] = low;
    accessor["max"] = high;
  }
  return addAccessor(std::move(accessor), start, target);
}

int GlbBuilder::addIndices(const std::vector<std::uint32_t>& indices) {
  std::size_t start = buffer_.size();
  bool small = std::all_of(indices.begin(), indices.end(), [](std::uint32_t i) { return i < 65535; });
  for (std::uint32_t i : indices) {
    if (small) {
      buffer_.push_back(std::uint8_t(i));
      buffer_.push_back(std::uint8_t(i >> 8));
    } else {
      put32(buffer_, i);
    }
  }
  json accessor = {{"componentType", small ? 5123 : 5125}, {"count", indices.size()}, {"type", "SCALAR"}};
  int place = addAccessor(std::move(accessor), start, kIndices);
  while (buffer_.size() % 4 != 0) buffer_.push_back(0);
  return place;
}

int GlbBuilder::addTexture(const Bytes& png) {
  const std::size_t start = buffer_.size();
  buffer_.insert(buffer_.end(), png.begin(), png.end());
  const int view = add("bufferViews", {{"buffer", 0}, {"byteOffset", start}, {"byteLength", png.size()}});
  while (buffer_.size() % 4 != 0) buffer_.push_back(0);
  const int image = add("images", {{"bufferView", view}, {"mimeType", "image/png"}, {"name", "grain"}});
  const int sampler = add("samplers", {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", 10497}, {"wrapT", 10497}});
  return add("textures", {{"source", image}, {"sampler", sampler}});
}

bool GlbBuilder::writeTo(AtomicFile& file) {
  root_["buffers"][0]["byteLength"] = buffer_.size();
  if (buffer_.empty()) root_.erase("buffers");  // nothing to draw: a buffer of no bytes is not allowed
  std::string text = root_.dump(-1, ' ', false, json::error_handler_t::replace);
  while (text.size() % 4 != 0) text += ' ';
  std::uint64_t total = 12 + 8 + text.size() + (buffer_.empty() ? 0 : 8 + buffer_.size());
  if (total > 0xffffffffu) return false;
  Bytes head;
  put32(head, 0x46546C67);  // "glTF"
  put32(head, 2);
  put32(head, std::uint32_t(total));
  put32(head, std::uint32_t(text.size()));
  put32(head, 0x4E4F534A);  // "JSON"
  file.write(head);
  file.write(text);
  if (buffer_.empty()) return true;
  Bytes middle;
  put32(middle, std::uint32_t(buffer_.size()));
  put32(middle, 0x004E4942);  // "BIN"
  file.write(middle);
  file.write(buffer_);
  return true;
}

}  // namespace brickfall
