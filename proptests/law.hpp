// Laws: what must be true of any engine's answers, each a plain declaration. The one list is in laws.cpp.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engines/protocol/results.hpp"
#include "oracle/truth/truth.hpp"
#include "proptests/trial.hpp"

namespace contact::proptests {

/// The engine that laws are asked of, as it declares itself for one pair, and what it is held to.
struct Subject {
  engines::EngineInfo info;
  Pair pair;
  bool correctly_rounded;   ///< held to correct rounding, else to its tolerance, or its declared bounds
  std::vector<Pair> alike;  ///< the pairs that it serves, and whose answers mean the same: this one too
  Range range;              ///< the numbers that it claims to serve

  Subject(const engines::EngineInfo& engine, Pair of, bool held_to_correct_rounding);
  /// The bound of a field that an answer is held to, in ulps of the field's scale; 1 where held to correct rounding.
  [[nodiscard]] double bound(oracle::Field field) const;
  /// What it is held to in the place of the bounds, if anything.
  [[nodiscard]] const std::optional<Tolerance>& tolerance() const { return info.declared.tolerance; }
  /// Whether the engine declares an aspect.
  [[nodiscard]] bool claims(Aspect aspect) const { return info.declared.claimed().has(aspect); }
  [[nodiscard]] bool claims(oracle::Field field) const { return claims(aspect(field)); }
  [[nodiscard]] bool serves_alike(Pair other) const {
    return std::find(alike.begin(), alike.end(), other) != alike.end();
  }
};

/// One trial of a law: the questions asked and what the engine said.
class Case {
 public:
  using TruthOf = std::function<oracle::Truth(const Query&)>;
  Case(const Subject& engine, const Trial& tried, std::vector<Query> asked, std::vector<Claim> said,
       const TruthOf& truth)
      : subject(engine),
        trial(tried),
        queries(std::move(asked)),
        claims(std::move(said)),
        truth_of_(truth),
        truths_(queries.size()) {}

  /// What is true of question i. Domain: the question is inside the domain.
  [[nodiscard]] const oracle::Truth& truth(std::size_t i) const {
    if (!truths_[i]) truths_[i] = truth_of_(queries[i]);
    return *truths_[i];
  }
  [[nodiscard]] const ContactClaim* contact(std::size_t i) const {
    return claims[i].contact ? &*claims[i].contact : nullptr;
  }

  const Subject& subject;
  const Trial& trial;
  std::vector<Query> queries;
  std::vector<Claim> claims;

 private:
  const TruthOf& truth_of_;
  mutable std::vector<std::optional<oracle::Truth>> truths_;
};

/// What a trial says of a law. A vacuous one does not count as tested.
struct Outcome {
  enum class Kind { holds, vacuous, violated };
  Kind kind = Kind::holds;
  std::string text;  ///< what is wrong

  [[nodiscard]] static Outcome vacuous() { return {Kind::vacuous, ""}; }
  [[nodiscard]] static Outcome violated(std::string why) { return {Kind::violated, std::move(why)}; }
};

enum class Exactness { bits, reals };
inline constexpr std::array<std::string_view, 2> kExactnessNames{"bit for bit", "exact reals"};

/// How an engine is asked.
enum class Asking {
  together,                 ///< all questions in one batch; an answer that is none makes the trial vacuous
  together_and_one_by_one,  ///< in one batch and then alone, from the last to the first: twice as many claims
  whatever_comes            ///< in one batch; the law judges crashes, errors and refusals itself
};

/// The pairs that a law is asked of.
struct About {
  std::string_view pairs;  ///< in words: "a pair of ..."
  bool (*includes)(Pair pair);
};

struct Law {
  std::string_view name;
  std::string_view sentence;
  std::string_view formula;
  std::string_view reason;
  Exactness exactness;
  About about;
  bool only_when_named;
  Asking asking;
  /// Why the law is not asked of an engine about a pair, or nothing: by what the engine declares it has nothing to ask.
  std::optional<std::string> (*skip)(const Subject& subject);
  rc::Gen<Query> (*draw)(Pair pair, const Range& range);
  /// The questions to ask; none where the trial does not suit the law.
  std::vector<Query> (*questions)(const Trial& trial, const Subject& subject);
  Outcome (*check)(const Case& c);
  /// More questions, made of the answer to the first; none where it does not suit the law.
  std::vector<Query> (*next)(const Trial& trial, const Subject& subject, const Claim& claim) = nullptr;
};

/// Every law. Where several are violated, the earlier one names the mistake better.
[[nodiscard]] std::span<const Law> laws();
[[nodiscard]] const Law* find_law(std::string_view name);
/// The table of docs/properties.md, which a test compares with this.
[[nodiscard]] std::string law_table();

}  // namespace contact::proptests
