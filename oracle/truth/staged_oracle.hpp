// The oracles one after another, the fastest first: each proves its answer or passes the question on.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "oracle/truth/double_double_oracle.hpp"
#include "oracle/truth/interval_oracle.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::oracle {

enum class Stage { double_double, interval, exact };
inline constexpr std::array<std::string_view, 3> kStageNames{"double-double", "interval", "exact"};

/// Past so many bits the interval oracle passes a question on. Below, it is faster than the exact oracle even where
/// numbers of all scales meet; above are ties that no precision settles.
inline constexpr int kMostBits = 12288;

/// The truth of a question, its exact numbers waiting until they are asked for, and its rounding.
struct StagedAnswer {
  Truth truth;
  Expectation expected;
  Stage stage;          ///< which one decided
  MarginBounds margin;  ///< what the stage knows of it: nothing where that is the exact one
};

/// Domain: every number of the question finite and inside the domain.
[[nodiscard]] StagedAnswer staged_answer(const Query& query, Scalar scalar);

/// The two decisions and the rounding that a truth stands for.
[[nodiscard]] RoundedAnswer rounded_answer(const Truth& truth, Scalar scalar);
[[nodiscard]] RoundedAnswer rounded_answer(const StagedAnswer& staged);

/// The first thing in which two answers differ: "the decision", or a field; nothing where they are the same.
[[nodiscard]] std::optional<std::string> first_difference(const RoundedAnswer& x, const RoundedAnswer& y);

/// How many answers each stage gave.
struct StageCounts {
  std::array<std::uint64_t, kStageNames.size()> answers{};

  void add(Stage stage) { ++answers[static_cast<std::size_t>(stage)]; }
  void merge(const StageCounts& other) {
    for (std::size_t i = 0; i < answers.size(); ++i) answers[i] += other.answers[i];
  }
};

}  // namespace contact::oracle
