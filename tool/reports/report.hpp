// What a run found: counts and worst cases by family and field, and the verdict.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "engines/engine.hpp"
#include "oracle/diagnosis/diagnosis.hpp"
#include "oracle/judge/judge.hpp"
#include "tool/reports/fitness.hpp"
#include "tool/reports/repeats.hpp"
#include "tool/reports/saved_report.hpp"

namespace contact::tool {

using oracle::Field;
using oracle::Grade;
using oracle::Level;
using oracle::Verdict;

/// The power of two that a number of ulps, not 0, is counted under: floor(log2(ulps)), or at either end of the range
/// what lies beyond it.
inline constexpr int kFarthestPower = 64;
[[nodiscard]] int power_of(double ulps);

/// Where a question lies: how far the spheres are from the alarm distance.
struct MarginBin {
  int side = 0;   ///< -1 hit, 0 exactly at the alarm distance, 1 miss
  int power = 0;  ///< power_of the distance in ulps of the reach; 0 at side 0

  // NOLINTNEXTLINE(modernize-use-nullptr): the 0 is in what the compiler makes
  friend auto operator<=>(const MarginBin&, const MarginBin&) = default;
};

/// How many decisions were claimed, and how many of them are wrong.
struct Decisions {
  std::uint64_t claimed = 0;
  std::uint64_t wrong = 0;
};

/// Questions by their right answer.
struct Sides {
  std::uint64_t hits = 0;
  std::uint64_t misses = 0;

  void add(bool hit) { ++(hit ? hits : misses); }
  void merge(const Sides& other) {
    hits += other.hits;
    misses += other.misses;
  }
  [[nodiscard]] bool both() const { return hits != 0 && misses != 0; }
};

/// The claims of one field: how many reach each grade, and the largest error.
struct FieldCount {
  std::array<std::uint64_t, oracle::kGradeNames.size()> grades{};
  double worst = 0;  ///< ulps of the field's scale
  std::string worst_id;
  /// Those that are neither correctly rounded nor not finite, by the power_of their error; it may be too small for a
  /// double, and counts as the smallest then.
  std::map<int, std::uint64_t> errors;

  [[nodiscard]] std::uint64_t at(Grade grade) const { return grades[static_cast<std::size_t>(grade)]; }
  [[nodiscard]] std::uint64_t judged() const;
  void add(const oracle::FieldVerdict& verdict, const std::string& id);
  void merge(const FieldCount& other);
};

/// The fresh questions of a run on published ones: docs/specification.md#fresh-questions.
struct Fresh {
  std::uint64_t each = 0;  ///< how many of every family that a generator makes; 0: none was asked
  std::uint64_t seed = 0;
  std::vector<std::string> unmade{};  ///< families that no generator makes, and of which none could be asked
  std::string none{};                 ///< why none was asked
};

/// One dataset, or one generated family.
struct FamilyReport {
  std::size_t source = 0;  ///< which source of the run, from 0
  bool fresh = false;      ///< its questions are new, beside those of a dataset
  Pair pair = Pair::sphere_sphere;
  Scalar scalar = Scalar::binary64;
  std::string family;
  std::uint64_t cases = 0;
  std::uint64_t hits = 0;  ///< by the exact answer
  std::uint64_t missed_hits = 0;
  std::uint64_t false_hits = 0;
  Largest farthest_false_hit;               ///< how far from where the answer changes
  std::uint64_t outside_domain = 0;         ///< answers where there is no question
  std::uint64_t refused = 0;                ///< refusals there
  std::uint64_t not_finite = 0;             ///< cases with a field that is not finite where the truth is
  std::uint64_t accepted = 0;               ///< failures that the baseline accepts
  std::array<std::uint64_t, 7> statuses{};  ///< by Claim::Status
  std::array<FieldCount, oracle::kFields.size()> fields;
  Sides decided;                                                   ///< cases with a decision that was judged
  std::array<Sides, 2> decisions;                                  ///< these decisions: overlap, contact
  std::array<Sides, 2> said;                                       ///< what the engine said where these were judged
  Sides askable;                                                   ///< questions, those that it does not serve included
  std::uint64_t with_numbers = 0;                                  ///< cases whose right answer has numbers
  std::uint64_t incomplete = 0;                                    ///< answers to hits that lack a declared field
  std::array<std::uint64_t, kAspectNames.size()> missing{};        ///< these fields
  std::array<std::uint64_t, oracle::kLevelNames.size()> levels{};  ///< cases by the strictest level they reach
  decltype(levels) accepted_levels{};                              ///< those of them that are accepted failures
  std::map<MarginBin, Decisions> margins;                          ///< decisions on spheres
  Fitness fitness;
  Fitness everyday;  ///< the same of questions whose numbers are everyday ones

  [[nodiscard]] std::string title() const;  ///< family_title, or "total"
  [[nodiscard]] FieldCount all_fields() const;
  [[nodiscard]] std::uint64_t with(Claim::Status status) const { return statuses[static_cast<std::size_t>(status)]; }
  /// Cases whose question got no answer, for whatever reason.
  [[nodiscard]] std::uint64_t unanswered() const { return cases - with(Claim::Status::answered); }
  /// Cases that count: all but those left out because the engine may say "unsupported".
  [[nodiscard]] std::uint64_t judged(bool allow_unsupported) const;
  /// The strictest level that all cases reach; `decisions` at best where no number was judged.
  [[nodiscard]] Level level(bool allow_unsupported) const;
  /// The worst level of the cases that count, the accepted failures aside; nothing where none is left.
  [[nodiscard]] std::optional<Level> worst_level(bool allow_unsupported) const;
  /// The level of all cases but the accepted failures.
  [[nodiscard]] Level level_but_accepted(bool allow_unsupported) const;
  /// Whether that is enough: of questions that have no numbers no level asks for more than decisions.
  [[nodiscard]] bool reaches(Level required, bool allow_unsupported) const;
  /// Whether the declared tolerance allows every case but the accepted failures.
  [[nodiscard]] bool none_beyond_tolerance(bool allow_unsupported) const;
  /// The same, and whether there are such cases, and numbers among them where numbers are asked for.
  [[nodiscard]] bool within_tolerance(bool allow_unsupported) const;
  /// The one answer, "hit" or "miss", that would have been right in every decision judged, or "the same".
  [[nodiscard]] std::optional<std::string_view> one_answer() const;
  /// `level`: what the answer reaches. `margin`: of a question whose decisions depend on it.
  void add(const Verdict& verdict, Level level, const std::string& id, bool hit,
           const std::optional<MarginBin>& margin);
  /// The same answer in the question's own units.
  void add_fitness(const Verdict& verdict, const Query& query);
  /// Cases whose overlap, or whose contact, is a miss.
  [[nodiscard]] std::uint64_t could_be_false_hits() const;
  /// A case already added is a failure that the baseline accepts.
  void accept(Level level);
  /// Cases that the run ended before.
  void add_unreached(std::uint64_t count);
  void merge(const FamilyReport& other);
};

/// A case worth showing.
struct WorstCase {
  Query query;
  Scalar scalar;
  Claim claim;
  Verdict verdict;

  [[nodiscard]] std::string what() const;  ///< "missed hit", "normal not finite", "value off by 12.5 ulps"
  /// The worst first.
  enum class Kind { no_answer, missed_hit, false_hit, missing_field, not_finite, number_off };
  [[nodiscard]] Kind kind() const;
  [[nodiscard]] double severity() const;
  /// What the engine should have claimed.
  [[nodiscard]] Claim right(const oracle::Declaration& declared) const;
};

/// Cases that the engine's declaration excludes.
struct Skipped {
  std::string what;
  std::string why;
  std::uint64_t cases;
  std::size_t source = 0;  ///< which source of the run, from 0
  bool fresh = false;
};

/// What a run found, or a part of one. Parts merged in the order of their questions give what the whole run finds, to
/// the last byte, wherever it was cut.
struct Findings {
  std::size_t sources = 0;             ///< datasets and generated families looked at
  std::vector<FamilyReport> families;  ///< one for each source that is not skipped, in their order
  std::vector<Skipped> skipped;        ///< likewise, at most one a source and reason
  std::vector<WorstCase> worst;        ///< at most kWorstOfAKind of each kind, the worst first; none that is accepted
  std::vector<Failure> failures;       ///< the first kMostFailures
  std::uint64_t failure_count = 0;     ///< of all, accepted or not
  std::uint64_t fresh_failures = 0;    ///< those of them on fresh questions
  std::set<std::string> gone;          ///< ids of accepted failures that fail no longer
  std::uint64_t unreached = 0;         ///< cases that the run ended before; counted as missing
  std::string stopped;                 ///< why it ended before them
  oracle::Diagnosis why;               ///< what the wrong answers have in common

  void add(const WorstCase& c);
  void add(Failure failure);
  /// `later`: what was found in questions behind these.
  void merge(const Findings& later);
};

/// A verdict rests on at least so many judged cases, or on half of those given where these are fewer: who tosses a coin
/// decides ten cases right once in a thousand times.
inline constexpr std::uint64_t kLeastJudged = 10;

struct Report : Findings {
  engines::EngineInfo engine;
  Level required = Level::bounded;
  bool allow_unsupported = false;
  std::optional<double> within;               ///< where a false hit may be no farther from the limit: a length
  std::uint64_t least_judged = kLeastJudged;  ///< 0: a verdict may rest on as little as there is
  std::optional<Fresh> fresh;                 ///< nothing where no published question was asked
  std::optional<Accepted> accepted;           ///< what the baseline is, where one is given
  std::optional<Repeats> repeats;             ///< where the engine was asked again
  std::vector<std::string> unknown_answers;   ///< ids of recorded answers to questions that were not asked

  /// Of all questions but the fresh ones.
  [[nodiscard]] FamilyReport total() const;
  [[nodiscard]] FamilyReport fresh_total() const;
  /// Of both.
  [[nodiscard]] FamilyReport all() const;
  [[nodiscard]] std::uint64_t judged() const { return total().judged(allow_unsupported); }
  [[nodiscard]] std::uint64_t fresh_judged() const { return fresh_total().judged(allow_unsupported); }
  [[nodiscard]] std::uint64_t skipped_cases(bool fresh = false) const;
  /// That both reach, accepted failures left out.
  [[nodiscard]] Level level_but_accepted() const;
  /// Every judged answer is as required, and they are enough to certify anything.
  [[nodiscard]] bool certified() const { return right() && falls_short().empty(); }
  /// Every judged answer is as required. Nothing left to judge reaches no level, and is not right.
  [[nodiscard]] bool right() const;
  /// Why right answers are no certificate: too few, or such as say nothing.
  /// docs/specification.md#what-a-verdict-rests-on
  [[nodiscard]] std::vector<std::string> falls_short() const;
  /// "certified", "REFUTED", or "too little".
  [[nodiscard]] std::string_view outcome() const;
  /// What the engine is judged by, where that is no level.
  [[nodiscard]] const std::optional<Tolerance>& tolerance() const { return engine.declared.tolerance; }
  /// The level that an answer reaches: none where it is a false hit farther from the limit than `within`.
  [[nodiscard]] Level level_of(const Verdict& verdict) const;
  /// Whether an answer fails.
  [[nodiscard]] bool fails(const Verdict& verdict) const;
  /// Whether no answer of a family fails, those aside that are accepted or may be unsupported.
  [[nodiscard]] bool none_fails(const FamilyReport& family) const;
  /// Why answers are wrong; nothing where the tolerance allows them all, so that none is.
  [[nodiscard]] std::vector<std::string> diagnosis() const;
  /// From which tolerance on it would pass, and what stands in the way of everyday numbers, else of all.
  [[nodiscard]] std::vector<std::string> fitness() const;
  [[nodiscard]] std::vector<InTheWay> in_the_way() const;
  /// "bounded", or "within length ...".
  [[nodiscard]] std::string demand() const;
  /// The judged pairs of which something is not claimed, and whether these are all that an answer could say it of.
  struct LackingPairs {
    std::vector<std::string_view> pairs;
    bool all = true;
  };
  /// What the engine does not claim, of all that an answer can say: its decisions, and numbers where they are asked
  /// for.
  [[nodiscard]] std::map<Aspect, LackingPairs> not_claimed() const;
  /// The same, whatever the pair.
  [[nodiscard]] Aspects aspects_not_claimed() const;
  /// Whether the engine never gave a well-formed answer that claims something.
  [[nodiscard]] bool harness_invalid() const;
  /// The engine's name and version, fit for a terminal and for XML: no control characters.
  [[nodiscard]] std::string who() const;
  /// The verdict in one sentence, and what it rests on in those behind it.
  [[nodiscard]] std::string sentence() const;
  /// What the verdict rests on: hits, misses, and how many numbers of each field; what is not claimed; and whether one
  /// answer would have been right throughout.
  [[nodiscard]] std::string rests_on() const;
  /// What became of the failures that the baseline accepts, a line each; none without a baseline.
  [[nodiscard]] std::vector<std::string> baseline_lines() const;
  /// Which cases were not judged, and why: those skipped and those not reached, a line each.
  [[nodiscard]] std::vector<std::string> left_out() const;

 private:
  [[nodiscard]] FamilyReport total_of(bool published, bool fresh) const;
  [[nodiscard]] bool fresh_right() const;
  /// Whether of fresh questions no number was judged, and some were called unsupported that may have asked for one. Of
  /// a few fresh questions all may be misses, or such as ask for no number.
  [[nodiscard]] bool withholds_numbers(const FamilyReport& asked) const;
  [[nodiscard]] bool meets(const FamilyReport& family) const;
  [[nodiscard]] std::vector<std::string> reasons(const FamilyReport& family) const;
};

inline constexpr std::size_t kWorstOfAKind = 2;
inline constexpr std::size_t kMostFailures = 100'000;  // that a report lists: some 45 MB

/// The reports in their forms.
/// `colour`: with the codes that a terminal knows.
[[nodiscard]] std::string terminal_text(const Report& report, bool colour);
[[nodiscard]] std::string scoreboard_text(const std::vector<Report>& reports, bool colour);
/// `failures`: whether they are listed.
[[nodiscard]] std::string json_text(const Report& report, bool failures = true);
[[nodiscard]] std::string junit_text(const Report& report);
[[nodiscard]] std::string markdown_text(const Report& report);
[[nodiscard]] std::string html_text(const std::vector<Report>& reports);

}  // namespace contact::tool
