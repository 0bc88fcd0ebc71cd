#include "bad_input/cli/left_files.h"

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "brickfall/take.h"

namespace brickfall::test {
namespace fs = std::filesystem;
namespace {

bool isWholeGlb(const std::string& bytes) {
  std::uint32_t length = 0;
  if (bytes.size() < 12 || !bytes.starts_with("glTF")) return false;
  std::memcpy(&length, bytes.data() + 8, 4);
  return length == bytes.size();
}

bool isWholeTake(const fs::path& path) {
  const Result<TakeReader> take = TakeReader::open(path.string());
  if (!take || !take->complete() || take->frameCount() == 0) return false;
  for (std::size_t i = 0; i < take->frameCount(); i++)
    if (!take->frame(i)) return false;
  return true;
}

// A line of names, then numbers: as many in each line.
bool isWholeTable(const std::string& text) {
  if (!text.starts_with("time_s,") || !text.ends_with('\n')) return false;
  std::size_t columns = 0, commas = 0;
  for (char c : text) {
    commas += c == ',';
    if (c != '\n') continue;
    if (columns > 0 && commas != columns) return false;
    columns = commas;
    commas = 0;
  }
  return true;
}

bool isWhole(const fs::path& path) {
  const std::string name = path.filename().string(), ending = path.extension().string();
  if (name == "replay.html") return contentOfFile(path).ends_with("</html>\n");
  if (name == "summary.json") return nlohmann::json::accept(contentOfFile(path));
  if (name == "series.csv") return isWholeTable(contentOfFile(path));
  if (ending == ".glb") return isWholeGlb(contentOfFile(path));
  return ending == ".take" && isWholeTake(path);
}

}  // namespace

std::string contentOfFile(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string problemOfFiles(const fs::path& folder, bool killed) {
  if (!fs::exists(folder)) return "";
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".take.part") || (killed && name.ends_with(".part"))) continue;
    if (name.ends_with(".part")) return name + " is left over";
    if (!isWhole(entry.path())) return name + " is not whole";
  }
  return "";
}

}  // namespace brickfall::test
