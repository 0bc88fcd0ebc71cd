// The panel: one function for each part of it. Each lays itself out between Gui::begin and Gui::end.
#pragma once
#include "viewer_core/frame.h"
#include "viewer_window/desk.h"

namespace brickfall::viewer {

// All of it. `now`: s of the window's clock.
void showPanel(Desk& desk, const Frame& frame, double now);

// --- Tabs.
void showScenes(Desk& desk, const Frame& frame);
void showTools(Desk& desk, const Frame& frame);
void showViews(Desk& desk, const Frame& frame);
void showSettings(Desk& desk, const Frame& frame);
void showFigures(Desk& desk, const Frame& frame);
void showEvents(Desk& desk, const Frame& frame);
// --- Windows of their own.
void showTimeBar(Desk& desk, const Frame& frame);
void showBody(Desk& desk, const Frame& frame);
void showMessages(Desk& desk, const Frame& frame, double now);
void showHelp(Desk& desk);
// The legend of mortar's colours, over the picture, with the panel and without it.
void showMortarLegend(Desk& desk, const Frame& frame);
void showFiles(Desk& desk);
void showContactNumbers(const Desk& desk, const Frame& frame);  // over the picture, as the table has them

// Height of the bar at the bottom, pixels; and width of the panel.
constexpr float kBarHeight = 74, kPanelWidth = 348;

}  // namespace brickfall::viewer
