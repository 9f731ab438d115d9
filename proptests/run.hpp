// Asks an engine every law: draws trials, judges them, and shrinks what violates a law.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engines/engine.hpp"
#include "proptests/law.hpp"

namespace contact::proptests {

struct RunOptions {
  std::uint64_t seed = 0;
  std::uint64_t cases = 1000;      ///< a law
  bool correctly_rounded = false;  ///< hold the engine to correct rounding instead of its bounds
  /// Hold it to this instead of its bounds. Domain: nothing where held to correct rounding.
  std::optional<Tolerance> tolerance;
  std::vector<std::string> names;  ///< only these laws
  Case::TruthOf truth = oracle::truth_of;
  /// Called after each case; what it throws ends the run.
  std::function<void()> after_case;
  /// An engine in the place of one that counts as dead.
  std::function<std::unique_ptr<engines::Engine>()> restart;
};

/// The smallest trial found that violates a law: what was asked, what was said, what is wrong.
struct Violation {
  Trial trial;
  std::vector<Query> queries;
  std::vector<Claim> claims;
  std::string why;
  std::uint64_t tries = 0;  ///< trials that shrinking took
};

struct LawResult {
  const Law* law;
  std::uint64_t tested = 0;
  std::optional<std::string> skipped;  ///< why it was not asked
  std::optional<Violation> violation;
  bool given_up = false;  ///< a right engine would have been tested on many more

  [[nodiscard]] bool holds() const { return !skipped && !violation && !given_up; }
};

/// The classes of the questions that laws were tested on.
enum class Class { hit, exact_edge, near_edge, coincident, subnormal, huge, flat };
inline constexpr std::array<std::string_view, 7> kClassNames{"hits",
                                                             "exactly touching or at the alarm distance",
                                                             "within 4 ulps of it",
                                                             "coincident centres",
                                                             "a subnormal number",
                                                             "a number of the topmost binades",
                                                             "a flat box"};
struct Shares {
  std::uint64_t questions = 0;
  std::array<std::uint64_t, kClassNames.size()> counts{};

  [[nodiscard]] double percent(Class c) const {
    return questions == 0
               ? 0
               : 100.0 * static_cast<double>(counts[static_cast<std::size_t>(c)]) / static_cast<double>(questions);
  }
};

struct RunResult {
  engines::EngineInfo engine;
  std::vector<LawResult> laws;  ///< in the order of the list, so that the first violated names the mistake best
  Shares shares;
  bool ever_answered = false;

  [[nodiscard]] const LawResult* first_violated() const;
  /// How many laws were not asked.
  [[nodiscard]] std::size_t skipped() const;
  /// Whether some law was tested and none is violated or given up.
  [[nodiscard]] bool holds() const;
};

[[nodiscard]] RunResult run_laws(std::unique_ptr<engines::Engine>& engine, const RunOptions& options);

}  // namespace contact::proptests
