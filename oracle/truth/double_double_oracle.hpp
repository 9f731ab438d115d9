// The double-double stage: pairs of doubles with a radius of error. It proves an answer, or has none.
#pragma once

#include <optional>

#include "oracle/truth/query.hpp"
#include "oracle/truth/rounded_answer.hpp"

namespace contact::oracle {

/// The answer of the exact oracle where sums and products of two doubles with a proved bound of their error settle
/// every decision and every rounding; nothing otherwise, and nothing for numbers that are neither 0 nor of magnitude
/// 2^-200 .. 2^200.
///
/// Domain      every number of the question finite and inside the domain
/// Error       none: the interval around the real number lies on one side of the boundary, or rounds to one number
/// Source      docs/oracle-stages.md#the-double-double-stage
/// Evidence    oracle/truth/double_double_oracle_test.cpp
[[nodiscard]] std::optional<RoundedAnswer> double_double_answer(const Query& query, Scalar scalar);

/// The same, as on processors without fma.
[[nodiscard]] std::optional<RoundedAnswer> double_double_answer_without_fma(const Query& query, Scalar scalar);

// Of the pairs that have files of their own.
[[nodiscard]] std::optional<RoundedAnswer> double_double_answer(const Balls& balls, Distances distances, Scalar scalar);
[[nodiscard]] std::optional<RoundedAnswer> double_double_answer(const BallAndBox& shapes, Distances distances,
                                                                Scalar scalar);
[[nodiscard]] std::optional<RoundedAnswer> double_double_answer(const BallAndTriangle& shapes, Distances distances,
                                                                Scalar scalar);

}  // namespace contact::oracle
