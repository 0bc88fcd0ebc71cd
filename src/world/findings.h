// What a look at invariants found: the texts of those that do not hold, each once in a row.
#pragma once
#include <algorithm>
#include <string>
#include <vector>

namespace brickfall {

class Findings {
 public:
  void expect(bool holds, const std::string& text) {
    if (!holds && found_.size() < kMost && (found_.empty() || found_.back() != text)) found_.push_back(text);
  }
  // For what is asked of every body or contact: no text is made unless it is needed.
  void expect(bool holds, const char* text) {
    if (!holds) expect(false, std::string(text));
  }
  void expect(bool holds, const char* what, std::size_t i, const char* text) {
    if (!holds) expect(false, std::string(what) + " " + std::to_string(i) + ": " + text);
  }
  bool any() const { return !found_.empty(); }
  std::vector<std::string> take() { return std::move(found_); }

 private:
  //! not of the method: what is told
  static constexpr std::size_t kMost = 100;
  std::vector<std::string> found_;
};

template <class List> bool isAscending(const List& list) {
  return std::adjacent_find(list.begin(), list.end(), [](const auto& a, const auto& b) { return !(a < b); }) ==
         list.end();
}

// Of slots: those listed as free are those that are, each once.
template <class Free>
void checkFreeSlots(Findings& f, const std::vector<std::uint32_t>& listed, std::size_t slots, Free isFree) {
  std::vector<bool> seen(slots, false);
  std::size_t all = 0;
  for (std::size_t i = 0; i < slots; i++) all += isFree(i);
  bool exact = listed.size() == all;
  for (std::uint32_t slot : listed) {
    exact = exact && slot < slots && isFree(slot) && !seen[slot];
    if (slot < slots) seen[slot] = true;
  }
  f.expect(exact, "slots: the free ones are not those listed as free");
}

}  // namespace brickfall
