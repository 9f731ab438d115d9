// What every command that ends in a report has: the options for its files, writing them, and the exit code.
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>
#include <vector>

#include "formats/output_file.hpp"
#include "tool/commands/json_output.hpp"
#include "tool/reports/report.hpp"

namespace contact::tool {

struct ReportOptions {
  std::string html;
  std::string junit;
  std::string json;
  std::string markdown;
};

void add_report_options(CLI::App& command, ReportOptions& options);

/// The files are opened before the work, so that a name that cannot be written is refused at once.
class ReportFiles {
 public:
  explicit ReportFiles(const ReportOptions& options);

  /// Writes the files.
  void write(const std::vector<Report>& reports);
  /// Prints the report of the first engine or the scoreboard of all, and returns the exit code. It comes behind all that
  /// is written: nobody may read it. Throws formats::InputError where no case was judged.
  [[nodiscard]] int print(const std::vector<Report>& reports, bool scoreboard);

 private:
  using File = std::unique_ptr<formats::OutputFile>;

  std::string html_path_;
  File html_;
  File junit_;
  JsonOutput json_;
  File markdown_;
};

}  // namespace contact::tool
