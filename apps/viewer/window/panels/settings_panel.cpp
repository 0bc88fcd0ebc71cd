// Every setting of the world and of materials. A change goes off when the slider is let go, so that it is one step to undo.
#include <fmt/format.h>

#include <cmath>
#include <map>

#include "viewer_core/settings_table.h"
#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

// What a slider shows while it is held: frames go on bringing the old value.
std::map<std::string, float> held;

// True when it was let go at another value.
bool heldSlider(const std::string& key, double& value, double least, double most, const std::string& format,
                bool logarithmic) {
  const auto at = held.find(key);
  float shown = at != held.end() ? at->second : float(value);
  const bool moved = slider(("##" + key).c_str(), shown, float(least), float(most), format.c_str(),
                            logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
  if (moved) held[key] = shown;
  if (ImGui::IsItemDeactivatedAfterEdit() || (moved && !ImGui::IsItemActive())) {
    held.erase(key);
    value = shown;
    return true;
  }
  if (!ImGui::IsItemActive()) held.erase(key);
  return false;
}

const char* formatOf(const SettingRow& row) {
  const double most = std::max(std::fabs(row.usualLeast), std::fabs(row.usualMost));
  if (row.kind == SettingKind::whole) return "%.0f";
  return row.logarithmic ? "%.3g" : most >= 100 ? "%.0f" : most >= 1 ? "%.2f" : "%.4f";
}

void changed(Desk& desk, const SettingRow& row, double value) {
  if (row.kind == SettingKind::whole) value = std::round(value);
  desk.send(ChangeSetting{std::string(row.key), std::min(std::max(value, row.least), row.most)});
}

void showSetting(Desk& desk, const SettingRow& row, double value) {
  const std::string key(row.key), label(row.label);
  ImGui::PushID(key.c_str());
  if (row.kind == SettingKind::onOff) {
    bool on = value != 0;
    if (ImGui::Checkbox(label.c_str(), &on)) changed(desk, row, on ? 1 : 0);
  } else {
    ImGui::TextDisabled("%s%s", label.c_str(), row.live ? "" : "  *");
    hint(std::string(row.help));
    ImGui::SetNextItemWidth(-1);
    if (row.kind == SettingKind::choice) {
      const auto chosen = std::size_t(std::max(value, 0.0));
      const std::string now(chosen < row.choices.size() ? row.choices[chosen] : "");
      if (ImGui::BeginCombo("##choice", now.c_str())) {
        for (std::size_t i = 0; i < row.choices.size(); i++) {
          if (ImGui::Selectable(std::string(row.choices[i]).c_str(), i == chosen)) changed(desk, row, double(i));
        }
        ImGui::EndCombo();
      }
    } else {
      const std::string format = std::string(formatOf(row)) + (row.unit.empty() ? "" : " " + std::string(row.unit));
      if (heldSlider(key, value, row.usualLeast, row.usualMost, format, row.logarithmic)) changed(desk, row, value);
    }
  }
  note(desk, ("setting:" + key).c_str());
  hint(std::string(row.help) + (row.live ? "" : " Acts from the next restart on."));
  ImGui::PopID();
}

void showMaterials(Desk& desk, const Frame& frame) {
  for (const MaterialRow& material : frame.materials) {
    ImGui::PushID(material.name.c_str());
    const std::uint32_t c = material.colour;
    const ImVec4 colour(float(c >> 16 & 255) / 255, float(c >> 8 & 255) / 255, float(c & 255) / 255, 1);
    ImGui::ColorButton("##colour", colour, ImGuiColorEditFlags_NoTooltip, ImVec2(16, 16));
    ImGui::SameLine();
    ImGui::Text("%s", material.name.c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("(%d shapes)", material.shapes);
    ChangeMaterial change{material.name, material.density, material.friction, material.restitution,
                          material.rollingResistance};
    ImGui::PushItemWidth(-1);
    bool send = heldSlider(material.name + ".density", change.density, 100, 12000, "density %.0f kg/m3", true);
    send = heldSlider(material.name + ".friction", change.friction, 0, 2, "friction %.2f", false) || send;
    note(desk, ("friction:" + material.name).c_str());
    send = heldSlider(material.name + ".restitution", change.restitution, 0, 1, "restitution %.2f", false) || send;
    send = heldSlider(material.name + ".rolling", change.rollingResistance, 0, 0.5, "rolling resistance %.3f", false) ||
           send;
    ImGui::PopItemWidth();
    if (send) desk.send(change);
    ImGui::PopID();
  }
}

}  // namespace

void showSettings(Desk& desk, const Frame& frame) {
  const auto rows = settingRows();
  if (frame.settings.size() != rows.size()) {
    ImGui::TextWrapped("A take is what has happened: its settings are past changing. Open a scene to change its own.");
    return;
  }
  if (frame.status.settingsWait > 0) {
    ImGui::TextWrapped("%d changed settings act from the next restart on.", int(frame.status.settingsWait));
    actionButton(desk, Action::restart, "Restart now", ImVec2(-1, 0));
  }
  std::string_view group;
  bool open = false, report = false;
  for (std::size_t i = 0; i < rows.size(); i++) {
    // Of the report's system only whether it is wanted, until it is.
    if (rows[i].key == "method") report = frame.settings[i] != 0;
    if (rows[i].group == "Report" && rows[i].key != "method" && !report) continue;
    if (rows[i].group != group) {
      group = rows[i].group;
      // The solver's are for those who know what they look for.
      open =
          ImGui::CollapsingHeader(std::string(group).c_str(), group == "Solver" ? 0 : ImGuiTreeNodeFlags_DefaultOpen);
      note(desk, ("group:" + std::string(group)).c_str());
    }
    if (open) showSetting(desk, rows[i], frame.settings[i]);
  }
  if (!frame.materials.empty() && ImGui::CollapsingHeader("Materials", ImGuiTreeNodeFlags_DefaultOpen)) {
    showMaterials(desk, frame);
  }
  ImGui::TextDisabled("* acts from the next restart on");
  if (ImGui::Button("As in the file", ImVec2(-1, 0))) desk.send(Restart{true});
  hint("Restart with all settings of the scene file");
}

}  // namespace brickfall::viewer
