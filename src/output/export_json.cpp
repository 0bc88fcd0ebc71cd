// One JSON text, frame by frame, so that it may be larger than memory.
#include <nlohmann/json.hpp>

#include "output/export_common.h"
#include "output/role_name.h"
#include "output/take_poses.h"

namespace brickfall {
namespace {

using Json = nlohmann::ordered_json;

std::string textOfValue(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

Json headOf(const TakeReader& take) {
  const TakeHeader& header = take.header();
  Json bodies = Json::array();
  for (std::size_t k = 0; k < take.bodies().size(); k++) {
    const TakeBody& body = take.bodies()[k];
    bodies.push_back({{"name", body.name},
                      {"role", roleName(body.role)},
                      {"material", body.material},
                      {"colour", body.colour},
                      {"mass_kg", body.mass},
                      {"first_frame", take.lives()[k].birth},
                      {"end_frame", take.lives()[k].end}});
  }
  Json series = Json::object();
  for (const TakeColumn& column : seriesOf(take.summaryJson())) series[column.name] = column.values;
  Json summary = Json::parse(take.summaryJson(), nullptr, false);
  if (summary.is_object()) summary.erase("series");
  return {{"scene", header.scene},
          {"title", header.title},
          {"version", header.engineVersion},
          {"seed", header.seed},
          {"frames_per_second", header.framesPerSecond},
          {"complete", take.complete()},
          {"summary", summary.is_object() ? summary : Json(nullptr)},
          {"series", std::move(series)},
          {"bodies", std::move(bodies)}};
}

void appendList(std::string& out, std::initializer_list<double> values) {
  char before = '[';
  for (double value : values) {
    out += before;
    appendNumber(out, value);
    before = ',';
  }
  out += ']';
}

void addFrame(const TakeReader& take, std::size_t index, const TakeFrame& frame, bool poses, std::string& out) {
  out += "{\"frame\":";
  appendNumber(out, index);
  out += ",\"time_s\":";
  appendNumber(out, frame.time);
  if (poses) {
    // Each: body, position, quaternion, speed, contact force.
    out += ",\"poses\":[";
    std::size_t place = 0;
    for (std::uint32_t body : take.bodiesAt(index)) {
      const TakePose& p = frame.poses[place];
      if (place++ > 0) out += ',';
      appendList(out, {double(body), p.position.x, p.position.y, p.position.z, p.rotation.x, p.rotation.y, p.rotation.z,
                       p.rotation.w, double(p.speed), double(p.contactForce)});
    }
    out += ']';
  }
  out += ",\"events\":[";
  for (std::size_t k = 0; k < frame.events.size(); k++) {
    const TakeEvent& event = frame.events[k];
    Json json = {{"event", eventName(event.type)}, {"body_a", event.bodyA}};
    if (event.type == TakeEventType::hit) {
      json["body_b"] = event.bodyB;
      json["point_m"] = {event.pointWorld.x, event.pointWorld.y, event.pointWorld.z};
      json["impulse_n_s"] = event.impulse;
    }
    out += (k > 0 ? "," : "") + textOfValue(json);
  }
  out += "]}";
}

}  // namespace

Status exportJson(const TakeReader& take, const std::string& stem, const ExportOptions& options,
                  const Progress& progress, std::vector<std::string>& files) {
  const std::string path = stem + ".json";
  TextFile file(path);
  if (Status opened = file.open(); !opened) return opened;
  std::string head = textOfValue(headOf(take));
  head.pop_back();
  file.text() += head +
                 ",\n\"pose_columns\":[\"body\",\"x_m\",\"y_m\",\"z_m\",\"qx\",\"qy\",\"qz\",\"qw\",\"speed_m_s\","
                 "\"contact_force_n\"],\n\"frames\":[";
  bool first = true;
  for (std::size_t f = 0; f < take.frameCount(); f++) {
    if (progress && f % 32 == 0 && !progress(double(f) / double(take.frameCount()))) return cancelled(path);
    const Result<TakeFrame> frame = take.frame(f);
    if (!frame) return frame.error();
    const bool poses = f % options.every == 0;
    if (!poses && frame->events.empty()) continue;
    file.text() += first ? "\n" : ",\n";
    first = false;
    addFrame(take, f, *frame, poses, file.text());
    file.flush(false);
  }
  file.text() += "\n]}\n";
  if (Status written = file.commit(); !written) return written;
  files.push_back(path);
  return {};
}

}  // namespace brickfall
