// What every command that ends in a report has: the options for its files, writing them, and the exit code.
#include "tool/reports/report_files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "tool/commands/commands.hpp"
#include "tool/run/cluster.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

std::unique_ptr<formats::OutputFile> opened(const std::string& path) {
  return path.empty() ? nullptr : std::make_unique<formats::OutputFile>(path);
}

/// Where --color does not say: at a terminal that knows colours, unless NO_COLOR says otherwise (https://no-color.org).
/// To processes that mpirun started it gives a terminal of its own, whatever becomes of what they print.
bool wants_colour() {
  if (chosen_colour() != Colour::automatic) return chosen_colour() == Colour::always;
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
  const Heading heading(command, "Reports");
  command.add_option("--report", options.html, "Write the report as a page, HTML")->type_name("FILE");
  add_json_option(command, options.json, "The report as JSON", FileOfJson::behind_space_too);
  command.add_option("--junit", options.junit, "Write the report as JUnit XML")->type_name("FILE");
  command.add_option("--markdown", options.markdown, "Write the report as Markdown, for the summary of a CI job")
      ->type_name("FILE");
}

ReportFiles::ReportFiles(const ReportOptions& options)
    : html_path_(options.html),
      html_(opened(options.html)),
      junit_(opened(options.junit)),
      json_(options.json),
      markdown_(opened(options.markdown)) {}

void ReportFiles::write(const std::vector<Report>& reports) {
  const Report& first = reports.front();
  write_to(junit_, junit_text(first));
  write_to(markdown_, markdown_text(first));
  write_to(html_, html_text(reports));
  if (json_.alone()) return;
  json_.write(json_text(first));
  json_.commit();
}

int ReportFiles::print(const std::vector<Report>& reports, bool scoreboard) {
  const Report& first = reports.front();
  if (json_.alone()) json_.write(json_text(first));
  const bool colour = wants_colour();
  if (colour) let_colours_through();
  if (!json_.alone()) words() << (scoreboard ? scoreboard_text(reports, colour) : terminal_text(first, colour));
  if (!html_path_.empty()) say("\nReport: {}\n", html_path_);
  if (first.judged() == 0)
    throw formats::InputError({first.engine.name, 0}, "", "no case was judged: see what was skipped, and why");
  if (first.harness_invalid()) return kHarnessInvalid;
  return first.certified() ? kCertified : kRefuted;
}

}  // namespace contact::tool
