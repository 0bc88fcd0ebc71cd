// All machines of a world, each step.
#include <algorithm>
#include <cmath>

#include "brickfall/machines.h"
#include "machines/faults.h"

namespace brickfall {

namespace {

using machines::Fields;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kLate = 1e-9;     // s: a step that begins so little before its time counts as on time
constexpr double kArrived = 1e-9;  // of its place in m, and rad: so near a body stands where it is to be

template <class Keys, class TimeOf> void checkTimes(Fields& check, const char* field, const Keys& keys, TimeOf timeOf) {
  check.condition(!keys.empty(), field, "no key", "at least one");
  for (std::size_t k = 0; k < keys.size(); k++)
    check.condition(
        std::fabs(timeOf(keys[k])) <= machines::kLatest && (k == 0 || timeOf(keys[k]) > timeOf(keys[k - 1])),
        field + std::string("[") + std::to_string(k) + "].time", std::to_string(timeOf(keys[k])), "times that ascend");
}

Status checkPath(const MotionPath& path) {
  Fields check;
  checkTimes(check, "keys", path.keys, [](const MotionKey& key) { return key.time; });
  for (std::size_t k = 0; k < path.keys.size(); k++) {
    const MotionKey& key = path.keys[k];
    const std::string at = "keys[" + std::to_string(k) + "]";
    const double far = std::max({std::fabs(key.position.x), std::fabs(key.position.y), std::fabs(key.position.z)});
    check.condition(isFinite(key.position) && far <= machines::kFarthest, at + ".position", std::to_string(far),
                    "finite, within " + std::to_string(machines::kFarthest) + " m");
    const Quat q = key.rotation;
    const double size = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    check.condition(size > 1e-12 && size < 1e12, at + ".rotation", "length^2 " + std::to_string(size), "a rotation");
    if (k == 0 || !check.status()) continue;
    const double speed = length(key.position - path.keys[k - 1].position) / (key.time - path.keys[k - 1].time);
    check.condition(speed <= machines::kFastest, at + ".time", "a move at " + std::to_string(speed) + " m/s",
                    "at most " + std::to_string(machines::kFastest) + " m/s");
  }
  return check.status();
}

Status checkTilt(const Tilt& tilt) {
  Fields check;
  const double size = length(tilt.axis);
  check.condition(size > 1e-9 && size < 1e9, "axis", "a vector of length " + std::to_string(size), "an axis");
  check.condition(isFinite(tilt.pivot) && length(tilt.pivot) <= machines::kFarthest, "pivot",
                  std::to_string(length(tilt.pivot)) + " m away", "a point within reach");
  checkTimes(check, "angle.keys", tilt.angle.keys, [](const auto& key) { return key.first; });
  for (const auto& [time, angle] : tilt.angle.keys) check.range("angle", angle, -1e4, 1e4);
  return check.status();
}

Quat turnOf(const Tilt& tilt, double time) {
  return quatFromRotationVector(normalized(tilt.axis) * tilt.angle.at(time));
}

// Sets what differs: a call that changes nothing would wake the body.
Status setVelocities(World& world, BodyId body, const BodyState& state, Vec3 linear, Vec3 angular) {
  if (linear != state.linearVelocity)
    if (Status set = world.setLinearVelocity(body, linear); !set) return set;
  if (angular != state.angularVelocity)
    if (Status set = world.setAngularVelocity(body, angular); !set) return set;
  return {};
}

}  // namespace

Status driveTo(World& world, BodyId body, const Transform& target, double dt) {
  if (!(dt > 0 && dt <= 1e6)) return machines::refused("dt", std::to_string(dt), "a time step above 0");
  const Result<BodyState> state = world.state(body);
  if (!state) return state.error();
  if (state->type != BodyType::kinematic)
    return machines::refused("body", "one that is not kinematic", "a kinematic one");
  const Quat rotation = normalized(target.rotation);
  const Vec3 arm = rotate(conjugate(state->rotation), state->centreOfMass - state->position);
  const Vec3 way = target.position + rotate(rotation, arm) - state->centreOfMass;
  const Vec3 turn = rotationVector(normalized(rotation * conjugate(state->rotation)));
  return setVelocities(world, body, *state, way * (1 / dt), turn * (1 / dt));
}

double Machines::Drive::begin() const {
  double first = kInfinity;
  if (!path.keys.empty()) first = std::min(first, path.keys.front().time);
  for (const Tilt& tilt : tilts) first = std::min(first, tilt.angle.keys.front().first);
  for (const ShakeMotion& shake : shakes) first = std::min(first, shake.start());
  return first;
}

double Machines::Drive::end() const {
  double last = -kInfinity;
  if (!path.keys.empty()) last = std::max(last, path.keys.back().time);
  for (const Tilt& tilt : tilts) last = std::max(last, tilt.angle.keys.back().first);
  // A body that the shake left a speed goes on at it for ever; loads do not.
  for (const ShakeMotion& shake : shakes) last = std::max(last, shake.endsAtRest() || !body ? shake.end() : kInfinity);
  return last;
}

Transform Machines::Drive::at(double time) const {
  Transform pose = path.keys.empty() ? base : path.at(time);
  for (const Tilt& tilt : tilts) {
    const Quat turn = turnOf(tilt, time);
    pose = {tilt.pivot + rotate(turn, pose.position - tilt.pivot), normalized(turn * pose.rotation)};
  }
  for (const ShakeMotion& shake : shakes) pose.position += shake.direction() * shake.at(time).displacement;
  return pose;
}

Result<Machines::Drive*> Machines::driveOf(const World& world, BodyId body) {
  const Result<BodyState> state = world.state(body);
  if (!state) return state.error();
  if (state->type != BodyType::kinematic)
    return machines::refused("body", "one that is not kinematic", "a kinematic one");
  for (Drive& drive : drives_)
    if (drive.body == body) return &drive;
  drives_.push_back({body, {state->position, state->rotation}, {}, {}, {}});
  return &drives_.back();
}

Status Machines::follow(const World& world, BodyId body, const MotionPath& path) {
  if (Status fine = checkPath(path); !fine) return fine;
  Result<Drive*> drive = driveOf(world, body);
  if (!drive) return drive.error();
  (*drive)->path = path;
  return {};
}

Status Machines::tilt(const World& world, BodyId body, const Tilt& tilt) {
  if (Status fine = checkTilt(tilt); !fine) return fine;
  Result<Drive*> drive = driveOf(world, body);
  if (!drive) return drive.error();
  (*drive)->tilts.push_back(tilt);
  return {};
}

Status Machines::shake(const World& world, BodyId body, const Shake& shake) {
  Result<ShakeMotion> motion = ShakeMotion::create(shake);
  if (!motion) return motion.error();
  Result<Drive*> drive = driveOf(world, body);
  if (!drive) return drive.error();
  (*drive)->shakes.push_back(std::move(motion).value());
  return {};
}

Status Machines::tiltAll(const World& world, const Tilt& tilt) {
  if (Status fine = checkTilt(tilt); !fine) return fine;
  if (loads_.idle()) gravity_ = world.gravity();
  loads_.tilts.push_back(tilt);
  return {};
}

Status Machines::shakeAll(const World& world, const Shake& shake) {
  Result<ShakeMotion> motion = ShakeMotion::create(shake);
  if (!motion) return motion.error();
  if (loads_.idle()) gravity_ = world.gravity();
  loads_.shakes.push_back(std::move(motion).value());
  return {};
}

Status Machines::add(const Wind& wind) {
  Fields check;
  check.condition(isFinite(wind.velocity) && length(wind.velocity) <= machines::kFastest, "velocity",
                  std::to_string(length(wind.velocity)) + " m/s", "at most " + std::to_string(machines::kFastest));
  check.range("dragCoefficient", wind.dragCoefficient, 0, 100);
  check.range("ramp", wind.ramp, 0, machines::kLatest);
  check.condition(wind.until > wind.from, "until", std::to_string(wind.until), "a time after from");
  if (check.status()) winds_.push_back(wind);
  return check.status();
}

Status Machines::add(const Blast& blast) {
  Fields check;
  check.range("impulse", blast.impulse, 0, 1e12);
  check.range("radius", blast.radius, 1e-6, machines::kFarthest);
  check.condition(isFinite(blast.centre) && length(blast.centre) <= machines::kFarthest, "centre",
                  std::to_string(length(blast.centre)) + " m away", "a point within reach");
  check.range("time", blast.time, -machines::kLatest, machines::kLatest);
  if (check.status()) blasts_.push_back(blast);
  return check.status();
}

Status Machines::move(World& world, const Drive& drive, double time, double dt) const {
  const Result<BodyState> state = world.state(drive.body);
  if (!state || state->type != BodyType::kinematic || state->quarantined) return {};  // gone, or another's by now
  const Transform target = drive.at(time + dt), now = drive.at(time);
  // Where the path stands still, the last rounding is no motion: what rests on the body may go on resting.
  const double away = length(state->position - target.position) / (1 + length(target.position)) +
                      length(rotationVector(normalized(target.rotation * conjugate(state->rotation))));
  const bool stands = now.position == target.position && now.rotation == target.rotation && away < kArrived;
  if (stands || time >= drive.end()) return setVelocities(world, drive.body, *state, {}, {});
  return driveTo(world, drive.body, target, dt);
}

// In the frame of the ground: gravity is turned back by the tilt, and what the ground gains in speed all else loses.
Status Machines::turnLoads(World& world, double time, double dt) const {
  Vec3 gravity = gravity_;
  for (const Tilt& tilt : loads_.tilts) gravity = rotate(conjugate(turnOf(tilt, time + dt)), gravity);
  for (const ShakeMotion& shake : loads_.shakes)
    gravity -= shake.direction() * ((shake.at(time + dt).velocity - shake.at(time).velocity) / dt);
  if (gravity == world.gravity()) return {};
  return world.setGravity(gravity);
}

Status Machines::act(World& world, double time, double dt) {
  if (!(dt > 0 && dt <= 1e6) || !std::isfinite(time))
    return machines::refused("dt", std::to_string(dt), "a time step above 0, at a time that is finite");
  // Once more after the end: that is where it stops.
  const auto acts = [&](const Drive& drive) {
    return !drive.idle() && time + dt > drive.begin() && actedUntil_ < drive.end();
  };
  for (const Drive& drive : drives_)
    if (acts(drive))
      if (Status moved = move(world, drive, time, dt); !moved) return moved;
  if (acts(loads_))
    if (Status turned = turnLoads(world, time, dt); !turned) return turned;
  for (const Wind& wind : winds_)
    if (Status blown = applyWind(world, wind, time, dt); !blown) return blown;
  for (const Blast& blast : blasts_)
    if (actedUntil_ < blast.time - kLate && blast.time - kLate <= time)
      if (Result<BlastReport> done = applyBlast(world, blast); !done) return done.error();
  actedUntil_ = time;
  return {};
}

}  // namespace brickfall
