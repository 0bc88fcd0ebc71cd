#include "viewer_window/still.h"

#include <OgreDataStream.h>
#include <OgreException.h>
#include <OgreImage.h>
#include <fmt/format.h>

#include <filesystem>

#include "brickfall/whole_file.h"

namespace brickfall::viewer {

Status saveStill(const Picture& picture, const std::string& path) {
  try {
    Ogre::Image image;
    auto* pixels = const_cast<unsigned char*>(picture.pixels.data());
    image.loadDynamicImage(pixels, Ogre::uint32(picture.width), Ogre::uint32(picture.height), Ogre::PF_BYTE_RGB);
    const Ogre::DataStreamPtr bytes = image.encode("png");
    return writeWhole(path, bytes->getAsString());
  } catch (const Ogre::Exception& error) {
    return Error{ErrorCode::inputOutput, path + ": the picture cannot be made: " + error.getDescription()};
  }
}

std::string freeStillName(const std::string& scene) {
  std::error_code problem;
  for (int number = 1;; number++) {
    std::string name = fmt::format("{}-{:03}.png", scene.empty() ? "scene" : scene, number);
    if (!std::filesystem::exists(name, problem)) return name;
  }
}

}  // namespace brickfall::viewer
