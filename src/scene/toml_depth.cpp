// A scanner that knows strings, comments and brackets, and no more of TOML.
#include "scene/toml_depth.h"

#include <algorithm>

namespace brickfall::scene {

namespace {

bool isDigit(char c) { return c >= '0' && c <= '9'; }

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  int run() {
    while (at_ < text_.size()) {
      char c = text_[at_];
      if (c == '"' || c == '\'') {
        skipText(c);
        continue;
      }
      if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size());
        continue;
      }
      if (c == '\n') endLine();
      if (c == '[' || c == '{') brackets_++;
      if ((c == ']' || c == '}') && brackets_ > 0) brackets_--;
      if (c == '.' && !inNumber() && ++dots_ > kMaxDottedKeys) return line_;
      at_++;
    }
    return 0;
  }

 private:
  void endLine() {
    line_++;
    if (brackets_ == 0) dots_ = 0;
  }
  // The one dot of a number: digits on both sides, and no other dot beside them.
  bool inNumber() const {
    std::size_t from = at_, to = at_ + 1;
    while (from > 0 && isDigit(text_[from - 1])) from--;
    while (to < text_.size() && isDigit(text_[to])) to++;
    bool digits = from < at_ && to > at_ + 1;
    bool dotBefore = from > 0 && text_[from - 1] == '.', dotAfter = to < text_.size() && text_[to] == '.';
    return digits && !dotBefore && !dotAfter;
  }
  void skipText(char quote) {
    std::string_view three = quote == '"' ? "\"\"\"" : "'''";
    bool multiLine = text_.substr(at_, 3) == three;
    at_ += multiLine ? 3 : 1;
    while (at_ < text_.size()) {
      if (text_[at_] == '\n') {
        if (!multiLine) return;  // unclosed: the parser will say so, and run() counts the line
        line_++;
      }
      if (quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size() && text_[at_ + 1] != '\n') {
        at_ += 2;
        continue;
      }
      bool closes = multiLine ? text_.substr(at_, 3) == three : text_[at_] == quote;
      at_ += closes && multiLine ? 3 : 1;
      if (closes) return;
    }
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, brackets_ = 0, dots_ = 0;
};

}  // namespace

int lineOfTooManyDots(std::string_view text) { return Scanner(text).run(); }

}  // namespace brickfall::scene
