// Small parts that the panels share.
#pragma once
#include <imgui.h>

#include <string>

#include "viewer_window/desk.h"

namespace brickfall::viewer {

// A line of bold text with room above it.
void heading(const char* text);
// Shown while the mouse rests on the item before.
void hint(const std::string& text);
// "name   value", the values below each other.
void row(const char* name, const std::string& value);
// The mouse is the panel's where the window that is being laid out lies.
void cover(Desk& desk);
// The item before is known to tests by this name.
void note(Desk& desk, const char* name);
// A button that does what a key does; the hint names the key.
bool actionButton(Desk& desk, Action action, const char* label, ImVec2 size = {0, 0});
// A slider whose number stands beside its knob, not under it.
bool slider(const char* label, float& value, float least, float most, const char* format, ImGuiSliderFlags flags = 0);
bool textField(const char* label, std::string& text, const char* whenEmpty);
// A plain number as short as it may be: "9.81", "1000", "1.5e-04".
std::string numberText(double value, const char* unit = "");

}  // namespace brickfall::viewer
