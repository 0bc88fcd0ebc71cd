// The layers over the picture, as lines: what the engine believes beside what is drawn.
#pragma once
#include "viewer_core/frame.h"
#include "viewer_window/lines.h"
#include "viewer_window/view_options.h"

namespace brickfall::viewer {

// Adds what the options ask for; `blend` as the bodies are drawn.
void addLayers(Lines& lines, const Frame& frame, double blend, const ViewOptions& options);
// The spring of a drag, and a box around the selected body.
void addHands(Lines& lines, const Frame& frame, double blend, Serial selected);

}  // namespace brickfall::viewer
