// The interval oracle: MPFR intervals with outward rounding. It exists to check the exact one and shares only plain structs.
#pragma once

#include <optional>

#include "oracle/truth/query.hpp"
#include "oracle/truth/rounded_answer.hpp"

namespace contact::oracle {

/// The same answer as the exact oracle's, derived by interval arithmetic at a precision that is doubled until every
/// decision and every rounding is settled.
/// Domain: every number of the question finite and inside the domain.
/// Terminates: sums, differences and products of dyadic numbers are exact at some precision, and so are sqrt(D) and the
/// quotients wherever a result is dyadic; every other result is at some distance from every rounding boundary.
[[nodiscard]] RoundedAnswer interval_answer(const Query& query, Scalar scalar);

/// The same, or nothing where `most` bits do not settle it.
[[nodiscard]] std::optional<RoundedAnswer> interval_answer_within(int most, const Query& query, Scalar scalar);

}  // namespace contact::oracle
