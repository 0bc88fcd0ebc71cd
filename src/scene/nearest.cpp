// Optimal string alignment distance (Levenshtein with swaps of neighbours).
#include "scene/nearest.h"

#include <algorithm>

namespace brickfall::scene {

namespace {

std::string plain(std::string_view word) {
  std::string out;
  for (char c : word.substr(0, 64))
    if (c != '_' && c != '-' && c != ' ') out += char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
  return out;
}

std::size_t distance(const std::string& a, const std::string& b) {
  std::size_t width = b.size() + 1;
  std::vector<std::size_t> d((a.size() + 1) * width);
  auto at = [&](std::size_t i, std::size_t j) -> std::size_t& { return d[i * width + j]; };
  for (std::size_t i = 0; i <= a.size(); i++) at(i, 0) = i;
  for (std::size_t j = 0; j <= b.size(); j++) at(0, j) = j;
  for (std::size_t i = 1; i <= a.size(); i++)
    for (std::size_t j = 1; j <= b.size(); j++) {
      std::size_t change = at(i - 1, j - 1) + (a[i - 1] != b[j - 1]);
      at(i, j) = std::min({at(i - 1, j) + 1, at(i, j - 1) + 1, change});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        at(i, j) = std::min(at(i, j), at(i - 2, j - 2) + 1);
    }
  return at(a.size(), b.size());
}

}  // namespace

std::string nearest(std::string_view word, const std::vector<std::string>& known) {
  std::string wanted = plain(word), best;
  std::size_t bestDistance = std::max<std::size_t>(1, wanted.size() / 3) + 1;
  for (const std::string& candidate : known) {
    std::string other = plain(candidate);
    std::size_t d = distance(wanted, other);
    // "gravity_vec" for "gravity", "rot" for "rotation_degrees": one begins with the other
    bool begins =
        std::min(wanted.size(), other.size()) >= 3 && (other.starts_with(wanted) || wanted.starts_with(other));
    if (begins) d = std::min<std::size_t>(d, 1);
    if (d < bestDistance) {
      bestDistance = d;
      best = candidate;
    }
  }
  return best;
}

}  // namespace brickfall::scene

namespace brickfall {

std::string didYouMean(std::string_view word, const std::vector<std::string>& known) {
  std::string best = scene::nearest(word, known);
  return best.empty() ? std::string() : " (did you mean \"" + best + "\"?)";
}

}  // namespace brickfall
