// What two reports differ in: what became better, and what worse.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tool/reports/saved_report.hpp"
#include "tool/reports/table.hpp"

namespace contact::tool {

inline constexpr std::size_t kNamedFailures = 20;  ///< of a kind: the others are counted

struct Change {
  bool worse = false;
  bool better = false;

  void became(bool is_worse, bool is_better) {
    worse = worse || is_worse;
    better = better || is_better;
  }
};

/// A question that fails in one report, or in both and differently.
struct ChangedFailure {
  Failure failure;
  std::optional<std::string> was = std::nullopt;  ///< what it was before, where it failed then too

  [[nodiscard]] std::string text() const;
};

enum class SameBits { not_said, differ, same };

class Comparison {
 public:
  Comparison(const SavedReport& older, const SavedReport& newer);

  [[nodiscard]] bool worse() const { return change_.worse; }
  /// "BETTER", "WORSE", "MIXED" or "NO CHANGE".
  [[nodiscard]] std::string_view word() const;
  /// The same in a sentence.
  [[nodiscard]] std::string sentence() const;
  /// Of the families that both reports judge, by title.
  [[nodiscard]] const std::map<std::string, Change>& families() const { return families_; }
  /// New failures and those that are worse than they were; failures that are gone. By id.
  [[nodiscard]] const std::vector<ChangedFailure>& fresh() const { return fresh_; }
  [[nodiscard]] const std::vector<ChangedFailure>& gone() const { return gone_; }
  /// Whether both reports say what the bits of their answers are, and these are the same.
  [[nodiscard]] SameBits same_bits() const { return same_bits_; }
  /// Families that one report alone judges, a line each.
  [[nodiscard]] const std::vector<std::string>& alone() const { return alone_; }
  /// What else is not compared, and what is to be said of the bits.
  [[nodiscard]] std::vector<std::string> notes() const;
  /// All of it, as `compare` prints it.
  [[nodiscard]] std::string text() const;

 private:
  void compare_bits(const SavedReport& older, const SavedReport& newer);
  void compare_families(const SavedReport& older, const SavedReport& newer);
  void compare_family(const SavedFamily& old, const SavedFamily& now);
  void compare_failures(const SavedReport& older, const SavedReport& newer);

  Table table_;
  std::size_t changed_ = 0;
  std::map<std::string, Change> families_;
  std::vector<ChangedFailure> fresh_;
  std::vector<ChangedFailure> gone_;
  std::vector<std::string> alone_;
  std::vector<std::string> notes_;
  std::vector<std::string> not_listed_;  ///< of reports that do not list all failures
  SameBits same_bits_ = SameBits::not_said;
  Change change_;
};

}  // namespace contact::tool
