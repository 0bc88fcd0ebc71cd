// Errors as values: what every fallible call of the public API returns. The engine never throws and never prints.
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "brickfall/hooks.h"

namespace brickfall {

enum class ErrorCode : std::uint8_t {
  none,
  invalidArgument,  // a value out of range, not finite, or of the wrong kind; the message names the field
  staleId,          // the id is null, was destroyed, or belongs to another world
  wrongState,       // the call is not allowed now (for example while the world is stepping)
  limitExceeded,    // more bodies, vertices or bytes than the stated limit
  badGeometry,      // a shape that encloses no volume
  badFormat,        // bytes that are not what they claim to be
  inputOutput,      // the operating system refused (missing file, full disk, no permission)
};

// What was wrong, in words a user can act on: the field or line, what was found, what was expected.
struct Error {
  ErrorCode code = ErrorCode::none;
  std::string message;
};

// A value or an error. Test with `if (result)`. value(), * and -> of a failed result are a bug of the caller: the program
// ends with the error's message (hooks.h), in every build. From a temporary both return by value: nothing dangles.
template <class T> class [[nodiscard]] Result {
 public:
  Result(T value) : value_(std::move(value)) {}
  Result(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return value_.has_value(); }
  bool ok() const { return value_.has_value(); }
  T& value() & { return held(); }
  const T& value() const& { return held(); }
  T value() && { return std::move(held()); }
  T& operator*() & { return held(); }
  const T& operator*() const& { return held(); }
  T operator*() && { return std::move(held()); }
  T* operator->() { return &held(); }
  const T* operator->() const { return &held(); }
  const Error& error() const { return error_; }

 private:
  T& held() {
    if (!value_.has_value()) refuse();
    return *value_;
  }
  const T& held() const {
    if (!value_.has_value()) refuse();
    return *value_;
  }
  [[noreturn]] void refuse() const {
    const std::string text = "value of a failed result: " + error_.message;
    fail({"", 0, text.c_str(), ""});
  }
  std::optional<T> value_;
  Error error_;
};

// Success or an error, for calls that return nothing else.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}

  explicit operator bool() const { return error_.code == ErrorCode::none; }
  bool ok() const { return error_.code == ErrorCode::none; }
  const Error& error() const { return error_; }

 private:
  Error error_;
};

}  // namespace brickfall
