// A take to what people open: one HTML file, one glTF binary. Files appear whole or not at all.
#pragma once
#include <functional>
#include <span>
#include <string>

#include "brickfall/result.h"
#include "brickfall/take.h"

namespace brickfall {

// Called with 0..1 now and then; return false to cancel (nothing is then left behind).
using Progress = std::function<bool(double share)>;

// What a page may say of itself besides its take.
struct PageWishes {
  std::string poster;   // a file: PNG, JPEG or WebP, at most 4 MB; shown until the first picture is drawn
  std::string address;  // "https://...", of the page: who shows a link to it takes the poster that lies beside it there
};

// ONE self-contained page that plays the take in any browser, without network.
Status writeReplayHtml(const TakeReader& take, const std::string& path, const Progress& progress = {},
                       const PageWishes& wishes = {});

// glTF 2.0 binary: one node per body, meshes shared by equal shapes, keyframes thinned where nothing moves.
Status writeGlb(const TakeReader& take, const std::string& path, const Progress& progress = {});

// Every output there is, in the order in which `brickfall run` makes them.
struct OutputKind {
  const char* name;     // "html": --no-html leaves it out
  const char* file;     // what its file is called; "*" stands for the scene's name
  const char* purpose;  // in a few words
  Status (*write)(const TakeReader& take, const std::string& path, const Progress& progress);
};
std::span<const OutputKind> outputKinds();

}  // namespace brickfall
