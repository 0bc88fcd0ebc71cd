#include "viewer_window/desk.h"

#include <algorithm>

namespace brickfall::viewer {
namespace {

constexpr double kShownSeconds = 5;
constexpr std::size_t kMostErrors = 3;

}  // namespace

void Desk::say(std::string text, bool error, double now, std::vector<std::string> details) {
  // Done is told in one place, the last thing alone; a mistake once, however often it is made, and each line of it once.
  std::erase(details, text);
  std::erase_if(messages, [&](const Message& old) { return error ? old.text == text : !old.error; });
  messages.push_back({std::move(text), std::move(details), error, now + kShownSeconds});
  const auto isError = [](const Message& message) { return message.error; };
  if (std::size_t(std::count_if(messages.begin(), messages.end(), isError)) > kMostErrors)
    messages.erase(std::find_if(messages.begin(), messages.end(), isError));
}

}  // namespace brickfall::viewer
