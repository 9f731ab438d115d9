// The exact answer to a question, as exact numbers, and its correct rounding.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "oracle/exact.hpp"
#include "oracle/expectation.hpp"
#include "oracle/query.hpp"

namespace contact::oracle {

/// What is exactly true of two spheres.
///   delta = c2 - c1      D = delta.delta      reach = alarm + r1 + r2      n = delta / sqrt(D)
/// The exact numbers are made when one of them is first asked for, so an object is one thread's at a time.
class SphereTruth {
 public:
  explicit SphereTruth(const Balls& balls, Distances distances) : balls_(balls), distances_(distances) {}

  /// D = 0.
  [[nodiscard]] bool degenerate() const;
  [[nodiscard]] const Rational& distance2() const { return exact().distance2; }
  [[nodiscard]] const Rational& reach() const { return exact().reach; }
  /// The sign of sqrt(D) - reach, and of sqrt(D) - (r1 + r2).
  [[nodiscard]] CGAL::Sign at_alarm() const;
  [[nodiscard]] CGAL::Sign at_zero() const;

  /// One component of n; (1,0,0) where the centres coincide.
  [[nodiscard]] Exact normal(int axis) const;
  /// One coordinate of sphere 0's or 1's contact point for the normal n.
  [[nodiscard]] Exact point(int sphere, int axis, PointOn on) const;
  /// The same for a claimed normal instead of n: what a point must be where the centres coincide.
  [[nodiscard]] Rational point_for(int sphere, int axis, PointOn on, const Vector3& normal) const;
  /// One coordinate of the middle of the two nearest surface points.
  [[nodiscard]] Exact midpoint(int axis) const;
  /// sqrt(D) - (r1 + r2), less the contact distance or not.
  [[nodiscard]] Exact value(bool less_contact) const;
  /// (sqrt(D) - reach) / ulp(reach).
  [[nodiscard]] Exact margin(Scalar scalar) const;
  /// The scale by which `bounded` measures: value max(sqrt D, r1 + r2, contact), point max(|c_i| coordinates, r_i).
  [[nodiscard]] Exact value_scale() const;
  [[nodiscard]] Rational point_scale(int sphere) const;

 private:
  struct Numbers {
    Numbers(const Balls& balls, Distances distances);

    std::array<std::array<Rational, 3>, 2> center;
    std::array<Rational, 2> radius;
    Rational contact;
    std::array<Rational, 3> delta;
    Rational distance2;
    Rational radii;
    Rational reach;
  };
  [[nodiscard]] const Numbers& exact() const;

  Balls balls_;
  Distances distances_;
  mutable std::optional<Numbers> exact_;
};

/// What is exactly true of two boxes: on each axis the gap max(min1 - max2, min2 - max1), negative where they overlap.
/// The exact numbers are made when one of them is first asked for, so an object is one thread's at a time.
class CubeTruth {
 public:
  explicit CubeTruth(const Boxes& boxes, Distances distances) : boxes_(boxes), distances_(distances) {}

  [[nodiscard]] const std::array<Rational, 3>& gap() const { return exact().gap; }
  [[nodiscard]] const Rational& alarm() const { return exact().alarm; }
  [[nodiscard]] const Rational& widest_gap() const;
  /// The sign of the largest gap less the alarm distance, and of the largest gap.
  [[nodiscard]] CGAL::Sign at_alarm() const { return CGAL::sign(widest_gap() - alarm()); }
  [[nodiscard]] CGAL::Sign at_zero() const { return CGAL::sign(widest_gap()); }

 private:
  struct Numbers {
    std::array<Rational, 3> gap;
    Rational alarm;
  };
  [[nodiscard]] const Numbers& exact() const;

  Boxes boxes_;
  Distances distances_;
  mutable std::optional<Numbers> exact_;
};

struct Truth {
  CGAL::Sign at_alarm;  ///< NEGATIVE within the alarm distance, ZERO exactly at it, POSITIVE beyond it
  CGAL::Sign at_zero;   ///< the same for an alarm distance of 0
  std::optional<SphereTruth> spheres;
  std::optional<CubeTruth> cubes;

  [[nodiscard]] bool hit() const { return at_alarm != CGAL::POSITIVE; }
};

/// Domain: every number of the question finite and inside the domain.
[[nodiscard]] Truth truth_of(const Query& query);
/// The same where both signs have been decided already: its exact numbers wait until they are asked for.
[[nodiscard]] Truth truth_with(const Query& query, CGAL::Sign at_alarm, CGAL::Sign at_zero);

/// The correctly rounded answer.
[[nodiscard]] Expectation expectation(const Truth& truth, Scalar scalar);

/// Every number of a contact, before it is rounded, with its field. Domain: a hit of two spheres.
struct FieldNumber {
  std::string_view field;
  Exact number;
};
[[nodiscard]] std::vector<FieldNumber> numbers(const SphereTruth& spheres);

/// How far a field's numbers lie from the nearest rounding boundary: the least of those that are not on one.
struct FieldDistance {
  std::string_view field;
  Rational ulps;  ///< distance_in_ulps
  int log2;       ///< rounded down, exactly
};
/// Of every field that has such a number; empty without a contact.
[[nodiscard]] std::vector<FieldDistance> rounding_distances(const Truth& truth, Scalar scalar);

/// The exact numbers that a golden file records beside an expectation.
struct Witness {
  std::string distance2;  ///< spheres
  std::string reach;
  double margin_ulps = 0;
  std::array<std::string, 3> gap;  ///< cubes

  friend bool operator==(const Witness&, const Witness&) = default;
};
[[nodiscard]] Witness witness(const Truth& truth, Scalar scalar);

}  // namespace contact::oracle
