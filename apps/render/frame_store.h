// The pictures of a film while it is made, in a folder: each appears whole or not at all, so that after a break those that are there
// need not be made again. A text beside them says what they are pictures of; with other settings the folder is refused.
#pragma once
#include <optional>
#include <string>

#include "brickfall/result.h"

namespace brickfall::render {

class FrameStore {
 public:
  // Makes the folder, or goes on in it. `settings`: a line for each thing that the pictures depend on, "samples 4".
  static Result<FrameStore> open(const std::string& folder, const std::string& settings);

  std::string frame(std::size_t index) const;  // its file
  bool has(std::size_t index) const;
  // The take of a scene that the pictures are of: under a name that no recording of a user's has.
  std::string sceneTake() const;
  // Settings lay there already, and they are the same: what else of our names lies there was made by them.
  bool goesOn() const { return goesOn_; }
  bool hasAny() const;
  const std::string& folder() const { return folder_; }
  // Nothing is left of it, but for files that are none of its own and a folder that was there before them.
  void remove(std::size_t frames) const;
  // The text that says what they are, once the pictures are for good.
  void forgetSettings() const;

 private:
  explicit FrameStore(std::string folder) : folder_(std::move(folder)) {}
  std::string folder_;
  bool goesOn_ = false, folderIsOurs_ = false;
};

// The first line in which two texts of settings differ: "found samples 4, expected samples 8". Empty: none does.
std::string settingsDifference(const std::string& found, const std::string& expected);

}  // namespace brickfall::render
