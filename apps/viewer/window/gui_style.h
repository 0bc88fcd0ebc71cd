// How the panel looks: fonts and colours.
#pragma once

struct ImFont;

namespace brickfall::viewer {

// Before ImGui draws for the first time.
void useStyle();
ImFont* headingFont();

}  // namespace brickfall::viewer
