// The only file that sees libpng. Its simple interface, which needs no long jumps.
#include "render/png_file.h"

#include <png.h>

#include <cstring>

#include "brickfall/whole_file.h"

namespace brickfall::render {

Status writePng(const std::string& path, const Image& image) {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  png.width = png_uint_32(image.width);
  png.height = png_uint_32(image.height);
  png.format = PNG_FORMAT_RGB;
  png.flags = PNG_IMAGE_FLAG_FAST;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (!png_image_write_to_memory(&png, bytes.data(), &size, 0, image.bytes.data(), 0, nullptr))
    return Error{ErrorCode::inputOutput, path + ": cannot make a PNG file of it: " + png.message};
  bytes.resize(size);
  return writeWhole(path, bytes);
}

Result<Image> readPng(const std::string& path) {
  png_image png;
  std::memset(&png, 0, sizeof png);
  png.version = PNG_IMAGE_VERSION;
  const auto refused = [&] {
    Error error{ErrorCode::inputOutput, path + ": cannot read it as a PNG file: " + png.message};
    png_image_free(&png);
    return error;
  };
  if (!png_image_begin_read_from_file(&png, path.c_str())) return refused();
  if (png.width > 16384 || png.height > 16384) {
    png_image_free(&png);
    return Error{ErrorCode::badFormat, path + ": larger than 16384 pixels"};
  }
  png.format = PNG_FORMAT_RGB;
  Image image{int(png.width), int(png.height), std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
  if (!png_image_finish_read(&png, nullptr, image.bytes.data(), 0, nullptr)) return refused();
  return image;
}

}  // namespace brickfall::render
