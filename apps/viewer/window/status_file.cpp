#include "viewer_window/status_file.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>

namespace brickfall::viewer {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += static_cast<unsigned char>(c) < 32 ? ' ' : c;
  }
  return out + "\"";
}

std::string placesText(const Desk& desk) {
  std::string out;
  for (const auto& [name, place] : desk.places) {
    out += fmt::format("{}{}:[{:.0f},{:.0f},{:.0f},{:.0f}]", out.empty() ? "" : ",", quoted(name), place.x, place.y,
                       place.width, place.height);
  }
  return "{" + out + "}";
}

std::string viewsText(const ViewOptions& view) {
  std::string out;
  for (const auto& [on, name] : {std::pair{view.collisions, "collisions"},
                                 {view.wireframe, "wireframe"},
                                 {view.colliders, "colliders"},
                                 {view.bounds, "bounds"},
                                 {view.contacts, "contacts"},
                                 {view.islands, "islands"},
                                 {view.asleep, "asleep"},
                                 {view.mortar == MortarView::utilisation, "mortar utilisation"},
                                 {view.mortar == MortarView::damage, "mortar damage"}}) {
    if (on) out += (out.empty() ? "" : ",") + quoted(name);
  }
  return "[" + out + "]";
}

std::string messagesText(const Desk& desk) {
  std::string out;
  for (const Message& message : desk.messages) out += (out.empty() ? "" : ",") + quoted(message.text);
  return "[" + out + "]";
}

}  // namespace

Result<StatusFile> StatusFile::open(const std::string& path) {
  StatusFile status;
  if (path.empty()) return status;
  status.file_.reset(std::fopen(path.c_str(), "w"));
  if (!status.file_) {
    return Error{ErrorCode::inputOutput, path + ": cannot be written: " + std::strerror(errno)};
  }
  return status;
}

void StatusFile::write(const std::string& why, const Desk& desk, const Frame& frame, std::uint64_t pictures,
                       std::size_t lines) {
  if (!file_) return;
  const RunStatus& run = frame.status;
  const auto shadows = desk.shadows == ShadowMode::stencil ? "stencil"
                       : desk.shadows == ShadowMode::depth ? "depth"
                                                           : "none";
  std::string text = fmt::format(
      R"({{"why":{},"pictures":{},"scene":{},"step":{},"time":{:.6f},"earliest":{:.6f},"latest":{:.6f},)", quoted(why),
      pictures, quoted(frame.info ? frame.info->name : ""), run.step, run.time, run.earliest, run.latest);
  text += fmt::format(R"("running":{},"speed":{:.4g},"loading":{},"recording":{},"undo":{},"bodies":{},"selected":{},)",
                      run.running, run.speed, quoted(run.loading), quoted(run.recording), quoted(run.undo),
                      frame.bodies.size(), frame.selected ? frame.selected->serial : 0);
  const Vec3 eye = desk.rig.view().position;
  text +=
      fmt::format(R"("tool":{},"dragging":{},"camera":[{:.4f},{:.4f},{:.4f}],"shadows":"{}","views":{},"lines":{},)",
                  quoted(nameOf(desk.hand.tool)), frame.drag.has_value(), eye.x, eye.y, eye.z, shadows,
                  viewsText(desk.view), lines);
  text += fmt::format(
      R"("resting":{},"files":{},"typed":{},"size":[{},{}],"fps":{:.1f},"draw_ms":{:.2f},"messages":{},"places":{}}})",
      desk.resting, desk.filesShown, quoted(desk.filesTyped), desk.size.width, desk.size.height, desk.framesPerSecond,
      desk.drawMilliseconds, messagesText(desk), placesText(desk));
  std::fprintf(file_.get(), "%s\n", text.c_str());
  std::fflush(file_.get());
}

}  // namespace brickfall::viewer
