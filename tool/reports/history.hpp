// Several reports in the order given, each against the one before it: of the versions of an engine, or of several
// engines.
#pragma once

#include <string>
#include <vector>

#include "tool/reports/comparison.hpp"
#include "tool/reports/saved_report.hpp"

namespace contact::tool {

class History {
 public:
  /// Two reports or more.
  explicit History(std::vector<SavedReport> reports);

  /// The first step leads from the first report to the second.
  [[nodiscard]] const std::vector<Comparison>& steps() const { return steps_; }
  /// Whether in each step both reports say what the bits of their answers are, and these are the same.
  [[nodiscard]] bool same_bits() const;
  /// For the terminal: a line a report, and what was not compared.
  [[nodiscard]] std::string text() const;
  /// For a browser.
  [[nodiscard]] std::string html() const;

 private:
  /// A row for each report.
  [[nodiscard]] Table table() const;
  /// What the table means, and what does not compare.
  [[nodiscard]] std::vector<std::string> notes() const;
  [[nodiscard]] std::string families_html() const;
  [[nodiscard]] std::string steps_html() const;

  std::vector<SavedReport> reports_;
  std::vector<std::string> labels_;
  std::vector<Comparison> steps_;
};

}  // namespace contact::tool
