// The derivatives of a contact's numbers by the numbers of its question: exact, and rounded once.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "oracle/truth/truth.hpp"

namespace contact::oracle {

/// What is differentiated, in this order: the value, then three components of each of the others.
inline constexpr std::array<std::string_view, 4> kDifferentiated{"value", "normal", "point1", "point2"};
inline constexpr std::size_t kOutputs = 10;

/// The derivative of one number of a contact by one number of the question.
struct Derivative {
  std::optional<double> number;
  std::string_view undefined = {};  ///< why there is none
  /// Where there is none: those from below and from above, where there are such.
  std::array<std::optional<double>, 2> sides = {};
};

struct Gradient {
  std::vector<std::string> by;  ///< the numbers of both shapes in the canonical order: "a.center[0]"
  /// By each of them.
  std::vector<std::array<Derivative, kOutputs>> derivatives;
};

/// The derivatives of what the reference says of two shapes, whatever the alarm distance: of a miss those of its nearest points and of its distance.
///   value = s - r1 - r2 - contact     point1 = p + r1 n     point2 = q - r2 n
/// s the signed distance of the cores, n the normal, p and q the nearest points. Each is that by one number, all others kept.
/// Domain      a question inside the domain, `truth` its own. Nothing for a pair without a distance.
/// Error       every number is the exact real rounded once to binary64, to nearest, ties to even.
/// Exists      where the derivatives from both sides exist and are equal, exactly; `undefined` says what is amiss elsewhere. What begins with "not told" may exist.
/// Source      docs/gradients.md.
/// Evidence    golden/gradient_test.cpp: differences of the exact oracle's answers, 2^-400 apart and less.
[[nodiscard]] std::optional<Gradient> gradient(const Query& query, const Truth& truth);

}  // namespace contact::oracle
