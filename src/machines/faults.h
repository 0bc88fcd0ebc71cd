// Messages of errors: the field, what was found, what was expected.
#pragma once
#include <cmath>
#include <string>

#include "brickfall/result.h"

namespace brickfall::machines {

inline Error refused(const std::string& field, const std::string& found, const std::string& expected) {
  return {ErrorCode::invalidArgument, field + ": found " + found + ", expected " + expected};
}

// Each does nothing once something was wrong: the first mistake is told.
class Fields {
 public:
  void range(const char* field, double value, double least, double most) {
    if (status_ && !(value >= least && value <= most))
      status_ = refused(field, std::to_string(value), std::to_string(least) + " .. " + std::to_string(most));
  }
  void condition(bool fine, const std::string& field, const std::string& found, const std::string& expected) {
    if (status_ && !fine) status_ = refused(field, found, expected);
  }
  const Status& status() const { return status_; }

 private:
  Status status_;
};

constexpr double kLatest = 1e9;     // s
constexpr double kStrongest = 1e4;  // m/s2
constexpr double kFarthest = 1e6;   // m
constexpr double kFastest = 1e4;    // m/s

}  // namespace brickfall::machines
