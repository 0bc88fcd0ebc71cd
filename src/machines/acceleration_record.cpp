// Records of accelerations: lines of numbers.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "brickfall/machines.h"

namespace brickfall {

namespace {

constexpr double kGap = 10;  // times the median interval
constexpr std::size_t kMostSamples = 10'000'000;

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
std::string_view trimmed(std::string_view s) {
  while (!s.empty() && isBlank(s.front())) s.remove_prefix(1);
  while (!s.empty() && isBlank(s.back())) s.remove_suffix(1);
  return s;
}

// At most 40 characters of what was found, without anything that a terminal would act on.
std::string shownCell(std::string_view cell) {
  std::string out;
  for (char c : cell.substr(0, 40)) out += c >= ' ' && c <= '~' ? c : '?';
  return cell.empty() ? "nothing" : "\"" + out + "\"";
}

// Cells of a line: between commas or semicolons where it has any, else between blanks.
std::vector<std::string_view> cellsOf(std::string_view line) {
  std::vector<std::string_view> cells;
  const bool marked = line.find_first_of(",;") != std::string_view::npos;
  const auto parts = [&](char c) { return marked ? c == ',' || c == ';' : isBlank(c); };
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= line.size(); i++) {
    if (i < line.size() && !parts(line[i])) continue;
    const std::string_view cell = trimmed(line.substr(begin, i - begin));
    if (marked || !cell.empty()) cells.push_back(cell);
    begin = i + 1;
  }
  return cells;
}

std::optional<double> numberOf(std::string_view cell) {
  if (!cell.empty() && cell.front() == '+') cell.remove_prefix(1);
  double value = 0;
  const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (cell.empty() || problem != std::errc() || end != cell.data() + cell.size()) return std::nullopt;
  return value;
}

class RecordReader {
 public:
  RecordReader(const std::string& name, const RecordFormat& format) : name_(name), format_(format) {}

  Result<AccelerationRecord> read(std::string_view text) {
    while (!text.empty() && message_.empty()) {
      const std::size_t end = std::min(text.find('\n'), text.size());
      line_++;
      std::string_view line = text.substr(0, end);
      line = trimmed(line.substr(0, line.find('#')));
      if (!line.empty()) readLine(line);
      text.remove_prefix(std::min(end + 1, text.size()));
    }
    if (message_.empty()) checkWhole();
    if (!message_.empty()) return Error{ErrorCode::badFormat, message_};
    return std::move(record_);
  }

 private:
  void fail(std::size_t line, const std::string& what) {
    message_ = name_ + (line > 0 ? ":" + std::to_string(line) : "") + ": " + what;
  }

  double cell(const std::vector<std::string_view>& cells, std::size_t column, double unit, const char* what) {
    const std::string_view found = column < cells.size() ? cells[column] : std::string_view{};
    const std::optional<double> value = numberOf(found);
    if (value && std::isfinite(*value * unit)) return *value * unit;
    fail(line_, "found " + shownCell(found) + " in column " + std::to_string(column + 1) + ", expected " + what);
    return 0;
  }

  void readLine(std::string_view line) {
    const std::vector<std::string_view> cells = cellsOf(line);
    if (!named_ && record_.times.empty() && !numberOf(cells[0])) {
      named_ = true;  // the names of the columns
      return;
    }
    const double time = cell(cells, 0, format_.timeUnit, "a time");
    if (message_.empty() && !record_.times.empty() && !(time > record_.times.back()))
      fail(line_, "found the time " + std::to_string(time) + " s after " + std::to_string(record_.times.back()) +
                      " s, expected times that ascend");
    if (!message_.empty()) return;
    const double value = cell(cells, std::size_t(format_.column), format_.unit, "an acceleration");
    if (!message_.empty()) return;
    if (record_.times.size() >= kMostSamples) return fail(line_, "found too many samples");
    record_.times.push_back(time);
    record_.values.push_back(value);
    lines_.push_back(line_);
  }

  void checkWhole() {
    const std::size_t n = record_.times.size();
    if (n < 2) return fail(0, "found " + std::to_string(n) + " samples, expected at least 2");
    std::vector<double> intervals;
    for (std::size_t k = 1; k < n; k++) intervals.push_back(record_.times[k] - record_.times[k - 1]);
    std::vector<double> sorted = intervals;
    std::nth_element(sorted.begin(), sorted.begin() + std::ptrdiff_t(sorted.size() / 2), sorted.end());
    const double usual = sorted[sorted.size() / 2];
    for (std::size_t k = 0; k < intervals.size(); k++)
      if (intervals[k] > kGap * usual)
        return fail(lines_[k + 1], "found " + std::to_string(intervals[k]) +
                                       " s since the sample before, expected no gap (usual: " + std::to_string(usual) +
                                       " s)");
  }

  const std::string& name_;
  const RecordFormat& format_;
  std::size_t line_ = 0;
  bool named_ = false;
  std::string message_;
  AccelerationRecord record_;
  std::vector<std::size_t> lines_;
};

}  // namespace

Result<AccelerationRecord> readAccelerationRecord(std::string_view text, const std::string& name,
                                                  const RecordFormat& format) {
  if (!(format.column >= 1 && format.column <= 1000))
    return Error{ErrorCode::invalidArgument, "column: found " + std::to_string(format.column) + ", expected 1 .. 1000"};
  if (!(format.unit > 0 && format.timeUnit > 0))
    return Error{ErrorCode::invalidArgument, "unit: found one that is not above 0, expected one above 0"};
  return RecordReader(name, format).read(text);
}

}  // namespace brickfall
