// What every command that ends in a report has: the options for its files, writing them, and the exit code.
#include "tool/reports/report_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "tool/run/cluster.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

std::unique_ptr<formats::OutputFile> opened(const std::string& path) {
  return path.empty() ? nullptr : std::make_unique<formats::OutputFile>(path);
}

/// At a terminal that knows colours, unless NO_COLOR says otherwise (https://no-color.org). To processes that mpirun
/// started it gives a terminal of its own, whatever becomes of what they print.
bool wants_colour() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string_view(value == nullptr ? "" : value);
  };
  return Cluster::size() == 1 && ::isatty(STDOUT_FILENO) == 1 && variable("NO_COLOR").empty() &&
         variable("TERM") != "dumb";
}

void write_to(const std::unique_ptr<formats::OutputFile>& file, const std::string& text) {
  if (file == nullptr) return;
  file->write(text);
  file->commit();
}

}  // namespace

void add_report_options(CLI::App& command, ReportOptions& options) {
  command.add_option("--report", options.html, "Write the report as HTML");
  command.add_option("--junit", options.junit, "Write the report as JUnit XML");
  command.add_option("--json", options.json, "Write the report as JSON");
  command.add_option("--markdown", options.markdown, "Write the report as Markdown, for the summary of a CI job");
}

ReportFiles::ReportFiles(const ReportOptions& options)
    : html_path_(options.html),
      html_(opened(options.html)),
      junit_(opened(options.junit)),
      json_(opened(options.json)),
      markdown_(opened(options.markdown)) {}

int ReportFiles::write(const std::vector<Report>& reports, bool scoreboard) {
  const Report& first = reports.front();
  write_to(json_, json_text(first));
  write_to(junit_, junit_text(first));
  write_to(markdown_, markdown_text(first));
  write_to(html_, html_text(reports));
  const bool colour = wants_colour();
  fmt::print("{}", scoreboard ? scoreboard_text(reports, colour) : terminal_text(first, colour));
  if (!html_path_.empty()) fmt::print("\nReport: {}\n", html_path_);
  if (first.judged() == 0)
    throw formats::InputError({"certify", 0}, "", "no case was judged: see what was skipped, and why");
  if (first.harness_invalid()) return kHarnessInvalid;
  return first.certified() ? kCertified : kRefuted;
}

}  // namespace contact::tool
