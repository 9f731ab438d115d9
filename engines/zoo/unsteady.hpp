// Engines whose answers are right once and depend on what they should not depend on: for `certify --determinism`.
#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "engines/engine.hpp"

namespace contact::engines {

inline constexpr std::string_view kUnsteadyPrefix = "unsteady:";

struct Unsteady {
  std::string_view id;
  std::string_view about;
};
[[nodiscard]] std::span<const Unsteady> unsteady_engines();

/// Production, and now and then a value that is off by some ulps. nullptr where there is none of that id.
[[nodiscard]] std::unique_ptr<Engine> make_unsteady(std::string_view id);

}  // namespace contact::engines
