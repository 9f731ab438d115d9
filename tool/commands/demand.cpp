// The options that say what an engine must reach.
#include "tool/commands/demand.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "engines/protocol/results.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/engine_options.hpp"
#include "tool/run/profiles.hpp"

namespace contact::tool {
Tolerance read_tolerance(const std::string& text) {
  nlohmann::json object = nlohmann::json::object();
  nlohmann::json scale{{"min", 0}, {"max", "Infinity"}};
  const auto refuse = [&](const std::string& part) {
    throw formats::InputError(
        {"command line", 0}, "--tolerance",
        fmt::format("expected length=, relative=, angle=, min= or max= and a number each, got '{}'", part));
  };
  constexpr std::array<std::string_view, 5> kParts{"length", "relative", "angle", "min", "max"};
  std::set<std::string> given;
  std::istringstream parts(text);
  std::string part;
  while (std::getline(parts, part, ',')) {
    const std::size_t equals = std::min(part.find('='), part.size());
    const std::string key = part.substr(0, equals);
    double value = 0;
    const char* end = part.data() + part.size();
    const char* begin = part.data() + std::min(equals + 1, part.size());
    if (const auto read = std::from_chars(begin, end, value); begin == end || read.ptr != end || read.ec != std::errc())
      refuse(part);
    if (std::find(kParts.begin(), kParts.end(), key) == kParts.end() || std::isnan(value)) refuse(part);
    if (!given.insert(key).second) refuse(text);
    (scale.contains(key) ? scale : object)[key] = value;
  }
  if (text.empty() || text.back() == ',') refuse(text);
  object["scale"] = scale;
  const formats::Location where{"--tolerance", 0};
  return engines::read_tolerance(formats::Node(object, where));
}

void add_demand_options(CLI::App& command, DemandOptions& options, std::span<const std::string_view> levels,
                        const std::string& about_levels) {
  options.parsed = &command;
  const Heading heading(command, "What passes");
  auto* level =
      command.add_option("--level", options.level, about_levels)->capture_default_str()->check(CLI::IsMember(levels));
  auto* tolerance = command
                        .add_option("--tolerance", options.tolerance,
                                    "Instead of a level: length=L,relative=R,angle=A. A number may be off by L and R "
                                    "times its scale, a normal by A radians; a decision may be wrong as near as "
                                    "that to where it changes; min=,max= leave questions with other numbers out")
                        ->excludes(level);
  command.add_option("--profile", options.profile, "A tolerance by name, in metres and radians")
      ->check(CLI::IsMember(kProfileNames))
      ->excludes(level)
      ->excludes(tolerance);
  if (std::find(levels.begin(), levels.end(), name(Level::conservative)) == levels.end())
    return;  // no verdict rests on cases
  command
      .add_option(
          "--within", options.within,
          "With --level conservative: refute a false hit that lies farther than this from where the answer changes")
      ->check(kLength);
  command
      .add_option("--least-judged", options.least_judged,
                  "How many judged cases a certificate rests on at least, or half of those given where these are "
                  "fewer, with hits and misses among them where the questions have both. 0: as few as there are")
      ->capture_default_str()
      ->check(kFromZero);
}

std::optional<Tolerance> demanded_tolerance(const DemandOptions& options, const std::optional<Tolerance>& declared,
                                            const std::string& profile) {
  if (options.parsed->count("--tolerance") != 0) return read_tolerance(options.tolerance);
  if (!options.profile.empty()) return profile_of(options.profile).tolerance;
  if (options.parsed->count("--level") != 0) return std::nullopt;
  return profile.empty() ? declared : profile_of(profile).tolerance;
}

void set_demand(const DemandOptions& options, Report& report, const std::string& profile) {
  report.required = static_cast<Level>(index_of(oracle::kLevelNames, options.level, "level"));
  report.engine.declared.tolerance = demanded_tolerance(options, report.engine.declared.tolerance, profile);
  report.least_judged = options.least_judged;
  if (options.within && (report.engine.declared.tolerance || report.required != Level::conservative))
    throw formats::InputError(
        {"command line", 0}, "--within",
        fmt::format("is of --level conservative, which forgives false hits, and {} is required", report.demand()));
  report.within = options.within;
}

}  // namespace contact::tool
