// Engines that others wrote, each behind an adapter that is started as a process of its own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contact/contact.hpp"
#include "golden/results.hpp"
#include "oracle/claim.hpp"

namespace contact::engines {

struct Adapter {
  std::string_view name;
  std::string_view about;
  Scalar scalar;
  std::string_view npm = {};  ///< the npm package that engines/node/NAME.mjs adapts; none: engines/adapters
};

[[nodiscard]] std::span<const Adapter> adapters();

/// What starts it, or nothing where its engine is not installed.
[[nodiscard]] std::optional<std::vector<std::string>> command_of(const Adapter& adapter);

}  // namespace contact::engines
