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

/// middle + k spread for all |k| <= 1.
struct Segment {
  std::array<Exact, 3> middle;
  Point spread;
  Rational room;
};

/// Whether one point of the set lies in all three ranges.
bool meets(const Segment& set, const std::array<Range, 3>& ranges) {
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

/// x + y alpha + z beta, of which the first may be a root.
struct Linear {
  Exact x;
  Rational y;
  Rational z;

  [[nodiscard]] Exact at(const std::array<Exact, 2>& place) const {
    return x.plus(place[0].scaled(y)).plus(place[1].scaled(z));
  }
  [[nodiscard]] Linear plus(const Exact& other) const { return {x.plus(other), y, z}; }
  [[nodiscard]] Linear scaled(const Rational& k) const { return {x.scaled(k), k * y, k * z}; }
  [[nodiscard]] Linear less(const Linear& other) const {
    return {x.plus(other.x.scaled(Rational(-1))), y - other.y, z - other.z};
  }
};

/// A polygon in two coordinates of its plane. What is least of it, or whether it has something, is told by the places where two lines cross: its edges
/// and those where something changes.
class Polygon {
 public:
  /// Domain: the spread does not lie in one line.
  explicit Polygon(const PointSet& set) : room_(set.room) {
    const Point& origin = set.spread[0];
    const Point u = set.spread[1] - origin;
    const auto across = [&](const Point& x) { return cross(u, x - origin); };
    const Point& far =
        *std::find_if(set.spread.begin(), set.spread.end(), [&](const Point& x) { return !is_zero(across(x)); });
    const Point v = far - origin;
    for (std::size_t i = 0; i < 3; ++i) coordinates_.push_back({set.middle[i].plus(origin[i]), u[i], v[i]});
    const Point n = cross(u, v);
    std::vector<Place> places;
    for (const Point& x : set.spread) {
      const Rational N = dot(n, n);
      places.push_back({dot(n, cross(x - origin, v)) / N, dot(n, cross(u, x - origin)) / N});
    }
    // Each two with all others on one side are an edge.
    for (const Place& p : places)
      for (const Place& q : places) {
        const Linear side{Exact(p[0] * q[1] - p[1] * q[0]), p[1] - q[1], q[0] - p[0]};
        const auto value = [&](const Place& x) { return p[0] * q[1] - p[1] * q[0] + side.y * x[0] + side.z * x[1]; };
        if (p != q &&
            std::none_of(places.begin(), places.end(), [&](const Place& x) { return value(x) < Rational(0); }))
          edges_.push_back(side);
      }
  }

  /// Whether one point lies in all three ranges, the ends included: where the set has but an end of one, both of its neighbours are right.
  [[nodiscard]] bool meets(const std::array<Range, 3>& ranges) const {
    std::vector<Linear> sides = edges_;  // each >= 0
    for (std::size_t i = 0; i < 3; ++i) {
      sides.push_back(coordinates_[i].plus(ranges[i].low.plus(-room_).scaled(Rational(-1))));
      sides.push_back(coordinates_[i].scaled(Rational(-1)).plus(ranges[i].high.plus(room_)));
    }
    bool found = false;
    for_each_crossing(sides, [&](const std::array<Exact, 2>& place) { found = found || is_inside(sides, place); });
    return found;
  }

  /// The least over all of it of the largest distance from a claim in a coordinate.
  [[nodiscard]] Exact least_error(const Vector3& claim) const {
    std::vector<Linear> off;
    for (std::size_t i = 0; i < 3; ++i)
      off.push_back(coordinates_[i].plus(-Rational(claim[static_cast<Eigen::Index>(i)])));
    std::vector<Linear> lines = edges_;
    for (std::size_t i = 0; i < 3; ++i) {
      lines.push_back(off[i]);
      for (std::size_t j = 0; j < i; ++j)
        lines.push_back(off[i].less(off[j])), lines.push_back(off[i].less(off[j].scaled(Rational(-1))));
    }
    std::optional<Exact> least;
    for_each_crossing(lines, [&](const std::array<Exact, 2>& place) {
      if (!is_inside(edges_, place)) return;
      Exact largest(Rational(0));
      for (const Linear& x : off)
        if (const Exact error = magnitude(x.at(place)); is_smaller(largest, error)) largest = error;
      if (!least || is_smaller(largest, *least)) least = largest;
    });
    return *least;
  }

 private:
  using Place = std::array<Rational, 2>;

  static bool is_inside(const std::vector<Linear>& sides, const std::array<Exact, 2>& place) {
    return std::all_of(sides.begin(), sides.end(),
                       [&](const Linear& side) { return side.at(place).sign() != CGAL::NEGATIVE; });
  }
  /// Where each two lines cross, if they do.
  template <class Visit>
  static void for_each_crossing(const std::vector<Linear>& lines, Visit visit) {
    for (std::size_t i = 0; i < lines.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Linear& f = lines[i];
        const Linear& g = lines[j];
        const Rational whole = f.y * g.z - f.z * g.y;
        if (CGAL::is_zero(whole)) continue;
        visit(std::array{g.x.scaled(f.z / whole).plus(f.x.scaled(-g.z / whole)),
                         f.x.scaled(g.y / whole).plus(g.x.scaled(-f.y / whole))});
      }
  }

  Rational room_;
  std::vector<Linear> coordinates_;
  std::vector<Linear> edges_;  ///< each >= 0 inside
};

/// Whether some points lie in one line with 0.
bool is_segment(const Spread& spread) {
  return std::all_of(spread.begin(), spread.end(), [&](const Point& x) { return is_zero(cross(spread[0], x)); });
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
  const std::optional<Polygon> polygon = is_segment(set.spread) ? std::nullopt : std::optional<Polygon>(set);
  const Segment segment{set.middle, set.spread.empty() ? point_of(Vector3::Zero()) : set.spread.back(), set.room};
  const auto has = [&](const std::array<Range, 3>& all) { return polygon ? polygon->meets(all) : meets(segment, all); };
  const auto representable = [&](double x) { return is_representable(x, scalar); };
  const bool in_format = std::all_of(claim.begin(), claim.end(), representable);
  if (in_format && has(ranges(rounding_to))) return {};
  std::array<Exact, 3> off{set.middle};
  for (std::size_t i = 0; i < 3; ++i) off[i] = off[i].plus(-Rational(claim[static_cast<Eigen::Index>(i)]));
  const Exact least = polygon ? polygon->least_error(claim) : least_error(off, segment.spread);
  const Rational unit = ulp(by.scale, scalar);
  const double error = error_in_units(Rational(0), least, unit);
  const Off beside_set = length_off(least, by.scale, by.tolerance, set.room);
  if (in_format && has(ranges(beside))) return {Grade::faithful, error, beside_set};
  return {is_within(Rational(0), least, Rational(by.bound) * unit + set.room) ? Grade::bounded : Grade::beyond_bound,
          error, beside_set};
}

}  // namespace contact::oracle
