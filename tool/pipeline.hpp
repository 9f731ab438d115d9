// The pipeline: questions -> engines -> judge -> reports.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "golden/dataset.hpp"
#include "golden/families.hpp"
#include "oracle/interval_oracle.hpp"
#include "tool/report.hpp"

namespace contact::tool {

/// Where questions come from: a dataset, or a family's generator.
struct Source {
  Pair pair;
  Scalar scalar;
  std::string family;
  std::uint64_t count;  ///< of the questions that are judged
  std::optional<std::filesystem::path> dataset;
  const golden::Family* generator = nullptr;
  std::uint64_t seed = 0;
  std::uint64_t first = 0;  ///< questions before those
};

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

/// Judges every subject on every question of a source, until `stop` says otherwise: what is not reached then is
/// missing. Both oracles answer every question: a disagreement between them is an OracleFault, one between the exact
/// oracle and a dataset's expectation an InputError.
void judge_source(const Source& source, std::vector<Subject>& subjects, Stop& stop);

/// Throws OracleFault where the two oracles differ on a question.
void require_agreement(const Query& query, const oracle::Truth& truth, const oracle::RoundedAnswer& second,
                       Scalar scalar);

}  // namespace contact::tool
