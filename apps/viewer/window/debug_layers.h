// The layers over the picture, as lines: what the engine believes beside what is drawn.
#pragma once
#include <map>
#include <utility>
#include <vector>

#include "viewer_core/frame.h"
#include "viewer_window/lines.h"
#include "viewer_window/view_options.h"

namespace brickfall::viewer {

constexpr std::size_t kMostBounds = 6000;  // boxes of the broad phase: a picture of more is a blot, and slow

class DebugLayers {
 public:
  // Adds what the options ask for; `blend` as the bodies are drawn.
  void addLayers(Lines& lines, const Frame& frame, double blend, const ViewOptions& options);
  // The spring of a drag, and the shapes of the selected body.
  void addHands(Lines& lines, const Frame& frame, double blend, Serial selected);

 private:
  void addShapes(Lines& lines, const ListedBody& body, const Transform& pose, std::uint32_t colour);
  const std::vector<std::pair<Vec3, Vec3>>& edgesOf(const ListedBody& body, std::size_t shape);

  // Of hulls and meshes, by body and place of the shape; found when first shown, as long as the run is the same.
  std::map<std::pair<Serial, std::size_t>, std::vector<std::pair<Vec3, Vec3>>> edges_;
  std::shared_ptr<const RunInfo> run_;
};

}  // namespace brickfall::viewer
