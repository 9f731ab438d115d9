// A claimed contact point held against a set of right ones: docs/specification.md#capsule-pairs.
#pragma once

#include <array>

#include "oracle/judge/judge.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

/// The middle; or where the nearest points are not unique, a segment or a polygon: all that lies between middle + each of
/// the spread. Each coordinate may be `room` beside that. Domain: the coordinates of the middle are of one D.
struct PointSet {
  std::array<Exact, 3> middle;
  Spread spread;
  Rational room;
};

/// The grade of a claimed point: right where one point of the set rounds to it in all three coordinates, faithful where
/// one is beside it in all three. Else its error is the least, over the set, of the largest error of a coordinate.
[[nodiscard]] FieldVerdict grade(const Vector3& claim, const PointSet& set, const Yardstick& by);

}  // namespace contact::oracle
