#include "viewer_window/panels/parts.h"

#include <fmt/format.h>
#include <imgui_internal.h>  // TempInputIsActive: which slider is typed into

#include <cmath>
#include <cstdio>
#include <cstring>

#include "viewer_window/gui_style.h"

namespace brickfall::viewer {

void heading(const char* text) {
  ImGui::Dummy(ImVec2(0, 2));
  ImGui::PushFont(headingFont());
  ImGui::TextUnformatted(text);
  ImGui::PopFont();
}

void hint(const std::string& text) {
  if (!ImGui::IsItemHovered() || text.empty()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(360);
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

void row(const char* name, const std::string& value) {
  ImGui::TextDisabled("%s", name);
  ImGui::SameLine(150);
  ImGui::TextUnformatted(value.c_str());
}

void cover(Desk& desk) {
  const ImVec2 from = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
  desk.covers.push_back({from.x, from.y, size.x, size.y});
}

void note(Desk& desk, const char* name) {
  const ImVec2 from = ImGui::GetItemRectMin(), size = ImGui::GetItemRectSize();
  desk.places[name] = {from.x, from.y, size.x, size.y};
}

bool actionButton(Desk& desk, Action action, const char* label, ImVec2 size) {
  const bool pressed = ImGui::Button(label, size);
  const KeyBinding& binding = bindingOf(action);
  hint(fmt::format("{} ({})", binding.help, binding.key));
  note(desk, label);
  if (pressed) desk.actions.push_back(action);
  return pressed;
}

bool slider(const char* label, float& value, float least, float most, const char* format, ImGuiSliderFlags flags) {
  const bool named = label[0] != '#';
  const std::string hidden = named ? "##" + std::string(label) : label;
  // Typing into it (Ctrl and a click) shows the number itself.
  const bool typed = ImGui::TempInputIsActive(ImGui::GetID(hidden.c_str()));
  if (!typed) ImGui::PushStyleColor(ImGuiCol_Text, ImVec4(0, 0, 0, 0));
  const bool moved = ImGui::SliderFloat(hidden.c_str(), &value, least, most, format, flags);
  if (!typed) ImGui::PopStyleColor();
  const ImVec2 from = ImGui::GetItemRectMin(), to = ImGui::GetItemRectMax();
  if (!typed) {
    char text[64];
    std::snprintf(text, sizeof text, format, double(value));
    const bool byRatio = (flags & ImGuiSliderFlags_Logarithmic) != 0 && least > 0;
    const float share =
        byRatio ? std::log(std::max(value, least) / least) / std::log(most / least) : (value - least) / (most - least);
    const ImVec2 size = ImGui::CalcTextSize(text);
    const float x = share < 0.5f ? to.x - size.x - 8 : from.x + 8;
    ImGui::GetWindowDrawList()->AddText(ImVec2(x, (from.y + to.y - size.y) / 2), ImGui::GetColorU32(ImGuiCol_Text),
                                        text);
  }
  if (named) {
    ImGui::GetWindowDrawList()->AddText(
        ImVec2(to.x + ImGui::GetStyle().ItemInnerSpacing.x, from.y + ImGui::GetStyle().FramePadding.y),
        ImGui::GetColorU32(ImGuiCol_Text), label);
  }
  return moved;
}

bool textField(const char* label, std::string& text, const char* whenEmpty) {
  char buffer[512];
  const std::size_t length = std::min(text.size(), sizeof buffer - 1);
  std::memcpy(buffer, text.data(), length);
  buffer[length] = 0;
  const bool entered =
      ImGui::InputTextWithHint(label, whenEmpty, buffer, sizeof buffer, ImGuiInputTextFlags_EnterReturnsTrue);
  text = buffer;
  return entered;
}

std::string numberText(double value, const char* unit) {
  const double size = std::fabs(value);
  std::string text = size != 0 && (size < 1e-3 || size >= 1e6) ? fmt::format("{:.2e}", value)
                     : size >= 100                             ? fmt::format("{:.0f}", value)
                                                               : fmt::format("{:.3g}", value);
  if (*unit) text += std::string(" ") + unit;
  return text;
}

}  // namespace brickfall::viewer
