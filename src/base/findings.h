// The result of a look at invariants: the texts of the broken ones, each once in a row.
#pragma once
#include <string>
#include <vector>

namespace brickfall {

class Findings {
 public:
  void expect(bool holds, const std::string& text) {
    if (!holds && found_.size() < kMost && (found_.empty() || found_.back() != text)) found_.push_back(text);
  }
  // For checks of every body or contact: the text is made only if it is needed.
  void expect(bool holds, const char* text) {
    if (!holds) expect(false, std::string(text));
  }
  void expect(bool holds, const char* what, std::size_t i, const char* text) {
    if (!holds) expect(false, std::string(what) + " " + std::to_string(i) + ": " + text);
  }
  bool any() const { return !found_.empty(); }
  std::vector<std::string> take() { return std::move(found_); }

 private:
  //! not of the method: how much is told
  static constexpr std::size_t kMost = 100;
  std::vector<std::string> found_;
};

// Checks slots: the list of free slots names exactly the free ones, each once.
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
