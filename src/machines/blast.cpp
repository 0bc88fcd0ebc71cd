// A blast: each face takes the share of its solid angle, along the line from the centre.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "machines/faces.h"
#include "machines/faults.h"

namespace brickfall {

namespace {

using machines::Face;

// Faces are cut in four until they are small for their distance, and at least once: what is half hidden feels half.
constexpr double kSmall = 0.5;  // longest side over distance
constexpr int kLeastCuts = 1, kMostCuts = 5;

// Of a triangle seen from the origin; below 0 if it is seen from behind. (Van Oosterom and Strackee.)
double solidAngle(Vec3 a, Vec3 b, Vec3 c) {
  const double la = length(a), lb = length(b), lc = length(c);
  const double y = dot(a, cross(b, c)), x = la * lb * lc + dot(a, b) * lc + dot(a, c) * lb + dot(b, c) * la;
  const double size = std::sqrt(x * x + y * y);
  if (!(size > 0)) return 0;
  // Twice the angle of (x, y): that of a quaternion's turn.
  return -rotationVector(Quat{y / size, 0, 0, x / size}).x;
}

// One body in the blast.
class Target {
 public:
  Target(const World& world, const Blast& blast, BodyId body, Vec3 mass)
      : world_(world), blast_(blast), body_(body), mass_(mass) {}
  void take(const Face& face, int cuts = 0) {
    const Vec3 a = face.corners[0] - blast_.centre, b = face.corners[1] - blast_.centre,
               c = face.corners[2] - blast_.centre;
    if (!(dot(face.area(), face.centre() - blast_.centre) < 0)) return;  // its back
    const double longest = std::sqrt(std::max({lengthSquared(a - b), lengthSquared(b - c), lengthSquared(c - a)}));
    const double distance = length(face.centre() - blast_.centre);
    if (cuts < kMostCuts && (cuts < kLeastCuts || longest > kSmall * distance)) return cut(face, cuts + 1);
    if (!(distance <= blast_.radius) || !seen(face.centre(), distance)) return;
    const double share = std::fabs(solidAngle(a, b, c)) / (4 * std::numbers::pi);
    const Vec3 push = (face.centre() - blast_.centre) * (blast_.impulse * share / distance);
    linear += push;
    angular += cross(face.centre() - mass_, push);
    taken += blast_.impulse * share;
  }
  Vec3 linear, angular;
  double taken = 0;

 private:
  void cut(const Face& face, int cuts) {
    const auto& [a, b, c] = face.corners;
    const Vec3 ab = (a + b) * 0.5, bc = (b + c) * 0.5, ca = (c + a) * 0.5;
    for (const Face& part : {Face{{a, ab, ca}}, Face{{ab, b, bc}}, Face{{ca, bc, c}}, Face{{ab, bc, ca}}})
      take(part, cuts);
  }
  bool seen(Vec3 point, double distance) const {
    if (!blast_.occlusion) return true;
    const auto hit = world_.castRay(blast_.centre, point - blast_.centre, distance);
    return !hit || !hit->has_value() || (*hit)->body == body_;
  }
  const World& world_;
  const Blast& blast_;
  BodyId body_;
  Vec3 mass_;  // centre of mass
};

Status checkBlast(const Blast& blast) {
  machines::Fields check;
  check.range("centre", std::max({std::fabs(blast.centre.x), std::fabs(blast.centre.y), std::fabs(blast.centre.z)}), 0,
              machines::kFarthest);
  check.range("impulse", blast.impulse, 0, 1e12);
  check.range("radius", blast.radius, 1e-6, machines::kFarthest);
  check.condition(!std::isnan(blast.time), "time", "nan", "a time in s");
  return check.status();
}

}  // namespace

// All shares are found before any body moves: none stands in another's way that is already gone.
Result<BlastReport> applyBlast(World& world, const Blast& blast) {
  if (Status fine = checkBlast(blast); !fine) return fine.error();
  Result<std::vector<BodyId>> near = world.overlapSphere(blast.centre, blast.radius);
  if (!near) return near.error();
  struct Push {
    BodyId body;
    Vec3 linear, angular;
  };
  std::vector<Push> pushes;
  BlastReport report;
  for (BodyId body : *near) {
    const Result<BodyState> state = world.state(body);
    if (!state || state->type != BodyType::dynamic || state->quarantined || !state->enabled) continue;
    Target target(world, blast, body, state->centreOfMass);
    std::vector<Face> faces;
    for (ShapeId shape : world.shapes(body))
      machines::appendFaces(*world.shape(shape), {state->position, state->rotation}, faces);
    for (const Face& face : faces) target.take(face);
    if (!(target.taken > 0)) continue;
    pushes.push_back({body, target.linear, target.angular});
    report.bodies++;
    report.impulse += target.taken;
  }
  for (const Push& push : pushes) {
    if (Status pushed = world.applyImpulse(push.body, push.linear); !pushed) return pushed.error();
    if (Status turned = world.applyAngularImpulse(push.body, push.angular); !turned) return turned.error();
  }
  return report;
}

}  // namespace brickfall
