// What a refusal says.
#pragma once

#include <charconv>
#include <string>

#include "contact/domain.hpp"
#include "kernel/floating_point_environment.hpp"

namespace contact::component {

/// field = value: rule
[[nodiscard]] inline std::string message(const DomainError& error) {
  const kernel::RoundToNearest environment;  // to_chars calculates with subnormal numbers
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), error.value).ptr;
  return error.field + " = " + std::string(std::begin(digits), end) + ": " + error.rule;
}

}  // namespace contact::component
