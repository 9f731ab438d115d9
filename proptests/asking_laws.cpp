// Whether and how an engine answers: always, the same again, alone or in a batch, and bad input refused.
#include <fmt/format.h>

#include "golden/results.hpp"
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
  const std::string x = golden::claim_text(c.claims[i]);
  const std::string y = golden::claim_text(c.claims[j]);
  if (x == y) return {};
  return Outcome::violated(
      fmt::format("the same question got two answers, {}: {{{}}} and {{{}}}", how, x.substr(1), y.substr(1)));
}

}  // namespace

Questions itself(const Trial& trial, const Subject&) { return {trial.query}; }

Questions itself_if_bad(const Trial& trial, const Subject&) {
  return outside_domain(trial.query) ? Questions{trial.query} : Questions{};
}

Questions itself_if_coincident(const Trial& trial, const Subject&) {
  const Balls& balls = *trial.query.balls();
  return balls.a.center == balls.b.center ? Questions{trial.query} : Questions{};
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
  if (!claim.overlap && !claim.speaks_of_contact) return Outcome::violated("the answer makes no claim");
  return {};
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
