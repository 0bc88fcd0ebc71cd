#include "viewer_window/gui_style.h"

#include <imgui.h>

#include <filesystem>

namespace brickfall::viewer {
namespace {

constexpr float kTextSize = 15, kHeadingSize = 16;  // pixels
ImFont* boldFont = nullptr;

// A font of the system; ImGui brings one, which is legible but coarse.
ImFont* fontFrom(const char* path, float size) {
  ImGuiIO& io = ImGui::GetIO();
  std::error_code problem;
  if (std::filesystem::is_regular_file(path, problem)) return io.Fonts->AddFontFromFileTTF(path, size);
  return io.Fonts->AddFontDefault();
}

ImVec4 shade(int colour, float alpha = 1) {
  return ImVec4(float(colour >> 16 & 255) / 255, float(colour >> 8 & 255) / 255, float(colour & 255) / 255, alpha);
}

}  // namespace

ImFont* headingFont() { return boldFont; }

void useStyle() {
  fontFrom("/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", kTextSize);
  boldFont = fontFrom("/usr/share/fonts/truetype/dejavu/DejaVuSans-Bold.ttf", kHeadingSize);
  ImGui::StyleColorsDark();
  ImGuiStyle& style = ImGui::GetStyle();
  style.WindowRounding = style.ChildRounding = style.PopupRounding = 6;
  style.FrameRounding = style.GrabRounding = style.TabRounding = 4;
  style.WindowBorderSize = 0;
  style.WindowPadding = ImVec2(12, 10);
  style.FramePadding = ImVec2(8, 4);
  style.ItemSpacing = ImVec2(8, 6);
  style.ScrollbarSize = 12;
  const int kBack = 0x1B1E23, kFrame = 0x343A44, kHover = 0x434B58, kAccent = 0xC8623F, kAccentLight = 0xE07A54;
  auto* colours = style.Colors;
  colours[ImGuiCol_WindowBg] = shade(kBack, 0.93f);
  colours[ImGuiCol_PopupBg] = shade(kBack, 0.98f);
  colours[ImGuiCol_MenuBarBg] = shade(kBack, 0.96f);
  colours[ImGuiCol_Text] = shade(0xE8E6E3);
  colours[ImGuiCol_TextDisabled] = shade(0x9AA0A8);
  colours[ImGuiCol_FrameBg] = colours[ImGuiCol_Button] = shade(kFrame);
  colours[ImGuiCol_FrameBgHovered] = colours[ImGuiCol_ButtonHovered] = shade(kHover);
  colours[ImGuiCol_FrameBgActive] = shade(kHover);
  colours[ImGuiCol_ButtonActive] = colours[ImGuiCol_SliderGrabActive] = shade(kAccentLight);
  colours[ImGuiCol_SliderGrab] = shade(kAccent, 0.75f);  // the number shows through
  colours[ImGuiCol_CheckMark] = shade(kAccentLight);
  colours[ImGuiCol_TitleBg] = colours[ImGuiCol_TitleBgActive] = colours[ImGuiCol_TitleBgCollapsed] = shade(kFrame);
  colours[ImGuiCol_Header] = shade(kFrame);
  colours[ImGuiCol_HeaderHovered] = colours[ImGuiCol_TabHovered] = shade(kHover);
  colours[ImGuiCol_HeaderActive] = shade(kAccent);
  colours[ImGuiCol_Tab] = shade(kBack);
  colours[ImGuiCol_TabActive] = shade(kAccent);
  colours[ImGuiCol_PlotLines] = colours[ImGuiCol_PlotHistogram] = shade(kAccentLight);
  colours[ImGuiCol_Separator] = shade(kHover);
}

}  // namespace brickfall::viewer
