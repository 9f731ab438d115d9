// What the laws said of an engine, for people, for JUnit and as JSON.
#pragma once

#include <string>

#include "proptests/run.hpp"

namespace contact::tool {

struct LawRun {
  proptests::RunResult result;
  std::uint64_t seed;
  std::uint64_t cases;
  std::string again;  ///< the command that repeats the run, without --law
};

[[nodiscard]] std::string terminal_text(const LawRun& run);
[[nodiscard]] std::string junit_text(const LawRun& run);
[[nodiscard]] std::string json_text(const LawRun& run);

}  // namespace contact::tool
