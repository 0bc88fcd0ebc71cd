// What is shown and how: what the keys and the panel switch, and the drawing reads.
#pragma once
#include <cstdint>

#include "viewer_core/frame.h"

namespace brickfall::viewer {

enum class ShadowChoice : std::uint8_t { depth, stencil, none };
constexpr int kShadowChoiceCount = 3;
const char* nameOf(ShadowChoice choice);  // "stencil"; as --shadows takes it

// Which number of a mortar joint gives it a colour.
enum class MortarView : std::uint8_t { none, utilisation, damage };
constexpr int kMortarViewCount = 3;
const char* nameOf(MortarView view);  // "utilisation"

struct ViewOptions {
  // Views of the bodies; where several are on, the first of these that has something to say about a body gives its colour.
  bool collisions = false;  // colliding bodies red
  bool asleep = false;      // by activity
  bool islands = false;     // a colour for each island
  MortarView mortar =
      MortarView::none;  // of joints; bodies are grey behind them unless a view before has something to say
  // How they are drawn.
  bool wireframe = false;  // unshaded polygons
  ShadowChoice shadows = ShadowChoice::depth;
  bool dust = true;
  // Layers over them.
  bool colliders = false, bounds = false, contacts = false;

  FrameNeeds needs(bool plots) const;
};

// 0xRRGGBB and how much of it replaces the material's own look, 0 .. 1.
struct BodyTint {
  std::uint32_t colour = 0;
  float strength = 0;
};
// What the views say about a body.
BodyTint tintOf(const ListedBody& listed, const FrameBody& body, const ViewOptions& options);
// A colour for each island, neighbours in number far apart in hue.
std::uint32_t islandColour(int island);
// Of 0 .. 1: blue to pale yellow, ever lighter, so that it reads without colour vision. The page has the same.
std::uint32_t scaleColour(double share);

}  // namespace brickfall::viewer
