// The second oracle: MPFR intervals with outward rounding. It exists to check the first and shares only plain structs.
#pragma once

#include "oracle/expectation.hpp"
#include "oracle/query.hpp"

namespace contact::oracle {

/// The same answer as the exact oracle's, derived by interval arithmetic at a precision that is doubled until every
/// decision and every rounding is settled.
struct IntervalAnswer {
  int at_alarm;  ///< -1 within the alarm distance, 0 exactly at it, 1 beyond it
  int at_zero;   ///< the same for an alarm distance of 0
  Expectation expected;
};

/// Domain: every number of the question finite and inside the domain.
/// Terminates: sums, differences and products of dyadic numbers are exact at some precision, and so are sqrt(D) and the
/// quotients wherever a result is dyadic; every other result is at some distance from every rounding boundary.
[[nodiscard]] IntervalAnswer interval_answer(const Query& query, Scalar scalar);

}  // namespace contact::oracle
