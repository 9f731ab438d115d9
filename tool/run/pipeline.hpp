// The pipeline: questions -> engines -> judge -> reports.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "golden/dataset.hpp"
#include "golden/families.hpp"
#include "oracle/truth/staged_oracle.hpp"
#include "tool/reports/report.hpp"

namespace contact::tool {

/// Where questions come from: a dataset, a family's generator, or a list of them.
struct Source {
  Pair pair;
  Scalar scalar;
  std::string family;
  std::uint64_t count;  ///< of the questions that are judged
  std::optional<std::filesystem::path> dataset;
  const golden::Family* generator = nullptr;
  std::uint64_t seed = 0;
  std::uint64_t first = 0;  ///< questions before those
  std::uint64_t whole = 0;  ///< questions of the source that this is a part of; 0: of this one
  std::shared_ptr<const std::vector<Query>> listed = nullptr;
  bool fresh = false;  ///< new questions, beside those of datasets: tool/run/fresh.hpp

  [[nodiscard]] std::uint64_t size() const { return whole != 0 ? whole : count; }
};

/// How many questions the one source has, whose rows may be answered in their order; nothing of several.
[[nodiscard]] inline std::optional<std::uint64_t> rows_of(const std::vector<Source>& sources) {
  return sources.size() == 1 ? std::optional(sources.front().size()) : std::nullopt;
}

/// Calls visit for the questions of a source in their order.
void for_each_question(const Source& source, const std::function<void(const engines::Question&)>& visit);
/// Whether an engine that declares this is asked questions of a pair, in numbers of a scalar.
[[nodiscard]] bool engine_takes(const engines::EngineInfo& engine, Pair pair, Scalar scalar);

/// An engine under judgement and what was found of it.
struct Subject {
  std::unique_ptr<engines::Engine> engine;
  Report report;
  std::shared_ptr<const Baseline> baseline = nullptr;  ///< failures that it may have
};

/// Thrown by Stop::check where the time is up.
struct TimeUp {};

/// When a run ends before its last question.
struct Stop {
  using Clock = std::chrono::steady_clock;

  bool at_first_failure = false;  ///< of the first subject, one that its baseline does not accept
  std::optional<Clock::time_point> deadline;
  std::string why;  ///< what ended the run; empty while it goes on

  [[nodiscard]] bool late() const { return deadline && Clock::now() >= *deadline; }
  /// For an engine that is waited for: throws Interrupted or TimeUp.
  void check() const;
};

/// Which questions are asked of all oracles, and not only of the quickest stage that can prove its answer.
enum class Check { sample, all };
inline constexpr std::array<std::string_view, 2> kCheckNames{"sample", "all"};

// A sample has every question of a source of up to kWhole; of a larger one, and of fresh questions, those whose id,
// which is a digest, says so: one in kOneIn of what the double-double stage decided, one in kHardOneIn of what it passed on.
inline constexpr std::uint64_t kWhole = 4096;
inline constexpr unsigned kOneIn = 1024;
inline constexpr unsigned kHardOneIn = 16;
[[nodiscard]] bool is_checked(Check check, std::uint64_t size, const std::string& id, oracle::Stage stage);

/// How the oracles are asked, and what came of it in this process.
struct Oracles {
  Check check = Check::sample;
  oracle::StageCounts decided;  ///< one a question and scalar
  std::uint64_t checked = 0;    ///< of those, how many were put to all oracles
};

/// Judges every subject on every question of a source, until `stop` says otherwise: what is not reached then is
/// missing. A disagreement between the oracles on a question that is asked of all is an OracleFault, one between them
/// and a dataset's expectation an InputError. `run` is how many questions all sources of the run have, so that the
/// diagnosis hears no more right answers of many sources than of one.
void judge_source(const Source& source, std::vector<Subject>& subjects, Stop& stop, Oracles& oracles,
                  std::uint64_t run = 0);

}  // namespace contact::tool
