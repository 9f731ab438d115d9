// The options that say what an engine must reach: a level, a tolerance, or a profile's; and on how much.
#pragma once

#include <CLI/App.hpp>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "tool/commands/engine_options.hpp"
#include "tool/reports/report.hpp"

namespace contact::tool {

struct DemandOptions {
  std::string level = std::string(name(Level::bounded));
  std::string tolerance;
  std::string profile;
  std::optional<double> within;
  std::uint64_t least_judged = kLeastJudged;
  const CLI::App* parsed = nullptr;  ///< the command that they were given to
};

void add_demand_options(CLI::App& command, DemandOptions& options,
                        std::span<const std::string_view> levels = kRequiredLevels,
                        const std::string& about_levels = "Required level");
/// What --tolerance is given: "length=1e-6,relative=1e-6,angle=1e-6", any of which may be absent, with min= and max= of
/// the numbers served. Throws InputError for anything else.
[[nodiscard]] Tolerance read_tolerance(const std::string& text);
/// A tolerance that is given, else that of `profile` where it is not empty, else the `declared` one; none where a level
/// is given.
[[nodiscard]] std::optional<Tolerance> demanded_tolerance(const DemandOptions& options,
                                                          const std::optional<Tolerance>& declared,
                                                          const std::string& profile = "");
/// What a report demands: a tolerance that is given, else that of `profile` where it is not empty, else the one that
/// the engine declares, and where a level is given or there is none of these, the level.
void set_demand(const DemandOptions& options, Report& report, const std::string& profile = "");

}  // namespace contact::tool
