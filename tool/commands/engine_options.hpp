// The options that choose the engine: one declaration for every command that asks one.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "contact/contact.hpp"
#include "engines/engine.hpp"
#include "formats/input_error.hpp"
#include "tool/run/determinism.hpp"
#include "tool/run/process.hpp"

namespace CLI {
class App;
}

namespace contact::tool {

/// The levels that may be asked for: "none" asks for nothing.
inline constexpr auto kRequiredLevels = std::span(oracle::kLevelNames).first<5>();

struct EngineOptions {
  std::string engine;   ///< a built-in engine
  std::string command;  ///< --engine-command
  std::string library;  ///< --engine-library
  std::string results;  ///< --results, where a command takes it
  std::string points = std::string(engines::kComputedPointsNames.front());
  std::size_t jobs = 0;  ///< engine processes, and threads where the command has them; 0: one process, a thread a core
  std::optional<std::uint64_t> rows{};  ///< of a results file: the questions, where all are of one dataset
  double start_limit = 10;              ///< seconds
  double answer_limit = 10;             ///< seconds
  const CLI::App* parsed = nullptr;     ///< the command that they were given to

  /// Whether none was chosen.
  [[nodiscard]] bool none() const { return engine.empty() && command.empty() && library.empty() && results.empty(); }
};

/// `recorded`: with --results, for commands that ask no questions of their own.
void add_engine_options(CLI::App& command, EngineOptions& options, bool recorded);
/// Throws InputError naming an option that was given and that the chosen engine has no use for. `threads`: whether
/// --jobs is of use to the command itself.
void require_used(const EngineOptions& options, bool threads);

/// The chosen engine, started; production where none was chosen. What `check` throws while an engine is waited for ends
/// the wait. Throws InputError for what is not there, and engines::HarnessInvalid for an engine that does not start.
[[nodiscard]] std::unique_ptr<engines::Engine> make_engine(const EngineOptions& options,
                                                           std::function<void()> check = throw_if_interrupted);

/// The other ways to ask it at once from several threads: of a process several, of a library several threads besides.
[[nodiscard]] std::vector<OtherHost> other_hosts(const EngineOptions& options, const std::function<void()>& check);

/// A built-in engine by name. Throws InputError with the names where there is none.
[[nodiscard]] std::unique_ptr<engines::Engine> built_in(const std::string& name, PointConvention points);
/// The convention that --points names.
[[nodiscard]] PointConvention computed_points(const EngineOptions& options);

/// The index of `text` among names. Throws InputError with the names.
template <class Names>
[[nodiscard]] std::size_t index_of(const Names& names, const std::string& text, const std::string& what) {
  const auto it = std::find(names.begin(), names.end(), text);
  if (it == names.end())
    throw formats::InputError({"command line", 0}, "",
                              fmt::format("unknown {} '{}'; known: {}", what, text, fmt::join(names, ", ")));
  return static_cast<std::size_t>(it - names.begin());
}

}  // namespace contact::tool
