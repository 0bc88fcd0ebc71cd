#include "viewer_core/frame_maker.h"

#include <algorithm>
#include <map>

#include "viewer_core/mortar_story.h"
#include "viewer_core/settings_table.h"
#include "viewer_core/shape_facts.h"

namespace brickfall::viewer {

namespace {

bool isFinite(const Aabb& box) { return box.lower.y > -1e20 && box.upper.y < 1e20; }

// Of the body's shapes but planes, whose bounds have no end.
bool boundsOf(const World& world, BodyId id, Aabb& box) {
  const BodyState state = *world.state(id);
  bool any = false;
  for (ShapeId shape : world.shapes(id)) {
    const Aabb one = bounds(*world.shape(shape), Transform{state.position, state.rotation});
    if (!isFinite(one) || one.upper.x > 1e20) continue;
    box = any ? merged(box, one) : one;
    any = true;
  }
  return any;
}

double topOfBody(const World& world, BodyId id) {
  const BodyState state = *world.state(id);
  std::vector<ShapeDef> shapes;
  for (ShapeId shape : world.shapes(id)) shapes.push_back(*world.shape(shape));
  return topOf(shapes, Transform{state.position, state.rotation});
}

// Those that bodies are made of, by name.
std::vector<MaterialRow> materialsIn(const SceneRun& run) {
  std::map<std::string, int> shapes;
  for (const PlacedBody& body : run.bodies())
    for (const std::string& name : body.materials) shapes[name]++;
  std::vector<MaterialRow> rows;
  for (const auto& [name, count] : shapes) {
    const std::optional<MaterialDef> def = run.material(name);
    if (!def) continue;
    const Material& m = def->material;
    rows.push_back({name, def->colour, m.density, m.friction, m.restitution, m.rollingResistance, count});
  }
  return rows;
}

}  // namespace

std::shared_ptr<const RunInfo> infoOf(const SceneRun& run) {
  auto info = std::make_shared<RunInfo>();
  const SceneDescription& scene = run.scene();
  info->kind = RunKind::live;
  info->file = scene.file;
  info->name = scene.name;
  info->title = scene.title;
  info->description = scene.description;
  info->cameras = scene.cameras;
  if (info->cameras.empty()) info->cameras.push_back({});
  info->seconds = scene.seconds;
  info->reportMethod = scene.method == SceneMethod::report;
  info->ground = kNoGround;
  bool any[2] = {false, false};  // of what stays, and of what can move
  Aabb box[2];
  for (const PlacedBody& body : run.bodies()) {
    Aabb one;
    if (!run.world().isValid(body.id)) continue;
    if (body.role == BodyRole::ground) info->ground = std::max(info->ground, topOfBody(run.world(), body.id));
    if (!boundsOf(run.world(), body.id, one)) continue;
    const int which = body.def.type == BodyType::dynamic;
    box[which] = any[which] ? merged(box[which], one) : one;
    any[which] = true;
  }
  info->extent = any[1] ? box[1] : any[0] ? box[0] : Aabb{{-1, 0, -1}, {1, 1, 1}};
  return info;
}

void FrameMaker::fillSettings(Frame& frame, const LiveRun& run) {
  if (materialsOf_ != run.list() || changesShown_ != run.changes()) {
    materialsOf_ = run.list();
    changesShown_ = run.changes();
    settings_.clear();
    for (const SettingRow& row : settingRows()) settings_.push_back(settingOf(run.wanted(), row));
    materials_ = materialsIn(run.run());
  }
  frame.settings = settings_;
  frame.materials = materials_;
}

void FrameMaker::listPlaces(const BodyList& list) {
  std::fill(placeByIndex_.begin(), placeByIndex_.end(), -1);
  for (std::size_t place = 0; place < list.bodies.size(); place++) {
    const std::size_t index = list.bodies[place].id.index;
    if (index >= placeByIndex_.size()) placeByIndex_.resize(index + 1, -1);
    placeByIndex_[index] = int(place);
  }
}

int FrameMaker::placeOf(BodyId id) const {
  const int place = id.index < placeByIndex_.size() ? placeByIndex_[id.index] : -1;
  return place >= 0 && placedList_->bodies[std::size_t(place)].id == id ? place : -1;
}

void FrameMaker::fill(Frame& frame, const LiveRun& run, const FrameNeeds& needs, Serial selected) {
  frame.list = run.list();
  if (placedList_ != frame.list) {
    placedList_ = frame.list;
    listPlaces(*placedList_);
  }
  fillBodies(frame, run);
  const World& world = run.run().world();
  int place = frame.list->find(selected);
  if (place >= 0) select(frame, run, place);
  if (!frame.selected) place = -1;
  if (place >= 0 && !run.run().reported()) frame.selected->contacts.emplace();
  if (needs.contacts || needs.collisions || place >= 0) fillContacts(frame, run, needs, place);
  if (needs.collisions && run.run().reported()) fillCollisions(frame, *run.run().reported());
  if (needs.islands) fillIslands(frame, world);
  if (needs.bounds) fillBounds(frame, world);
  if (needs.mortar) fillMortar(frame, world);
  if (needs.plots) frame.samples.assign(run.samples().begin(), run.samples().end());
  frame.report = run.report();
  if (run.drag()) {
    FrameDrag drag;
    drag.serial = run.drag()->serial;
    drag.grabbed = heldPoint(world, *run.drag());
    drag.target = run.drag()->target;
    drag.force = run.drag()->force;
    frame.drag = drag;
  }
  fillSettings(frame, run);
}

namespace {

Activity activityOf(const BodyState& state, const ListedBody& body) {
  if (state.quarantined) return Activity::quarantined;
  if (state.type != BodyType::dynamic)
    return body.mass > 0 && state.type == BodyType::fixed ? Activity::held : Activity::fixed;
  return state.awake ? Activity::awake : Activity::asleep;
}

}  // namespace

void FrameMaker::fillBodies(Frame& frame, const LiveRun& run) {
  const std::vector<ListedBody>& list = frame.list->bodies;
  frame.bodies.resize(list.size());
  std::size_t old = 0;  // both lists lie in the order of their serials
  for (std::size_t i = 0; i < list.size(); i++) {
    FrameBody& body = frame.bodies[i];
    const Result<BodyState> state = run.run().world().state(list[i].id);
    if (!state) continue;
    body.pose = body.before = {state->position, state->rotation};
    body.linearVelocity = state->linearVelocity;
    body.angularVelocity = state->angularVelocity;
    body.activity = activityOf(*state, list[i]);
    body.sinceHit = float(run.sinceHit(list[i].id));
    body.hitSpeed = float(run.hitSpeed(list[i].id));
    if (!last_) continue;
    while (old < last_->bodies.size() && last_->bodies[old].serial < list[i].serial) old++;
    if (old < last_->bodies.size() && last_->bodies[old].serial == list[i].serial) body.before = poses_[old];
  }
  last_ = frame.list;
  poses_.resize(frame.bodies.size());
  for (std::size_t i = 0; i < frame.bodies.size(); i++) poses_[i] = frame.bodies[i].pose;
}

// One walk over all contacts for all that is asked of them.
void FrameMaker::fillContacts(Frame& frame, const LiveRun& run, const FrameNeeds& needs, int selected) {
  std::vector<std::pair<int, int>>& pairs = frame.touchingPairs;
  run.run().world().forEachContact([&](const ContactView& c) {
    const int a = placeOf(c.bodyA), b = placeOf(c.bodyB);
    if (a < 0 || b < 0) return;
    double force = 0;
    for (int i = 0; i < c.pointCount; i++) {
      const ContactPointView& p = c.points[i];
      force += p.normalForce;
      if (needs.contacts)
        frame.contacts.push_back(
            {a, b, p.pointWorld, c.normalWorld, float(p.separation), float(p.normalForce), p.frictionForce});
      if ((a != selected && b != selected) || !(p.normalForce > 0) || !frame.selected->contacts) continue;
      const double sign = b == selected ? 1 : -1;
      const ListedBody& other = frame.list->bodies[std::size_t(b == selected ? a : b)];
      frame.selected->contacts->push_back(
          {other.serial, other.name, p.pointWorld, c.normalWorld * sign, p.normalForce, p.frictionForce * sign});
    }
    if (!needs.collisions || !(force > 0)) return;
    pairs.push_back({a, b});
    for (int place : {a, b}) {
      frame.bodies[std::size_t(place)].touching = true;
      frame.bodies[std::size_t(place)].contactForce += float(force);
    }
  });
}

// The report's system tells who collided, no forces.
void FrameMaker::fillCollisions(Frame& frame, const ReportRun& run) const {
  for (const auto& [first, second] : run.collisions()) {
    const int a = placeOf(first), b = placeOf(second);
    if (a < 0 || b < 0) continue;
    frame.touchingPairs.push_back({a, b});
    frame.bodies[std::size_t(a)].touching = frame.bodies[std::size_t(b)].touching = true;
  }
}

void FrameMaker::fillIslands(Frame& frame, const World& world) const {
  world.forEachIsland([&](const IslandView& island) {
    for (BodyId id : island.bodies)
      if (const int place = placeOf(id); place >= 0) frame.bodies[std::size_t(place)].island = frame.islands;
    frame.islands++;
  });
}

// The world names no body with its bounds, but tells the shape that they are of just before.
void FrameMaker::fillBounds(Frame& frame, const World& world) const {
  int body = -1;
  DebugDraw draw;
  draw.shape = [&](BodyId id, const ShapeDef&, const Transform&, std::uint32_t) { body = placeOf(id); };
  draw.bounds = [&](const Aabb& box) {
    if (body >= 0) frame.bounds.push_back({box, body});
  };
  world.draw(draw);
}

void FrameMaker::fillMortar(Frame& frame, const World& world) const {
  for (MortarId id : world.mortars()) {
    const MortarState state = *world.state(id);
    const int place = placeOf(state.bodyA);
    if (place < 0) continue;
    const Transform& pose = frame.bodies[std::size_t(place)].pose;
    const Quat back = conjugate(pose.rotation);
    frame.mortar.push_back({place, rotate(back, state.centre - pose.position), rotate(back, state.along1),
                            rotate(back, state.along2), float(state.utilisation), float(state.damage)});
  }
}

std::vector<std::string> FrameMaker::mortarOf(const LiveRun& run, BodyId body) const {
  const World& world = run.run().world();
  MortarCount count;
  for (MortarId id : world.mortars(body)) {
    const MortarState state = *world.state(id);
    count.all++;
    if (state.broken) continue;
    count.hold++;
    count.utilisation = std::max(count.utilisation, state.utilisation);
  }
  if (count.all == 0) return {};
  const PlacedBody* placed = run.run().find(body);
  const Result<FallStory> story = world.whyFell(body);
  const bool moved = placed && length(world.state(body)->position - placed->def.position) > kFellWay;
  if (!story || !story->first || !moved) return mortarLines(count, nullptr);
  auto nameOf = [&](BodyId id) {
    const int place = placeOf(id);
    return place >= 0 ? placedList_->bodies[std::size_t(place)].name : std::string("what is gone");
  };
  const MortarPast& past = *story->first;
  ToldBreak told{past.breakTime,     past.mode,          past.tensionShare,  past.shearShare,
                 length(past.force), nameOf(past.bodyA), nameOf(past.bodyB), {}};
  for (const LoadTaker& taker : past.takers)
    told.takers.push_back({!taker.mortar, nameOf(taker.bodyA), nameOf(taker.bodyB), taker.before, taker.after});
  return mortarLines(count, &told);
}

void FrameMaker::select(Frame& frame, const LiveRun& run, int place) const {
  const ListedBody& listed = frame.list->bodies[std::size_t(place)];
  const World& world = run.run().world();
  const Result<BodyState> state = world.state(listed.id);
  const Result<MassProperties> mass = world.massProperties(listed.id);
  if (!state || !mass) return;
  SelectedBody s;
  s.serial = listed.serial;
  s.name = listed.name;
  s.material = listed.material;
  s.mass = listed.mass;
  s.speed = length(state->linearVelocity);
  s.spin = length(state->angularVelocity);
  s.surfaceSpeed = length(state->surfaceVelocity);
  const Vec3 spin = transposeTimes(toMatrix(state->rotation), state->angularVelocity);
  s.kineticEnergy = 0.5 * listed.mass * s.speed * s.speed + 0.5 * dot(spin, mass->inertia * spin);
  s.centreOfMass = state->centreOfMass;
  s.acceleration = state->linearAcceleration;
  s.mortar = mortarOf(run, listed.id);
  frame.selected = std::move(s);
}

}  // namespace brickfall::viewer
