// What the mouse does to the scene, the camera, and files.
#include <fmt/format.h>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

bool heldValue(const char* label, double& value, double least, double most, const char* format, bool logarithmic) {
  auto shown = float(value);
  if (!slider(label, shown, float(least), float(most), format,
              (logarithmic ? ImGuiSliderFlags_Logarithmic : 0) | ImGuiSliderFlags_AlwaysClamp)) {
    return false;
  }
  value = shown;
  return true;
}

void showToolChoice(Desk& desk) {
  heading("The left button");
  const float width = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
  constexpr Action kActions[kToolCount] = {Action::selectTool, Action::shootTool, Action::dragTool,
                                           Action::removeTool, Action::blastTool, Action::cutTool};
  for (int i = 0; i < kToolCount; i++) {
    if (i % 3 != 0) ImGui::SameLine();
    const bool chosen = int(desk.hand.tool) == i;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
    actionButton(desk, kActions[i], nameOf(Tool(i)), ImVec2(width, 0));
    if (chosen) ImGui::PopStyleColor();
  }
}

void showBall(Desk& desk, const Frame& frame) {
  ToolSettings& settings = desk.hand.settings;
  heading("The ball");
  ImGui::PushItemWidth(170);
  double diameter = settings.ballRadius * 2000;
  if (heldValue("Diameter", diameter, 2000 * kLeastBall, 1000, "%.0f mm", true)) settings.ballRadius = diameter / 2000;
  note(desk, "ball diameter");
  heldValue("Speed", settings.ballSpeed, 0, 60, "%.1f m/s", false);
  note(desk, "ball speed");
  if (ImGui::BeginCombo("Material", settings.ballMaterial.c_str())) {
    std::vector<std::string> names;
    for (const MaterialRow& material : frame.materials) names.push_back(material.name);
    for (const MaterialDef& material : predefinedMaterials()) {
      if (std::find(names.begin(), names.end(), material.name) == names.end()) names.push_back(material.name);
    }
    for (const std::string& name : names) {
      if (ImGui::Selectable(name.c_str(), name == settings.ballMaterial)) settings.ballMaterial = name;
    }
    ImGui::EndCombo();
  }
  if (desk.hand.tool == Tool::drag) {
    heading("The spring");
    heldValue("Strength", settings.dragStrength, 1, 1000, "%.0f weights", true);
  }
  if (desk.hand.tool == Tool::blast) {
    heading("The blast");
    heldValue("Impulse", settings.blastImpulse, 1, 1e6, "%.0f N s", true);
    heldValue("Radius", settings.blastRadius, 0.1, 100, "%.1f m", true);
  }
  ImGui::PopItemWidth();
}

void showCamera(Desk& desk, const Frame& frame) {
  heading("Camera");
  constexpr std::pair<CameraMode, const char*> kModes[] = {{CameraMode::orbit, "Orbit"}, {CameraMode::fly, "Fly"}};
  for (const auto& [mode, label] : kModes) {
    const bool chosen = desk.rig.mode() == mode;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
    actionButton(desk, mode == CameraMode::orbit ? Action::orbitCamera : Action::flyCamera, label);
    if (chosen) ImGui::PopStyleColor();
    ImGui::SameLine();
  }
  const bool follows = desk.rig.mode() == CameraMode::follow;
  if (follows) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_TabActive));
  actionButton(desk, Action::followSelected, "Follow");
  if (follows) ImGui::PopStyleColor();
  ImGui::SameLine();
  actionButton(desk, Action::frameAll, "All");
  if (!frame.info) return;
  for (std::size_t i = 0; i < frame.info->cameras.size(); i++) {
    const Camera& camera = frame.info->cameras[i];
    if (i % 4 != 0) ImGui::SameLine();
    ImGui::PushID(int(i));
    if (ImGui::SmallButton(camera.name.c_str())) desk.rig.goTo(camera, false, frame.list.get());
    hint("A view that the scene file saved");
    ImGui::PopID();
  }
}

}  // namespace

void showTools(Desk& desk, const Frame& frame) {
  showToolChoice(desk);
  showBall(desk, frame);
  showCamera(desk, frame);

  heading("This moment");
  const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  const std::string undo = frame.status.undo.empty() ? "Nothing to undo" : "Undo " + frame.status.undo;
  ImGui::PushID("undo");
  if (ImGui::Button((undo + "###undo").c_str(), ImVec2(half, 0)) && !frame.status.undo.empty()) desk.send(Undo{});
  note(desk, "Undo");
  ImGui::PopID();
  ImGui::SameLine();
  actionButton(desk, Action::wakeAll, "Wake all", ImVec2(half, 0));

  heading("Files");
  ImGui::SetNextItemWidth(-1);
  textField("##state", desk.statePath, "file for the state");
  actionButton(desk, Action::saveState, "Save state", ImVec2(half, 0));
  ImGui::SameLine();
  actionButton(desk, Action::loadState, "Load state", ImVec2(half, 0));
  actionButton(desk, Action::saveScene, "Save as a scene", ImVec2(-1, 0));
  ImGui::SetNextItemWidth(-1);
  textField("##take", desk.takePath, "file for the take");
  const bool records = !frame.status.recording.empty();
  actionButton(desk, Action::record, records ? "Stop recording" : "Record", ImVec2(half, 0));
  ImGui::SameLine();
  actionButton(desk, Action::saveStill, "Save still", ImVec2(half, 0));
}

}  // namespace brickfall::viewer
