// How a diagnostic reads: compilers' form, so that editors can jump to it.
#include <string>

#include "brickfall/scene.h"

namespace brickfall {

std::string format(const Diagnostic& diagnostic) {
  std::string text = diagnostic.file.empty() ? std::string("scene") : diagnostic.file;
  if (diagnostic.line > 0) {
    text += ":" + std::to_string(diagnostic.line);
    if (diagnostic.column > 0) text += ":" + std::to_string(diagnostic.column);
  }
  text += diagnostic.severity == Severity::error ? ": error: " : ": warning: ";
  if (!diagnostic.key.empty()) text += diagnostic.key + ": ";
  return text + diagnostic.message;
}

}  // namespace brickfall
