// What a refusal says.
#pragma once

#include <charconv>
#include <string>

#include "contact/domain.hpp"

namespace contact::component {

/// field = value: rule
[[nodiscard]] inline std::string message(const DomainError& error) {
  char digits[32];
  const auto end = std::to_chars(std::begin(digits), std::end(digits), error.value).ptr;
  return error.field + " = " + std::string(std::begin(digits), end) + ": " + error.rule;
}

}  // namespace contact::component
