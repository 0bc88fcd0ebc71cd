#include "brickfall/take_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "record/atomic_file.h"

namespace brickfall {

struct TakeRecorder::Impl {
  struct Followed {
    BodyId id;
    std::uint32_t number = 0;  // in the take
  };
  struct FollowedMortar {
    MortarId id;
    BodyId a, b;
    std::uint32_t number = 0;  // in the take
    TakeMortarState state;     // as it was recorded
    bool broken = false;       // its break has been heard of
  };
  struct Heard {
    TakeEvent event;  // numbers are found when it is written
    BodyId a, b;
  };

  AsideFile aside;
  TakeWriter writer;
  double framesPerSecond;
  double nextFrame = 1;                     // number of the frame that is due next
  std::uint32_t known = 0;                  // bodies that were ever recorded
  std::vector<Followed> there;              // in the last frame, by number
  std::vector<std::uint32_t> placeByIndex;  // by BodyId::index: position in `there`, kNowhere = none
  std::vector<BodyId> held;                 // bodies that forces do not move: one that they will has been launched
  std::vector<Heard> heard;                 // since the last frame
  std::vector<FollowedMortar> mortar;       // in the last frame, by number
  std::uint32_t knownMortar = 0;            // joints that were ever recorded
  static constexpr std::uint32_t kNowhere = 0xffffffffu;

  Impl(AsideFile file, TakeWriter take, double rate)
      : aside(std::move(file)), writer(std::move(take)), framesPerSecond(rate) {}

  // The body's place in `there`, kNowhere for one that is not.
  std::uint32_t placeOf(BodyId id) const {
    std::uint32_t place = id.index < placeByIndex.size() ? placeByIndex[id.index] : kNowhere;
    return place < there.size() && there[place].id == id ? place : kNowhere;
  }
  void hear(const World& world, const StepReport& report);
  TakeChange follow(const World& world, const Describe& describe, std::vector<Followed>& gone);
  void followMortar(const World& world, TakeChange& change);
  void addMortar(const World& world, TakeFrame& frame);
  bool addBreak(const World& world, const FollowedMortar& joint, TakeFrame& frame) const;
  std::uint32_t numberOfMortar(MortarId id) const;
  void listPlaces();
  void addEvents(const std::vector<Followed>& gone, TakeFrame& frame);
  Status writeFrame(const World& world, double time, const Describe& describe);
};

namespace {

TakeBody described(const World& world, BodyId id, std::uint32_t number, const TakeRecorder::Describe& describe) {
  TakeBody body;
  if (describe) {
    body = describe(id);
  } else {
    body.name = "body " + std::to_string(number);
    if (const Result<BodyState> state = world.state(id)) body.mass = state->mass;
  }
  if (body.shapes.empty())
    for (ShapeId shape : world.shapes(id)) body.shapes.push_back(*world.shape(shape));
  if (!body.look) body.look = id.index - 1;  // its place in the world, which a saved world keeps
  return body;
}

TakeRecorder::Describe descriptionsOf(const SceneRun& run) {
  return [&run](BodyId id) {
    TakeBody body;
    body.name = "body " + std::to_string(id.index);
    const Result<MassProperties> mass = run.world().massProperties(id);
    const PlacedBody* placed = run.find(id);
    // Of a body that is still held the world knows no mass: its own is that of its shapes.
    const bool moves = placed ? placed->def.type == BodyType::dynamic : run.world().state(id)->mass > 0;
    if (moves && mass) body.mass = mass->mass;
    if (!placed) return body;
    body.name = placed->name;
    body.role = placed->role;
    body.colour = placed->colour;
    const std::vector<std::string>& materials = placed->materials;
    if (!materials.empty()) body.material = materials.front();
    const bool differ =
        std::any_of(materials.begin(), materials.end(), [&](const auto& name) { return name != materials[0]; });
    if (differ) body.shapeMaterials = materials;
    if (const DrawnBody* drawn = run.drawn(id)) {
      body.shapes = drawn->shapes;
      body.shapeMaterials = drawn->materials;
    }
    if (!body.shapeMaterials.empty()) body.shapeColours = run.colours(id);
    return body;
  };
}

}  // namespace

void TakeRecorder::Impl::hear(const World& world, const StepReport& report) {
  std::erase_if(held, [&](BodyId id) {
    const Result<BodyState> state = world.state(id);
    if (!state) return true;
    if (state->type != BodyType::dynamic) return false;
    heard.push_back({{TakeEventType::launch, 0, 0, {}, 0}, id, {}});
    return true;
  });
  for (const HitEvent& hit : world.events().hits)
    heard.push_back({{TakeEventType::hit, 0, 0, hit.pointWorld, float(hit.impulse)}, hit.bodyA, hit.bodyB});
  for (BodyId id : world.events().fellAsleep) heard.push_back({{TakeEventType::fellAsleep, 0, 0, {}, 0}, id, {}});
  for (BodyId id : report.quarantined) heard.push_back({{TakeEventType::quarantined, 0, 0, {}, 0}, id, {}});
}

// Who came and went since the last frame.
TakeChange TakeRecorder::Impl::follow(const World& world, const Describe& describe, std::vector<Followed>& gone) {
  TakeChange change;
  std::vector<Followed> now;
  for (const Followed& body : there) {
    if (world.isValid(body.id)) {
      now.push_back(body);
    } else {
      gone.push_back(body);
      change.ends.push_back(body.number);
    }
  }
  for (BodyId id : world.bodies()) {
    if (placeOf(id) != kNowhere) continue;
    change.births.push_back(described(world, id, known, describe));
    now.push_back({id, known++});
    if (world.state(id)->type != BodyType::dynamic) held.push_back(id);
  }
  if (change.births.empty() && change.ends.empty()) return change;
  there = std::move(now);
  listPlaces();
  return change;
}

// A joint that goes on with a piece of its body is another to the take.
void TakeRecorder::Impl::followMortar(const World& world, TakeChange& change) {
  const std::vector<MortarId> now = world.mortars();
  if (now.empty() && mortar.empty()) return;
  std::vector<FollowedMortar> kept;
  for (const FollowedMortar& joint : mortar) {
    const Result<MortarState> state = world.state(joint.id);
    if (state && state->bodyA == joint.a && state->bodyB == joint.b)
      kept.push_back(joint);
    else
      change.mortarEnds.push_back(joint.number);
  }
  std::vector<MortarId> old;
  for (const FollowedMortar& joint : kept) old.push_back(joint.id);
  std::sort(old.begin(), old.end());
  for (MortarId id : now) {
    if (std::binary_search(old.begin(), old.end(), id)) continue;
    const MortarState state = *world.state(id);
    const std::uint32_t a = placeOf(state.bodyA), b = placeOf(state.bodyB);
    if (a == kNowhere || b == kNowhere) continue;
    const BodyState of = *world.state(state.bodyA);
    const Quat back = conjugate(of.rotation);
    change.mortar.push_back({there[a].number, there[b].number, rotate(back, state.centre - of.position),
                             rotate(back, state.along1), rotate(back, state.along2)});
    kept.push_back({id, state.bodyA, state.bodyB, knownMortar++, {}, false});
  }
  mortar = std::move(kept);
}

std::uint32_t TakeRecorder::Impl::numberOfMortar(MortarId id) const {
  const auto joint = std::find_if(mortar.begin(), mortar.end(), [&](const auto& one) { return one.id == id; });
  return joint == mortar.end() ? TakeLoadTaker::kContacts : joint->number;
}

// False: who bears its load is not known yet.
bool TakeRecorder::Impl::addBreak(const World& world, const FollowedMortar& joint, TakeFrame& frame) const {
  const Result<MortarPast> past = world.past(joint.id);
  if (!past) return true;
  if (!past->settled) return false;
  TakeBreak out;
  out.mortar = joint.number;
  out.crackTime = past->crackTime;
  out.breakTime = past->breakTime;
  out.mode = past->mode;
  out.tensionShare = float(past->tensionShare);
  out.shearShare = float(past->shearShare);
  out.force = past->force;
  for (const LoadTaker& taker : past->takers) {
    const std::uint32_t a = placeOf(taker.bodyA), b = placeOf(taker.bodyB);
    const std::uint32_t by = taker.mortar ? numberOfMortar(taker.mortar) : TakeLoadTaker::kContacts;
    if (a == kNowhere || b == kNowhere || (taker.mortar && by == TakeLoadTaker::kContacts)) continue;
    out.takers.push_back({by, there[a].number, there[b].number, float(taker.before), float(taker.after)});
  }
  frame.breaks.push_back(std::move(out));
  return true;
}

void TakeRecorder::Impl::addMortar(const World& world, TakeFrame& frame) {
  for (FollowedMortar& joint : mortar) {
    const bool fresh = joint.state.utilisation == 0 && joint.state.damage == 0;
    if (const Result<MortarState> state = world.state(joint.id); state && (state->awake || fresh))
      joint.state = {float(state->utilisation), float(state->damage)};
    frame.mortar.push_back(joint.state);
    if (joint.broken || joint.state.damage < 1) continue;
    joint.broken = addBreak(world, joint, frame);
  }
}

void TakeRecorder::Impl::listPlaces() {
  std::fill(placeByIndex.begin(), placeByIndex.end(), kNowhere);
  for (std::size_t place = 0; place < there.size(); place++) {
    const std::size_t index = there[place].id.index;
    if (index >= placeByIndex.size()) placeByIndex.resize(index + 1, kNowhere);
    placeByIndex[index] = std::uint32_t(place);
  }
}

// Those whose bodies the take knows: one that came and went between two frames left no trace.
void TakeRecorder::Impl::addEvents(const std::vector<Followed>& gone, TakeFrame& frame) {
  const auto find = [&](BodyId id, std::uint32_t& number) {
    if (const std::uint32_t place = placeOf(id); place != kNowhere) {
      number = there[place].number;
      return true;
    }
    const auto ended = std::find_if(gone.begin(), gone.end(), [&](const Followed& body) { return body.id == id; });
    if (ended == gone.end()) return false;
    number = ended->number;
    return true;
  };
  for (Heard& h : heard)
    if (find(h.a, h.event.bodyA) && (!h.b || find(h.b, h.event.bodyB))) frame.events.push_back(h.event);
  heard.clear();
}

Status TakeRecorder::Impl::writeFrame(const World& world, double time, const Describe& describe) {
  std::vector<Followed> gone;
  TakeChange change = follow(world, describe, gone);
  followMortar(world, change);
  TakeFrame frame;
  frame.time = time;
  frame.poses.resize(there.size());
  for (std::size_t i = 0; i < there.size(); i++) {
    const Result<BodyState> state = world.state(there[i].id);
    if (!state) return state.error();
    frame.poses[i] = {state->position, state->rotation, static_cast<float>(length(state->linearVelocity)), 0};
  }
  world.forEachContact([&](const ContactView& contact) {
    float force = 0;
    for (int i = 0; i < contact.pointCount; i++) force += static_cast<float>(contact.points[i].normalForce);
    for (BodyId id : {contact.bodyA, contact.bodyB})
      if (const std::uint32_t place = placeOf(id); place != kNowhere) frame.poses[place].contactForce += force;
  });
  addEvents(gone, frame);
  addMortar(world, frame);
  return writer.write(frame, change);
}

TakeRecorder::TakeRecorder(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
TakeRecorder::TakeRecorder(TakeRecorder&&) noexcept = default;
TakeRecorder& TakeRecorder::operator=(TakeRecorder&&) noexcept = default;
TakeRecorder::~TakeRecorder() = default;

Result<TakeRecorder> TakeRecorder::create(const std::string& path, const TakeHeader& header, const World& world,
                                          const Describe& describe) {
  Result<AsideFile> aside = AsideFile::open(path);
  if (!aside) return aside.error();
  Result<TakeWriter> writer = TakeWriter::create(aside->name(), header);
  if (!writer) {
    aside->remove();
    return writer.error();
  }
  auto impl = std::make_unique<Impl>(std::move(aside).value(), std::move(writer).value(), header.framesPerSecond);
  impl->nextFrame = std::floor(world.time() * header.framesPerSecond + 1e-6) + 1;
  if (Status written = impl->writeFrame(world, world.time(), describe); !written) {
    impl->aside.remove();  // without a frame it is of no use
    return written.error();
  }
  return TakeRecorder(std::move(impl));
}

Result<TakeRecorder> TakeRecorder::create(const std::string& path, const SceneRun& run) {
  const SceneDescription& scene = run.scene();
  TakeHeader header;
  header.scene = scene.name;
  header.title = scene.title;
  header.engineVersion = versionString();
  header.seed = scene.seed;
  header.framesPerSecond = std::min(scene.framesPerSecond, 1 / scene.timeStep);
  header.cameras = scene.cameras;
  return create(path, header, run.world(), descriptionsOf(run));
}

Status TakeRecorder::afterStep(const World& world, const StepReport& report, const Describe& describe) {
  impl_->hear(world, report);
  const double frames = std::floor(report.time * impl_->framesPerSecond + 1e-6);
  if (frames < impl_->nextFrame) return {};
  impl_->nextFrame = frames + 1;
  return impl_->writeFrame(world, report.time, describe);
}

Status TakeRecorder::afterStep(const SceneRun& run, const StepReport& report) {
  return afterStep(run.world(), report, descriptionsOf(run));
}

Status TakeRecorder::finish(const std::string& summaryJson) {
  if (Status finished = impl_->writer.finish(summaryJson); !finished) return finished;
  return impl_->aside.takePlace();
}

const std::string& TakeRecorder::file() const { return impl_->aside.name(); }

}  // namespace brickfall
