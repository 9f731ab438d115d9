// Asks an engine every law: draws trials, judges them, and shrinks what violates a law.
//
// RapidCheck draws the trials and says what is smaller. Its own runner (checkTestable) would serve for the rest, but
// for three things: it shrinks without a limit on tries or time, where a try at an engine that hangs takes seconds; it
// knows no engine that has to be started anew between tries; and it does not tell which class of failure a try must
// repeat.
#include "proptests/run.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "golden/query_id.hpp"
#include "oracle/judge/right_claim.hpp"
#include "proptests/law_functions.hpp"

namespace contact::proptests {
namespace {

// Shrinking ends after so many trials, or so long where the engine does not even answer.
constexpr std::uint64_t kShrinkTries = 2000;
constexpr std::chrono::seconds kShrinkTime{20};
constexpr int kRedraws = 50;                // for a question within the engine's range
constexpr std::uint64_t kMostVacuous = 30;  // trials for each case, before a law is given up
constexpr int kMostRestarts = 100;          // of a dead engine
constexpr std::uint64_t kSpareCases = 2;    // right answers may differ where more than one is right

class Runner {
 public:
  Runner(std::unique_ptr<engines::Engine>& engine, const RunOptions& options) : engine_(engine), options_(options) {
    result_.engine = engine->info();
    result_.engine.declared.tolerance = options.tolerance;
    for (const Pair pair : kPairs) subjects_.emplace_back(result_.engine, pair, options.correctly_rounded);
  }

  RunResult run() {
    for (const Law& law : laws()) {
      const bool named = std::find(options_.names.begin(), options_.names.end(), law.name) != options_.names.end();
      if (!options_.names.empty() && !named) continue;
      LawResult result{&law, 0, std::nullopt, std::nullopt, false};
      if (law.only_when_named && !named)
        result.skipped = "asked only when named: --law " + std::string(law.name);
      else
        ask(law, result);
      result_.laws.push_back(std::move(result));
    }
    return std::move(result_);
  }

 private:
  void ask(const Law& law, LawResult& result) {
    std::vector<Pair> pairs;
    for (const Pair pair : kPairs)
      if (law.about.includes(pair) && result_.engine.serves(pair)) pairs.push_back(pair);
    if (pairs.empty()) {
      result.skipped = "the engine serves no pair of " + std::string(law.about.pairs);
      return;
    }
    std::optional<std::string> skipped;
    std::erase_if(pairs, [&](Pair pair) {
      const auto why = law.skip(subject(pair));
      if (why) skipped = why;
      return why.has_value();
    });
    if (pairs.empty()) {
      result.skipped = skipped;
      return;
    }

    std::vector<rc::Gen<Trial>> gens;
    gens.reserve(pairs.size());
    for (const Pair pair : pairs) gens.push_back(trials(law, pair));
    rc::Random random(law_seed(law));
    for (std::uint64_t drawn = 0; result.tested < options_.cases; ++drawn) {
      if (!may_draw(drawn)) {
        result.given_up = would_suit_more(law, gens, result.tested);
        if (!result.given_up && result.tested == 0) result.skipped = "no question that the engine serves suits it";
        return;
      }
      const auto trial = draw(law, gens[drawn % gens.size()], random);
      if (!trial) continue;
      if (options_.after_case) options_.after_case();
      Violation violation{*trial, {}, {}, "", 0};
      const Outcome outcome = test(law, *trial, violation, Answers::counted);
      if (outcome.kind == Outcome::Kind::vacuous) continue;
      ++result.tested;
      if (outcome.kind == Outcome::Kind::holds) continue;
      result.violation = shrunk(law, std::move(violation));
      return;
    }
  }

  /// Whether a law is not yet given up after so many trials. The product of cases and trials might not fit.
  [[nodiscard]] bool may_draw(std::uint64_t drawn) const { return drawn / kMostVacuous < options_.cases; }

  /// Whether many more of the same trials would have suited a law if the engine had answered rightly. If not, the
  /// engine serves too few questions of this kind, and that is no fault of its answers.
  bool would_suit_more(const Law& law, const std::vector<rc::Gen<Trial>>& gens, std::uint64_t tested) {
    rc::Random random(law_seed(law));
    const std::uint64_t most = 2 * tested + kSpareCases;
    std::uint64_t suited = 0;
    for (std::uint64_t drawn = 0; may_draw(drawn) && suited <= most; ++drawn) {
      const auto trial = draw(law, gens[drawn % gens.size()], random);
      if (!trial) continue;
      if (options_.after_case) options_.after_case();
      Violation unused{*trial, {}, {}, "", 0};
      suited += test(law, *trial, unused, Answers::right).kind == Outcome::Kind::vacuous ? 0 : 1;
    }
    return suited > most;
  }

  /// The engine as it declares itself for a pair.
  [[nodiscard]] const Subject& subject(Pair pair) const { return subjects_[static_cast<std::size_t>(pair)]; }

  /// Each law draws for itself, so that a law alone repeats what it did among all.
  [[nodiscard]] std::uint64_t law_seed(const Law& law) const {
    std::uint64_t hash = 0xcbf29ce484222325U ^ options_.seed;
    for (const char c : law.name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
    return hash;
  }

  [[nodiscard]] rc::Gen<Trial> trials(const Law& law, Pair pair) const {
    const Range& range = subject(pair).range;
    const bool others = law.questions == itself_among_others || law.questions == with_others;
    const auto other =
        others ? rc::gen::container<std::vector<Query>>(3, queries(pair, range)) : rc::gen::just(std::vector<Query>{});
    return rc::gen::map(rc::gen::tuple(law.draw(pair, range), changes(range), other),
                        [](const std::tuple<Query, Change, std::vector<Query>>& parts) {
                          const auto& [query, change, with] = parts;
                          return Trial{query, change, with};
                        });
  }

  /// Whether the engine claims to serve a question.
  [[nodiscard]] bool suits(const Query& query) const {
    const Subject& of_pair = subject(query.pair);
    return of_pair.range.contains(query) && !oracle::not_served(query, of_pair.info.declared);
  }

  std::optional<Trial> draw(const Law& law, const rc::Gen<Trial>& gen, rc::Random& random) const {
    for (int i = 0; i < kRedraws; ++i) {
      const rc::Random here = random.split();
      Trial trial = gen(here, rc::kNominalSize).value();
      if (law.questions == itself_if_bad) return trial;
      std::erase_if(trial.others, [&](const Query& q) { return !suits(q); });
      if (suits(trial.query)) return trial;
    }
    return std::nullopt;
  }

  std::vector<Claim> answers(const std::vector<Query>& queries) {
    std::vector<engines::Question> questions;
    questions.reserve(queries.size());
    for (const Query& query : queries) questions.push_back({golden::query_id(query), query});
    std::vector<Claim> claims = engine_->answer(questions);
    const auto keep_declared = [&] {
      if (result_.engine.declared.claims)
        for (Claim& claim : claims) claim.keep(*result_.engine.declared.claims);
    };
    keep_declared();
    const bool dead =
        std::any_of(claims.begin(), claims.end(), [](const Claim& c) { return c.status == Claim::Status::missing; });
    if (dead && options_.restart && restarts_++ < kMostRestarts) {
      engine_ = options_.restart();
      claims = engine_->answer(questions);
      keep_declared();
    }
    for (const Claim& claim : claims)
      result_.ever_answered = result_.ever_answered ||
                              (claim.status == Claim::Status::answered && (claim.overlap || claim.speaks_of_contact));
    return claims;
  }

  /// Whose answers a law is tested on, and whether the questions count.
  enum class Answers { counted, uncounted, right };

  /// What a right engine with this declaration says.
  [[nodiscard]] std::vector<Claim> right_answers(const std::vector<Query>& queries) const {
    std::vector<Claim> claims;
    claims.reserve(queries.size());
    for (const Query& query : queries) {
      const oracle::Declaration& declared = subject(query.pair).info.declared;
      if (outside_domain(query)) {
        claims.emplace_back().status = Claim::Status::rejected;
        continue;
      }
      claims.push_back(oracle::right_claim(query, options_.truth(query), declared));
      claims.back().keep(declared.claimed());
    }
    return claims;
  }

  /// Whether the tolerance allows every answer as it is, so that it forgives whatever they have to do with each other.
  [[nodiscard]] bool within_tolerance(const Case& c) const {
    for (std::size_t i = 0; i < c.queries.size(); ++i)
      if (!oracle::judge(c.queries[i], c.truth(i), c.claims[i], subject(c.queries[i].pair).info.declared).within())
        return false;
    return true;
  }

  Outcome test(const Law& law, const Trial& trial, Violation& violation, Answers whose) {
    const Subject& of_pair = subject(trial.query.pair);
    std::vector<Query> asked = law.questions(trial, of_pair);
    const bool bad = law.questions == itself_if_bad;
    if (asked.empty() || (!bad && !std::all_of(asked.begin(), asked.end(), [&](const Query& q) { return suits(q); })))
      return Outcome::vacuous();
    std::vector<Claim> said = whose == Answers::right ? right_answers(asked) : answers(asked);
    if (law.asking == Asking::together_and_one_by_one) {
      std::vector<Claim> alone = said;
      for (std::size_t i = asked.size(); whose != Answers::right && i-- > 0;) alone[i] = answers({asked[i]}).front();
      said.insert(said.end(), alone.begin(), alone.end());
    }
    if (law.next != nullptr) {
      if (said.front().status != Claim::Status::answered) return Outcome::vacuous();
      const std::vector<Query> next = law.next(trial, of_pair, said.front());
      if (next.empty() || !std::all_of(next.begin(), next.end(), [&](const Query& q) { return suits(q); }))
        return Outcome::vacuous();
      const std::vector<Claim> of_next = whose == Answers::right ? right_answers(next) : answers(next);
      asked.insert(asked.end(), next.begin(), next.end());
      said.insert(said.end(), of_next.begin(), of_next.end());
    }
    if (law.asking != Asking::whatever_comes &&
        std::any_of(said.begin(), said.end(), [](const Claim& c) { return c.status != Claim::Status::answered; }))
      return Outcome::vacuous();
    const Case c(of_pair, trial, std::move(asked), std::move(said), options_.truth);
    Outcome outcome = law.check(c);
    // Whether and how often alike an engine answers is no question of a tolerance.
    const bool is_of_answers = law.asking == Asking::together && law.check != check_repeatable;
    if (outcome.kind == Outcome::Kind::violated && of_pair.tolerance() && is_of_answers && within_tolerance(c))
      outcome = {};
    if (whose == Answers::counted && !bad && outcome.kind != Outcome::Kind::vacuous) count(c);
    if (outcome.kind == Outcome::Kind::violated)
      violation = {trial, c.queries, c.claims, outcome.text, violation.tries};
    return outcome;
  }

  Violation shrunk(const Law& law, Violation violation) {
    const Claim::Status status = violation.claims.front().status;
    // An engine that hangs or has to be started anew takes seconds a try. Where it answers, only the tries are counted,
    // so that the same seed shrinks to the same question on every machine.
    const auto end = status == Claim::Status::answered ? std::chrono::steady_clock::time_point::max()
                                                       : std::chrono::steady_clock::now() + kShrinkTime;
    auto here = shrinkable(violation.trial, subject(violation.trial.query.pair).range);
    for (bool easier = true; easier;) {
      easier = false;
      auto next = here.shrinks();
      while (auto candidate = next.next()) {
        if (++violation.tries > kShrinkTries || std::chrono::steady_clock::now() > end) return violation;
        if (options_.after_case) options_.after_case();
        Violation found = violation;
        // A crash shrinks to a crash; an engine that counts as dead says nothing about the question.
        if (test(law, candidate->value(), found, Answers::uncounted).kind != Outcome::Kind::violated ||
            found.claims.front().status != status || status == Claim::Status::missing)
          continue;
        violation = std::move(found);
        here = *candidate;
        easier = true;
        break;
      }
    }
    return violation;
  }

  void count(const Case& c) {
    const oracle::Truth& truth = c.truth(0);
    const Scalar scalar = result_.engine.declared.scalar;
    const double normal = std::ldexp(1.0, format_of(scalar).min_exponent);
    const double top = std::ldexp(1.0, format_of(scalar).max_exponent - 23);
    bool is_subnormal = false;
    bool is_huge = false;
    for_each_number(c.queries[0], [&](const std::string&, double x) {
      is_subnormal = is_subnormal || (x != 0 && std::abs(x) < normal);
      is_huge = is_huge || std::abs(x) > top;
    });
    const auto add = [&](Class kind, bool holds) {
      result_.shares.counts[static_cast<std::size_t>(kind)] += holds ? 1 : 0;
    };
    ++result_.shares.questions;
    add(Class::hit, truth.hit());
    add(Class::exact_edge, truth.at_alarm == oracle::Side::at);
    add(Class::near_edge, truth.has_distance() && truth.at_alarm != oracle::Side::at &&
                              std::abs(oracle::witness(truth, scalar).margin_ulps) <= 4);
    add(Class::coincident, truth.degenerate());
    add(Class::subnormal, is_subnormal);
    add(Class::huge, is_huge);
    bool is_flat = false;
    for_each_shape(c.queries[0], [&]<class Shape>(const Shape& shape) {
      if constexpr (std::same_as<Shape, Box>) is_flat = is_flat || (shape.min.array() == shape.max.array()).any();
      if constexpr (std::same_as<Shape, Obb>) is_flat = is_flat || (shape.extents.array() == 0).any();
    });
    add(Class::flat, is_flat);
  }

  std::unique_ptr<engines::Engine>& engine_;
  const RunOptions& options_;
  std::vector<Subject> subjects_;  ///< one a pair
  RunResult result_;
  int restarts_ = 0;
};

}  // namespace

const LawResult* RunResult::first_violated() const {
  const auto it = std::find_if(laws.begin(), laws.end(), [](const LawResult& r) { return r.violation.has_value(); });
  return it == laws.end() ? nullptr : &*it;
}

std::size_t RunResult::skipped() const {
  return static_cast<std::size_t>(
      std::count_if(laws.begin(), laws.end(), [](const LawResult& r) { return r.skipped.has_value(); }));
}

bool RunResult::holds() const {
  return std::any_of(laws.begin(), laws.end(), [](const LawResult& r) { return r.holds(); }) &&
         std::all_of(laws.begin(), laws.end(), [](const LawResult& r) { return r.holds() || r.skipped; });
}

RunResult run_laws(std::unique_ptr<engines::Engine>& engine, const RunOptions& options) {
  return Runner(engine, options).run();
}

}  // namespace contact::proptests
