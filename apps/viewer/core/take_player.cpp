#include "viewer_core/take_player.h"

#include <algorithm>
#include <cmath>

#include "brickfall/fall.h"
#include "viewer_core/mortar_story.h"
#include "viewer_core/shape_facts.h"

namespace brickfall::viewer {

namespace {

constexpr double kSlack = 1e-6;           // s: times are sums
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
  info->ground = kNoGround;
  lastHit_.resize(take_.bodies().size());
  info_ = std::move(info);
}

Result<std::unique_ptr<TakePlayer>> TakePlayer::start(TakeReader take, const std::string& path, Serial& nextSerial) {
  if (take.frameCount() == 0)
    return Error{ErrorCode::badFormat, path + ": found a take without frames, expected at least one"};
  const Serial first = nextSerial;
  nextSerial += Serial(take.bodies().size());
  std::unique_ptr<TakePlayer> player(new TakePlayer(std::move(take), path, first));
  player->readMortar();
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
    info->ground = std::max(info->ground, topOf(body.shapes, Transform{pose.position, pose.rotation}));
  }
  player->info_ = std::move(info);
  return player;
}

// One walk through the take: how joints broke, and who fell by which of them.
void TakePlayer::readMortar() {
  if (take_.mortar().empty()) return;
  firstPlace_.resize(take_.bodies().size());
  for (std::size_t f = 0; f <= last(); f++) {
    const Result<TakeFrame> frame = take_.frame(f);
    if (!frame) continue;  // told when it is shown
    breaks_.insert(breaks_.end(), frame->breaks.begin(), frame->breaks.end());
    const std::vector<std::uint32_t> there = take_.bodiesAt(f);
    for (std::size_t k = 0; k < there.size(); k++)
      if (take_.lives()[there[k]].birth == f) firstPlace_[there[k]] = frame->poses[k].position;
  }
  std::vector<std::size_t> breakOf(take_.mortar().size(), breaks_.size()), ofJoint;
  for (std::size_t k = 0; k < breaks_.size(); k++) breakOf[breaks_[k].mortar] = k;
  std::vector<FallJoint> joints;
  for (std::size_t k = 0; k < breakOf.size(); k++) {
    const bool broke = breakOf[k] < breaks_.size();
    if (!broke && take_.mortarLives()[k].end <= last()) continue;  // it ended with a body
    FallJoint joint{take_.mortar()[k].bodyA, take_.mortar()[k].bodyB};
    if (broke) joint.breakTime = breaks_[breakOf[k]].breakTime;
    if (broke) joint.lift = breaks_[breakOf[k]].force.y;
    joints.push_back(joint);
    ofJoint.push_back(breakOf[k]);
  }
  std::vector<bool> moves;
  for (const TakeBody& body : take_.bodies()) moves.push_back(body.mass > 0);
  const FallFinder finder(joints, moves);
  fallOf_.assign(moves.size(), breaks_.size());
  for (std::uint32_t body = 0; body < moves.size(); body++)
    if (const std::optional<std::uint32_t> first = finder.first(body)) fallOf_[body] = ofJoint[*first];
}

void TakePlayer::fillMortar(Frame& frame) const {
  const std::vector<std::uint32_t> there = take_.mortarAt(at_);
  for (std::size_t k = 0; k < there.size() && k < now_.mortar.size(); k++) {
    const TakeMortar& joint = take_.mortar()[there[k]];
    const int place = placeOf(numbers_, joint.bodyA);
    if (place < 0) continue;
    frame.mortar.push_back(
        {place, joint.centre, joint.along1, joint.along2, now_.mortar[k].utilisation, now_.mortar[k].damage});
  }
}

std::vector<std::string> TakePlayer::mortarOf(std::uint32_t body, const TakePose& pose) const {
  MortarCount count;
  const std::vector<std::uint32_t> there = take_.mortarAt(at_);
  for (std::size_t k = 0; k < there.size() && k < now_.mortar.size(); k++) {
    const TakeMortar& joint = take_.mortar()[there[k]];
    if (joint.bodyA != body && joint.bodyB != body) continue;
    count.all++;
    if (now_.mortar[k].damage >= 1) continue;
    count.hold++;
    count.utilisation = std::max(count.utilisation, double(now_.mortar[k].utilisation));
  }
  if (fallOf_.empty() || fallOf_[body] >= breaks_.size()) return mortarLines(count, nullptr);
  const TakeBreak& first = breaks_[fallOf_[body]];
  if (first.breakTime > now_.time + kSlack || length(pose.position - firstPlace_[body]) < kFellWay)
    return mortarLines(count, nullptr);
  auto nameOf = [&](std::uint32_t number) { return take_.bodies()[number].name; };
  const TakeMortar& joint = take_.mortar()[first.mortar];
  ToldBreak told{first.breakTime,     first.mode,          double(first.tensionShare), double(first.shearShare),
                 length(first.force), nameOf(joint.bodyA), nameOf(joint.bodyB),        {}};
  for (const TakeLoadTaker& taker : first.takers)
    told.takers.push_back({taker.mortar == TakeLoadTaker::kContacts, nameOf(taker.bodyA), nameOf(taker.bodyB),
                           double(taker.before), double(taker.after)});
  return mortarLines(count, &told);
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
  const bool readAhead = frame == at_ + 1 && next_.time > now_.time;
  Result<TakeFrame> found = readAhead ? Result<TakeFrame>(std::move(next_)) : take_.frame(frame);
  if (!found) return found.error();
  now_ = std::move(*found);
  at_ = frame;
  next_ = {};
  if (frame < last()) {
    Result<TakeFrame> after = take_.frame(frame + 1);
    if (!after) return after.error();
    next_ = std::move(*after);
  }
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
    body.number = from.look.value_or(number);
    body.name = from.name;
    body.role = from.role;
    body.colour = from.colour;
    body.material = from.shapeMaterials.empty() ? from.material : from.shapeMaterials.front();
    body.mass = from.mass;
    body.shapes = from.shapes;
    body.drawnMaterials = from.shapeMaterials;
    body.drawnColours = from.shapeColours;
    body.radius = radiusOf(from.shapes);
    made->bodies.push_back(std::move(body));
  }
  list_ = std::move(made);
}

void TakePlayer::hear(EventLog* log) {
  std::size_t hits = 0, asleep = 0;
  const auto name = [&](std::uint32_t number) { return take_.bodies()[number].name; };
  for (const TakeEvent& event : now_.events) {
    if (event.type == TakeEventType::hit) {
      for (const std::uint32_t number : {event.bodyA, event.bodyB}) {
        const double mass = take_.bodies()[number].mass;
        const float speed = mass > 0 ? float(event.impulse / mass) : 0;
        Hit& hit = lastHit_[number];
        hit = {now_.time, hit.time == now_.time ? std::max(hit.speed, speed) : speed};
      }
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
  return jumpTo(at_ - std::min<std::size_t>(at_, std::size_t(-std::int64_t(frames))));
}

double TakePlayer::dt() const {
  const double usual = 1 / take_.header().framesPerSecond, step = next_.time - now_.time;
  return at_ < last() && step > 0 ? step : usual;
}

Status TakePlayer::seek(double time) {
  if (!(time >= -1e9 && time <= 1e9)) return Error{ErrorCode::invalidArgument, "seek: found no time"};
  const Result<std::size_t> frame = frameAt(time);
  return frame ? jumpTo(*frame) : Status(frame.error());
}

// The last frame that is not later. Mostly they come at a steady rate, so the two where it should be are looked at first.
Result<std::size_t> TakePlayer::frameAt(double time) const {
  if (time >= lastTime_ - kSlack) return last();
  std::size_t from = 0, to = last();
  const auto narrow = [&](std::size_t frame) -> Status {
    const Result<TakeFrame> found = take_.frame(frame);
    if (!found) return found.error();
    (found->time <= time + kSlack ? from : to) = frame;
    return {};
  };
  const double place = (time - firstTime_) * take_.header().framesPerSecond + kSlack;
  const auto guess = std::size_t(std::clamp(place, 0.0, double(to)));
  for (const std::size_t near : {guess, guess + 1})
    if (near > from && near < to)
      if (Status read = narrow(near); !read) return read.error();
  while (to - from > 1)
    if (Status read = narrow(from + (to - from) / 2); !read) return read.error();
  return from;
}

Status TakePlayer::jumpTo(std::size_t frame) {
  previous_ = {};
  previousNumbers_.clear();
  if (frame > 0) {
    if (Status there = go(frame - 1); !there) return there;
    previous_ = now_;
    previousNumbers_ = numbers_;
  }
  if (Status there = go(frame); !there) return there;
  std::fill(lastHit_.begin(), lastHit_.end(), Hit{});
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
    body.sinceHit = float(now_.time - lastHit_[numbers_[i]].time);
    body.hitSpeed = lastHit_[numbers_[i]].speed;
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
    s.material = list_->bodies[i].material;
    s.mass = list_->bodies[i].mass;
    s.speed = pose.speed;
    s.spin = length(body.angularVelocity);
    s.centreOfMass = pose.position;
    s.contactForce = pose.contactForce;
    s.mortar = mortarOf(numbers_[i], pose);
    frame.selected = std::move(s);
  }
  if (needs.mortar) fillMortar(frame);
  beforeNumbers_ = numbers_;
  before_.resize(frame.bodies.size());
  for (std::size_t i = 0; i < before_.size(); i++) before_[i] = frame.bodies[i].pose;
}

}  // namespace brickfall::viewer
