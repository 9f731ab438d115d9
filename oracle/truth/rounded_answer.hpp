// What every oracle says of a question: the two decisions, the answer rounded once, and by how much it is a hit.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "oracle/truth/expectation.hpp"

namespace contact::oracle {

/// What is known of (sqrt(D) - reach) / ulp(reach) in the scalar, which a golden file's witness has rounded to
/// binary64: that rounding lies between two numbers.
struct MarginBounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();

  /// The rounding, where that is known.
  [[nodiscard]] std::optional<double> rounded() const {
    if (low != high) return std::nullopt;
    return low == 0 ? 0.0 : low;  // no -0
  }
  /// A number with its sign and of its binary exponent, where those are known.
  [[nodiscard]] std::optional<double> of_its_size() const {
    if (low == high) return low;
    return low * high > 0 && std::ilogb(low) == std::ilogb(high) ? std::optional(low) : std::nullopt;
  }
  [[nodiscard]] bool allows(double margin) const { return low <= margin && margin <= high; }
};

struct RoundedAnswer {
  int at_alarm;  ///< -1 within the alarm distance, 0 exactly at it, 1 beyond it
  int at_zero;   ///< the same for an alarm distance of 0
  Expectation expected;
  MarginBounds margin{};  ///< says nothing for pairs without a distance
};

}  // namespace contact::oracle
