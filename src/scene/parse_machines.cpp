// [[tilt]], [[shake]], [[wind]] and [[blast]].
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "scene/scene_build.h"

namespace brickfall::scene {

namespace {

constexpr std::uintmax_t kMostRecordBytes = 64u << 20;

// The name of a kinematic body of the file, read before; none: everything.
std::string movedBody(SceneBuild& build, TableReader& reader) {
  std::string name;
  if (!reader.text("body", name)) return {};
  std::vector<std::string> known;
  for (const SceneBody& body : build.scene.bodies) {
    if (body.def.type == BodyType::kinematic) known.push_back(body.name);
    if (body.name != name) continue;
    if (body.def.type != BodyType::kinematic)
      reader.error("body", "found \"" + name + "\", which is not kinematic, expected a body of type \"kinematic\"");
    return name;
  }
  reader.error("body", "found \"" + name + "\", expected the name of a kinematic body" + didYouMean(name, known));
  return name;
}

void readDirection(TableReader& reader, const char* key, Vec3& out) {
  if (reader.vector(key, out) && !(lengthSquared(out) > 1e-12))
    reader.error(key, "found a vector of length 0, expected a direction");
}

// By a rate from a time on.
void readRate(TableReader& reader, Track& angle) {
  double from = 0, rate = 0, to = 0;
  reader.number("from", from);
  const bool rated = reader.number("rate_degrees", rate), aimed = reader.number("to_degrees", to);
  if (!reader.has("rate_degrees") || !reader.has("to_degrees"))
    return reader.error("",
                        "found no [[tilt.key]] and not both of rate_degrees and to_degrees, expected one or the other");
  if (!rated || !aimed) return;
  angle.interpolation = Interpolation::linear;
  angle.keys = {{from, 0}};
  if (to != 0) angle.keys.push_back({from + std::fabs(to) / rate, to * kRadians});
}

void readAngles(TableReader& reader, std::vector<TableReader>& tables, Track& angle) {
  for (const char* key : {"from", "rate_degrees", "to_degrees"})
    if (reader.has(key)) reader.error(key, "found beside [[tilt.key]], expected one or the other");
  reader.choice("interpolation", angle.interpolation);
  for (TableReader& at : tables) {
    double time = 0, degrees = 0;
    const bool read = at.number("time", time);
    if (!at.number("degrees", degrees) || !read) continue;
    if (!angle.keys.empty() && !(time > angle.keys.back().first))
      at.error("time", "found " + numberText(time) + " s after a key at " + numberText(angle.keys.back().first) +
                           " s, expected times that ascend");
    else
      angle.keys.push_back({time, degrees * kRadians});
  }
}

// In the order of the choices.
constexpr double kUnits[] = {1, 0.01, 0.001, 9.80665};  // m/s2
constexpr double kTimeUnits[] = {1, 0.001};             // s

// The whole text of a file, or why not.
Result<std::string> wholeText(const std::string& path) {
  std::error_code problem;
  const auto failed = [&](const std::string& what) { return Error{ErrorCode::inputOutput, path + ": " + what}; };
  const std::filesystem::file_status status = std::filesystem::status(path, problem);
  if (!std::filesystem::exists(status)) return failed("there is no such file, expected a record");
  if (!std::filesystem::is_regular_file(status)) return failed("found something else, expected a file");
  if (!(std::filesystem::file_size(path, problem) <= kMostRecordBytes) || problem)
    return failed("found a file of over 64 MiB, expected a smaller record");
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  if (file && file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
  if (!file.is_open() || file.bad() || text.bad()) return failed("the file can't be read");
  return text.str();
}

void readRecord(SceneBuild& build, TableReader& reader, Shake& shake) {
  std::string file;
  int unit = 0, timeUnit = 0;
  RecordFormat format;
  const bool united = reader.choice("unit", unit), named = reader.text("file", file);
  reader.choice("time_unit", timeUnit);
  reader.integer("column", format.column);
  reader.number("scale", shake.amplitude);
  reader.choice("baseline", shake.baseline);
  if (!reader.has("file")) reader.error("file", "not given, expected the file of the record");
  if (!reader.has("unit"))
    reader.error("unit", "not given, expected that of the record: " + expectation(*findKey("shake", "unit")));
  if (!united || !named) return;
  format.unit = kUnits[unit];
  format.timeUnit = kTimeUnits[timeUnit];
  const std::string path = (std::filesystem::path(build.context.file).parent_path() / file).string();
  const Result<std::string> text = wholeText(path);
  if (!text) return reader.error("file", text.error().message);
  Result<AccelerationRecord> record = readAccelerationRecord(*text, path, format);
  if (record)
    shake.record = std::move(record).value();
  else
    reader.error("file", record.error().message);
}

// A key of another signal would silently do nothing.
void refuseKeysOfOtherSignals(TableReader& reader, ShakeSignal signal) {
  const bool record = signal == ShakeSignal::record, sine = signal == ShakeSignal::sine;
  for (const char* key : {"file", "unit", "time_unit", "column", "scale", "baseline"})
    if (!record && reader.has(key)) reader.error(key, "found with another signal, expected it only with \"record\"");
  for (const char* key : {"amplitude", "seconds"})
    if (record && reader.has(key)) reader.error(key, "found with a record, which has its own, expected scale");
  for (const char* key : {"frequency", "ramp"})
    if (!sine && reader.has(key)) reader.error(key, "found with another signal, expected it only with \"sine\"");
}

void readSignal(SceneBuild& build, TableReader& reader, Shake& shake) {
  if (reader.has("signal") && !reader.choice("signal", shake.signal)) return;
  refuseKeysOfOtherSignals(reader, shake.signal);
  if (shake.signal == ShakeSignal::record) return readRecord(build, reader, shake);
  reader.number("amplitude", shake.amplitude);
  reader.number("seconds", shake.seconds);
  if (shake.signal != ShakeSignal::sine) return;
  reader.number("frequency", shake.frequency);
  shake.ramp = std::min(1 / shake.frequency, shake.seconds / 2);
  reader.number("ramp", shake.ramp);
  if (!(shake.ramp <= shake.seconds / 2))
    reader.error("ramp", "found " + numberText(shake.ramp) +
                             " s, expected at most half of seconds = " + numberText(shake.seconds) + " s");
}

}  // namespace

void readTilts(SceneBuild& build, TableReader& top) {
  for (TableReader& reader : top.tables("tilt")) {
    SceneTilt tilt;
    tilt.body = movedBody(build, reader);
    readDirection(reader, "axis", tilt.tilt.axis);
    reader.vector("pivot", tilt.tilt.pivot);
    std::vector<TableReader> keys = reader.tables("key");
    if (keys.empty())
      readRate(reader, tilt.tilt.angle);
    else
      readAngles(reader, keys, tilt.tilt.angle);
    build.scene.tilts.push_back(std::move(tilt));
  }
}

void readShakes(SceneBuild& build, TableReader& top) {
  for (TableReader& reader : top.tables("shake")) {
    const std::size_t before = build.context.diagnostics.size();
    SceneShake shake;
    shake.body = movedBody(build, reader);
    readDirection(reader, "direction", shake.shake.direction);
    reader.number("from", shake.shake.start);
    readSignal(build, reader, shake.shake);
    if (build.context.diagnostics.size() == before)
      if (const auto motion = ShakeMotion::create(shake.shake); !motion) reader.error("", motion.error().message);
    build.scene.shakes.push_back(std::move(shake));
  }
}

void readWinds(SceneBuild& build, TableReader& top) {
  for (TableReader& reader : top.tables("wind")) {
    Wind wind;
    reader.vector("velocity", wind.velocity);
    reader.number("from", wind.from);
    reader.number("until", wind.until);
    reader.number("ramp", wind.ramp);
    reader.number("drag_coefficient", wind.dragCoefficient);
    reader.boolean("shelter", wind.shelter);
    if (!(wind.until > wind.from))
      reader.error("until", "found " + numberText(wind.until) +
                                " s, expected later than from = " + numberText(wind.from) + " s");
    build.scene.winds.push_back(wind);
  }
}

void readBlasts(SceneBuild& build, TableReader& top) {
  for (TableReader& reader : top.tables("blast")) {
    Blast blast;
    reader.vector("centre", blast.centre);
    reader.number("impulse", blast.impulse);
    reader.number("radius", blast.radius);
    reader.number("time", blast.time);
    reader.boolean("occlusion", blast.occlusion);
    build.scene.blasts.push_back(blast);
  }
}

}  // namespace brickfall::scene
