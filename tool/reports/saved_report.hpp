// What an earlier run left in its --json report: failures to accept, and numbers to compare with.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "formats/visible.hpp"
#include "oracle/judge/judge.hpp"

namespace contact::tool {

/// A case below the required level, as reports list it.
struct Failure {
  std::string id;
  Pair pair;
  Scalar scalar;  ///< of the questions
  std::string family;
  oracle::Level level;  ///< that its answer does reach
  std::string what;
  bool accepted = false;
  std::string reason{};                          ///< why it may be accepted, where the report says so
  std::string expires{};                         ///< the last day on which it may be, YYYY-MM-DD; empty: none was named
  std::optional<Query> question = std::nullopt;  ///< what was asked; reports of older versions do not say
  bool fresh = false;                            ///< of a fresh question
};

/// pair/family, with .f32 for questions in binary32.
[[nodiscard]] std::string family_title(Pair pair, std::string_view family, Scalar scalar);

/// What a report says that everyday numbers need of a tolerance.
struct SavedFitness {
  std::uint64_t answers;
  std::uint64_t never;  ///< answers that no tolerance allows
  std::array<double, oracle::kMeasures.size()> needs;
};

struct SavedFamily {
  /// family_title, with a number behind it from the second of a title on; empty for all of them together. A run may
  /// have several sources of one pair, family and scalar, and the k-th of one report is compared with the k-th of another.
  std::string title;
  std::uint64_t cases;
  std::uint64_t missed_hits;
  std::uint64_t false_hits;
  std::uint64_t not_finite;
  std::uint64_t unanswered;  ///< for whatever reason
  std::uint64_t fields;
  std::uint64_t correctly_rounded;
  std::uint64_t beyond_bound;
  oracle::Level level;
  std::optional<SavedFitness> everyday = std::nullopt;  ///< reports of older versions do not say

  /// "99.50 %" of the numbers; "-" where there are none.
  [[nodiscard]] std::string share_rounded() const;
};

/// The answers to the questions of a family, where the report says what their bits are.
struct SavedAnswers {
  std::string title;  ///< as a family's
  std::string sha256;
  std::string each;  ///< an id and 8 digits of the answer's digest for each
};

/// The fresh questions of a run: how many of each family, and their seed.
struct AskedFresh {
  std::uint64_t each;
  std::uint64_t seed;

  friend bool operator==(const AskedFresh&, const AskedFresh&) = default;
};

struct SavedReport {
  std::filesystem::path path;
  std::string engine;  ///< its name
  std::string version;
  oracle::Level required;
  std::string verdict;  ///< the sentence
  std::vector<SavedFamily> families;
  std::vector<Failure> failures;  ///< on published questions
  std::uint64_t failure_count;    ///< more than are listed, perhaps
  std::vector<SavedAnswers> answers{};
  SavedFamily total{};
  std::optional<Tolerance> tolerance = std::nullopt;  ///< what it was judged by instead of the required level
  std::optional<double> within = std::nullopt;        ///< how far a false hit might be, where that was said
  std::optional<AskedFresh> fresh = std::nullopt;     ///< where any were asked
  std::vector<Failure> fresh_failures{};              ///< on those
  std::uint64_t fresh_failure_count = 0;

  /// Its name and its version.
  [[nodiscard]] std::string who() const { return engine + " " + version; }
  [[nodiscard]] std::string file() const { return formats::visible(path.string()); }
  /// What the verdict says first: "REFUTED", "CERTIFIED but for 3 failures".
  [[nodiscard]] std::string_view outcome() const { return std::string_view(verdict).substr(0, verdict.find(':')); }
  /// What it was judged by: a level, or a tolerance.
  [[nodiscard]] std::string demand() const;
};

/// Reads a report that `certify --json` wrote. Throws formats::InputError with file and field.
[[nodiscard]] SavedReport read_report(const std::filesystem::path& path);

/// What a report says of its baseline.
struct Accepted {
  std::string path;
  std::uint64_t failures;
};

/// Why a failure is accepted, how bad it may be, and until when.
struct Acceptance {
  oracle::Level level;  ///< the worst that its answer may reach
  std::string reason;
  std::string expires;
};

/// Failures that a run may have again, by question.
class Baseline {
 public:
  /// The failures whose acceptance has not expired on the day `today`. Throws formats::InputError where the report does
  /// not list all failures.
  Baseline(const SavedReport& report, const std::string& today);

  [[nodiscard]] const std::string& engine() const { return engine_; }
  [[nodiscard]] Accepted accepted() const { return {path_, accepted_.size()}; }
  [[nodiscard]] bool lists(const std::string& id) const { return accepted_.contains(id); }
  /// Whether a question may be answered no better than `level`: it was answered no better then.
  [[nodiscard]] bool accepts(const std::string& id, oracle::Level level) const;
  /// Of a question that is listed.
  [[nodiscard]] const Acceptance& acceptance(const std::string& id) const { return accepted_.at(id); }
  /// A listed failure without a reason or a last day; nothing where all have both.
  [[nodiscard]] std::optional<std::string> unexplained() const;
  /// The failures whose acceptance has expired, a line each.
  [[nodiscard]] const std::vector<std::string>& expired() const { return expired_; }

 private:
  std::string path_;
  std::string engine_;
  std::unordered_map<std::string, Acceptance> accepted_;
  std::vector<std::string> expired_;
};

}  // namespace contact::tool
