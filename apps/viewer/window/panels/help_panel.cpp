// Keys and mouse, from the tables that act on them.
#include <algorithm>

#include "viewer_window/gui_style.h"
#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

constexpr float kColumnWidth = 292, kLeastScale = 0.75f;  // pixels; of the text

// Goes on in the next column where one is full, so that all of it fits the window.
class Columns {
 public:
  Columns(float width, float height)
      : width_(width), bottom_(ImGui::GetCursorPosY() + height), top_(ImGui::GetCursorPosY()) {
    left_ = ImGui::GetCursorPosX();
  }
  // Room for a line of this height, and for `more` after it that must not be parted from it.
  void begin(float height, float more = 0) {
    if (y_ < 0) y_ = top_;
    if (y_ + height + more > bottom_) {
      y_ = top_;
      column_++;
    }
    ImGui::SetCursorPos(ImVec2(left_ + float(column_) * width_, y_));
    y_ += height;
  }
  float x() const { return left_ + float(column_) * width_; }
  int used() const { return column_ + 1; }

 private:
  float width_, bottom_, top_, left_ = 0, y_ = -1;
  int column_ = 0;
};

float heightOf(const std::string& text, float room) {
  return ImGui::CalcTextSize(text.c_str(), nullptr, false, room).y + 4;
}

void showTitle(Columns& columns, const char* text) {
  const float line = ImGui::GetTextLineHeight();
  columns.begin(line + 10, 2 * line);
  ImGui::SetCursorPosY(ImGui::GetCursorPosY() + 6);
  ImGui::PushFont(headingFont());
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

void showLine(Columns& columns, std::string_view name, std::string_view help, float room, float indent) {
  const std::string text(help);
  columns.begin(heightOf(text, room - indent));
  const float y = ImGui::GetCursorPosY(), x = columns.x();
  ImGui::TextColored(ImVec4(0.93f, 0.66f, 0.52f, 1), "%s", std::string(name).c_str());
  ImGui::SetCursorPos(ImVec2(x + indent, y));
  ImGui::PushTextWrapPos(x + room);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
}

int showAll(float width, float height, float scale) {
  Columns columns(width, height);
  const float room = width - 14;
  showTitle(columns, "Mouse");
  for (const MouseBinding& binding : mouseBindings())
    showLine(columns, binding.button, binding.help, room, 140 * scale);
  std::string_view group;
  for (const KeyBinding& binding : keyBindings()) {
    if (binding.group != group) showTitle(columns, std::string(group = binding.group).c_str());
    showLine(columns, binding.key, binding.help, room, 86 * scale);
  }
  return columns.used();
}

}  // namespace

void showHelp(Desk& desk) {
  const ImVec2 size(std::min(1260.0f, float(desk.size.width) - 20), std::min(680.0f, float(desk.size.height) - 20));
  ImGui::SetNextWindowPos(ImVec2(float(desk.size.width) / 2, float(desk.size.height) / 2), 0, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(size);
  // Smaller letters until it fits; in a window that is too small even for these it scrolls.
  static float scale = 1;
  static ImVec2 fitted;
  if (fitted.x != size.x || fitted.y != size.y) scale = 1;
  fitted = size;
  if (ImGui::Begin("Help", &desk.helpShown, ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize)) {
    cover(desk);
    ImGui::SetWindowFontScale(scale);
    const float wide = ImGui::GetContentRegionAvail().x;
    const int columns = std::max(1, int(wide / (kColumnWidth * scale)));
    float height = ImGui::GetContentRegionAvail().y;
    if (scale <= kLeastScale) {
      // As high as it takes.
      ImGui::PushClipRect(ImVec2(0, 0), ImVec2(0, 0), true);
      const ImVec2 from = ImGui::GetCursorPos();
      for (; height < 8000 && showAll(wide / float(columns), height, scale) > columns; height += 40)
        ImGui::SetCursorPos(from);
      ImGui::SetCursorPos(from);
      ImGui::PopClipRect();
    }
    if (showAll(wide / float(columns), height, scale) > columns && scale > kLeastScale) {
      scale = std::max(kLeastScale, scale - 0.05f);
      desk.unsettled = true;
    }
    ImGui::SetWindowFontScale(1);
  }
  ImGui::End();
}

}  // namespace brickfall::viewer
