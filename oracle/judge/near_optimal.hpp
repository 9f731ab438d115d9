// Claims that are as good as a right answer: where the answer jumps, a tolerance asks whether a claim is possible and
// nearly the best, exactly: docs/specification.md#where-the-answer-jumps.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "oracle/judge/judge.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

/// A claimed contact, the normal from the first shape to the second and of any length.
struct ClaimedContact {
  std::optional<Point> normal;
  bool zero_where_cores_meet = false;  ///< a normal of length 0 says that they do
  std::array<std::optional<Point>, 2> points;
  std::array<PointOn, 2> on{PointOn::nearest_surface, PointOn::nearest_surface};
  std::optional<Point> midpoint;
  bool is_finite = true;  ///< every number of these that was claimed
};

/// A vector made one of length 1, to 200 bits.
[[nodiscard]] Point of_length_one(const Point& n);

/// The square of how far a point is from the boundary of a half-space.
[[nodiscard]] Rational squared_height_over(const Plane& plane, const Point& x);

/// What length each field of a claimed contact needs. One that no length allows needs an infinite one.
class NearOptimal {
 public:
  NearOptimal(const Query& query, const DistanceTruth& truth, const ClaimedContact& claim,
              const std::optional<Tolerance>& tolerance, Scalar scalar);

  /// Domain: there is one. The points that are claimed must go with it.
  [[nodiscard]] Off normal() const;
  /// The contact point of shape 0 or 1. Domain: there is one.
  [[nodiscard]] Off point(int shape) const;
  /// Domain: there is one.
  [[nodiscard]] Off midpoint() const;

 private:
  /// A way to read the points: with this normal, of length 1 or 0, and this way from the first core's point to the
  /// second's.
  struct Reading {
    Off need;
    Point normal;
    Point delta;
  };
  /// One of the six faces of a box that a sphere's centre is in.
  struct Face {
    WayOut way;
    Rational depth;
  };

  [[nodiscard]] Off length(const Exact& error, const Exact& scale) const;
  [[nodiscard]] Off root(const Rational& squared, const Exact& scale) const;
  [[nodiscard]] bool is_noise(const Rational& squared) const;
  [[nodiscard]] Off turn(const Rational& length2, const Point& from, const Point& to) const;
  [[nodiscard]] Off positions_turn(const Point& n) const;
  [[nodiscard]] Off goes_with(int shape, const Point& unit) const;
  [[nodiscard]] Point core_point(int shape, const Point& unit) const;
  [[nodiscard]] Rational squared_distance(int shape, const Point& x) const;
  [[nodiscard]] Off middle_goes_with(const Point& unit, const Point& delta) const;
  [[nodiscard]] Point delta() const;
  [[nodiscard]] Point out_along(const Point& n) const;
  [[nodiscard]] Off beside_cores(int shape, const Point& x, const Rational& radius, const Exact& scale) const;
  [[nodiscard]] std::vector<Reading> readings() const;

  const Query& query_;
  const DistanceTruth& truth_;
  const ClaimedContact& claim_;
  const std::optional<Tolerance>& tolerance_;
  Exact scale_;              ///< the larger one of the two points
  Exact noise_;              ///< 8 roundings of it: what is no longer has no direction
  bool is_flat_ = false;     ///< a segment all of which is no farther from the plane that it crosses
  std::vector<Face> faces_;  ///< where the cores are one in the other; of them only those that the normal speaks of
};

}  // namespace contact::oracle
