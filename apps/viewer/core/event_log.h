// What happened, as lines for the panel: the last ones, numbered over the whole session.
#pragma once
#include <deque>
#include <memory>
#include <vector>

#include "viewer_core/frame.h"

namespace brickfall::viewer {

class EventLog {
 public:
  void add(double time, LogKind kind, std::string text);
  // The same object until a line is added.
  std::shared_ptr<const std::vector<LogLine>> lines() const;

 private:
  std::deque<LogLine> lines_;
  std::uint64_t next_ = 1;
  mutable std::shared_ptr<const std::vector<LogLine>> shown_;
};

// "12.3", "0.45", "1.2e+06": three digits.
std::string shortNumber(double value);

}  // namespace brickfall::viewer
