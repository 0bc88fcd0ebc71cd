#include "viewer_window/desk.h"

namespace brickfall::viewer {
namespace {

constexpr double kShownSeconds = 5;
constexpr std::size_t kMostMessages = 4;

}  // namespace

void Desk::say(std::string text, bool error, double now, std::vector<std::string> details) {
  if (!messages.empty() && messages.back().text == text) messages.pop_back();
  messages.push_back({std::move(text), std::move(details), error, now + kShownSeconds});
  if (messages.size() > kMostMessages) messages.erase(messages.begin());
}

}  // namespace brickfall::viewer
