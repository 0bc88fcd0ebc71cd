// The replay page without its take, bundled from apps/web at build time.
#pragma once
#include <span>
#include <string_view>

namespace brickfall {

// In pieces, because compilers limit the length of one string. Joined they hold the place holders below once each, in this
// order.
std::span<const std::string_view> replayTemplate();

constexpr std::string_view kTitlePlace = "{{BRICKFALL_TITLE}}", kPreviewPlace = "{{BRICKFALL_PREVIEW}}",
                           kPosterPlace = "{{BRICKFALL_POSTER}}", kMetaPlace = "{{BRICKFALL_META}}",
                           kDataPlace = "{{BRICKFALL_DATA}}";

}  // namespace brickfall
