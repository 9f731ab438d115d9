// Integers out of input: the one way in which a number that a file or a command line states becomes an integer.
#pragma once

#include <charconv>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

#include "formats/input_error.hpp"

namespace contact::formats {

/// The integer that x is; nothing where it is none, or one that To does not have.
template <std::integral To, class From>
requires std::is_arithmetic_v<From>
[[nodiscard]] std::optional<To> whole_number(From x) {
  if constexpr (std::is_floating_point_v<From>) {
    // The greatest To need not be a From; the power of two behind it is one.
    const From end = std::ldexp(From{1}, std::numeric_limits<To>::digits);
    if (!(x < end && x >= (std::is_signed_v<To> ? -end : From{0}) && x == std::trunc(x))) return std::nullopt;
  } else if (!std::in_range<To>(x)) {
    return std::nullopt;
  }
  return static_cast<To>(x);
}

/// The integer whose digits are the whole text, behind a minus where To has a sign.
template <std::integral To>
[[nodiscard]] std::optional<To> whole_number(std::string_view text) {
  To number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

/// The same within bounds, or InputError naming file, line, field and value.
template <std::integral To, class From>
[[nodiscard]] To require_whole_number(const From& x, const Location& where, const std::string& field,
                                      To least = std::numeric_limits<To>::min(),
                                      To most = std::numeric_limits<To>::max()) {
  const std::optional<To> number = whole_number<To>(x);
  if (!number || *number < least || *number > most)
    throw InputError(where, field, fmt::format("expected a whole number from {} to {}, got {}", least, most, x));
  return *number;
}

}  // namespace contact::formats
