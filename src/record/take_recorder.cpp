#include "brickfall/take_recorder.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "record/atomic_file.h"

namespace brickfall {
namespace {

TakeHeader headerOf(const SceneRun& run, double framesPerSecond) {
  const SceneDescription& scene = run.scene();
  TakeHeader header;
  header.scene = scene.name;
  header.title = scene.title;
  header.engineVersion = versionString();
  header.seed = scene.seed;
  header.framesPerSecond = framesPerSecond;
  for (const PlacedBody& body : run.bodies()) {
    // Of a body that is still held the world knows no mass: its own is that of its shapes.
    const Result<MassProperties> mass = run.world().massProperties(body.id);
    const bool moves = body.def.type == BodyType::dynamic;
    header.bodies.push_back({body.name, body.role, body.colour, moves && mass ? mass->mass : 0, body.def.shapes});
  }
  header.cameras = scene.cameras;
  return header;
}

bool isHeld(const SceneRun& run, const PlacedBody& body) {
  const Result<BodyState> state = run.world().state(body.id);
  return state && body.def.type == BodyType::dynamic && state->type != BodyType::dynamic;
}

}  // namespace

TakeRecorder::TakeRecorder(TakeRecorder&&) noexcept = default;
TakeRecorder::~TakeRecorder() = default;

TakeRecorder::TakeRecorder(std::unique_ptr<AsideFile> aside, TakeWriter writer, const SceneRun& run,
                           double framesPerSecond)
    : aside_(std::move(aside)), writer_(std::move(writer)), framesPerSecond_(framesPerSecond) {
  const std::vector<PlacedBody>& bodies = run.bodies();
  for (std::size_t i = 0; i < bodies.size(); i++) {
    const std::size_t index = bodies[i].id.index;
    if (index >= placeByIndex_.size()) placeByIndex_.resize(index + 1, -1);
    placeByIndex_[index] = int(i);
    if (isHeld(run, bodies[i])) held_.push_back(i);
  }
}

Result<TakeRecorder> TakeRecorder::create(const std::string& path, const SceneRun& run) {
  // No more frames than steps.
  const double rate = std::min(run.scene().framesPerSecond, 1 / run.scene().timeStep);
  Result<AsideFile> opened = AsideFile::open(path);
  if (!opened) return opened.error();
  auto aside = std::make_unique<AsideFile>(std::move(opened).value());
  Result<TakeWriter> writer = TakeWriter::create(aside->name(), headerOf(run, rate));
  if (!writer) {
    aside->remove();
    return writer.error();
  }
  TakeRecorder recorder(std::move(aside), std::move(writer).value(), run, rate);
  if (Status written = recorder.writeFrame(run); !written) {
    recorder.aside_->remove();  // without a frame it is of no use
    return written.error();
  }
  return recorder;
}

Status TakeRecorder::finish(const std::string& summaryJson) {
  if (Status finished = writer_.finish(summaryJson); !finished) return finished;
  return aside_->takePlace();
}

const std::string& TakeRecorder::file() const { return aside_->name(); }

Status TakeRecorder::afterStep(const SceneRun& run, const StepReport& report) {
  collectEvents(run, report);
  const double frames = std::floor(report.time * framesPerSecond_ + 1e-6);
  if (frames < nextFrame_) return {};
  nextFrame_ = frames + 1;
  return writeFrame(run);
}

void TakeRecorder::collectEvents(const SceneRun& run, const StepReport& report) {
  const auto add = [&](TakeEventType type, int body) {
    if (body >= 0) events_.push_back({type, std::uint32_t(body), 0, {}, 0});
  };
  std::erase_if(held_, [&](std::size_t place) {
    if (isHeld(run, run.bodies()[place])) return false;
    add(TakeEventType::launch, int(place));
    return true;
  });
  for (const HitEvent& hit : run.world().events().hits) {
    const int a = placeOf(hit.bodyA), b = placeOf(hit.bodyB);
    if (a < 0 || b < 0) continue;
    events_.push_back(
        {TakeEventType::hit, std::uint32_t(a), std::uint32_t(b), hit.pointWorld, static_cast<float>(hit.impulse)});
  }
  for (BodyId id : run.world().events().fellAsleep) add(TakeEventType::fellAsleep, placeOf(id));
  for (BodyId id : report.quarantined) add(TakeEventType::quarantined, placeOf(id));
}

Status TakeRecorder::writeFrame(const SceneRun& run) {
  const World& world = run.world();
  TakeFrame frame;
  frame.time = run.time();
  frame.poses.resize(run.bodies().size());
  for (std::size_t i = 0; i < frame.poses.size(); i++) {
    const Result<BodyState> state = world.state(run.bodies()[i].id);
    if (!state) return state.error();
    frame.poses[i] = {state->position, state->rotation, static_cast<float>(length(state->linearVelocity)), 0};
  }
  world.forEachContact([&](const ContactView& contact) {
    float force = 0;
    for (int i = 0; i < contact.pointCount; i++) force += static_cast<float>(contact.points[i].normalForce);
    for (BodyId id : {contact.bodyA, contact.bodyB})
      if (const int place = placeOf(id); place >= 0) frame.poses[std::size_t(place)].contactForce += force;
  });
  frame.events = std::move(events_);
  events_.clear();
  return writer_.write(frame);
}

}  // namespace brickfall
