// The double-double stage of every pair with a distance: the answer for two cores with known nearest points, in pairs of
// doubles.
#pragma once

#include <array>

#include "oracle/truth/double_double.hpp"
#include "oracle/truth/double_double_oracle.hpp"

namespace contact::oracle {

using DoubleDoubles = std::array<DoubleDouble, 3>;

/// Nearest points p and q of two cores, which are unique, and delta = q - p. Where they are one point, and only there,
/// delta is 0 without a radius.
struct DoubleDoubleNearest {
  DoubleDoubles p;
  DoubleDoubles q;
  DoubleDoubles delta;
};

/// Whether no operation overflows, and no product underflows whose error matters: 0, or 2^-most <= |x| <= 2^most.
[[nodiscard]] inline bool in_range(double x, int most) {
  const double magnitude = std::abs(x);
  return magnitude == 0 || (magnitude <= std::ldexp(1.0, most) && magnitude >= std::ldexp(1.0, -most));
}
[[nodiscard]] inline bool in_range(const Vector3& v, int most) {
  return in_range(v[0], most) && in_range(v[1], most) && in_range(v[2], most);
}

[[nodiscard]] inline DoubleDoubles exactly(const Vector3& v) { return {{{v[0]}, {v[1]}, {v[2]}}}; }
[[nodiscard]] inline DoubleDoubles difference(const Vector3& b, const Vector3& a) {
  return {two_sum(b[0], -a[0]), two_sum(b[1], -a[1]), two_sum(b[2], -a[2])};
}
/// x + y, exact where y is 0.
[[nodiscard]] inline DoubleDouble plus(const DoubleDouble& x, double y) { return y == 0 ? x : x + DoubleDouble{y}; }
[[nodiscard]] inline DoubleDouble dot(const DoubleDoubles& x, const DoubleDoubles& y) {
  return x[0] * y[0] + x[1] * y[1] + x[2] * y[2];
}

/// Nearest points, the unit normal, the signed distance along it, and the decisions.
struct DoubleDoubleAlong {
  DoubleDoubles p;
  DoubleDoubles q;
  DoubleDoubles normal;
  DoubleDouble distance;
  int at_alarm;
  int at_zero;
  bool degenerate;
  bool unique;
  // Where more is known of these than their difference tells: the distance past the reach, and the value.
  std::optional<DoubleDouble> past_reach{};
  std::optional<DoubleDouble> value{};
};
/// past / ulp(reach) in the scalar. Domain: reach is in_range of 500.
[[nodiscard]] MarginBounds margin_of(const DoubleDouble& past, const DoubleDouble& reach, Scalar scalar);

[[nodiscard]] std::optional<RoundedAnswer> case_along(const DoubleDoubleAlong& along, double radius1, double radius2,
                                                      Distances distances, Scalar scalar);

/// How far D is past the squares of the reach, of the radii, and of what a value is less than the distance: without
/// cancellation.
struct Excess {
  DoubleDouble at_alarm;
  DoubleDouble at_zero;
  DoubleDouble at_contact;
};
/// Domain: every number in_range of 200. Where the cores meet, the normal is (1, 0, 0).
[[nodiscard]] std::optional<RoundedAnswer> case_of_nearest(const DoubleDoubleNearest& nearest, double radius1,
                                                           double radius2, Distances distances, Scalar scalar,
                                                           const std::optional<Excess>& excess = std::nullopt);

}  // namespace contact::oracle
