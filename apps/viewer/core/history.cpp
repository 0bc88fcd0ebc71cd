#include "viewer_core/history.h"

#include <zstd.h>

#include <algorithm>
#include <chrono>

namespace brickfall::viewer {

namespace {

constexpr int kLevel = 1;        // of zstd: higher ones take longer than a step may
constexpr double kSlack = 1e-9;  // s: times are sums
constexpr std::size_t kLargestSnapshot = 1u
                                         << 30;  // bytes: a quarter of a million bodies; a forged state claims no more

}  // namespace

std::vector<std::byte> compressed(std::span<const std::byte> bytes) {
  std::vector<std::byte> out(ZSTD_compressBound(bytes.size()));
  const std::size_t size = ZSTD_compress(out.data(), out.size(), bytes.data(), bytes.size(), kLevel);
  out.resize(ZSTD_isError(size) ? 0 : size);
  out.shrink_to_fit();
  return out;
}

Result<std::vector<std::byte>> decompressed(std::span<const std::byte> bytes) {
  const Error bad{ErrorCode::badFormat, "snapshot: damaged or cut off (it can't be decompressed)"};
  const unsigned long long size = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (size == ZSTD_CONTENTSIZE_UNKNOWN || size == ZSTD_CONTENTSIZE_ERROR || size > kLargestSnapshot) return bad;
  // zstd makes at most some 100 000 times as much of what it is given: a forged size can't claim more.
  if (size / 200'000 > bytes.size()) return bad;
  std::vector<std::byte> out{std::size_t(size)};
  const std::size_t done = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(done) || done != out.size()) return bad;
  return out;
}

PackedBytes::PackedBytes(std::vector<std::byte> bytes) : before_(bytes.size()) {
  // Where there is no thread to be had it is done when it is asked for.
  constexpr auto kEither = std::launch::async | std::launch::deferred;
  packed_ = std::async(kEither, [raw = std::move(bytes)] { return compressed(raw); }).share();
}

Result<std::vector<std::byte>> PackedBytes::unpacked() const { return decompressed(packed_.get()); }

std::size_t PackedBytes::size() const {
  const bool done = packed_.valid() && packed_.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
  return done ? packed_.get().size() : before_;
}

std::size_t History::bytes() const {
  std::size_t sum = 0;
  for (const Kept& kept : kept_) sum += kept.bytes.size();
  return sum;
}

void History::begin(std::uint64_t step, double time) {
  kept_.clear();
  log_.clear();
  firstCommand_ = 0;
  times_.assign(1, time);
  firstStep_ = step;
  window_ = {step, 0};
}

Moment History::end() const { return {firstStep_ + times_.size() - 1, firstCommand_ + log_.size()}; }
double History::latest() const { return times_.back(); }
double History::earliest() const { return timeAt(window_); }

bool History::due(double time) const {
  for (auto kept = kept_.rbegin(); kept != kept_.rend(); ++kept)
    if (kept->regular) return time >= kept->time + limits_.interval - kSlack;
  return true;
}

bool History::keptAt(const Moment& moment) const {
  return std::any_of(kept_.begin(), kept_.end(), [&](const Kept& kept) { return kept.moment == moment; });
}

void History::keep(Kept kept) {
  if (kept_.empty()) window_ = kept.moment;
  kept_.push_back(std::move(kept));
  trim();
}

void History::stepped(double time) { times_.push_back(time); }

void History::did(Command command, Serial made) { log_.push_back({end().step, std::move(command), made}); }

void History::cutAfter(const Moment& moment) {
  while (!kept_.empty() && kept_.back().moment > moment) kept_.pop_back();
  // Taken before a change that is cut off with all that came after it.
  if (!kept_.empty() && kept_.back().moment == moment) kept_.back().change.clear();
  if (moment >= window_) {
    times_.resize(std::size_t(moment.step - firstStep_ + 1));
    log_.resize(std::size_t(moment.commands - firstCommand_));
    return;
  }
  // A change can lie before the window: the run goes on from there, and only from there on its steps are known.
  log_.clear();
  firstCommand_ = moment.commands;
  times_.assign(1, kept_.back().time);
  firstStep_ = moment.step;
  window_ = moment;
}

Moment History::at(double time) const {
  const Moment last = end();
  if (time >= latest() - kSlack) return last;
  Moment moment = window_;
  while (moment.step < last.step && timeAt({moment.step + 1, 0}) <= time + kSlack) moment.step++;
  if (moment.step == window_.step) return window_;
  while (moment.commands < last.commands && command(moment.commands)->step < moment.step) moment.commands++;
  return moment;
}

const Kept* History::before(const Moment& moment) const {
  const Kept* best = nullptr;
  for (const Kept& kept : kept_)
    if (kept.moment >= window_ && kept.moment <= moment && kept.moment.commands <= moment.commands) best = &kept;
  return best;
}

const Logged* History::command(std::uint64_t number) const {
  return number < firstCommand_ || number >= firstCommand_ + log_.size() ? nullptr
                                                                         : &log_[std::size_t(number - firstCommand_)];
}

const Kept* History::lastChange(const Moment& from) const {
  const Kept* last = nullptr;
  for (const Kept& kept : kept_)
    if (!kept.change.empty() && kept.moment < from) last = &kept;
  return last;
}

// The window keeps one snapshot that is older than its length, so that all of it is within reach. Older ones go, but for changes,
// to which Undo goes back without the steps between.
void History::trim() {
  const double oldest = latest() - limits_.seconds;
  for (const Kept& kept : kept_)
    if (kept.moment >= window_ && kept.time <= oldest + kSlack) window_ = kept.moment;
  std::size_t changes = 0;
  for (auto kept = kept_.rbegin(); kept != kept_.rend(); ++kept) {
    changes += !kept->change.empty();
    if (changes > limits_.mostUndos) kept->change.clear();
  }
  std::erase_if(kept_, [&](const Kept& kept) { return kept.moment < window_ && kept.change.empty(); });
  // Those that only save time have half of the room.
  const auto spare = [](const Kept& kept) { return !kept.regular && kept.change.empty(); };
  while (bytes() > limits_.mostBytes / 2) {
    const auto first = std::find_if(kept_.begin(), kept_.end(), spare);
    if (first == kept_.end() || first + 1 == kept_.end()) break;
    if (first->moment == window_) window_ = (first + 1)->moment;
    kept_.erase(first);
  }
  while (kept_.size() > 1 && bytes() > limits_.mostBytes) {
    kept_.pop_front();
    window_ = std::max(window_, kept_.front().moment);
  }
  dropLog();
}

// Steps and commands before the window.
void History::dropLog() {
  while (firstStep_ < window_.step) {
    times_.pop_front();
    firstStep_++;
  }
  while (!log_.empty() && log_.front().step < window_.step) {
    log_.pop_front();
    firstCommand_++;
  }
}

}  // namespace brickfall::viewer
