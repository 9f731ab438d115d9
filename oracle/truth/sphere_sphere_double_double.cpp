// Two spheres in pairs of doubles.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "oracle/truth/double_double.hpp"
#include "oracle/truth/double_double_oracle.hpp"

namespace contact::oracle {
namespace {

// Within these bounds no operation of two spheres overflows, and no product underflows whose error matters.
constexpr double kLeast = 0x1p-200;
constexpr double kLargest = 0x1p200;

bool in_range(double x) {
  const double magnitude = std::abs(x);
  return magnitude <= kLargest && (magnitude >= kLeast || magnitude == 0);
}
bool in_range(const Vector3& v) { return in_range(v[0]) && in_range(v[1]) && in_range(v[2]); }

/// Takes answers, and remembers whether one of them was nothing.
class Settled {
 public:
  double operator()(const std::optional<double>& number) {
    all_ = all_ && number.has_value();
    return number.value_or(0);
  }
  [[nodiscard]] bool all() const { return all_; }

 private:
  bool all_ = true;
};

/// (sqrt(D) - reach) / ulp(reach), rounded to binary64.
std::optional<double> margin_of(const DoubleDouble& distance, const DoubleDouble& reach, Scalar scalar) {
  const Format format = format_of(scalar);
  int exponent = format.min_exponent;
  if (reach.high > 0) {
    // No other double lies between high and the real number, so both have one exponent, but for a power of two that is
    // approached from below.
    exponent = std::ilogb(reach.high);
    if (std::ldexp(1.0, exponent) == reach.high && (reach.low < 0 || reach.radius != 0)) return std::nullopt;
    exponent = std::max(exponent, format.min_exponent);
  }
  // The unit is a power of two and, as the answer, far from the ends of the range: scaling commutes with rounding.
  const auto off = round_to_nearest(distance - reach, Scalar::binary64);
  if (!off) return std::nullopt;
  if (*off != 0 && std::abs(std::ilogb(*off)) > 500) return std::nullopt;
  return std::ldexp(*off, format.precision - 1 - exponent);
}

}  // namespace

std::optional<DoubleDoubleCase> double_double_case(const Balls& balls, Distances distances, Scalar scalar,
                                                   bool with_margin) {
  const auto& [a, b] = balls;
  if (!in_range(a.center) || !in_range(b.center) || !in_range(a.radius) || !in_range(b.radius) ||
      !in_range(distances.alarm) || !in_range(distances.contact))
    return std::nullopt;
  std::array<DoubleDouble, 3> delta;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    delta[i] = two_sum(b.center[axis], -a.center[axis]);
  }
  const DoubleDouble D = delta[0] * delta[0] + delta[1] * delta[1] + delta[2] * delta[2];
  const DoubleDouble radii = two_sum(a.radius, b.radius);
  const DoubleDouble reach = radii + DoubleDouble{distances.alarm};
  const auto at_alarm = (D - reach * reach).sign();
  const auto at_zero = (D - radii * radii).sign();
  if (!at_alarm || !at_zero) return std::nullopt;

  DoubleDoubleCase found{{*at_alarm, *at_zero, {*at_alarm <= 0, std::nullopt}}, std::nullopt};
  const bool degenerate = a.center == b.center;
  const DoubleDouble distance = degenerate ? DoubleDouble{} : root(D);
  if (with_margin) found.margin_ulps = margin_of(distance, reach, scalar);
  if (!found.answer.expected.hit) return found;

  Settled settled;
  Contact& contact = found.answer.expected.contact.emplace();
  contact.degenerate = degenerate;
  const DoubleDouble inverse = degenerate ? DoubleDouble{} : reciprocal(distance);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<Eigen::Index>(i);
    const DoubleDouble n = degenerate ? DoubleDouble{i == 0 ? 1.0 : 0.0} : delta[i] * inverse;
    contact.normal[axis] = settled(round_to_nearest(n, scalar));
    contact.point1[axis] = settled(round_to_nearest(DoubleDouble{a.center[axis]} + DoubleDouble{a.radius} * n, scalar));
    contact.point2[axis] = settled(round_to_nearest(DoubleDouble{b.center[axis]} - DoubleDouble{b.radius} * n, scalar));
  }
  contact.value = settled(round_to_nearest(distance - (radii + DoubleDouble{distances.contact}), scalar));
  if (!settled.all()) return std::nullopt;
  return found;
}

}  // namespace contact::oracle
