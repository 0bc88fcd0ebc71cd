#include "world/mortar_succession.h"

#include <algorithm>

#include "geometry/queries.h"
#include "solver/mortar/law.h"

namespace brickfall {

namespace {

//! of half the face's edges | too small: a piece without a strip of the face keeps all of the mortar
//! | too large: chamfers end it
constexpr double kInFace = 0.95;
//! not of the method: a count
constexpr int kPlacesAcross = 5;

double distanceTo(const Registry& registry, BodyIndex body, Vec3 point) {
  double least = 1e300;
  for (ShapeIndex shape : registry.bodies.shapes[body]) {
    const Transform pose = registry.shapes.worldPose(shape, registry.bodies);
    const Vec3 local = transformPoint(inverse(pose), point);
    least = std::min(least, length(closestPoint(registry.shapes.data[shape].geometry, local) - local));
  }
  return least;
}

// The point lies on the surface, which faces along the normal.
bool isOn(const Registry& registry, BodyIndex body, Vec3 point, Vec3 normal, double near) {
  return distanceTo(registry, body, point) <= near && distanceTo(registry, body, point + normal * (4 * near)) > near;
}

}  // namespace

MortarSuccession::MortarSuccession(const Registry& registry, BodyIndex body, MortarSet& set) {
  for (MortarIndex mortar : set.inOrder()) {
    Mortar& m = set.slots[mortar];
    if (!m.names(body) || m.broken || m.idle) continue;
    Face face(MortarPose(m, registry.bodies));
    face.mortar = mortar;
    face.ofA = m.bodyA == body;
    face.was = registry.idOf(body);
    const BodyMotion& motion = registry.bodies.motion[body];
    face.centre = registry.bodies.origin(body) + motion.orientation * inDouble(face.ofA ? m.centreA : m.centreB);
    face.axes = normalized(motion.rotation * inDouble(face.ofA ? m.frameA : m.frameB));
    const Mat3 axes = toMatrix(face.axes);
    face.normal = face.ofA ? axes.column(0) : -axes.column(0);
    face.size = m.gyration[1];
    // Mortar may be thick: the middle of it lies off both bodies.
    const double off = distanceTo(registry, body, face.centre);
    const Vec3 onBody = face.centre - face.normal * off;
    const double edge = 3 * mortar::kKern * kInFace, step = 2.0 / (kPlacesAcross - 1);
    for (int i = 0; i < kPlacesAcross; i++)
      for (int k = 0; k < kPlacesAcross; k++) {
        const Vec3 place = onBody + axes.column(1) * ((i * step - 1) * edge * m.gyration[0]) +
                           axes.column(2) * ((k * step - 1) * edge * m.gyration[1]);
        if (isOn(registry, body, place, face.normal, kTrifle * face.size)) face.places.push_back(place);
      }
    faces_.push_back(std::move(face));
    set.takeOff(mortar, body);
  }
}

bool MortarSuccession::bears(const Registry& registry, BodyIndex piece, const Face& face) {
  return !face.places.empty() && std::all_of(face.places.begin(), face.places.end(), [&](Vec3 place) {
    return isOn(registry, piece, place, face.normal, kTrifle * face.size);
  });
}

void MortarSuccession::pass(const Registry& registry, const std::vector<BodyIndex>& pieces, MortarSet& set,
                            Diary& diary) const {
  const BodySet& bodies = registry.bodies;
  for (const Face& face : faces_) {
    Mortar& m = set.slots[face.mortar];
    const BodyIndex other = face.ofA ? m.bodyB : m.bodyA;
    const auto heir = std::find_if(pieces.begin(), pieces.end(), [&](BodyIndex piece) {
      const bool holds = bodies.data[piece].type == BodyType::dynamic || bodies.data[other].type == BodyType::dynamic;
      return holds && bears(registry, piece, face);
    });
    if (heir != pieces.end()) {
      placeFace(m, face.ofA, transposeTimes(bodies.motion[*heir].orientation, face.centre - bodies.origin(*heir)),
                normalized(conjugate(bodies.motion[*heir].rotation) * face.axes));
      set.putOn(face.mortar, *heir);
      mortar::keepForces(m, face.pose, MortarPose(m, bodies));
      continue;
    }
    MortarEvent event;
    event.mortar = {face.mortar + 1, m.generation, registry.worldNumber};
    event.bodyA = face.ofA ? face.was : registry.idOf(other);
    event.bodyB = face.ofA ? registry.idOf(other) : face.was;
    event.pointWorld = face.centre;
    event.mode = modeOf(m);
    event.energy = workOn(m);
    event.dropped = true;
    diary.heard().mortar.push_back(event);
    // Destroyed as one of any body, since the set unlists what its bodies were.
    set.putOn(face.mortar, pieces.front());
    set.destroy(face.mortar);
  }
}

}  // namespace brickfall
