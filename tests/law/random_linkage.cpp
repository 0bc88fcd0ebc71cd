#include "law/random_linkage.h"

#include <algorithm>
#include <cmath>

namespace brickfall::law {

namespace {

constexpr double kResolved = 0.2;    // of the size of the smallest body, that a fall or a throw goes in a step
constexpr double kApart = 1.85;      // of two sizes: so far apart no shapes of these sizes touch
constexpr int kTries = 60;           // to place a body beside the others
constexpr double kLeastWay = 1e-15;  // of a size, that a place tells

ShapeDef anyShape(Draw& draw, double size, double density) {
  switch (draw.below(4)) {
    case 0:
      return sphereOf(size, density);
    case 1:
      return boxOf({size, size * draw.scale(.2, 1), size * draw.scale(.2, 1)}, density);
    case 2:
      return capsuleOf(size / 2, size * draw.between(.2, .6), density);
    default:
      return hullOf(size, density);
  }
}

// All that is drawn for a linkage as a whole.
struct Plan {
  LinkageKind kind;
  double gravity, largest, smallest, speed;
  int count;
  bool chain, ring, wild, limits;
  int type;  // of all joints; -1: any
  Material material;
  Vec3 way, velocity, spin;
};

Plan planOf(LinkageKind kind, Draw& draw, double part) {
  Plan p{};
  p.kind = kind;
  p.largest = draw.scale(5e-3, 3);
  p.smallest = p.largest * (draw.oneIn(2) ? 1 : draw.scale(.05, 1));
  const double most = kResolved * p.smallest / part;
  const double drawn = draw.oneIn(2) ? kG : draw.scale(.1, 100);
  p.gravity = kind == LinkageKind::floats ? 0 : std::min(drawn, most / part);
  p.speed = draw.oneIn(3) ? 0 : std::min(most, draw.scale(.1, 30) * std::sqrt(kG * p.largest));
  p.count = 2 + draw.below(draw.oneIn(3) ? 3 : 12);
  p.chain = draw.oneIn(2);
  p.ring = draw.oneIn(5) && p.count > 3;
  p.wild = draw.oneIn(3);
  p.limits = draw.oneIn(2);
  p.type = draw.oneIn(2) ? draw.below(7) : -1;
  p.material.friction = draw.oneIn(4) ? 0 : draw.between(0, 2);
  p.material.restitution = draw.oneIn(3) ? 0 : draw.unit();
  p.way = draw.direction();
  if (kind == LinkageKind::falls) p.way.y = std::fabs(p.way.y) * .3;
  p.velocity = draw.direction() * p.speed;
  p.spin = draw.direction() * (draw.oneIn(3) ? 0 : p.speed * draw.unit() * .3 / p.largest);
  return p;
}

class Builder {
 public:
  Builder(const Plan& plan, Draw& draw, RandomLinkage& out) : plan_(plan), draw_(draw), out_(out) {
    if (plan.kind == LinkageKind::hangs)
      base_ = add(out.world, bodyOf(boxOf(Vec3{1, 1, 1} * baseSize()), {}, BodyType::fixed));
    if (plan.kind != LinkageKind::falls) return;
    BodyDef ground = bodyOf(planeOf(plan.material.friction), {}, BodyType::fixed);
    ground.shapes[0].material.restitution = plan.material.restitution;
    add(out.world, ground);
  }

  // False where it finds no place: the linkage is done.
  bool addBody() {
    const std::size_t i = places_.size();
    const double size = i == 0 ? plan_.largest : draw_.scale(plan_.smallest, plan_.largest);
    std::size_t parent = plan_.chain || plan_.ring || i == 0 ? i - 1 : std::size_t(draw_.below(int(i)));
    Vec3 place = i == 0 ? firstPlace() : nextTo(parent, size, normalized(plan_.way + draw_.direction() * .7));
    for (int tries = 0; i > 0 && touches(place, size, parent); tries++) {
      if (tries == kTries) return false;
      if (!plan_.chain && !plan_.ring) parent = std::size_t(draw_.below(int(i)));
      place = nextTo(parent, size, draw_.direction() * (tries > kTries / 2 ? 1.6 : 1));
    }
    BodyDef def = bodyOf(anyShape(draw_, size, draw_.oneIn(2) ? 1000 : draw_.scale(50, 12000)), place);
    def.shapes[0].material.friction = plan_.material.friction;
    def.shapes[0].material.restitution = plan_.material.restitution;
    if (draw_.oneIn(2)) def.shapes[0].filter = {2, plan_.kind == LinkageKind::falls ? 1u : 0u};
    def.rotation = turn(draw_.direction(), draw_.between(0, 180));
    def.linearVelocity = plan_.velocity + cross(plan_.spin, place);
    def.angularVelocity = plan_.spin;
    if (plan_.wild) {
      def.linearVelocity += draw_.direction() * plan_.speed * .3;
      def.angularVelocity += draw_.direction() * (draw_.scale(.01, 1) * plan_.speed / size);
    }
    places_.push_back(place);
    out_.bodies.push_back(add(out_.world, def));
    out_.sizes.push_back(size);
    if (i > 0)
      join(out_.bodies[parent], places_[parent], i, std::min(size, out_.sizes[parent]));
    else if (plan_.kind == LinkageKind::hangs)
      join(base_, {}, i, size);
    return true;
  }

  void close() {
    if (places_.size() < 3) return;
    JointDef def;
    def.type = draw_.oneIn(2) ? JointType::rope : JointType::distance;
    add(def, out_.bodies.back(), places_.back(), 0, out_.sizes.back());
  }

 private:
  double baseSize() const { return plan_.largest * .2; }
  Vec3 firstPlace() {
    if (plan_.kind == LinkageKind::hangs) return plan_.way * (plan_.largest * 1.5 + baseSize() * 2);
    return {0, plan_.kind == LinkageKind::falls ? plan_.largest * draw_.between(1.9, 4) : 0, 0};
  }
  Vec3 nextTo(std::size_t parent, double size, Vec3 way) const {
    return places_[parent] + way * ((size + out_.sizes[parent]) * 1.05);
  }
  bool touches(Vec3 place, double size, std::size_t parent) const {
    if (plan_.kind == LinkageKind::hangs && length(place) < kApart * (size + baseSize())) return true;
    if (plan_.kind == LinkageKind::falls && place.y < kApart * size) return true;
    for (std::size_t k = 0; k < places_.size(); k++)
      if (k != parent && length(place - places_[k]) < kApart * (size + out_.sizes[k])) return true;
    return false;
  }

  void join(BodyId a, Vec3 placeA, std::size_t b, double size) {
    JointDef def;
    def.type = JointType(plan_.type >= 0 ? plan_.type : draw_.below(7));
    def.axis = draw_.direction();
    def.stiffness = draw_.scale(1, 1e6) * size;
    if (plan_.limits && draw_.oneIn(2)) {
      const double unit = def.type == JointType::prismatic ? size : 1;
      def.limit = {-draw_.between(0, 1.5) * unit, draw_.between(0, 1.5) * unit};
      if (def.type == JointType::spherical && draw_.oneIn(2)) def.cone = draw_.between(.05, 1.5);
    }
    add(def, a, placeA, b, size);
  }
  void add(JointDef def, BodyId a, Vec3 placeA, std::size_t b, double size) {
    const bool line = def.type == JointType::distance || def.type == JointType::rope || def.type == JointType::spring;
    def.bodyA = a;
    def.bodyB = out_.bodies[b];
    def.anchor = line ? placeA : (placeA + places_[b]) * .5;
    if (line) def.anchorB = places_[b];
    Result<JointId> made = out_.world.createJoint(def);
    ASSERT_TRUE(made.ok()) << made.error().message;
    out_.joints.push_back(*made);
    out_.spans.push_back(size);
  }
  BodyId add(World& world, const BodyDef& def) { return test::add(world, def); }

  const Plan& plan_;
  Draw& draw_;
  RandomLinkage& out_;
  BodyId base_;
  std::vector<Vec3> places_;
};

// J: what springs hold.
double springs(const RandomLinkage& r) {
  double sum = 0;
  for (JointId joint : r.joints) {
    const JointState state = *r.world.state(joint);
    if (state.type != JointType::spring) continue;
    const JointDef def = *r.world.definition(joint);
    const double stretch = state.position - *def.length;
    sum += .5 * def.stiffness * stretch * stretch;
  }
  return sum;
}

double placesEnergy(const RandomLinkage& r) { return r.world.energy().potential + springs(r); }

// J: kinetic, by the mean of the velocities before and after a step.
double meanKinetic(const RandomLinkage& r, const std::vector<BodyState>& before) {
  double sum = 0;
  for (std::size_t i = 0; i < r.bodies.size(); i++) {
    const BodyState now = *r.world.state(r.bodies[i]);
    const Mat3 inertia = r.world.massProperties(r.bodies[i])->inertia;
    const Vec3 v = (now.linearVelocity + before[i].linearVelocity) * .5,
               w = rotate(conjugate(before[i].rotation), (now.angularVelocity + before[i].angularVelocity) * .5);
    sum += .5 * (now.mass * lengthSquared(v) + dot(w, inertia * w));
  }
  return sum;
}

}  // namespace

const char* nameOf(LinkageKind kind) {
  constexpr const char* kNames[kLinkageKinds] = {"floating", "hanging", "falling"};
  return kNames[int(kind)];
}

RandomLinkage drawLinkage(LinkageKind kind, int seed) {
  Draw draw(seed * kLinkageKinds + int(kind) + 31000000);
  const double dt = 1 / draw.scale(20, 1000);
  const int substeps = draw.oneIn(3) ? 1 + draw.below(8) : 1;
  const Plan plan = planOf(kind, draw, dt / substeps);
  WorldDef def;
  def.enableSleep = false;
  def.gravity = {0, -plan.gravity, 0};
  RandomLinkage out{{makeWorld(def), {}, dt, substeps, 0, {}}, {}, {}, {}};
  const double time = plan.gravity > 0 ? 12 * std::sqrt(plan.largest / plan.gravity)
                                       : 10 * plan.largest / std::max(plan.speed, 1e-3 * plan.largest);
  out.steps = int(std::clamp(time / dt, 40.0, 200.0));
  Builder builder(plan, draw, out);
  while (int(out.bodies.size()) < plan.count && builder.addBody()) {
  }
  if (plan.ring) builder.close();
  out.text = std::string(nameOf(kind)) + label(" %g", seed) + label(": dt 1/%.4g s", 1 / dt) +
             label(" / %g", substeps) + label(", %g bodies", double(out.bodies.size())) +
             label(" from %.3g", plan.smallest) + label(" to %.3g m", plan.largest) + label(", %.3g m/s", plan.speed) +
             label(", g %.3g", plan.gravity) + label(", joints of type %g", plan.type);
  return out;
}

LinkageOutcome runLinkage(RandomLinkage& r) {
  LinkageOutcome out;
  double most = r.world.energy().kinetic, momentum = 1e-12, angular = 1e-12, size = 0;
  for (double each : r.sizes) size = std::max(size, each);
  std::vector<BodyState> before;
  for (BodyId body : r.bodies) {
    const BodyState& s = before.emplace_back(*r.world.state(body));
    most += .1 * s.mass * length(r.world.gravity()) * size;
    // Of what is made at rest, what doubles round of its place in a step.
    const double speed = length(s.linearVelocity) + kLeastWay * size / r.dt;
    momentum += s.mass * speed;
    angular += s.mass * speed * (length(s.position) + size);
  }
  most = std::max(most, 1e-12);
  const Vec3 p = r.world.linearMomentum(), l = r.world.angularMomentum();
  const double start = r.world.energy().kinetic + placesEnergy(r);
  double atEnds = 0, atMiddles = 0, places = placesEnergy(r);
  for (int i = 0; i < r.steps; i++) {
    Result<StepReport> made = r.world.step(r.dt, r.substeps);
    if (!made.ok() || !made->quarantined.empty()) {
      out.finite = false;
      return out;
    }
    const double kinetic = r.world.energy().kinetic;
    most = std::max(most, kinetic);
    atMiddles = std::max(atMiddles, (meanKinetic(r, before) + places - start) / most);
    places = placesEnergy(r);
    atEnds = std::max(atEnds, (kinetic + places - start) / most);
    out.linear = std::max(out.linear, length(r.world.linearMomentum() - p) / momentum);
    out.angular = std::max(out.angular, length(r.world.angularMomentum() - l) / angular);
    for (std::size_t k = 0; k < r.bodies.size(); k++) before[k] = *r.world.state(r.bodies[k]);
  }
  out.gain = std::max(0.0, std::min(atEnds, atMiddles));
  for (std::size_t k = 0; k < r.joints.size(); k++)
    out.gape = std::max(out.gape, r.world.state(r.joints[k])->error / r.spans[k]);
  return out;
}

}  // namespace brickfall::law
