// What closed forms do not give: ordinary differential equations, integrated with fine Runge-Kutta steps.
#pragma once
#include <cmath>

#include "brickfall/math.h"

namespace brickfall::law {

// A slender block that turns about its lower edge: theta'' = p^2 sin(theta - alpha), p^2 = 3 g / (4 R) for a solid block
// of half diagonal R, alpha the angle of its diagonal; theta = 0 upright. Each impact at theta = 0 keeps the share
// 1 - 1.5 sin^2(alpha) of the spin (Housner 1963: angular momentum about the new edge).
class RockingBlock {
 public:
  double time = 0, tilt, rate = 0;  // s, rad, rad/s

  RockingBlock(double height, double width, double start, double gravity = 9.81)
      : tilt(start),
        alpha_(std::atan(width / height)),
        p2_(3 * gravity / (4 * std::hypot(height, width) / 2)),
        kept_(1 - 1.5 * std::sin(alpha_) * std::sin(alpha_)) {}
  double alpha() const { return alpha_; }
  double kept() const { return kept_; }
  double timeScale() const { return 1 / std::sqrt(p2_); }
  void advance(double h) {
    double k1 = spinUp(tilt), k2 = spinUp(tilt + h / 2 * rate), k3 = spinUp(tilt + h / 2 * (rate + h / 2 * k1)),
           k4 = spinUp(tilt + h * (rate + h / 2 * k2));
    double before = tilt;
    tilt += h * rate + h * h / 6 * (k1 + k2 + k3);
    rate += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    time += h;
    if ((before > 0) != (tilt > 0)) rate *= kept_;
  }

 private:
  double spinUp(double t) const { return t >= 0 ? p2_ * std::sin(t - alpha_) : p2_ * std::sin(t + alpha_); }
  double alpha_, p2_, kept_;
};

// Torque-free rotation: angular momentum L is constant, omega = R I^-1 R^T L.
class FreeTop {
 public:
  Quat rotation;
  FreeTop(Quat q, Mat3 inertia, Vec3 spin)
      : rotation(q), invInertia_(inverse(inertia)), momentum_(rotate(q, inertia * rotate(conjugate(q), spin))) {}
  Vec3 momentum() const { return momentum_; }
  Vec3 spin(Quat q) const { return rotate(q, invInertia_ * rotate(conjugate(q), momentum_)); }
  void advance(double h) {
    Quat k1 = rate(rotation), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2)), k4 = rate(moved(k3, h));
    rotation = moved(Quat{(k1.x + 2 * (k2.x + k3.x) + k4.x) / 6, (k1.y + 2 * (k2.y + k3.y) + k4.y) / 6,
                          (k1.z + 2 * (k2.z + k3.z) + k4.z) / 6, (k1.w + 2 * (k2.w + k3.w) + k4.w) / 6},
                     h);
  }

 private:
  Quat rate(Quat q) const {
    Vec3 w = spin(q);
    return Quat{w.x / 2, w.y / 2, w.z / 2, 0} * q;
  }
  Quat moved(Quat k, double h) const {
    return normalized(Quat{rotation.x + h * k.x, rotation.y + h * k.y, rotation.z + h * k.z, rotation.w + h * k.w});
  }
  Mat3 invInertia_;
  Vec3 momentum_;
};

// A body in still air: v' = g - c |v| v.
class FallInAir {
 public:
  Vec3 position, velocity;
  FallInAir(Vec3 v, double dragPerMass, double gravity = 9.81) : velocity(v), c_(dragPerMass), g_{0, -gravity, 0} {}
  void advance(double h) {
    Vec3 k1 = push(velocity), k2 = push(velocity + k1 * (h / 2)), k3 = push(velocity + k2 * (h / 2)),
         k4 = push(velocity + k3 * h);
    position += velocity * h + (k1 + k2 + k3) * (h * h / 6);
    velocity += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6);
  }

 private:
  Vec3 push(Vec3 v) const { return g_ - v * (c_ * length(v)); }
  double c_;
  Vec3 g_;
};

}  // namespace brickfall::law
