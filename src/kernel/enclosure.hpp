// Real numbers within a radius of high + low: arithmetic that bounds its own error.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "kernel/sphere_sphere_double_double.hpp"

namespace contact::kernel {

/// A real number within `radius` of high + low, where |low| <= u |high|.
/// Errors of an operation on the midpoints are below 4 u^2 of a sum (Joldes, Muller and Popescu 2017, algorithm 6), 8 u^2 of a product, whose smallest part is left out, below
/// 9 u^2 of a reciprocal and 5 u^2 of a root (one Newton step on the rounded one); what is taken is wider. The radii themselves are rounded a few times: kWider.
/// Domain      to nearest; no overflow.
struct Enclosure {
  double high = 0;
  double low = 0;
  double radius = 0;

  static constexpr double kSquaredUnit = 0x1p-106;
  static constexpr double kWider = 1 + 0x1p-48;

  Enclosure() = default;
  explicit Enclosure(double x) : high(x) {}
  Enclosure(DoubleDouble<double> x, double off) : high(x.high), low(x.low), radius(off * kWider) {}

  [[nodiscard]] bool is_positive() const { return high * (1 - 0x1p-50) > radius; }
  /// Whether it is above 0 by far more than the radius.
  [[nodiscard]] bool is_clear() const { return high * 0x1p-20 > radius; }
  /// The real number, for what rounds it once.
  [[nodiscard]] Approximation approximation() const {
    return {high, low, radius * kWider + 4 * kSquaredUnit * std::abs(high)};
  }
};

inline Enclosure operator-(const Enclosure& x) { return {{-x.high, -x.low}, x.radius}; }
inline Enclosure operator+(const Enclosure& x, const Enclosure& y) {
  const DoubleDouble<double> s = two_sum(x.high, y.high);
  const DoubleDouble<double> t = two_sum(x.low, y.low);
  const DoubleDouble<double> v = two_sum(s.high, s.low + t.high);
  const DoubleDouble<double> sum = two_sum(v.high, t.low + v.low);
  return {sum, x.radius + y.radius + 8 * Enclosure::kSquaredUnit * std::abs(sum.high)};
}
inline Enclosure operator-(const Enclosure& x, const Enclosure& y) { return x + -y; }
/// Nothing is certain of a product of numbers so small that a low part would be lost.
inline Enclosure operator*(const Enclosure& x, const Enclosure& y) {
  const double p = x.high * y.high;
  const double rest = std::fma(x.high, y.high, -p) + std::fma(x.low, y.high, x.high * y.low);
  const DoubleDouble<double> both = two_sum(p, rest);
  const auto is_tiny = [](double z) { return z != 0 && std::abs(z) < 0x1p-300; };
  if (is_tiny(x.high) || is_tiny(y.high)) return {both, std::numeric_limits<double>::infinity()};
  return {both, std::abs(x.high) * y.radius + std::abs(y.high) * x.radius + x.radius * y.radius +
                    12 * Enclosure::kSquaredUnit * std::abs(p)};
}
/// 1 / x. Domain: is_clear().
inline Enclosure reciprocal(const Enclosure& x) {
  const double t = 1 / x.high;
  const DoubleDouble<double> y = two_sum(t, t * std::fma(-x.low, t, std::fma(-x.high, t, 1.0)));
  return {y, 2 * x.radius * (t * t) + 16 * Enclosure::kSquaredUnit * t};
}
/// sqrt(x). Domain: is_clear().
inline Enclosure root(const Enclosure& x) {
  const double s = std::sqrt(x.high);
  const DoubleDouble<double> y = two_sum(s, (std::fma(-s, s, x.high) + x.low) / (2 * s));
  return {y, x.radius / s + 16 * Enclosure::kSquaredUnit * s};
}

using Enclosures = std::array<Enclosure, 3>;
inline Enclosures operator+(const Enclosures& x, const Enclosures& y) {
  return {x[0] + y[0], x[1] + y[1], x[2] + y[2]};
}
inline Enclosures operator-(const Enclosures& x, const Enclosures& y) {
  return {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
}
inline Enclosures operator-(const Enclosures& x) { return {-x[0], -x[1], -x[2]}; }
inline Enclosures operator*(const Enclosure& k, const Enclosures& x) { return {k * x[0], k * x[1], k * x[2]}; }
inline Enclosure dot(const Enclosures& x, const Enclosures& y) { return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]; }
inline Enclosures cross(const Enclosures& x, const Enclosures& y) {
  return {x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]};
}

}  // namespace contact::kernel
