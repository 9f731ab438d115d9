// What this process computes on.
#include "tool/run/environment.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace contact::tool {
namespace {

/// What stands behind the first line that begins with `key`, without quotes; empty where there is none.
std::string value_in(const char* path, std::string_view key, char separator) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t begin = line.find_first_not_of(" \t\"", line.find(separator) + 1);
    const std::size_t end = line.find_last_not_of(" \t\"");
    return begin == std::string::npos || end < begin ? "" : line.substr(begin, end - begin + 1);
  }
  return "";
}

/// The rounding mode, by what it does: fegetround() tells what was asked for, and not of every unit.
std::string_view rounding() {
  const volatile double one = 1;
  const volatile double tiny = std::numeric_limits<double>::epsilon() / 8;
  const volatile double above = one + tiny;
  const volatile double below = -one - tiny;
  if (above > 1) return below < -1 ? "away from zero" : "upward";
  if (below < -1) return "downward";
  const volatile double nearly_one = one - tiny;
  return nearly_one < 1 ? "toward zero" : "to nearest";
}

}  // namespace

nlohmann::json environment() {
  utsname system{};
  uname(&system);
  const std::string distribution = value_in("/etc/os-release", "PRETTY_NAME", '=');
  std::string processor = value_in("/proc/cpuinfo", "model name", ':');
  if (processor.empty()) processor = system.machine;
  const volatile double smallest_normal = std::numeric_limits<double>::min();
  const volatile double smallest = std::numeric_limits<double>::denorm_min();
  const double half = smallest_normal / 2;
  const double scaled = smallest * 0x1p1000;
#ifdef __clang__
  constexpr std::string_view kCompiler = "";  // __VERSION__ says its name
#else
  constexpr std::string_view kCompiler = "gcc ";
#endif
  // The bits of what may be subnormal: a comparison of it would itself take it for zero where inputs are.
  return {{"processor", processor},
          {"system", fmt::format("{} {} {}{}{}", system.sysname, system.release, system.machine,
                                 distribution.empty() ? "" : ", ", distribution)},
          {"compiler", fmt::format("{}{}", kCompiler, __VERSION__)},
          {"rounding", rounding()},
          {"subnormal_results", std::bit_cast<std::uint64_t>(half) != 0 ? "kept" : "flushed to zero"},
          {"subnormal_inputs", scaled != 0 ? "kept" : "taken for zero"}};
}

}  // namespace contact::tool
