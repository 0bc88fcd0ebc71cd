// The selected body's numbers.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "viewer_window/panels/panels.h"
#include "viewer_window/panels/parts.h"

namespace brickfall::viewer {
namespace {

std::string forceText(double newton) {
  return newton >= 1e6   ? fmt::format("{:.1f} MN", newton / 1e6)
         : newton >= 1e3 ? fmt::format("{:.2f} kN", newton / 1e3)
                         : fmt::format("{:.1f} N", newton);
}

std::string placeText(Vec3 at) { return fmt::format("{:.2f}  {:.2f}  {:.2f} m", at.x, at.y, at.z); }

// All points of one other body together.
struct Touching {
  Serial other = 0;
  std::string name;
  int points = 0;
  Vec3 place, friction;  // place: the points' mean, by their force
  double force = 0;      // N
};
// The strongest first: so they are numbered in the table and in the picture.
std::vector<Touching> touchingOf(const SelectedBody& body) {
  std::vector<Touching> all;
  for (const SelectedContact& contact : *body.contacts) {
    auto at = std::find_if(all.begin(), all.end(), [&](const Touching& t) { return t.other == contact.other; });
    if (at == all.end()) at = all.insert(all.end(), Touching{contact.other, contact.otherName, 0, {}, {}, 0});
    at->points++;
    at->place += contact.point * contact.normalForce;
    at->friction += contact.frictionForce;
    at->force += contact.normalForce;
  }
  for (Touching& touching : all) touching.place = touching.place * (1 / touching.force);
  std::stable_sort(all.begin(), all.end(), [](const Touching& a, const Touching& b) { return a.force > b.force; });
  return all;
}

void showContacts(Desk& desk, const std::vector<Touching>& contacts) {
  heading(fmt::format("Contacts: {}", contacts.size()).c_str());
  if (contacts.empty() || !ImGui::BeginTable("contacts", 4, ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg)) return;
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthFixed, 20);
  ImGui::TableSetupColumn("on", ImGuiTableColumnFlags_WidthStretch);
  ImGui::TableSetupColumn("normal", ImGuiTableColumnFlags_WidthFixed, 78);
  ImGui::TableSetupColumn("friction", ImGuiTableColumnFlags_WidthFixed, 78);
  ImGui::TableHeadersRow();
  int number = 0;
  for (const Touching& contact : contacts) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::Text("%d", ++number);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(contact.name.c_str());
    note(desk, fmt::format("contact {}: {}, {}", number, contact.name, forceText(contact.force)).c_str());
    hint(fmt::format("{} at {} points", contact.name, contact.points));
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(forceText(contact.force).c_str());
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(forceText(length(contact.friction)).c_str());
  }
  ImGui::EndTable();
}

constexpr std::size_t kMostNumbers = 40;  // more would hide what they name

}  // namespace

void showContactNumbers(const Desk& desk, const Frame& frame) {
  const SelectedBody& body = *frame.selected;
  if (!body.contacts) return;
  const std::vector<Touching> contacts = touchingOf(body);
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const Viewport port{desk.size.width, desk.size.height};
  std::vector<ImVec2> taken;
  for (std::size_t i = 0; i < std::min(kMostNumbers, contacts.size()); i++) {
    const std::optional<PixelPlace> seen = pixelOf(desk.rig.view(), port, contacts[i].place);
    if (!seen) continue;
    const ImVec2 at(float(seen->x + desk.shift.x), float(seen->y + desk.shift.y));
    ImVec2 middle = at;
    // One below the other where several meet.
    for (const ImVec2& other : taken)
      if (std::abs(other.x - middle.x) < 16 && std::abs(other.y - middle.y) < 16) middle.y = other.y + 17;
    taken.push_back(middle);
    const std::string text = std::to_string(i + 1);
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    list.AddCircleFilled(at, 2.5f, IM_COL32(255, 235, 120, 255));
    list.AddCircleFilled(middle, 9, IM_COL32(20, 22, 26, 215));
    list.AddText(ImVec2(middle.x - size.x / 2, middle.y - size.y / 2), IM_COL32(255, 235, 120, 255), text.c_str());
  }
}

void showBody(Desk& desk, const Frame& frame) {
  const SelectedBody& body = *frame.selected;
  const float width = 310, room = float(desk.size.height) - kBarHeight - 30;
  ImGui::SetNextWindowPos(ImVec2(float(desk.size.width) - width - 10, 10));
  ImGui::SetNextWindowSize(ImVec2(width, std::min(room, !body.contacts           ? 215.0f
                                                        : body.contacts->empty() ? 300.0f
                                                                                 : 470.0f)));
  bool open = true;
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                      ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings;
  if (ImGui::Begin((body.name + "###body").c_str(), &open, kFlags)) {
    cover(desk);
    note(desk, "body");
    if (!body.material.empty()) row("Material", body.material);
    row("Mass", body.mass > 0 ? numberText(body.mass, "kg") : "fixed");
    row("Speed", fmt::format("{:.3f} m/s", body.speed));
    row("Spin", fmt::format("{:.2f} rad/s", body.spin));
    if (body.surfaceSpeed > 0) row("Surface runs", fmt::format("{:.2f} m/s", body.surfaceSpeed));
    if (body.kineticEnergy) row("Kinetic energy", numberText(*body.kineticEnergy, "J"));
    row(body.kineticEnergy ? "Centre of mass" : "Position", placeText(body.centreOfMass));
    if (body.acceleration) row("Acceleration", fmt::format("{:.2f} m/s2", length(*body.acceleration)));
    if (body.contactForce) row("Pressed with", forceText(*body.contactForce));
    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    actionButton(desk, Action::followSelected, "Follow it", ImVec2(half, 0));
    const int place = frame.list->find(body.serial);
    const bool ground = place >= 0 && frame.list->bodies[std::size_t(place)].role == BodyRole::ground;
    if (frame.info->kind == RunKind::live && !ground) {
      ImGui::SameLine();
      actionButton(desk, Action::removeSelected, "Remove it", ImVec2(half, 0));
    }
    if (!body.mortar.empty()) {
      heading("Mortar");
      ImGui::PushTextWrapPos(0);
      for (const std::string& line : body.mortar) ImGui::TextUnformatted(line.c_str());
      ImGui::PopTextWrapPos();
    }
    if (body.contacts) showContacts(desk, touchingOf(body));
  }
  ImGui::End();
  if (!open) desk.send(Select{0});
}

}  // namespace brickfall::viewer
