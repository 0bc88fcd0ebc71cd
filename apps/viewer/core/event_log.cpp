#include "viewer_core/event_log.h"

#include <cstdio>

namespace brickfall::viewer {

void EventLog::add(double time, LogKind kind, std::string text) {
  lines_.push_back({next_++, time, kind, std::move(text)});
  if (lines_.size() > kLogLines) lines_.pop_front();
  shown_.reset();
}

std::shared_ptr<const std::vector<LogLine>> EventLog::lines() const {
  if (!shown_) shown_ = std::make_shared<const std::vector<LogLine>>(lines_.begin(), lines_.end());
  return shown_;
}

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

}  // namespace brickfall::viewer
