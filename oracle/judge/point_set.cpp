// A claimed contact point held against a set of right ones.
#include "oracle/judge/point_set.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "oracle/judge/off.hpp"
#include "oracle/truth/default_environment.hpp"

namespace contact::oracle {
namespace {

bool is_smaller(const Exact& x, const Exact& y) { return x.plus(y.scaled(Rational(-1))).sign() == CGAL::NEGATIVE; }

/// The numbers between two, which belong to it or do not.
struct Range {
  Exact low;
  Exact high;
  bool low_belongs;
  bool high_belongs;

  [[nodiscard]] Range common(const Range& other) const {
    Range both = *this;
    if (is_smaller(low, other.low))
      both.low = other.low, both.low_belongs = other.low_belongs;
    else if (!is_smaller(other.low, low))
      both.low_belongs = low_belongs && other.low_belongs;
    if (is_smaller(other.high, high))
      both.high = other.high, both.high_belongs = other.high_belongs;
    else if (!is_smaller(high, other.high))
      both.high_belongs = high_belongs && other.high_belongs;
    return both;
  }
  [[nodiscard]] bool is_empty() const {
    return is_smaller(high, low) || (!is_smaller(low, high) && !(low_belongs && high_belongs));
  }
};

/// The k at which middle + k spread lies in a range. Domain: spread is not 0.
Range parameters(const Range& of, const Exact& middle, const Rational& spread) {
  const auto at = [&](const Exact& x) { return x.plus(middle.scaled(Rational(-1))).scaled(Rational(1) / spread); };
  if (CGAL::sign(spread) == CGAL::POSITIVE) return {at(of.low), at(of.high), of.low_belongs, of.high_belongs};
  return {at(of.high), at(of.low), of.high_belongs, of.low_belongs};
}

/// A range with room on both sides.
Range wider(const Range& range, const Rational& room) {
  if (CGAL::is_zero(room)) return range;
  return {range.low.plus(-room), range.high.plus(room), true, true};
}

/// Whether one point of the set lies in all three ranges.
bool meets(const PointSet& set, const std::array<Range, 3>& ranges) {
  Range k{Exact(Rational(-1)), Exact(Rational(1)), true, true};
  for (std::size_t i = 0; i < 3; ++i) {
    const Range range = wider(ranges[i], set.room);
    if (CGAL::is_zero(set.spread[i])) {
      if (range.common({set.middle[i], set.middle[i], true, true}).is_empty()) return false;
    } else {
      k = k.common(parameters(range, set.middle[i], set.spread[i]));
    }
  }
  return !k.is_empty();
}

/// What rounds to a finite number of the scalar; of the largest one up to where infinity begins.
Range rounding_to(double x, Scalar scalar) {
  const Rounding r = rounding_range(x, scalar);
  return {Exact(r.low), Exact(r.high), r.is_closed, r.is_closed};
}
/// What lies between its neighbours.
Range beside(double x, Scalar scalar) {
  const double above = next_up(x, scalar);
  const double below = next_down(x, scalar);
  const Rational unit = ulp(Exact(Rational(x)), scalar);
  return {Exact(std::isfinite(below) ? Rational(below) : Rational(x) - unit),
          Exact(std::isfinite(above) ? Rational(above) : Rational(x) + unit), false, false};
}

/// The largest error of a coordinate at k.
Exact largest_error(const std::array<Exact, 3>& off, const Point& spread, const Exact& k) {
  Exact largest(Rational(0));
  for (std::size_t i = 0; i < 3; ++i)
    if (const Exact error = magnitude(off[i].plus(k.scaled(spread[i]))); is_smaller(largest, error)) largest = error;
  return largest;
}

/// The least over all k of the largest error. Each error is |off + k spread|, so the least is at an end of the set, or
/// where one error is 0 or two are equal.
Exact least_error(const std::array<Exact, 3>& off, const Point& spread) {
  std::vector<Exact> places{Exact(Rational(-1)), Exact(Rational(1))};
  const auto cross = [&](const Exact& x, const Rational& slope) {
    if (!CGAL::is_zero(slope)) places.push_back(x.scaled(Rational(-1) / slope));
  };
  for (std::size_t i = 0; i < 3; ++i) {
    cross(off[i], spread[i]);
    for (std::size_t j = 0; j < i; ++j) {
      cross(off[i].plus(off[j].scaled(Rational(-1))), spread[i] - spread[j]);
      cross(off[i].plus(off[j]), spread[i] + spread[j]);
    }
  }
  std::optional<Exact> least;
  for (const Exact& k : places) {
    if (k.compare(Rational(-1)) == CGAL::SMALLER || k.compare(Rational(1)) == CGAL::LARGER) continue;
    const Exact error = largest_error(off, spread, k);
    if (!least || is_smaller(error, *least)) least = error;
  }
  return *least;
}

}  // namespace

FieldVerdict grade(const Vector3& claim, const PointSet& set, const Yardstick& by) {
  const DefaultEnvironment environment;
  const Scalar scalar = by.scalar;
  if (!claim.allFinite()) {
    // Beyond the range there is nothing to move along: each coordinate by itself, at the middle.
    FieldVerdict worst;
    for (std::size_t i = 0; i < 3; ++i) {
      const FieldVerdict one = grade(claim[static_cast<Eigen::Index>(i)], set.middle[i], by);
      worst = {std::max(worst.grade, one.grade), std::max(worst.error, one.error)};
    }
    return worst;
  }
  const auto ranges = [&](auto range) {
    return std::array{range(claim[0], scalar), range(claim[1], scalar), range(claim[2], scalar)};
  };
  const auto representable = [&](double x) { return is_representable(x, scalar); };
  const bool in_format = std::all_of(claim.begin(), claim.end(), representable);
  if (in_format && meets(set, ranges(rounding_to))) return {};
  std::array<Exact, 3> off{set.middle};
  for (std::size_t i = 0; i < 3; ++i) off[i] = off[i].plus(-Rational(claim[static_cast<Eigen::Index>(i)]));
  const Exact least = least_error(off, set.spread);
  const Rational unit = ulp(by.scale, scalar);
  const double error = error_in_units(Rational(0), least, unit);
  const Off beside_set = length_off(least, by.scale, by.tolerance, set.room);
  if (in_format && meets(set, ranges(beside))) return {Grade::faithful, error, beside_set};
  return {is_within(Rational(0), least, Rational(by.bound) * unit + set.room) ? Grade::bounded : Grade::beyond_bound,
          error, beside_set};
}

}  // namespace contact::oracle
