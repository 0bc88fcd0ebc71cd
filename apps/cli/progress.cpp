#include "cli/progress.h"

#include <fmt/core.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "cli/console.h"

namespace brickfall::cli {
namespace {

constexpr double kRedrawSeconds = 0.1;

double shareDone(const ProgressState& s) {
  return s.totalSeconds > 0 ? std::clamp(s.simulatedSeconds / s.totalSeconds, 0.0, 1.0) : 0;
}

double shareDone(const WorkState& s) { return s.total > 0 ? double(s.done) / double(s.total) : 0; }

std::string bar(double share, int width) {
  const int full = int(share * width);
  std::string text(std::size_t(width), ' ');
  for (int i = 0; i < full; i++) text[std::size_t(i)] = '#';
  return '[' + text + ']';
}

int terminalColumns() {
  winsize size{};
  if (ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return 80;
}

}  // namespace

std::string durationText(double seconds) {
  if (!(seconds >= 0 && seconds < 1e7)) return "very long";
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const long whole = std::lround(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
}

std::string progressText(const ProgressState& s) {
  std::string text = fmt::format("{:6.2f} of {:g} s", s.simulatedSeconds, s.totalSeconds);
  if (!(s.wallSeconds > 0) || s.steps == 0) return text;
  const double factor = s.simulatedSeconds / s.wallSeconds;
  text += fmt::format("  {:.0f} steps/s  {:.{}f} x real time", double(s.steps) / s.wallSeconds, factor,
                      factor < 0.1  ? 3
                      : factor < 10 ? 1
                                    : 0);
  const double share = shareDone(s);
  if (share > 0 && share < 0.9999) text += "  " + durationText(s.wallSeconds * (1 - share) / share) + " left";
  return text;
}

std::string workText(const WorkState& s) {
  std::string text = fmt::format("{} {} of {}", s.unit, s.done, s.total);
  if (!(s.wallSeconds > 0) || s.done <= s.doneBefore) return text;
  const double each = s.wallSeconds / double(s.done - s.doneBefore);
  if (each < 0.00995)
    text += fmt::format("  {:.2f} ms each", 1000 * each);
  else
    text += fmt::format("  {:.{}f} s each", each, each < 9.95 ? 2 : 0);
  if (s.done < s.total) text += "  " + durationText(each * double(s.total - s.done)) + " left";
  return text;
}

namespace {

std::string textOf(const ProgressState& s) { return progressText(s); }
std::string textOf(const WorkState& s) { return workText(s); }

std::string lineOf(double share, const std::string& text, int columns) {
  constexpr int kLongestBar = 30, kShortestBar = 8;
  std::string line = fmt::format("{:3.0f} % ", std::floor(share * 100));
  const int room = columns - int(line.size() + text.size()) - 3;
  if (room >= kShortestBar) line += bar(share, std::min(room, kLongestBar)) + ' ';
  line += text;
  if (int(line.size()) > columns) line.resize(std::size_t(std::max(columns, 0)));
  return line;
}

}  // namespace

std::string progressLine(const ProgressState& s, int columns) { return lineOf(shareDone(s), progressText(s), columns); }
std::string workLine(const WorkState& s, int columns) { return lineOf(shareDone(s), workText(s), columns); }

ProgressDisplay::Mode ProgressDisplay::modeForOutput(bool quiet) {
  if (quiet) return Mode::silent;
  const char* terminal = std::getenv("TERM");
  const bool cursor = terminal != nullptr && std::string_view(terminal) != "dumb";
  return isatty(STDOUT_FILENO) == 1 && cursor ? Mode::live : Mode::plain;
}

void ProgressDisplay::draw(const std::string& line) {
  std::fputs(("\r" + line + "\x1b[K").c_str(), stdout);
  std::fflush(stdout);
  drawn_ = true;
}

template <class State> void ProgressDisplay::show(const State& state, bool end) {
  if (mode_ == Mode::live) {
    if (lastDraw_ >= 0 && state.wallSeconds - lastDraw_ < kRedrawSeconds && !end) return;
    lastDraw_ = state.wallSeconds;
    draw(lineOf(shareDone(state), textOf(state), terminalColumns() - 1));
  } else if (mode_ == Mode::plain) {
    // A little slack: ten tenths of a sum of time steps may end a hair short of the whole.
    const int tenth = int(std::floor(shareDone(state) * 10 + 1e-6));
    if (tenth < nextTenth_) return;
    nextTenth_ = tenth + 1;
    sayf("{:3} % {}", tenth * 10, textOf(state));
  }
}

void ProgressDisplay::update(const ProgressState& state) { show(state, state.simulatedSeconds >= state.totalSeconds); }
void ProgressDisplay::updateWork(const WorkState& state) { show(state, state.done >= state.total); }

void ProgressDisplay::update(const std::string& what, double share) {
  if (mode_ != Mode::live) return;
  const std::string line = fmt::format("{:3.0f} % {}", std::floor(std::clamp(share, 0.0, 1.0) * 100), what);
  if (line == lastLine_) return;
  lastLine_ = line;
  draw(line);
}

void ProgressDisplay::finish() {
  if (drawn_) {
    std::fputs("\r\x1b[K", stdout);
    std::fflush(stdout);
  }
  drawn_ = false;
}

}  // namespace brickfall::cli
