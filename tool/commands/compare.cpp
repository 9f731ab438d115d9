// compare: what became better or worse between two reports, or from each of several to the next.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <optional>

#include "formats/output_file.hpp"
#include "tool/commands/commands.hpp"
#include "tool/reports/history.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

struct CompareOptions {
  std::string older;
  std::string newer;
  std::vector<std::string> more;
  std::string page;
  bool same_bits = false;
};

int compare_reports(const CompareOptions& options) {
  std::vector<std::string> paths{options.older, options.newer};
  paths.insert(paths.end(), options.more.begin(), options.more.end());
  std::optional<formats::OutputFile> page;
  if (!options.page.empty()) {
    require_apart({options.page}, paths);
    page.emplace(options.page);
  }
  std::vector<SavedReport> reports;
  for (const std::string& path : paths) {
    throw_if_interrupted();
    reports.push_back(read_report(path));
  }
  if (reports.size() == 2) say("old  {}\nnew  {}\n\n", reports.front().verdict, reports.back().verdict);
  const History history(std::move(reports));
  if (page) {
    page->write(history.html());
    page->commit();
  }
  words() << (history.steps().size() == 1 ? history.steps().front().text() : history.text());
  const bool other_bits = options.same_bits && !history.same_bits();
  if (other_bits) say("REFUTED: --same-bits asks for the same bits, and the reports do not show them.\n");
  if (page) say("\nReport: {}\n", options.page);
  return history.steps().back().worse() || other_bits ? kRefuted : kCertified;
}

}  // namespace

void add_compare(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("compare",
                                     "What became better or worse between reports of certify\n"
                                     "They are what certify --json writes, and each is held against the one before it. "
                                     "Exit 1 where anything became worse in the last step.");
  auto options = std::make_shared<CompareOptions>();
  command->add_option("old", options->older, "The earlier report")->required();
  command->add_option("new", options->newer, "The later report")->required();
  command->add_option("more", options->more, "Later ones still, in their order");
  command->add_option("--report", options->page, "Write a page of all of them, HTML")->type_name("FILE");
  command->add_flag(
      "--same-bits", options->same_bits,
      "Exit 1 too where the reports do not show the same bits in every answer: all of certify --determinism");
  command->callback([options, &exit] { exit = compare_reports(*options); });
}

}  // namespace contact::tool
