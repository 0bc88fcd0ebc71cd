// A trace: a hash of what every stage of every step wrote. Text, a line each, so that `diff` can read it too.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "brickfall/result.h"

namespace brickfall::cli {

struct TraceItem {
  std::string name;  // of the body, or of both of a contact: "a | b"
  std::uint64_t hash = 0;
};

struct TraceStage {
  std::uint64_t step = 0;  // from 1
  int substep = 0;         // from 0
  std::string stage;       // "given" (what the step starts from) or one of kStageNames
  std::uint64_t hash = 0;
  std::vector<TraceItem> items;  // only of the step that was asked for
};

struct Trace {
  std::string scene;
  std::uint64_t seed = 0;
  double timeStep = 0;  // s
  std::vector<TraceStage> stages;
  bool complete = true;  // false: the run was cut off
};

std::string toText(const Trace& trace);
// Mistakes name file and line. A text that ends early gives what is there, with `complete` false.
Result<Trace> parseTrace(std::string_view text, const std::string& file);

// Where two traces part: the first stage that differs.
struct Parting {
  std::uint64_t step = 0;
  int substep = 0;
  std::string stage;
  bool hasItems = false;  // of both
  std::string item;       // the first body or contact that differs, if it is known
  bool ended = false;     // one of the traces has no more; until there they are the same
};
std::optional<Parting> firstParting(const Trace& a, const Trace& b);

}  // namespace brickfall::cli
