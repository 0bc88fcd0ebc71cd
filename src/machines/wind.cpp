// Wind: pressure before faces, suction behind them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "machines/faces.h"
#include "machines/faults.h"

namespace brickfall {

namespace {

using machines::Face;

constexpr double kPress = 8.0 / 13, kDraw = 5.0 / 13;  // shares of the drag: usual codes have 0.8 and 0.5 of 1.3
constexpr double kLift = 1e-4;                         // of a face's size: rays start so far before it

// Share of the wind's speed at a time.
double strengthAt(const Wind& wind, double time) {
  if (!(time >= wind.from && time < wind.until)) return 0;
  if (!(wind.ramp > 0)) return 1;
  return std::min({1.0, (time - wind.from) / wind.ramp, (wind.until - time) / wind.ramp});
}

Status checkWind(const Wind& wind, double time, double dt) {
  machines::Fields check;
  check.condition(std::isfinite(time), "time", std::to_string(time), "a time in s");
  check.condition(dt > 0 && dt <= 1e6, "dt", std::to_string(dt), "a time step above 0");
  check.range("velocity",
              std::max({std::fabs(wind.velocity.x), std::fabs(wind.velocity.y), std::fabs(wind.velocity.z)}), 0,
              machines::kFastest);
  check.range("ramp", wind.ramp, 0, machines::kLatest);
  check.range("dragCoefficient", wind.dragCoefficient, 0, 100);
  check.condition(wind.until > wind.from, "until", std::to_string(wind.until), "later than from");
  return check.status();
}

// What the wind does to one body: force and torque, and how fast they would fall with the speed they give.
class Exposed {
 public:
  Exposed(const World& world, const Wind& wind, const BodyState& state, const MassProperties& mass)
      : world_(world), wind_(wind), state_(state) {
    const Mat3 turn = toMatrix(state.rotation);
    invInertia_ = turn * inverse(mass.inertia) * transpose(turn);
  }

  void take(const Face& face, ShapeId shape, Vec3 velocity, double density) {
    const Vec3 area = face.area(), centre = face.centre(), arm = centre - state_.centreOfMass;
    const double size = length(area);
    if (!(size > 0)) return;
    const Vec3 normal = area * (1 / size);
    const double speed =
        dot(velocity - state_.linearVelocity - cross(state_.angularVelocity, arm), normal);  // of the wind, outwards
    if (speed == 0) return;
    const Vec3 away = normalized(speed < 0 ? velocity * -1.0 : velocity);
    const double share = (speed < 0 ? kPress : kDraw) * wind_.dragCoefficient;
    const double lift = kLift * std::sqrt(size);
    // Upwind whatever stands there; behind, only what is nearer than the face is wide.
    if (wind_.shelter && dot(away, normal) > 0 &&
        machines::meets(world_, shape, centre + normal * lift, away, speed < 0 ? machines::kFarthest : std::sqrt(size)))
      return;
    const double slope = 0.5 * density * share * size * std::fabs(speed);  // N s/m, force over speed
    const Vec3 push = normal * (slope * speed), lever = cross(arm, normal);
    force += push;
    torque += cross(arm, push);
    rate += slope * (1 / state_.mass + dot(lever, invInertia_ * lever));
  }

  Vec3 force, torque;
  double rate = 0;  // 1/s

 private:
  const World& world_;
  const Wind& wind_;
  const BodyState& state_;
  Mat3 invInertia_;
};

}  // namespace

Status applyWind(World& world, const Wind& wind, double time, double dt) {
  if (Status fine = checkWind(wind, time, dt); !fine) return fine;
  const Vec3 velocity = wind.velocity * strengthAt(wind, time);
  if (!(lengthSquared(velocity) > 0)) return {};
  const double density = world.definition().airDensity;
  std::vector<Face> faces;
  for (BodyId body : world.bodies()) {
    const Result<BodyState> state = world.state(body);
    if (!state || state->type != BodyType::dynamic || state->quarantined || !state->enabled) continue;
    Exposed exposed(world, wind, *state, *world.massProperties(body));
    for (ShapeId shape : world.shapes(body)) {
      faces.clear();
      machines::appendFaces(*world.shape(shape), {state->position, state->rotation}, faces);
      for (const Face& face : faces) exposed.take(face, shape, velocity, density);
    }
    // As the force falls while it acts, so much of it is left on the mean: no body is pushed beyond the wind.
    const double left = 1 / (1 + exposed.rate * dt);
    if (exposed.force == Vec3{} && exposed.torque == Vec3{}) continue;
    if (Status pushed = world.applyForce(body, exposed.force * left); !pushed) return pushed;
    if (Status turned = world.applyTorque(body, exposed.torque * left); !turned) return turned;
  }
  return {};
}

}  // namespace brickfall
