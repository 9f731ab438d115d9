// The exact numbers of a truth, on CGAL.
#pragma once

#include <CGAL/Interval_nt.h>

#include <array>
#include <concepts>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "contact/contact.hpp"
#include "oracle/truth/exact.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::oracle {

using Point = std::array<Rational, 3>;
[[nodiscard]] inline Point point_of(const Vector3& v) { return {Rational(v[0]), Rational(v[1]), Rational(v[2])}; }

/// A real number of which an interval of doubles is known. It is right while the processor rounds upward.
using Enclosed = CGAL::Interval_nt<false>;

template <class Number>
concept Coordinate = std::same_as<Number, Rational> || std::same_as<Number, Whole> || std::same_as<Number, Enclosed> ||
    Number::kIsCoordinate;
template <Coordinate Number>
[[nodiscard]] std::array<Number, 3> operator-(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <Coordinate Number>
[[nodiscard]] std::array<Number, 3> operator+(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <Coordinate Number>
[[nodiscard]] std::array<Number, 3> operator*(const Number& k, const std::array<Number, 3>& a) {
  return {k * a[0], k * a[1], k * a[2]};
}
template <Coordinate Number>
[[nodiscard]] Number dot(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
template <Coordinate Number>
[[nodiscard]] std::array<Number, 3> cross(const std::array<Number, 3>& a, const std::array<Number, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
[[nodiscard]] inline bool is_zero(const Point& a) { return CGAL::is_zero(dot(a, a)); }
/// |x| + |y| + |z|: what a vector's product with another changes by at most, if each component of that does by 1.
[[nodiscard]] inline Rational size_of(const Point& a) { return CGAL::abs(a[0]) + CGAL::abs(a[1]) + CGAL::abs(a[2]); }

/// +1 where a contact point lies from its core along the normal, -1 against it, 0 on the core.
[[nodiscard]] Rational outward(int shape, PointOn on);

/// Where a point may be anywhere between some, what leads from the reference's to each of these; else nothing.
using Spread = std::vector<Point>;

/// A way to part two cores that meet: the second one moves along `direction`, or the first against it. `first` and `nearest` are
/// where the contact points of the two cores lie then.
struct WayOut {
  Point direction;
  Point first;
  Point nearest;
  Spread spread = {};
};

/// What is true of cores that meet (D = 0): how deep they are in each other, and the shortest ways out.
struct Meeting {
  Rational depth2;  ///< the square of the depth
  /// Where the depth is above 0: every one of that length, the reference's first. Else the reference's alone.
  std::vector<WayOut> ways;
  /// Where the depth is 0: b - a for all vertices a and b of the cores, times some number above 0. A right normal points against none of them.
  std::vector<Point> apart;
  bool is_overlap = false;  ///< the depth is above 0, and that is an ordinary hit
};

/// A second core that is a half-space, or one that is crossed: its boundary tells above from below, also where nothing
/// is between.
struct HalfSpace {
  Point inward;      ///< of any length: against the plane's normal
  Rational offset2;  ///< the square of the plane's distance from the origin
};

/// The first point of a ray that lies in a shape.
struct CastHit {
  Exact t;
  std::array<Exact, 3> at;
  std::array<Exact, 3> normal;  ///< the reference's
  Point along;                  ///< of its direction, which a 2^-100th of it may miss where that is not rational
  bool inside = false;          ///< the origin lies in the shape: any normal is right
  bool either_side = false;     ///< the normal turned round is as right
  /// Where more are right: those that point along none of these.
  std::optional<std::vector<Point>> against = {};
  Exact point_scale;
  Exact value_scale;
};

/// Two convex shapes as two cores, each blown up by a radius, and the nearest points p and q of the cores; of a
/// half-space q is the foot of the first one's lowest point p on the plane, also where p is below it.
struct Cores {
  std::array<Point, 2> nearest;
  std::array<Rational, 2> radius;
  std::array<Rational, 2> farthest;     ///< the largest coordinate that each contact point is computed from
  std::optional<Meeting> meeting = {};  ///< where they meet; of two points that are one it need not be said
  Spread spread = {};                   ///< where many points are nearest, of both
  std::optional<HalfSpace> half_space = {};
  std::optional<CastHit> cast = {};  ///< it says all numbers; both nearest points are near to its own
};

/// What is exactly true of two shapes with a distance.
///   delta = q - p      D = delta.delta      reach = alarm + r1 + r2      n = delta / sqrt(D)
/// Below a plane -sqrt(D) takes the place of sqrt(D), the signed distance, and n is -delta / sqrt(D).
class DistanceTruth {
 public:
  DistanceTruth(Cores cores, Distances distances);

  /// The cores meet, D = 0, and no plane says in which direction.
  [[nodiscard]] bool meets() const {
    return cores_.cast ? cores_.cast->inside : CGAL::is_zero(distance2_) && !cores_.half_space;
  }
  /// They meet, and that is an ordinary hit: the depth is the distance, below 0.
  [[nodiscard]] bool overlaps() const { return !cores_.cast && meets() && cores_.meeting->is_overlap; }
  /// They meet otherwise.
  [[nodiscard]] bool degenerate() const { return meets() && !overlaps(); }
  /// Where a ray is cast: what it hits, and how. nullptr for other pairs.
  [[nodiscard]] const CastHit* cast() const { return cores_.cast ? &*cores_.cast : nullptr; }
  /// p lies below the plane of a half-space.
  [[nodiscard]] bool below() const;
  /// D = 0, and nothing is inside anything: the direction is by agreement.
  [[nodiscard]] bool coincident() const { return !cores_.cast && meets() && CGAL::is_zero(cores_.meeting->depth2); }
  [[nodiscard]] const Cores& cores() const { return cores_; }
  /// Domain: D = 0.
  [[nodiscard]] const Meeting& meeting() const { return *cores_.meeting; }
  /// Where the nearest points are not unique: where the contact points may move to.
  [[nodiscard]] const Spread& spread() const { return overlaps() ? meeting().ways.front().spread : cores_.spread; }
  /// How deep cores that meet are in each other. Domain: they meet.
  [[nodiscard]] Exact depth() const { return {Rational(0), Rational(1), meeting().depth2}; }
  /// The distance of the cores; where they overlap, the depth below 0.
  [[nodiscard]] Exact core_distance() const;
  /// The same by another of the shortest ways out. Domain: they overlap.
  [[nodiscard]] DistanceTruth by_way(std::size_t way) const;
  [[nodiscard]] const Rational& distance2() const { return distance2_; }
  [[nodiscard]] const Rational& reach() const { return reach_; }
  [[nodiscard]] const Rational& radii() const { return radii_; }
  [[nodiscard]] const Rational& radius(int shape) const { return cores_.radius[static_cast<std::size_t>(shape)]; }
  /// The side of the signed distance against reach, and against r1 + r2.
  [[nodiscard]] Side at_alarm() const;
  [[nodiscard]] Side at_zero() const;

  /// The signed distance, below 0 also of cores that overlap, less a limit of it.
  [[nodiscard]] Exact beyond(const Rational& limit) const {
    return (overlaps() ? core_distance() : signed_distance()).plus(-limit);
  }
  /// n, of any length; where D = 0, the reference's way out.
  [[nodiscard]] const Point& along() const { return along_; }
  /// One component of n; where D = 0, of the reference's way out.
  [[nodiscard]] Exact normal(int axis) const;
  /// One coordinate of shape 0's or 1's contact point for the normal n.
  [[nodiscard]] Exact point(int shape, int axis, PointOn on) const;
  /// The same for a claimed normal instead of n, and the way out that is nearest to it. Domain: D = 0.
  [[nodiscard]] Rational point_for(int shape, int axis, PointOn on, const Vector3& normal) const;
  /// One coordinate of the middle of the two nearest surface points.
  [[nodiscard]] Exact midpoint(int axis) const;
  /// The signed distance less r1 + r2, less the depth, less the contact distance or not.
  [[nodiscard]] Exact value(bool less_contact) const;
  /// (signed distance - reach) / ulp(reach).
  [[nodiscard]] Exact margin(Scalar scalar) const;
  /// The scale by which `bounded` measures: value max(sqrt D, r1 + r2, contact, depth), point max(farthest, r_i); of a
  /// plane both its distance from the origin too, and the value farthest.
  [[nodiscard]] Exact value_scale() const;
  [[nodiscard]] Exact point_scale(int shape) const;

 private:
  [[nodiscard]] Side within(const Rational& reach) const;
  [[nodiscard]] Exact signed_distance() const { return {Rational(0), Rational(below() ? -1 : 1), distance2_}; }
  void settle_along();
  /// Where a shape's contact point is measured from; and for a claimed normal, where D = 0.
  [[nodiscard]] const Point& nearest(int shape) const;
  [[nodiscard]] const Point& foot(int shape, const Vector3& normal) const;

  Cores cores_;
  Rational contact_;
  Point delta_;
  Rational distance2_;
  Point along_;  ///< n is along_ / |along_|: delta, or the reference's way out
  Rational along2_;
  Rational radii_;
  Rational reach_;
};

/// What is exactly true of two shapes that are apart by the widest of three gaps, negative where they overlap on the
/// axis.
class GapTruth {
 public:
  GapTruth(std::array<Rational, 3> gap, Rational alarm) : gap_(std::move(gap)), alarm_(std::move(alarm)) {}

  [[nodiscard]] const std::array<Rational, 3>& gap() const { return gap_; }
  [[nodiscard]] const Rational& alarm() const { return alarm_; }
  [[nodiscard]] const Rational& widest_gap() const;
  /// The side of the widest gap against the alarm distance, and against 0.
  [[nodiscard]] Side at_alarm() const;
  [[nodiscard]] Side at_zero() const;

 private:
  std::array<Rational, 3> gap_;
  Rational alarm_;
};

/// What is exactly true of a shape that crosses another, or does not.
class CrossingTruth {
 public:
  CrossingTruth() = default;
  /// They cross at a point. The contact there is one of two cores that have it in common and touch along `normal`.
  CrossingTruth(const Point& at, const Point& normal, const Rational& farthest);

  /// Where they cross.
  [[nodiscard]] const std::optional<Point>& at() const { return at_; }
  /// The numbers of that contact. Domain: they cross.
  [[nodiscard]] const DistanceTruth& contact() const { return *contact_; }
  /// No distance makes a crossing or prevents it.
  [[nodiscard]] Side at_alarm() const { return at_ ? Side::within : Side::beyond; }
  [[nodiscard]] Side at_zero() const { return at_alarm(); }

 private:
  std::optional<Point> at_;
  std::optional<DistanceTruth> contact_;
};

/// Where on a ray's line a shape begins or ends: at middle - sqrt(half2), or middle + sqrt(half2).
struct LineEnd {
  Rational middle;
  Rational half2;

  [[nodiscard]] Exact first() const { return {middle, Rational(-1), half2}; }
  [[nodiscard]] Exact last() const { return {middle, Rational(1), half2}; }
};

/// What is exactly true of a ray that is cast at a shape.
class CastTruth {
 public:
  CastTruth() = default;
  /// It hits the shape, and leaves it at `exit` if it does.
  CastTruth(const LineEnd& entry, const std::optional<LineEnd>& exit, CastHit hit);

  /// Where it hits; of an origin in the shape, 0.
  [[nodiscard]] const std::optional<LineEnd>& entry() const { return entry_; }
  [[nodiscard]] const std::optional<LineEnd>& exit() const { return exit_; }
  /// The numbers of the contact. Domain: a hit.
  [[nodiscard]] const DistanceTruth& contact() const { return *contact_; }
  /// No distance makes a hit or prevents it.
  [[nodiscard]] Side at_alarm() const { return entry_ ? Side::within : Side::beyond; }
  [[nodiscard]] Side at_zero() const { return at_alarm(); }

 private:
  std::optional<LineEnd> entry_;
  std::optional<LineEnd> exit_;
  std::optional<DistanceTruth> contact_;
};

/// One of them, by what the contacts of the pair have.
struct ExactTruth {
  std::variant<DistanceTruth, GapTruth, CrossingTruth, CastTruth> numbers;
};

/// What a golden file records of it, but for the margin.
[[nodiscard]] Witness witness_of(const ExactTruth& truth);

/// How two cores meet: not at all, in their boundaries, or with one inside the other.
enum class Meet { no, touching, inside };

[[nodiscard]] ExactTruth exact_truth(const Shapes& shapes, Distances distances);
/// Whether the cores meet; never for a pair without numbers. Exact numbers, which are slow, are made only where nothing
/// quicker tells that they are apart.
[[nodiscard]] Meet cores_meet(const Shapes& shapes);

/// Every number of a contact, before it is rounded, with its field. Domain: a hit.
struct FieldNumber {
  std::string_view field;
  Exact number;
};
[[nodiscard]] std::vector<FieldNumber> numbers(const DistanceTruth& truth);

/// How far a field's numbers lie from the nearest rounding boundary: the least of those that are not on one.
struct FieldDistance {
  std::string_view field;
  Rational ulps;  ///< distance_in_ulps
  int log2;       ///< rounded down, exactly
};
/// Of every field that has such a number; empty without a contact.
[[nodiscard]] std::vector<FieldDistance> rounding_distances(const Truth& truth, Scalar scalar);

}  // namespace contact::oracle
