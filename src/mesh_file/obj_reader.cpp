// Wavefront OBJ: `v` and `f` lines; everything else (normals, texture coordinates, groups, materials) is passed over. Polygons are
// cut into a fan from their first corner.
//
// Written here rather than taken from tinyobjloader: that one passes over lines it does not understand and reads numbers
// leniently, and of the format we need two keywords.
#include <algorithm>
#include <charconv>
#include <cmath>

#include "brickfall/mesh_file.h"

namespace brickfall {

namespace {

constexpr std::size_t kMaxItems = 50'000'000;  // vertices, triangles

bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r'; }

// The words of one line.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}
  std::string_view next() {
    while (!rest_.empty() && isSpace(rest_.front())) rest_.remove_prefix(1);
    std::size_t end = 0;
    while (end < rest_.size() && !isSpace(rest_[end])) end++;
    std::string_view word = rest_.substr(0, end);
    rest_.remove_prefix(end);
    return word;
  }

 private:
  std::string_view rest_;
};

// At most 40 characters of what was found, without anything that a terminal would act on.
std::string shown(std::string_view word) {
  std::string out;
  for (char c : word.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return word.empty() ? "nothing" : "\"" + out + "\"";
}

class ObjReader {
 public:
  ObjReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  Result<MeshFileData> read() {
    while (!text_.empty() && message_.empty()) {
      std::size_t end = std::min(text_.find('\n'), text_.size());
      line_++;
      readLine(text_.substr(0, end));
      text_.remove_prefix(std::min(end + 1, text_.size()));
    }
    if (message_.empty() && data_.indices.empty()) {
      line_ = 0;
      fail("found no face (f), expected at least one");
    }
    if (!message_.empty()) return Error{ErrorCode::badFormat, message_};
    return std::move(data_);
  }

 private:
  void fail(const std::string& what) {
    message_ = name_ + (line_ > 0 ? ":" + std::to_string(line_) : "") + ": " + what;
  }

  void readLine(std::string_view line) {
    line = line.substr(0, line.find('#'));
    Words words(line);
    std::string_view keyword = words.next();
    if (keyword == "v") readVertex(words);
    if (keyword == "f") readFace(words);
    if (line.size() > 0 && line.back() == '\\') fail("found a line that goes on (\\), expected each on its own");
  }

  void readVertex(Words& words) {
    Vec3 p;
    for (int k = 0; k < 3; k++) {
      std::string_view word = words.next();
      if (!word.empty() && word.front() == '+') word.remove_prefix(1);
      auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), p[k]);
      if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(p[k]))
        return fail("found " + shown(word) + ", expected a coordinate");
    }
    if (data_.vertices.size() >= kMaxItems) return fail("found too many vertices");
    data_.vertices.push_back(p);
  }

  // "7", "7/1", "7//2", "7/1/2"; negative: from the last vertex back. 0 if it is none of these.
  std::size_t vertexOf(std::string_view word) const {
    std::string_view number = word.substr(0, word.find('/'));
    for (char c : word.substr(number.size()))
      if (c != '/' && c != '-' && (c < '0' || c > '9')) return 0;
    long long index = 0;
    auto [end, problem] = std::from_chars(number.data(), number.data() + number.size(), index);
    if (number.empty() || problem != std::errc() || end != number.data() + number.size()) return 0;
    long long count = static_cast<long long>(data_.vertices.size());
    if (index < 0 && index >= -count) index += count + 1;
    return index >= 1 && index <= count ? std::size_t(index) : 0;
  }

  void readFace(Words& words) {
    std::uint32_t first = 0, previous = 0;
    int corners = 0;
    for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
      std::size_t vertex = vertexOf(word);
      if (vertex == 0)
        return fail("found " + shown(word) + ", expected a vertex 1 .. " + std::to_string(data_.vertices.size()) +
                    " given above");
      std::uint32_t index = std::uint32_t(vertex - 1);
      if (corners == 0) first = index;
      if (corners >= 2) {
        if (data_.indices.size() >= 3 * kMaxItems) return fail("found too many triangles");
        data_.indices.insert(data_.indices.end(), {first, previous, index});
      }
      previous = index;
      corners++;
    }
    if (corners < 3) fail("found a face of " + std::to_string(corners) + " corners, expected at least 3");
  }

  std::string_view text_;
  const std::string& name_;
  std::size_t line_ = 0;
  std::string message_;
  MeshFileData data_;
};

}  // namespace

Result<MeshFileData> readObj(std::string_view text, const std::string& name) { return ObjReader(text, name).read(); }

}  // namespace brickfall
