#include "cli/trace_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstddef>

namespace brickfall::cli {
namespace {

constexpr std::string_view kFirstLine = "brickfall-trace 1";

template <class T> bool readNumber(std::string_view text, T& value, int base = 10) {
  const char* end = text.data() + text.size();
  std::from_chars_result read{};
  if constexpr (std::is_floating_point_v<T>)
    read = std::from_chars(text.data(), end, value);
  else
    read = std::from_chars(text.data(), end, value, base);
  return read.ec == std::errc() && read.ptr == end;
}

// The part before the next blank, which is taken off the line.
std::string_view takeWord(std::string_view& line) {
  const std::size_t blank = std::min(line.find(' '), line.size());
  const std::string_view word = line.substr(0, blank);
  line.remove_prefix(std::min(blank + 1, line.size()));
  return word;
}

bool readHash(std::string_view word, std::uint64_t& hash) { return word.size() == 16 && readNumber(word, hash, 16); }

class TraceReader {
 public:
  explicit TraceReader(const std::string& file) : file_(file) {}

  Result<Trace> read(std::string_view text) {
    trace_.complete = false;
    while (!text.empty() && !trace_.complete) {
      const std::size_t end = text.find('\n');
      if (end == std::string_view::npos) break;  // a line that was cut off
      number_++;
      if (const Status status = readLine(text.substr(0, end)); !status) return status.error();
      text.remove_prefix(end + 1);
    }
    if (number_ == 0) return wrong("nothing", fmt::format("\"{}\"", kFirstLine));
    if (trace_.complete && !text.empty()) {
      number_++;
      return wrong("more text", "the end of the file after \"end\"");
    }
    return std::move(trace_);
  }

 private:
  Error wrong(std::string_view found, const std::string& expected) const {
    return {ErrorCode::badFormat,
            fmt::format("{}:{}: found {}, expected {}", file_, std::max(number_, 1), found, expected)};
  }
  Error wrongLine(std::string_view line, const std::string& expected) const {
    return wrong(fmt::format("\"{}\"", line.substr(0, 60)), expected);
  }

  Status readLine(std::string_view line) {
    if (number_ == 1) {
      if (line != kFirstLine) return wrongLine(line, fmt::format("\"{}\"", kFirstLine));
      return {};
    }
    std::string_view rest = line;
    const std::string_view key = takeWord(rest);
    if (key == "step") return readStage(line, rest);
    if (key == "item") return readItem(line, rest);
    bool fine = trace_.stages.empty();  // the head comes first
    if (key == "scene") {
      trace_.scene = rest;
    } else if (key == "seed") {
      fine = fine && readNumber(rest, trace_.seed);
    } else if (key == "time_step") {
      fine = fine && readNumber(rest, trace_.timeStep) && trace_.timeStep > 0;
    } else {
      fine = line == "end";
      trace_.complete = fine;
    }
    if (!fine) return wrongLine(line, "scene, seed, time_step, step, item or end");
    return {};
  }

  Status readStage(std::string_view line, std::string_view rest) {
    TraceStage s;
    const std::string_view step = takeWord(rest), substep = takeWord(rest);
    s.stage = takeWord(rest);
    const bool fine = readNumber(step, s.step) && s.step > 0 && readNumber(substep, s.substep) && s.substep >= 0 &&
                      !s.stage.empty() && readHash(rest, s.hash);
    if (!fine) return wrongLine(line, "step NUMBER SUBSTEP STAGE HASH");
    trace_.stages.push_back(std::move(s));
    return {};
  }

  Status readItem(std::string_view line, std::string_view rest) {
    TraceItem item;
    const bool fine = !trace_.stages.empty() && readHash(takeWord(rest), item.hash) && !rest.empty();
    if (!fine) return wrongLine(line, "item HASH NAME, after a step");
    item.name = rest;
    trace_.stages.back().items.push_back(std::move(item));
    return {};
  }

  const std::string& file_;
  Trace trace_;
  int number_ = 0;
};

std::string firstItem(const std::vector<TraceItem>& a, const std::vector<TraceItem>& b) {
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); i++)
    if (a[i].name != b[i].name || a[i].hash != b[i].hash) return a[i].name;
  if (a.size() == b.size()) return "";
  return (a.size() > b.size() ? a : b)[std::min(a.size(), b.size())].name;
}

}  // namespace

std::string toText(const Trace& trace) {
  std::string text =
      fmt::format("{}\nscene {}\nseed {}\ntime_step {}\n", kFirstLine, trace.scene, trace.seed, trace.timeStep);
  for (const TraceStage& s : trace.stages) {
    text += fmt::format("step {} {} {} {:016x}\n", s.step, s.substep, s.stage, s.hash);
    for (const TraceItem& item : s.items) text += fmt::format("item {:016x} {}\n", item.hash, item.name);
  }
  if (trace.complete) text += "end\n";
  return text;
}

Result<Trace> parseTrace(std::string_view text, const std::string& file) { return TraceReader(file).read(text); }

std::optional<Parting> firstParting(const Trace& a, const Trace& b) {
  const std::size_t common = std::min(a.stages.size(), b.stages.size());
  for (std::size_t i = 0; i < common; i++) {
    const TraceStage &x = a.stages[i], &y = b.stages[i];
    if (x.step == y.step && x.substep == y.substep && x.stage == y.stage && x.hash == y.hash) continue;
    Parting p{x.step, x.substep, x.stage};
    p.hasItems = !x.items.empty() && !y.items.empty();
    if (p.hasItems) p.item = firstItem(x.items, y.items);
    return p;
  }
  if (a.stages.size() == b.stages.size()) return {};
  const TraceStage& more = (a.stages.size() > common ? a : b).stages[common];
  Parting p{more.step, more.substep, more.stage};
  p.ended = true;
  return p;
}

}  // namespace brickfall::cli
