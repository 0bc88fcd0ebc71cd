// Where the results of a scene go when nobody says where.
#pragma once
#include <string>

namespace brickfall::cli {

// out/NAME; out/NAME-2, ... where results of another scene of that name lie. `file`: the scene's own, as it was found.
std::string resultFolder(const std::string& name, const std::string& file);
// An absolute path, as summary.json has it.
std::string absolutePath(const std::string& file);

}  // namespace brickfall::cli
