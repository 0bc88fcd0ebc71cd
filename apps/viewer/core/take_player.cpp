#include "viewer_core/take_player.h"

#include <algorithm>
#include <cmath>

namespace brickfall::viewer {

namespace {

constexpr double kNever = -1e9;           // s
constexpr std::size_t kMostHitLines = 3;  // of a frame

// Places of a number in an ascending list, or -1.
int placeOf(const std::vector<std::uint32_t>& numbers, std::uint32_t number) {
  const auto found = std::lower_bound(numbers.begin(), numbers.end(), number);
  return found != numbers.end() && *found == number ? int(found - numbers.begin()) : -1;
}

}  // namespace

TakePlayer::TakePlayer(TakeReader take, std::string path, Serial firstSerial)
    : take_(std::move(take)), firstSerial_(firstSerial) {
  auto info = std::make_shared<RunInfo>();
  const TakeHeader& header = take_.header();
  info->kind = RunKind::take;
  info->file = std::move(path);
  info->name = header.scene;
  info->title = header.title;
  info->cameras = header.cameras;
  if (info->cameras.empty()) info->cameras.push_back({});
  info->ground = -1e30;
  hitAt_.assign(take_.bodies().size(), kNever);
  info_ = std::move(info);
}

Result<std::unique_ptr<TakePlayer>> TakePlayer::open(const std::string& path, Serial& nextSerial) {
  Result<TakeReader> take = TakeReader::open(path);
  if (!take) return take.error();
  if (take->frameCount() == 0)
    return Error{ErrorCode::badFormat, path + ": found a take without frames, expected at least one"};
  const Serial first = nextSerial;
  nextSerial += Serial(take->bodies().size());
  std::unique_ptr<TakePlayer> player(new TakePlayer(std::move(*take), path, first));
  if (Status there = player->go(player->last()); !there) return there.error();
  player->lastTime_ = player->now_.time;
  if (Status there = player->go(0); !there) return there.error();
  player->firstTime_ = player->now_.time;
  auto info = std::make_shared<RunInfo>(*player->info_);
  info->seconds = player->lastTime_;
  info->extent = player->extent();
  for (std::size_t i = 0; i < player->numbers_.size(); i++) {
    const TakeBody& body = player->take_.bodies()[player->numbers_[i]];
    if (body.role != BodyRole::ground) continue;
    const TakePose& pose = player->now_.poses[i];
    for (const ShapeDef& shape : body.shapes)
      if (shape.type == ShapeType::plane)
        info->ground = std::max(info->ground, pose.position.y + shape.local.position.y);
  }
  player->info_ = std::move(info);
  return player;
}

// Of what moves, in the first frame.
Aabb TakePlayer::extent() const {
  std::optional<Aabb> all;
  for (std::size_t i = 0; i < numbers_.size(); i++) {
    const TakeBody& body = take_.bodies()[numbers_[i]];
    if (!(body.mass > 0)) continue;
    for (const ShapeDef& shape : body.shapes) {
      const Aabb box = bounds(shape, Transform{now_.poses[i].position, now_.poses[i].rotation});
      all = all ? merged(*all, box) : box;
    }
  }
  return all.value_or(Aabb{{-1, 0, -1}, {1, 1, 1}});
}

Status TakePlayer::go(std::size_t frame) {
  Result<TakeFrame> found = take_.frame(frame);
  if (!found) return found.error();
  now_ = std::move(*found);
  at_ = frame;
  std::vector<std::uint32_t> there = take_.bodiesAt(frame);
  if (!list_ || there != numbers_) {
    numbers_ = std::move(there);
    list();
  }
  return {};
}

void TakePlayer::list() {
  auto made = std::make_shared<BodyList>();
  for (std::uint32_t number : numbers_) {
    const TakeBody& from = take_.bodies()[number];
    ListedBody body;
    body.serial = firstSerial_ + number;
    body.name = from.name;
    body.role = from.role;
    body.colour = from.colour;
    body.material = from.shapeMaterials.empty() ? from.material : from.shapeMaterials.front();
    body.mass = from.mass;
    body.shapes = from.shapes;
    for (const ShapeDef& shape : from.shapes) {
      if (shape.type == ShapeType::plane) continue;
      const Aabb box = bounds(shape, Transform{});
      body.radius = std::max(body.radius, length(max(abs(box.lower), abs(box.upper))));
    }
    made->bodies.push_back(std::move(body));
  }
  list_ = std::move(made);
}

void TakePlayer::hear(EventLog* log) {
  std::size_t hits = 0, asleep = 0;
  const auto name = [&](std::uint32_t number) { return take_.bodies()[number].name; };
  for (const TakeEvent& event : now_.events) {
    if (event.type == TakeEventType::hit) {
      hitAt_[event.bodyA] = hitAt_[event.bodyB] = now_.time;
      if (log && ++hits <= kMostHitLines)
        log->add(now_.time, LogKind::hit,
                 name(event.bodyA) + " and " + name(event.bodyB) + ": " + shortNumber(event.impulse) + " N s");
    }
    if (!log) continue;
    if (event.type == TakeEventType::launch) log->add(now_.time, LogKind::launch, name(event.bodyA) + " was launched");
    if (event.type == TakeEventType::quarantined)
      log->add(now_.time, LogKind::quarantine, name(event.bodyA) + " became non-finite");
    asleep += event.type == TakeEventType::fellAsleep;
  }
  if (log && hits > kMostHitLines)
    log->add(now_.time, LogKind::hit, "and " + std::to_string(hits - kMostHitLines) + " more hits");
  if (log && asleep > 0) log->add(now_.time, LogKind::asleep, std::to_string(asleep) + " bodies fell asleep");
}

Status TakePlayer::step(int frames, EventLog* log) {
  for (; frames > 0 && at_ < last(); frames--) {
    TakeFrame old = now_;
    std::vector<std::uint32_t> oldNumbers = numbers_;
    if (Status there = go(at_ + 1); !there) return there;
    previous_ = std::move(old);
    previousNumbers_ = std::move(oldNumbers);
    hear(log);
  }
  if (frames >= 0) return {};
  const std::size_t back = std::min<std::size_t>(at_, std::size_t(-std::int64_t(frames)));
  return seek(firstTime_ + double(at_ - back) * dt());
}

// Frames come at a steady rate; the last may be late.
Status TakePlayer::seek(double time) {
  if (!(time >= -1e9 && time <= 1e9)) return Error{ErrorCode::invalidArgument, "seek: found no time"};
  double place = std::floor((time - firstTime_) / dt() + 1e-6);
  if (time >= lastTime_ - 1e-9) place = double(last());
  const std::size_t frame = std::size_t(std::clamp(place, 0.0, double(last())));
  previous_ = {};
  previousNumbers_.clear();
  if (frame > 0) {
    if (Status there = go(frame - 1); !there) return there;
    previous_ = now_;
    previousNumbers_ = numbers_;
  }
  if (Status there = go(frame); !there) return there;
  std::fill(hitAt_.begin(), hitAt_.end(), kNever);
  hear(nullptr);
  jump();
  return {};
}

void TakePlayer::fill(Frame& frame, const FrameNeeds& needs, Serial selected) {
  frame.info = info_;
  frame.list = list_;
  frame.bodies.resize(numbers_.size());
  const double span = now_.time - previous_.time;
  for (std::size_t i = 0; i < numbers_.size(); i++) {
    FrameBody& body = frame.bodies[i];
    const TakePose& pose = now_.poses[i];
    body.pose = body.before = {pose.position, pose.rotation};
    body.activity = take_.bodies()[numbers_[i]].mass > 0 ? Activity::awake : Activity::fixed;
    body.contactForce = pose.contactForce;
    body.touching = needs.collisions && pose.contactForce > 0;
    body.sinceHit = float(now_.time - hitAt_[numbers_[i]]);
    if (const int was = before_.empty() ? -1 : placeOf(beforeNumbers_, numbers_[i]); was >= 0)
      body.before = before_[std::size_t(was)];
    if (const int was = placeOf(previousNumbers_, numbers_[i]); was >= 0 && span > 0) {
      const TakePose& from = previous_.poses[std::size_t(was)];
      body.linearVelocity = (pose.position - from.position) * (1 / span);
      body.angularVelocity = rotationVector(normalized(pose.rotation * conjugate(from.rotation))) * (1 / span);
    }
    if (list_->bodies[i].serial != selected) continue;
    SelectedBody s;
    s.serial = selected;
    s.name = list_->bodies[i].name;
    s.mass = list_->bodies[i].mass;
    s.speed = pose.speed;
    s.spin = length(body.angularVelocity);
    s.centreOfMass = pose.position;
    frame.selected = std::move(s);
  }
  beforeNumbers_ = numbers_;
  before_.resize(frame.bodies.size());
  for (std::size_t i = 0; i < before_.size(); i++) before_[i] = frame.bodies[i].pose;
}

}  // namespace brickfall::viewer
