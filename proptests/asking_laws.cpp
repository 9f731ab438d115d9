// Whether and how an engine answers: always, the same again, alone or in a batch, and bad input refused.
#include <fmt/format.h>

#include "engines/protocol/results.hpp"
#include "proptests/law_functions.hpp"

namespace contact::proptests {
namespace {

std::string status(const Claim& claim) {
  switch (claim.status) {
    case Claim::Status::answered:
      return "an answer";
    case Claim::Status::unsupported:
      return "unsupported: " + claim.text;
    case Claim::Status::rejected:
      return "rejected: " + claim.text;
    case Claim::Status::error:
      return "error: " + claim.text;
    case Claim::Status::timeout:
      return "timeout: " + claim.text;
    case Claim::Status::crash:
      return "crash: " + claim.text;
    case Claim::Status::missing:
      break;
  }
  return "no answer: " + claim.text;
}

/// Two claims as text, which tells numbers apart by their bits (but for the sign of a zero) and takes NaN for itself.
Outcome same(const Case& c, std::size_t i, std::size_t j, std::string_view how) {
  const std::string x = engines::claim_object(c.claims[i]);
  const std::string y = engines::claim_object(c.claims[j]);
  if (x == y) return {};
  return Outcome::violated(fmt::format("the same question got two answers, {}: {} and {}", how, x, y));
}

/// How the cores of a question meet, which takes no decision to say.
oracle::Truth meeting(const Query& query) {
  return oracle::truth_with(query, oracle::Side::within, oracle::Side::within);
}

}  // namespace

Questions itself(const Trial& trial, const Subject&) { return {trial.query}; }

Questions itself_if_bad(const Trial& trial, const Subject&) {
  return outside_domain(trial.query) ? Questions{trial.query} : Questions{};
}

Questions itself_if_coincident(const Trial& trial, const Subject&) {
  return meeting(trial.query).coincident() ? Questions{trial.query} : Questions{};
}

Questions itself_if_inside(const Trial& trial, const Subject&) {
  const oracle::Truth cores = meeting(trial.query);
  return cores.degenerate() && !cores.coincident() ? Questions{trial.query} : Questions{};
}

Questions itself_among_others(const Trial& trial, const Subject&) {
  Questions questions{trial.query};
  questions.insert(questions.end(), trial.others.begin(), trial.others.end());
  questions.push_back(trial.query);
  return questions;
}

Questions with_others(const Trial& trial, const Subject&) {
  Questions questions{trial.query};
  questions.insert(questions.end(), trial.others.begin(), trial.others.end());
  return questions;
}

Outcome check_answers(const Case& c) {
  const Claim& claim = c.claims[0];
  if (claim.status != Claim::Status::answered) return Outcome::violated(status(claim));
  const auto verdict = oracle::judge(c.queries[0], c.truth(0), claim, c.subject.info.declared);
  if (verdict.status != Claim::Status::answered) return Outcome::violated(verdict.text);
  if (verdict.missing.empty()) return {};
  return Outcome::violated(
      fmt::format("the answer to a hit lacks {}, which the engine declares", fmt::join(verdict.missing.names(), ", ")));
}

Outcome check_survives_bad_input(const Case& c) {
  const Claim::Status s = c.claims[0].status;
  if (s == Claim::Status::crash || s == Claim::Status::timeout || s == Claim::Status::missing)
    return Outcome::violated(status(c.claims[0]));
  return {};
}

Outcome check_refuses_bad_input(const Case& c) {
  const Claim::Status s = c.claims[0].status;
  if (s == Claim::Status::rejected || s == Claim::Status::error) return {};
  const DomainError error = *outside_domain(c.queries[0]);
  return Outcome::violated(
      fmt::format("{} is {}, which {}, and got {}", error.field, text(error.value), error.rule, status(c.claims[0])));
}

Outcome check_repeatable(const Case& c) {
  return same(c, 0, c.claims.size() - 1, fmt::format("with {} questions in between", c.claims.size() - 2));
}

Outcome check_batch(const Case& c) {
  const std::size_t count = c.claims.size() / 2;
  for (std::size_t i = 0; i < count; ++i)
    if (Outcome outcome = same(c, i, count + i, fmt::format("question {} in a batch and alone", i + 1));
        outcome.kind != Outcome::Kind::holds)
      return outcome;
  return {};
}

}  // namespace contact::proptests
