// How far a claim is off in the question's own units, and whether a tolerance allows it, exactly:
// docs/specification.md#tolerances.
#pragma once

#include <optional>
#include <vector>

#include "oracle/judge/judge.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

/// A number that is `error` off the right one, or off a range of them that reaches `room` farther. Domain: `error` is
/// that or its negative, scale >= 0.
[[nodiscard]] Off length_off(const Exact& error, const Exact& scale, const std::optional<Tolerance>& tolerance,
                             const Rational& room = Rational(0));

/// The same of a sum of two numbers whose square roots differ. Domain: it is not negative.
[[nodiscard]] Off length_off_sum(const Exact& x, const Exact& y, const Exact& scale,
                                 const std::optional<Tolerance>& tolerance);
/// What no length allows.
[[nodiscard]] Off beyond_lengths(const std::optional<Tolerance>& tolerance);

/// By how much the length of a vector differs from 1, which an angle allows.
[[nodiscard]] Off unit_off(const Point& v, const std::optional<Tolerance>& tolerance);
/// A normal beside a right one of any length other than 0. One that should be a unit vector is off by its length too.
[[nodiscard]] Off angle_off(const Point& claimed, const Point& right, bool unit,
                            const std::optional<Tolerance>& tolerance);
/// A normal that should point against none of these vectors.
[[nodiscard]] Off angle_off(const Point& claimed, const std::vector<Point>& apart, bool unit,
                            const std::optional<Tolerance>& tolerance);
/// No direction where one is asked for, or one where none is: half a turn.
[[nodiscard]] Off no_direction(const std::optional<Tolerance>& tolerance);

/// How far cores that do not lie in each other are apart.
[[nodiscard]] Off meeting_off(const Query& query, const DistanceTruth& distance, bool by_alarm,
                              const std::optional<Tolerance>& tolerance);
/// A wrong decision: how far the question is from one where it would be right. `by_alarm`: the alarm distance counts,
/// else it is taken as 0.
[[nodiscard]] Off decision_off(const Query& query, const Truth& truth, bool by_alarm,
                               const std::optional<Tolerance>& tolerance);

}  // namespace contact::oracle
