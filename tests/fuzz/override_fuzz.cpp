// libFuzzer: any text as the argument of --set, "key=value", applied to a scene that has most tables; and its value
// as an expression by itself.
#include <cmath>

#include "brickfall/scene.h"
#include "fuzz/fuzz_check.h"
#include "scene/expression.h"

namespace {

using namespace brickfall;
using fuzz::require;

constexpr const char* kScene = R"([parameters]
speed = 8
[world]
seconds = 1
[[wall]]
courses = 2
bricks = 2
[[wall.opening]]
from = 0.1
width = 0.1
height = 0.05
[[body]]
[[body.part]]
[[ball]]
position = [0, 1, "$speed"]
[[array]]
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string text(reinterpret_cast<const char*>(data), size);
  std::size_t equals = std::min(text.find('='), text.size());
  std::string key = text.substr(0, equals), value = equals < text.size() ? text.substr(equals + 1) : std::string();
  SceneLoad load = parseScene(kScene, "fuzz.toml", {{key, value}});
  bool error = false;
  for (const Diagnostic& d : load.diagnostics) {
    error = error || d.severity == Severity::error;
    require(!d.message.empty() && !d.file.empty(), "a diagnostic that says nothing");
  }
  require(load.scene.has_value() != error, "neither a scene nor an error, or both");
  auto lookup = [](const std::string& name, std::string& why) -> std::optional<double> {
    if (name == "speed") return 8;
    why = "unknown";
    return std::nullopt;
  };
  scene::Evaluated result = scene::evaluate(value, lookup);
  require(result.error.empty() ? std::isfinite(result.value) : result.column >= 1, "an expression without an answer");
  return 0;
}
