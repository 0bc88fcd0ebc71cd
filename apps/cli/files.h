// Folders and files of a run.
#pragma once
#include <string>
#include <string_view>

#include "brickfall/result.h"

namespace brickfall::cli {

// Makes the folder and those above it. The error names the part that is in the way.
Status makeFolder(const std::string& folder);
// "folder/name"; "name" in an empty folder.
std::string joinPath(const std::string& folder, const std::string& name);
// A name from a file (a take may come from anywhere) as a file name: letters, digits, '-', '_' and '.', not first a '.';
// anything else gives "scene".
std::string safeFileName(const std::string& name);
// "12.3 MB"
std::string sizeText(const std::string& path);

}  // namespace brickfall::cli
