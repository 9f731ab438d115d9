// The oracles one after another, the fastest first: each proves its answer or passes the question on.
#include "oracle/truth/staged_oracle.hpp"

namespace contact::oracle {
namespace {

StagedAnswer with(const Query& query, RoundedAnswer&& answer, Stage stage) {
  return {truth_with(query, static_cast<Side>(answer.at_alarm), static_cast<Side>(answer.at_zero)),
          std::move(answer.expected), stage, answer.margin};
}

}  // namespace

StagedAnswer staged_answer(const Query& query, Scalar scalar) {
  if (auto answer = double_double_answer(query, scalar)) return with(query, *std::move(answer), Stage::double_double);
  // Of any two cores the exact oracle, whose intervals of doubles leave few features, is the faster one.
  if (auto answer = is_convex(query.pair) ? std::nullopt : interval_answer_within(kMostBits, query, scalar))
    return with(query, *std::move(answer), Stage::interval);
  Truth truth = truth_of(query);
  Expectation expected = expectation(truth, scalar);
  return {std::move(truth), std::move(expected), Stage::exact, {}};
}

RoundedAnswer rounded_answer(const Truth& truth, Scalar scalar) {
  return {static_cast<int>(truth.at_alarm), static_cast<int>(truth.at_zero), expectation(truth, scalar)};
}

RoundedAnswer rounded_answer(const StagedAnswer& staged) {
  return {static_cast<int>(staged.truth.at_alarm), static_cast<int>(staged.truth.at_zero), staged.expected};
}

std::optional<std::string> first_difference(const RoundedAnswer& x, const RoundedAnswer& y) {
  if (auto field = contact::first_difference(x.expected, y.expected)) return field;
  if (x.at_alarm != y.at_alarm || x.at_zero != y.at_zero) return "the decision";
  return std::nullopt;
}

}  // namespace contact::oracle
