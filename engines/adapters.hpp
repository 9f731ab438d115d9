// Engines that others wrote, each behind an adapter that is started as a process of its own.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "contact/contact.hpp"
#include "engines/protocol/results.hpp"
#include "oracle/judge/claim.hpp"

namespace contact::engines {

struct Adapter {
  std::string_view name;
  std::string_view about;
  Scalar scalar;
  std::string_view npm = {};  ///< the npm package that engines/node/NAME.mjs adapts; none: engines/adapters
};

[[nodiscard]] std::span<const Adapter> adapters();

/// The adapter of that name, or null.
[[nodiscard]] const Adapter* find_adapter(std::string_view name);

/// What starts it, or nothing where its engine is not installed.
[[nodiscard]] std::optional<std::vector<std::string>> command_of(const Adapter& adapter);

/// The files that make an installed one what it is: its library; or its module, and the versions and digests of the
/// packages that it loads.
[[nodiscard]] std::vector<std::filesystem::path> files_of(const Adapter& adapter);

}  // namespace contact::engines
