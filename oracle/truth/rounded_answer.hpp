// What every oracle says of a question: the two decisions, the answer rounded once, and by how much it is a hit.
#pragma once

#include "oracle/truth/expectation.hpp"

namespace contact::oracle {

struct RoundedAnswer {
  int at_alarm;  ///< -1 within the alarm distance, 0 exactly at it, 1 beyond it
  int at_zero;   ///< the same for an alarm distance of 0
  Expectation expected;
  /// (sqrt(D) - reach) / ulp(reach) in the scalar, rounded to binary64: a golden file's witness. Nothing where an
  /// oracle does not tell, and for pairs without a distance.
  std::optional<double> margin_ulps{};
};

}  // namespace contact::oracle
