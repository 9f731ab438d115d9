// What every oracle says of a question: the two decisions, and the answer rounded once.
#pragma once

#include "oracle/truth/expectation.hpp"

namespace contact::oracle {

struct RoundedAnswer {
  int at_alarm;  ///< -1 within the alarm distance, 0 exactly at it, 1 beyond it
  int at_zero;   ///< the same for an alarm distance of 0
  Expectation expected;
};

}  // namespace contact::oracle
