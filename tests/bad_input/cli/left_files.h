// What a run left in its folder: is everything whole that has its final name?
#pragma once
#include <filesystem>
#include <string>

namespace brickfall::test {

// Empty, or which file is not whole, not known or left over. "<scene>.take.part", the recording of a run that did not end,
// is fine; other ".part" files are if `killed`.
std::string problemOfFiles(const std::filesystem::path& folder, bool killed);
std::string contentOfFile(const std::filesystem::path& path);

}  // namespace brickfall::test
