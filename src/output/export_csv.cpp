// Tables of text: the first line names the columns, with units; decimal points, commas between (RFC 4180).
#include "output/export_common.h"
#include "output/role_name.h"
#include "output/take_poses.h"

namespace brickfall {
namespace {

void appendField(std::string& out, std::string_view field) {
  if (field.find_first_of(",\"\r\n") == std::string_view::npos) {
    out += field;
    return;
  }
  out += '"';
  for (char c : field) {
    if (c == '"') out += '"';
    out += c;
  }
  out += '"';
}

// Numbers, each after a comma.
template <class... T> void appendNumbers(std::string& out, T... values) {
  ((out += ',', appendNumber(out, values)), ...);
}

void addBodies(const TakeReader& take, std::string& out) {
  out += "body,name,role,material,colour,mass_kg,first_frame,end_frame\n";
  for (std::size_t k = 0; k < take.bodies().size(); k++) {
    const TakeBody& body = take.bodies()[k];
    appendNumber(out, k);
    for (std::string_view field :
         {std::string_view(body.name), std::string_view(roleName(body.role)), std::string_view(body.material)}) {
      out += ',';
      appendField(out, field);
    }
    char colour[16];
    std::snprintf(colour, sizeof colour, ",#%06X", unsigned(body.colour & 0xFFFFFF));
    out += colour;
    appendNumbers(out, body.mass, take.lives()[k].birth, take.lives()[k].end);
    out += '\n';
  }
}

void addSeries(const std::vector<TakeColumn>& series, std::string& out) {
  for (std::size_t k = 0; k < series.size(); k++) out += (k > 0 ? "," : "") + series[k].name;
  out += '\n';
  const std::size_t rows = series.empty() ? 0 : series[0].values.size();
  for (std::size_t i = 0; i < rows; i++) {
    for (std::size_t k = 0; k < series.size(); k++) {
      if (k > 0) out += ',';
      appendNumber(out, series[k].values[i]);
    }
    out += '\n';
  }
}

void addPoses(const TakeReader& take, std::size_t index, const TakeFrame& frame, std::string& out) {
  std::size_t place = 0;
  for (std::uint32_t body : take.bodiesAt(index)) {
    const TakePose& p = frame.poses[place++];
    appendNumber(out, index);
    appendNumbers(out, frame.time, body, p.position.x, p.position.y, p.position.z, p.rotation.x, p.rotation.y,
                  p.rotation.z, p.rotation.w, p.speed, p.contactForce);
    out += '\n';
  }
}

void addEvents(std::size_t index, const TakeFrame& frame, std::string& out) {
  for (const TakeEvent& event : frame.events) {
    appendNumber(out, index);
    appendNumbers(out, frame.time);
    out += ',';
    out += eventName(event.type);
    appendNumbers(out, event.bodyA);
    out += ',';
    if (event.type == TakeEventType::hit) {
      appendNumber(out, event.bodyB);
      appendNumbers(out, event.pointWorld.x, event.pointWorld.y, event.pointWorld.z, event.impulse);
    } else {
      out += ",,,,";
    }
    out += '\n';
  }
}

}  // namespace

Status exportCsv(const TakeReader& take, const std::string& stem, const ExportOptions& options,
                 const Progress& progress, std::vector<std::string>& files) {
  const std::string names[] = {stem + ".bodies.csv", stem + ".poses.csv", stem + ".events.csv", stem + ".series.csv"};
  const std::vector<TakeColumn> columns = seriesOf(take.summaryJson());
  TextFile bodies(names[0]), poses(names[1]), events(names[2]), series(names[3]);
  for (TextFile* file : {&bodies, &poses, &events})
    if (Status opened = file->open(); !opened) return opened;
  if (!columns.empty())
    if (Status opened = series.open(); !opened) return opened;
  addBodies(take, bodies.text());
  addSeries(columns, series.text());
  poses.text() += "frame,time_s,body,x_m,y_m,z_m,qx,qy,qz,qw,speed_m_s,contact_force_n\n";
  events.text() += "frame,time_s,event,body_a,body_b,x_m,y_m,z_m,impulse_n_s\n";
  for (std::size_t f = 0; f < take.frameCount(); f++) {
    if (progress && f % 32 == 0 && !progress(double(f) / double(take.frameCount()))) return cancelled(stem);
    const Result<TakeFrame> frame = take.frame(f);
    if (!frame) return frame.error();
    if (f % options.every == 0) addPoses(take, f, *frame, poses.text());
    addEvents(f, *frame, events.text());
    poses.flush(false);
    events.flush(false);
  }
  for (TextFile* file : {&bodies, &poses, &events}) {
    if (Status written = file->commit(); !written) return written;
    files.push_back(names[files.size()]);
  }
  if (columns.empty()) return {};
  if (Status written = series.commit(); !written) return written;
  files.push_back(names[3]);
  return {};
}

}  // namespace brickfall
