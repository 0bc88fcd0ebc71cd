// From the bytes of a .glb or .gltf to its JSON and buffers.
#include <cmath>
#include <cstring>

#include "mesh_file/gltf.h"

namespace brickfall::gltf {

namespace {

constexpr std::size_t kMaxBytes = std::size_t(256) << 20;

std::uint32_t wordAt(std::span<const std::byte> bytes, std::size_t offset) {
  std::uint32_t word = 0;
  for (int k = 3; k >= 0; k--) word = word << 8 | std::uint32_t(bytes[offset + std::size_t(k)]);
  return word;
}

// The two chunks of a .glb; false with an error.
bool split(Document& d, std::span<const std::byte> bytes, std::string_view& text, std::span<const std::byte>& binary) {
  if (bytes.size() < 20)
    return d.fail("header", "found " + std::to_string(bytes.size()) + " bytes, expected a .glb"), false;
  if (wordAt(bytes, 4) != 2)
    return d.fail("header.version", "found " + std::to_string(wordAt(bytes, 4)) + ", expected 2"), false;
  std::size_t length = wordAt(bytes, 8);
  if (length > bytes.size() || length < 20)
    return d.fail("header.length",
                  "found " + std::to_string(length) + " in a file of " + std::to_string(bytes.size()) + " bytes"),
           false;
  bytes = bytes.first(length);
  std::size_t offset = 12;
  for (int chunk = 0; offset + 8 <= length; chunk++) {
    std::size_t size = wordAt(bytes, offset), type = wordAt(bytes, offset + 4);
    offset += 8;
    if (size > length - offset)
      return d.fail("chunk " + std::to_string(chunk), "found " + std::to_string(size) +
                                                          " bytes, expected at most the " +
                                                          std::to_string(length - offset) + " left"),
             false;
    std::span<const std::byte> part = bytes.subspan(offset, size);
    if (chunk == 0 && type != 0x4E4F534A) return d.fail("chunk 0", "found another kind, expected JSON"), false;
    if (chunk == 0) text = {reinterpret_cast<const char*>(part.data()), part.size()};
    if (chunk == 1 && type == 0x004E4942) binary = part;
    offset += size;
  }
  if (text.empty()) return d.fail("chunk 0", "found none, expected JSON"), false;
  return true;
}

int digitOf(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

std::optional<std::vector<std::byte>> fromBase64(std::string_view text) {
  std::vector<std::byte> out;
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::uint32_t bits = 0;
  int count = 0;
  for (char c : text) {
    int digit = digitOf(c);
    if (digit < 0) return {};
    bits = bits << 6 | std::uint32_t(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    out.push_back(std::byte(bits >> count & 255));
  }
  return out;
}

std::optional<std::string> fromPercent(std::string_view text) {
  std::string out;
  auto hex = [](char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
  };
  for (std::size_t i = 0; i < text.size(); i++) {
    if (text[i] != '%') {
      out += text[i];
      continue;
    }
    if (i + 2 >= text.size() || hex(text[i + 1]) < 0 || hex(text[i + 2]) < 0) return {};
    out += char(hex(text[i + 1]) * 16 + hex(text[i + 2]));
    i += 2;
  }
  return out;
}

bool addBuffer(Document& d, const Json& buffer, std::size_t index, std::span<const std::byte> binary,
               const MeshFileOpener& opener) {
  std::string field = at("buffers", index);
  std::size_t length = d.whole(buffer, "byteLength", field, {}, kMaxBytes);
  if (d.failed()) return false;
  std::vector<std::byte> bytes;
  auto uri = buffer.find("uri");
  if (uri == buffer.end()) {
    if (index != 0) return d.fail(field + ".uri", "not given, expected a URI"), false;
    bytes.assign(binary.begin(), binary.end());
  } else if (!uri->is_string()) {
    return d.fail(field + ".uri", "expected a text"), false;
  } else {
    const std::string& text = uri->get_ref<const std::string&>();
    if (text.rfind("data:", 0) == 0) {
      std::size_t comma = text.find(";base64,");
      std::optional<std::vector<std::byte>> decoded;
      if (comma != std::string::npos) decoded = fromBase64(std::string_view(text).substr(comma + 8));
      if (!decoded) return d.fail(field + ".uri", "found data that are not base64"), false;
      bytes = std::move(*decoded);
    } else {
      std::optional<std::string> path = fromPercent(text);
      if (!path || !opener) return d.fail(field + ".uri", "found a file that can't be opened from here"), false;
      Result<std::vector<std::byte>> read = opener(*path);
      if (!read) return d.fail(field + ".uri", read.error().message), false;
      bytes = std::move(read).value();
    }
  }
  if (bytes.size() < length)
    return d.fail(field + ".byteLength", "found " + std::to_string(length) + ", expected at most the " +
                                             std::to_string(bytes.size()) + " bytes there are"),
           false;
  bytes.resize(length);
  d.buffers.push_back(std::move(bytes));
  return true;
}

bool checkAsset(Document& d) {
  auto asset = d.json.find("asset");
  if (asset == d.json.end() || !asset->is_object()) return d.fail("asset", "not given, expected glTF 2.0"), false;
  auto version = asset->find("version");
  if (version == asset->end() || !version->is_string() || version->get_ref<const std::string&>().rfind("2.", 0) != 0)
    return d.fail("asset.version", "expected \"2.0\""), false;
  // Compressed geometry is what these extensions mean for us.
  auto required = d.json.find("extensionsRequired");
  if (required == d.json.end()) return true;
  if (!required->is_array()) return d.fail("extensionsRequired", "expected an array"), false;
  for (const Json& extension : *required) {
    std::string name = extension.is_string() ? extension.get<std::string>() : "";
    if (name.rfind("KHR_materials", 0) == 0 || name.rfind("KHR_texture", 0) == 0) continue;
    return d.fail("extensionsRequired", "found \"" + name.substr(0, 60) + "\", expected a file without it"), false;
  }
  return true;
}

}  // namespace

std::string at(const char* list, std::size_t index) { return std::string(list) + "[" + std::to_string(index) + "]"; }

const Json* Document::item(const char* list, std::size_t index, const std::string& field) {
  auto found = json.find(list);
  if (found == json.end() || !found->is_array() || index >= found->size() || !(*found)[index].is_object()) {
    fail(field, "found " + std::to_string(index) + ", expected one of " + list);
    return nullptr;
  }
  return &(*found)[index];
}

std::size_t Document::whole(const Json& object, const char* key, const std::string& field,
                            std::optional<std::size_t> fallback, std::size_t most) {
  auto found = object.find(key);
  if (found == object.end()) {
    if (!fallback) fail(field + "." + key, "not given, expected a whole number");
    return fallback.value_or(0);
  }
  double value = found->is_number() ? found->get<double>() : -1;
  if (!(value >= 0 && value <= double(most)) || value != std::floor(value)) {
    fail(field + "." + key, "expected a whole number 0 .. " + std::to_string(most));
    return 0;
  }
  return std::size_t(value);
}

bool Document::numbers(const Json& object, const char* key, const std::string& field, std::size_t count, double* out) {
  auto found = object.find(key);
  if (found == object.end()) return false;
  bool sound = found->is_array() && found->size() == count;
  for (std::size_t i = 0; sound && i < count; i++) {
    sound = (*found)[i].is_number();
    if (sound) out[i] = (*found)[i].get<double>();
    sound = sound && std::isfinite(out[i]);
  }
  if (!sound) fail(field + "." + key, "expected " + std::to_string(count) + " numbers");
  return sound;
}

bool open(Document& d, std::span<const std::byte> bytes, const MeshFileOpener& opener) {
  std::string_view text{reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  std::span<const std::byte> binary;
  bool glb = bytes.size() >= 4 && wordAt(bytes, 0) == 0x46546C67;
  if (glb && !split(d, bytes, text, binary)) return false;
  d.json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (!d.json.is_object()) return d.fail("JSON", "found something else, expected an object of sound JSON"), false;
  if (!checkAsset(d)) return false;
  auto list = d.json.find("buffers");
  if (list == d.json.end()) return true;
  if (!list->is_array()) return d.fail("buffers", "expected an array"), false;
  std::size_t total = 0;
  for (std::size_t i = 0; i < list->size(); i++) {
    if (!(*list)[i].is_object()) return d.fail(at("buffers", i), "expected an object"), false;
    if (!addBuffer(d, (*list)[i], i, binary, opener)) return false;
    total += d.buffers.back().size();
    if (total > kMaxBytes) return d.fail(at("buffers", i), "found more than 256 MiB in all"), false;
  }
  return true;
}

}  // namespace brickfall::gltf
