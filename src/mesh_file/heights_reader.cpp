// Heights over a grid as text: a row of the grid a line, numbers between commas, semicolons or blanks; lines that are empty or
// begin with # are passed over.
#include <charconv>
#include <cmath>
#include <optional>

#include "brickfall/geometry/height_field.h"
#include "brickfall/mesh_file.h"

namespace brickfall {

namespace {

bool isBetween(char c) { return c == ',' || c == ';' || c == ' ' || c == '\t' || c == '\r'; }

// At most 40 characters of what was found, without anything that a terminal would act on.
std::string shownHeight(std::string_view word) {
  std::string out;
  for (char c : word.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return "\"" + out + "\"";
}

// The numbers of one line, added to `heights`. What is no finite number, if something is not.
std::optional<std::string> readRow(std::string_view line, std::vector<double>& heights) {
  while (true) {
    while (!line.empty() && isBetween(line.front())) line.remove_prefix(1);
    if (line.empty()) return {};
    std::size_t end = 0;
    while (end < line.size() && !isBetween(line[end])) end++;
    double height = 0;
    const std::from_chars_result read = std::from_chars(line.data(), line.data() + end, height);
    if (read.ec != std::errc() || read.ptr != line.data() + end || !std::isfinite(height))
      return shownHeight(line.substr(0, end));
    heights.push_back(height);
    line.remove_prefix(end);
  }
}

}  // namespace

Result<MeshFileData> readHeights(std::string_view text, const std::string& name) {
  std::vector<double> heights;
  std::size_t columns = 0, number = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size()), before = heights.size();
    number++;
    auto failed = [&](const std::string& found) {
      return Error{ErrorCode::badFormat, name + ":" + std::to_string(number) + ": " + found};
    };
    const std::string_view line = text.substr(0, end);
    if (line.empty() || line.front() != '#')
      if (auto wrong = readRow(line, heights)) return failed("found " + *wrong + ", expected a height in metres");
    const std::size_t found = heights.size() - before;
    if (columns == 0) columns = found;
    if (found > 0 && found != columns)
      return failed("found " + std::to_string(found) + " heights, expected " + std::to_string(columns) +
                    " as in the first row");
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  Result<TriangleMesh> mesh = heightField(heights, columns, 1, 1);
  if (!mesh) return Error{ErrorCode::badFormat, name + ": " + mesh.error().message};
  MeshFileData data{mesh->vertices(), {}};
  for (const TriangleMesh::Face& face : mesh->faces())
    data.indices.insert(data.indices.end(), face.vertex, face.vertex + 3);
  return data;
}

}  // namespace brickfall
