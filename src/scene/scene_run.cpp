// A description becomes a World: the ground, then the bricks course by course, then everything else.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "brickfall/limits.h"
#include "brickfall/scene.h"
#include "masonry/named_seed.h"
#include "math/random.h"
#include "scene/body_bounds.h"
#include "scene/mortar_run.h"
#include "scene/node.h"

namespace brickfall {

namespace {

constexpr double kLate = 1e-9;  // s: a step that begins so little before its time counts as on time

Error inBody(const std::string& name, const Error& error) {
  return {error.code, "body \"" + name + "\": " + error.message};
}

const MaterialDef* findMaterial(const SceneDescription& scene, const std::string& name) {
  for (const auto* list : {&scene.materials, &predefinedMaterials()})
    for (const MaterialDef& def : *list)
      if (def.name == name) return &def;
  return nullptr;
}

// Collects what will be placed; errors stop it.
class Placer {
 public:
  explicit Placer(const SceneDescription& scene) : scene_(scene) {}

  Status place() {
    findBrickMaterials();
    for (const SceneWall& wall : scene_.walls) {
      Result<std::vector<BrickPlacement>> bricks = layBricks(wall.wall, scene_.seed);
      if (!bricks) return bricks.error();
      walls_.push_back({&wall, std::move(*bricks)});
    }
    mortar_ = scene::mortarOf(walls_, scene_.seed);
    for (const SceneBody& body : scene_.bodies)
      if (body.role == BodyRole::ground)
        if (Status status = add(body); !status) return status;
    for (scene::LaidWall& wall : walls_)
      if (Status status = add(wall); !status) return status;
    for (const SceneBody& body : scene_.bodies)
      if (body.role != BodyRole::ground)
        if (Status status = add(body); !status) return status;
    return {};
  }
  // Of all walls, by places in `bodies`; what they stand on is known once all are placed.
  Result<std::vector<scene::BrickJoint>> joints() const {
    std::vector<scene::BrickJoint> all = scene::jointsOf(mortar_, walls_);
    for (const scene::LaidWall& wall : walls_) {
      if (!wall.scene->foot || !wall.scene->mortar) continue;
      const std::vector<scene::BrickJoint> feet = scene::footOf(wall, bodies, scene_.seed);
      if (feet.empty())
        return Error{ErrorCode::invalidArgument,
                     "wall \"" + wall.scene->wall.name +
                         "\": foot: found nothing that its lowest course stands on, expected "
                         "a box or a plane"};
      all.insert(all.end(), feet.begin(), feet.end());
    }
    return all;
  }
  std::vector<PlacedBody> bodies;
  std::vector<std::pair<double, PlacedBody>> shots;  // in the order of the scene
  std::map<std::string, DrawnBody> drawn;            // bricks in mortar, by name

 private:
  // Materials that walls, arches and domes are laid of, and "brick".
  void findBrickMaterials() {
    brickMaterials_ = scene_.masonryMaterials;
    brickMaterials_.insert("brick");
    for (const SceneWall& wall : scene_.walls) brickMaterials_.insert(wall.material);
  }
  BodyRole roleOf(BodyRole role, BodyType type, const std::string& material) const {
    if (role == BodyRole::ground || role == BodyRole::ball) return role;
    const bool brick = type == BodyType::dynamic && brickMaterials_.count(material) > 0;
    return brick ? BodyRole::brick : BodyRole::body;
  }

  Result<MaterialDef> material(const std::string& name) const {
    if (const MaterialDef* def = findMaterial(scene_, name)) return *def;
    return Error{ErrorCode::invalidArgument, "material: found \"" + name + "\", expected the name of a material"};
  }

  Status add(const SceneBody& body) {
    PlacedBody placed;
    placed.name = body.name;
    placed.role = roleOf(body.role, body.def.type, body.material);
    placed.def = body.def;
    placed.launchTime = body.launchTime;
    placed.place = body.place;
    Result<MaterialDef> own = material(body.material);
    if (!own) return inBody(body.name, own.error());
    placed.colour = body.colour.value_or(own->colour);
    for (std::size_t i = 0; i < placed.def.shapes.size(); i++) {
      Result<MaterialDef> other = i < body.shapeMaterials.size() ? material(body.shapeMaterials[i]) : own;
      if (!other) return inBody(body.name, other.error());
      placed.def.shapes[i].material = other->material;
      placed.materials.push_back(other->name);
    }
    for (std::size_t k = 0; k < body.shots.size(); k++) {
      shots.push_back({body.shots[k], placed});
      shots.back().second.name += "/" + std::to_string(k);
    }
    if (body.shots.empty()) bodies.push_back(std::move(placed));
    return {};
  }

  Status add(scene::LaidWall& laid) {
    const SceneWall& wall = *laid.scene;
    Result<MaterialDef> brickMaterial = material(wall.material), lintelMaterial = material(wall.lintelMaterial);
    if (!brickMaterial) return inBody(wall.wall.name, brickMaterial.error());
    if (!lintelMaterial) return inBody(wall.wall.name, lintelMaterial.error());
    if (!(wall.densityScatter >= 0 && wall.densityScatter <= 0.5))
      return inBody(wall.wall.name, {ErrorCode::invalidArgument, "densityScatter: expected 0 .. 0.5"});
    laid.firstBody = bodies.size();
    for (std::size_t k = 0; k < laid.bricks.size(); k++) {
      const BrickPlacement& brick = laid.bricks[k];
      const MaterialDef& from = brick.lintel ? *lintelMaterial : *brickMaterial;
      PlacedBody placed;
      placed.name = brick.name;
      placed.role = roleOf(BodyRole::body, BodyType::dynamic, from.name);
      placed.colour = brick.lintel ? from.colour : wall.colour.value_or(from.colour);
      placed.materials = {from.name};
      placed.course = brick.course;
      placed.place = wall.place;
      placed.def.position = brick.centre;
      placed.def.rotation = brick.rotation;
      ShapeDef shape;
      shape.halfExtents = brick.size * 0.5;
      shape.material = from.material;
      if (wall.densityScatter > 0) {  // by name, so that the order of creation does not matter
        Random random(masonry::namedSeed(scene_.seed, brick.name));
        shape.material.density *= 1 + wall.densityScatter * random.between(-1, 1);
      }
      if (brick.bend > 0) {
        addBent(laid, k, shape.material, placed);
        bodies.push_back(std::move(placed));
        continue;
      }
      if (wall.mortar) {
        const GrownBrick& grown = mortar_.grown[laid.firstBrick + k];
        placed.def.position = grown.centre;
        scene::growBrick(wall, brick, grown, scene_.seed, shape);
        drawn[brick.name] = scene::drawnBrick(brick, grown, mortar_.slabs[laid.firstBrick + k], from.name);
      } else if (scene::isUneven(wall)) {
        const std::uint64_t own = masonry::namedSeed(scene_.seed, brick.name + " density");
        shape.distribution = std::make_shared<const MassProperties>(brickMass(wall.wall, brick, wall.uneven, own));
      }
      placed.def.shapes.push_back(shape);
      bodies.push_back(std::move(placed));
    }
    return {};
  }

  // A lintel of a round wall, of several shapes; in mortar with its half of the layers around it.
  void addBent(const scene::LaidWall& laid, std::size_t k, Material material, PlacedBody& placed) {
    BrickPlacement brick = laid.bricks[k];
    const std::string of = placed.materials.front();
    if (laid.scene->mortar) {
      const std::vector<MortarSlab>& slabs = mortar_.slabs[laid.firstBrick + k];
      const GrownBrick& grown = mortar_.grown[laid.firstBrick + k];
      drawn[brick.name] = scene::drawnBrick(brick, grown, slabs, of);
      const double share = brick.size.y / grown.size.y;
      material.density = share * material.density + (1 - share) * laid.scene->mortar->density;
      placed.def.position = brick.centre = grown.centre;
      brick.size = grown.size;
    }
    placed.def.shapes = shapesOf(brick);
    placed.materials.assign(placed.def.shapes.size(), of);
    for (ShapeDef& shape : placed.def.shapes) shape.material = material;
  }

  const SceneDescription& scene_;
  std::vector<scene::LaidWall> walls_;
  scene::WallMortar mortar_;
  std::set<std::string> brickMaterials_;
};

}  // namespace

SceneRun::SceneRun(SceneDescription scene, World world) : scene_(std::move(scene)), world_(std::move(world)) {}

Result<SceneRun> SceneRun::create(const SceneDescription& scene) {
  for (const MaterialDef& def : scene.materials)
    if (Status fine = checkMaterial(def.material); !fine)
      return Error{fine.error().code, "material \"" + def.name + "\": " + fine.error().message};
  Placer placer(scene);
  if (Status status = placer.place(); !status) return status.error();
  WorldDef def = scene.world;
  def.maxBodies = std::max(def.maxBodies, int(placer.bodies.size() + placer.shots.size()));
  Result<World> world = World::create(def);
  if (!world) return world.error();
  SceneRun run(scene, std::move(*world));
  run.scene_.world = def;
  run.drawn_ = std::move(placer.drawn);
  if (scene.method == SceneMethod::report) {
    if (!scene.mortars.empty() || std::any_of(scene.walls.begin(), scene.walls.end(),
                                              [](const SceneWall& wall) { return wall.mortar.has_value(); }))
      return Error{ErrorCode::invalidArgument, "mortar: found some, expected none under the report's system"};
    Result<ReportRun> reported = ReportRun::create(scene.report);
    if (!reported) return reported.error();
    run.reported_ = std::move(reported).value();
  }
  const Result<std::vector<scene::BrickJoint>> joints = placer.joints();
  if (!joints) return joints.error();
  for (PlacedBody& body : placer.bodies)
    if (Result<BodyId> made = run.place(std::move(body)); !made) return made.error();
  // First joined, then held: of two bodies that nothing moves no joint can be made.
  if (Status joined = run.join(); !joined) return joined.error();
  if (Status mortared = run.mortar(*joints); !mortared) return mortared.error();
  for (const PlacedBody& body : run.bodies_)
    if (Status held = run.hold(body.id); !held) return held.error();
  for (auto& [time, body] : placer.shots) run.shots_.push_back({time, std::move(body)});
  if (Status placed = run.placeMachines(); !placed) return placed.error();
  return run;
}

Status SceneRun::placeMachines() {
  const auto idOf = [&](const std::string& name) {
    for (const PlacedBody& body : bodies_)
      if (body.name == name) return body.id;
    return BodyId{};
  };
  for (const SceneBody& body : scene_.bodies)
    if (!body.path.keys.empty())
      if (Status led = machines_.follow(world_, idOf(body.name), body.path); !led)
        return inBody(body.name, led.error());
  for (const SceneTilt& tilt : scene_.tilts) {
    Status placed =
        tilt.body.empty() ? machines_.tiltAll(world_, tilt.tilt) : machines_.tilt(world_, idOf(tilt.body), tilt.tilt);
    if (!placed) return Error{placed.error().code, "tilt: " + placed.error().message};
  }
  for (const SceneShake& shake : scene_.shakes) {
    Status placed = shake.body.empty() ? machines_.shakeAll(world_, shake.shake)
                                       : machines_.shake(world_, idOf(shake.body), shake.shake);
    if (!placed) return Error{placed.error().code, "shake: " + placed.error().message};
  }
  for (const Wind& wind : scene_.winds)
    if (Status blown = machines_.add(wind); !blown) return Error{blown.error().code, "wind: " + blown.error().message};
  for (const Blast& blast : scene_.blasts)
    if (Status set = machines_.add(blast); !set) return Error{set.error().code, "blast: " + set.error().message};
  return {};
}

Status SceneRun::join() {
  std::map<std::string, BodyId> byName;
  for (const PlacedBody& body : bodies_) byName.emplace(body.name, body.id);
  for (const SceneJoint& joint : scene_.joints) {
    const auto inJoint = [&](const Error& error) {
      return Error{error.code, "joint \"" + joint.name + "\": " + error.message};
    };
    JointDef def = joint.def;
    for (const auto& [name, id] : {std::pair(&joint.bodyA, &def.bodyA), std::pair(&joint.bodyB, &def.bodyB)}) {
      const auto found = byName.find(*name);
      if (found == byName.end())
        return inJoint({ErrorCode::invalidArgument, "found \"" + *name + "\", expected the name of a body"});
      *id = found->second;
    }
    Result<JointId> made = world_.createJoint(def);
    if (!made) return inJoint(made.error());
    joints_.push_back(*made);
  }
  return {};
}

Status SceneRun::mortar(const std::vector<scene::BrickJoint>& ofWalls) {
  std::set<std::pair<BodyId, BodyId>> joined;
  // Once for two bodies: by a wall before its foot, by either before a [[mortar]].
  const auto make = [&](BodyId a, BodyId b, std::vector<Vec3> outline, const MortarStrength& strength) -> Status {
    if (!joined.insert(std::minmax(a, b)).second) return {};
    Result<MortarId> made = world_.createMortar({a, b, std::move(outline), strength});
    if (!made)
      return Error{made.error().code,
                   "mortar of \"" + find(a)->name + "\" and \"" + find(b)->name + "\": " + made.error().message};
    mortars_.push_back(*made);
    return {};
  };
  for (const scene::BrickJoint& joint : ofWalls)
    if (Status made = make(bodies_[joint.a].id, bodies_[joint.b].id, joint.outline, joint.strength); !made) return made;
  std::map<std::string, BodyId> byName;
  for (const PlacedBody& body : bodies_) byName.emplace(body.name, body.id);
  for (const SceneMortar& mortar : scene_.mortars) {
    Result<std::vector<std::pair<BodyId, std::vector<Vec3>>>> faces = facesOf(mortar, byName);
    if (!faces) return faces.error();
    const BodyId a = byName.at(mortar.bodyA);
    for (auto& [b, outline] : *faces) {
      const MortarStrength strength = scene::scattered(mortar.kind, true, scene_.seed, mortar.bodyA, find(b)->name);
      if (Status made = make(a, b, std::move(outline), strength); !made) return made;
    }
    if (faces->empty())
      return Error{ErrorCode::invalidArgument,
                   scene::mortarTitle(mortar) + ": found nothing that lies face to face within " +
                       scene::numberText(mortar.gap) + " m, expected boxes, hulls or planes that do"};
  }
  return {};
}

// Whom a table of mortar joins, and on which outlines.
Result<std::vector<std::pair<BodyId, std::vector<Vec3>>>> SceneRun::facesOf(
    const SceneMortar& mortar, const std::map<std::string, BodyId>& byName) const {
  std::vector<BodyId> others;
  for (const std::string* name : {&mortar.bodyA, &mortar.bodyB})
    if (!name->empty() && byName.count(*name) == 0)
      return Error{ErrorCode::invalidArgument,
                   scene::mortarTitle(mortar) + ": found \"" + *name + "\", expected the name of a body"};
  const BodyId a = byName.at(mortar.bodyA);
  std::vector<std::pair<BodyId, std::vector<Vec3>>> faces;
  if (!mortar.outline.empty()) {
    faces.push_back({byName.at(mortar.bodyB), mortar.outline});
    return faces;
  }
  if (!mortar.bodyB.empty()) {
    others.push_back(byName.at(mortar.bodyB));
  } else {
    const Aabb reach = grown(scene::bodyBounds(find(a)->def), mortar.gap);
    for (const PlacedBody& body : bodies_)
      if (body.id != a && overlaps(reach, scene::bodyBounds(body.def))) others.push_back(body.id);
  }
  for (BodyId b : others) {
    const bool still = find(a)->def.type != BodyType::dynamic && find(b)->def.type != BodyType::dynamic;
    if (still && mortar.bodyB.empty()) continue;
    Result<std::vector<Vec3>> outline = world_.sharedFace(a, b, mortar.gap);
    if (!outline) return Error{outline.error().code, scene::mortarTitle(mortar) + ": " + outline.error().message};
    if (!outline->empty()) faces.push_back({b, std::move(*outline)});
  }
  return faces;
}

std::vector<std::pair<JointId, std::string>> SceneRun::joints() const {
  std::vector<std::pair<JointId, std::string>> there;
  for (std::size_t k = 0; k < joints_.size(); k++)
    if (world_.isValid(joints_[k])) there.push_back({joints_[k], scene_.joints[k].name});
  return there;
}

Result<BodyId> SceneRun::createBody(PlacedBody body) {
  Result<BodyId> id = place(std::move(body));
  if (!id) return id;
  if (Status held = hold(*id); !held) return held.error();
  return id;
}

// Everything else already feels it.
Status SceneRun::hold(BodyId id) {
  const PlacedBody& body = *find(id);
  if (!(body.launchTime > time_) || body.def.type == BodyType::fixed) return {};
  if (Status held = world_.setType(id, BodyType::fixed); !held) return inBody(body.name, held.error());
  waiting_.push_back(id);
  return {};
}

Result<BodyId> SceneRun::place(PlacedBody body) {
  if (std::isnan(body.launchTime))
    return inBody(body.name, {ErrorCode::invalidArgument, "launchTime: found nan, expected a time in s"});
  // Made as it will be, so that what could not be launched is refused now.
  Result<BodyId> id = world_.createBody(body.def);
  if (!id) return inBody(body.name, id.error());
  body.id = *id;
  if (id->index >= placeByIndex_.size()) placeByIndex_.resize(id->index + 1);
  placeByIndex_[id->index] = bodies_.size();
  bodies_.push_back(std::move(body));
  return id;
}

const DrawnBody* SceneRun::drawn(BodyId id) const {
  const PlacedBody* body = find(id);
  const auto found = body ? drawn_.find(body->name) : drawn_.end();
  return found == drawn_.end() ? nullptr : &found->second;
}

std::vector<std::uint32_t> SceneRun::colours(BodyId id) const {
  const PlacedBody* body = find(id);
  if (!body) return {};
  const DrawnBody* drawn = this->drawn(id);
  const std::vector<std::string>& materials = drawn ? drawn->materials : body->materials;
  std::vector<std::uint32_t> out;
  for (const std::string& name : materials) {
    const MaterialDef* other = name == body->materials.front() ? nullptr : findMaterial(scene_, name);
    out.push_back(other ? other->colour : name == scene::kMortarMaterial ? scene::kMortarColour : body->colour);
  }
  return out;
}

void SceneRun::list(std::vector<PlacedBody> bodies) {
  bodies_ = std::move(bodies);
  for (std::size_t k = 0; k < bodies_.size(); k++) {
    const std::size_t index = bodies_[k].id.index;
    if (index >= placeByIndex_.size()) placeByIndex_.resize(index + 1);
    placeByIndex_[index] = k;
  }
}

Status SceneRun::destroyBody(BodyId id) {
  if (Status destroyed = world_.destroyBody(id); !destroyed) return destroyed;
  const PlacedBody* body = find(id);
  if (!body) return {};
  bodies_.erase(bodies_.begin() + (body - bodies_.data()));
  for (std::size_t k = 0; k < bodies_.size(); k++) placeByIndex_[bodies_[k].id.index] = k;
  return {};
}

const PlacedBody* SceneRun::find(BodyId id) const {
  const std::size_t place = id.index < placeByIndex_.size() ? placeByIndex_[id.index] : bodies_.size();
  return place < bodies_.size() && bodies_[place].id == id ? &bodies_[place] : nullptr;
}

// Each at the first step that begins at its time; actedUntil() tells which had theirs.
Status SceneRun::shoot() {
  for (const Shot& shot : shots_)
    if (machines_.actedUntil() < shot.time - kLate && shot.time - kLate <= time_)
      if (Result<BodyId> made = createBody(shot.body); !made) return made.error();
  return {};
}

Status SceneRun::launchWaiting() {
  std::vector<BodyId> stillWaiting;
  for (BodyId id : waiting_) {
    const PlacedBody* body = find(id);
    if (!body || !world_.isValid(id)) continue;  // destroyed meanwhile
    if (time_ < body->launchTime - kLate) {
      stillWaiting.push_back(id);
      continue;
    }
    Status status = world_.setType(id, body->def.type);
    if (status) status = world_.setLinearVelocity(id, body->def.linearVelocity);
    if (status) status = world_.setAngularVelocity(id, body->def.angularVelocity);
    if (!status) return inBody(body->name, status.error());
  }
  waiting_ = std::move(stillWaiting);
  return {};
}

Result<StepReport> SceneRun::step() {
  if (Status launched = launchWaiting(); !launched) return launched.error();
  if (Status shot = shoot(); !shot) return shot.error();
  if (Status acted = machines_.act(world_, time_, scene_.timeStep); !acted) return acted.error();
  Result<StepReport> report = reported_ ? reported_->step(world_, scene_.timeStep, scene_.substeps)
                                        : world_.step(scene_.timeStep, scene_.substeps);
  if (!report) return report;
  stepsDone_++;
  time_ = report->time;
  if (scene_.removeBelow)
    if (Status removed = removeFallen(); !removed) return removed.error();
  return report;
}

// Sleeping bodies do not fall.
Status SceneRun::removeFallen() {
  std::vector<BodyId> fallen;
  for (const PlacedBody& body : bodies_) {
    const Result<BodyState> state = world_.state(body.id);
    if (state && state->type == BodyType::dynamic && state->centreOfMass.y < *scene_.removeBelow)
      fallen.push_back(body.id);
  }
  for (BodyId id : fallen)
    if (Status destroyed = destroyBody(id); !destroyed) return destroyed;
  return {};
}

namespace {

// s: after it no machine begins or ends. One that never ends is none that is waited for.
double lastMachine(const SceneDescription& scene) {
  double last = 0;
  const auto later = [&](double time) { last = std::isfinite(time) ? std::max(last, time) : last; };
  for (const SceneBody& body : scene.bodies)
    if (!body.path.keys.empty()) later(body.path.keys.back().time);
  for (const SceneTilt& tilt : scene.tilts) {
    if (!tilt.tilt.angle.keys.empty()) later(tilt.tilt.angle.keys.back().first);
  }
  for (const SceneShake& shake : scene.shakes) {
    const Result<ShakeMotion> motion = ShakeMotion::create(shake.shake);
    if (motion) later(motion->end());
  }
  for (const Wind& wind : scene.winds) later(std::isfinite(wind.until) ? wind.until : wind.from + wind.ramp);
  for (const Blast& blast : scene.blasts) later(blast.time);
  return last;
}

}  // namespace

bool SceneRun::atRest() const {
  if (stepsDone_ == 0 || !waiting_.empty() || time_ < lastMachine(scene_)) return false;
  for (const Shot& shot : shots_)
    if (!(shot.time < time_)) return false;
  for (BodyId id : world_.bodies()) {
    const Result<BodyState> state = world_.state(id);
    if (state && state->type == BodyType::dynamic && !state->quarantined && state->awake) return false;
  }
  return true;
}

Status SceneRun::setTimeStep(double timeStep, int substeps) {
  const auto refused = [](const char* field, const std::string& found, const std::string& expected) {
    return Error{ErrorCode::invalidArgument, std::string(field) + ": found " + found + ", expected " + expected};
  };
  if (!(timeStep >= limits::kShortestTimeStep && timeStep <= limits::kLongestTimeStep))
    return refused("timeStep", std::to_string(timeStep),
                   std::to_string(limits::kShortestTimeStep) + " .. " + std::to_string(limits::kLongestTimeStep));
  if (!(substeps >= 1 && substeps <= limits::kMostSubsteps))
    return refused("substeps", std::to_string(substeps), "1 .. " + std::to_string(limits::kMostSubsteps));
  scene_.timeStep = timeStep;
  scene_.substeps = substeps;
  return {};
}

Status SceneRun::setWorld(const WorldDef& def) {
  if (Status changed = world_.setDefinition(def); !changed) return changed;
  scene_.world = def;
  return {};
}

std::optional<MaterialDef> SceneRun::material(const std::string& name) const {
  const MaterialDef* def = findMaterial(scene_, name);
  return def ? std::optional(*def) : std::nullopt;
}

namespace {

using MaterialChange = std::pair<ShapeId, Material>;

// What changes of a body if `old` becomes `material`: checked, all of it together. Where densities are scattered they stay so.
Result<std::vector<MaterialChange>> changesOf(const World& world, const PlacedBody& body, const MaterialDef& old,
                                              const Material& material) {
  const double densityRatio = material.density / old.material.density;
  const std::vector<ShapeId> shapes = world.shapes(body.id);
  std::vector<Material> all;
  std::vector<MaterialChange> changes;
  for (std::size_t i = 0; i < shapes.size(); i++) {
    all.push_back(world.shape(shapes[i])->material);
    if (i >= body.materials.size() || body.materials[i] != old.name) continue;
    const double before = all[i].density;
    all[i] = material;
    if (before != old.material.density) all[i].density = before * densityRatio;
    changes.push_back({shapes[i], all[i]});
  }
  if (changes.empty()) return changes;
  if (Status fine = world.checkMaterials(body.id, all); !fine) return inBody(body.name, fine.error());
  return changes;
}

}  // namespace

Status SceneRun::setMaterial(const std::string& name, const Material& material) {
  std::optional<MaterialDef> def = this->material(name);
  if (!def)
    return Error{ErrorCode::invalidArgument, "material: found \"" + name + "\", expected the name of a material"};
  if (Status fine = checkMaterial(material); !fine) return fine;  // though nothing may be made of it
  std::vector<MaterialChange> all;
  for (const PlacedBody& body : bodies_) {
    const Result<BodyState> state = world_.state(body.id);
    if (!state || state->quarantined) continue;  // it can't change any more, nor matter
    Result<std::vector<MaterialChange>> changes = changesOf(world_, body, *def, material);
    if (!changes) return changes.error();
    all.insert(all.end(), changes->begin(), changes->end());
  }
  for (const auto& [shape, now] : all)
    if (Status changed = world_.setMaterial(shape, now); !changed) return changed;  // it was checked: does not happen
  def->material = material;
  auto own = std::find_if(scene_.materials.begin(), scene_.materials.end(),
                          [&](const MaterialDef& defined) { return defined.name == name; });
  if (own == scene_.materials.end())
    scene_.materials.push_back(*def);
  else
    *own = *def;
  if (reported_) reported_->rereadBodies();
  return {};
}

}  // namespace brickfall
