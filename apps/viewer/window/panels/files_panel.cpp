// The list of files that can be opened, with the cursor in its field.
#include <fmt/format.h>

#include <algorithm>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

constexpr const char* kKindNames[] = {"Opened last", "Scenes", "Takes", "Saved states"};  // by FileKind

void openFile(Desk& desk, const std::string& path) {
  desk.send(Open{path, {}, false});
  desk.filesShown = false;
}

std::vector<const FileEntry*> fitting(const Desk& desk) {
  std::vector<const FileEntry*> out;
  for (const FileEntry& entry : desk.files)
    if (fits(entry, desk.filesTyped)) out.push_back(&entry);
  return out;
}

void showField(Desk& desk) {
  // The cursor stays here: a click elsewhere in the list must not make commands of what is typed.
  if (desk.filesAsked || (!ImGui::IsAnyItemActive() && !ImGui::IsMouseDown(0))) {
    ImGui::SetKeyboardFocusHere();
    desk.awaitsText = true;
  }
  ImGui::SetNextItemWidth(-1);
  const std::string before = desk.filesTyped;
  const bool entered =
      textField("##typed", desk.filesTyped, "type a part of its name, the name of a shipped scene, or a path");
  note(desk, "files field");
  if (desk.filesTyped != before) desk.filesChosen = 0;
  const std::vector<const FileEntry*> shown = fitting(desk);  // the last letters may have come with Enter
  const int last = std::max(0, int(shown.size()) - 1);
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_DownArrow))) desk.filesChosen++;
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_UpArrow))) desk.filesChosen--;
  desk.filesChosen = std::clamp(desk.filesChosen, 0, last);
  if (!entered) return;
  if (!shown.empty()) {
    openFile(desk, shown[std::size_t(desk.filesChosen)]->path);
  } else if (!desk.filesTyped.empty()) {
    openFile(desk, desk.filesTyped);
  }
}

void showList(Desk& desk, const std::vector<const FileEntry*>& shown) {
  if (shown.empty()) ImGui::TextDisabled("No file here fits. Enter opens what is typed.");
  for (std::size_t i = 0; i < shown.size(); i++) {
    const FileEntry& entry = *shown[i];
    if (i == 0 || shown[i - 1]->kind != entry.kind) heading(kKindNames[int(entry.kind)]);
    const bool chosen = int(i) == desk.filesChosen;
    ImGui::PushID(int(i));
    if (ImGui::Selectable(entry.path.c_str(), chosen)) openFile(desk, entry.path);
    if (i < 20) note(desk, ("file:" + entry.path).c_str());
    if (chosen && !desk.filesTyped.empty()) ImGui::SetScrollHereY();
    ImGui::PopID();
  }
}

}  // namespace

void showFiles(Desk& desk) {
  const ImVec2 size(std::min(640.0f, float(desk.size.width) - 40), std::min(460.0f, float(desk.size.height) - 40));
  ImGui::SetNextWindowPos(ImVec2(float(desk.size.width) / 2, float(desk.size.height) / 2), 0, ImVec2(0.5f, 0.5f));
  ImGui::SetNextWindowSize(size);
  if (desk.filesAsked) ImGui::SetNextWindowFocus();
  bool open = true;
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin("Open", &open, kFlags)) {
    cover(desk);
    if (desk.filesAsked) desk.filesTyped.clear(), desk.filesChosen = 0;
    showField(desk);
    ImGui::BeginChild("files", ImVec2(0, -ImGui::GetTextLineHeightWithSpacing()));
    showList(desk, fitting(desk));
    ImGui::EndChild();
    ImGui::TextDisabled("Enter opens the marked one, arrows move the mark, Escape closes");
  }
  ImGui::End();
  desk.filesAsked = false;
  if (!open) desk.filesShown = false;
}

}  // namespace brickfall::viewer
