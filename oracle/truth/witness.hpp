// Exact numbers as texts: what a golden file has beside an answer, so that anybody can check it.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace contact::oracle {

/// The exact numbers that a golden file records beside an expectation.
struct Witness {
  std::string distance2;  ///< of a pair with a distance
  std::string reach;
  double margin_ulps = 0;
  std::array<std::string, 3> gap;                           ///< of a pair without numbers
  bool below = false;                                       ///< the distance is signed, and negative
  std::optional<std::array<std::string, 3>> crossing = {};  ///< where one shape crosses the other
  /// Where a ray hits: a and h, t being a - sqrt(h).
  std::optional<std::array<std::string, 2>> cast = {};
  std::string depth2 = {};  ///< where cores overlap and that is an ordinary hit, else empty

  friend bool operator==(const Witness&, const Witness&) = default;
};

/// Whether a text is the one spelling of some exact number there: exact_string's.
[[nodiscard]] bool is_exact_string(std::string_view text);

}  // namespace contact::oracle
