// Checks of values that come in through the public API. They are written in the positive form, so that NaN fails them.
#pragma once
#include <cmath>
#include <cstdio>
#include <span>
#include <string>

#include "brickfall/body.h"
#include "brickfall/limits.h"
#include "brickfall/math.h"
#include "brickfall/result.h"

namespace brickfall {

// "6.5", "nan", "1e+300"
inline std::string numberText(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0 ? "infinity" : "-infinity";
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", value);
  return text;
}

inline Error outOfRange(const std::string& field, double found, const std::string& expected) {
  return {ErrorCode::invalidArgument, field + ": found " + numberText(found) + ", expected " + expected};
}

// Collects the first failed check.
class Checks {
 public:
  void range(const std::string& field, double value, double low, double high) {
    if (!failed() && !(value >= low && value <= high))
      error_ = outOfRange(field, value, numberText(low) + " .. " + numberText(high));
  }
  void above(const std::string& field, double value, double low, double high) {
    if (!failed() && !(value > low && value <= high))
      error_ = outOfRange(field, value, "more than " + numberText(low) + ", at most " + numberText(high));
  }
  void vector(const std::string& field, Vec3 value, double limit) { vector(field, value, -limit, limit); }
  void vector(const std::string& field, Vec3 value, double low, double high) {
    range(field + ".x", value.x, low, high);
    range(field + ".y", value.y, low, high);
    range(field + ".z", value.z, low, high);
  }
  void rotation(const std::string& field, Quat q) {
    double square = q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w;
    if (!failed() && !(square > 1e-12 && square < 1e12))
      error_ = {ErrorCode::invalidArgument, field + ": found a quaternion of length squared " + numberText(square) +
                                                ", expected a finite one that is not zero"};
  }
  void condition(bool holds, const std::string& message) {
    if (!failed() && !holds) error_ = {ErrorCode::invalidArgument, message};
  }
  void bodyType(BodyType type) {
    condition(type == BodyType::fixed || type == BodyType::kinematic || type == BodyType::dynamic,
              "type: found " + std::to_string(int(type)) + ", expected a BodyType");
  }
  void take(const Error& error) {
    if (!failed()) error_ = error;
  }
  bool failed() const { return error_.code != ErrorCode::none; }
  const Error& error() const { return error_; }

 private:
  Error error_;
};

// create.cpp. Requirements of createBody on a material ("shapes[0].material" is `at`), on a shape ("shapes[0]" is `at`)
// and on a body's constants.
void checkMaterial(Checks& check, const std::string& at, const Material& material);
void checkShape(Checks& check, const std::string& at, const ShapeDef& shape, BodyType type);
void checkGivenMass(Checks& check, const MassProperties& given, std::span<const ShapeDef> shapes);
void checkMotionSettings(Checks& check, double gravityScale, double linearDamping, double angularDamping,
                         double dragArea);

// Mass of a body that may move. Each field of its shapes may be legal and the body still lighter or heavier than sums
// in float can hold.
inline void checkMass(Checks& check, double mass) {
  check.condition(mass >= limits::kSmallestMass && mass <= limits::kLargestMass,
                  "shapes: found a mass of " + numberText(mass) + " kg (from sizes and density), expected " +
                      numberText(limits::kSmallestMass) + " .. " + numberText(limits::kLargestMass) + " kg");
}

}  // namespace brickfall
