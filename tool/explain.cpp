// explain: questions from a file or from a person, and the exact answer to each.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <memory>
#include <optional>

#include "golden/dataset.hpp"
#include "tool/commands.hpp"
#include "tool/explanation.hpp"
#include "tool/pipeline.hpp"
#include "tool/process.hpp"

namespace contact::tool {
namespace {

void explain(const std::string& input, bool json) {
  InputLines lines(input);
  std::optional<golden::DatasetHeader> header;
  bool any = false;
  while (lines.next()) {
    const auto parsed = golden::parse_object(lines.text(), lines.where());
    const golden::Node node(parsed, lines.where());
    if (node.find("format")) {  // a whole dataset: its header tells pair and scalar
      header = golden::read_header(node);
      continue;
    }
    const auto [query, scalar] = golden::read_query(node, header ? &*header : nullptr);
    const oracle::Truth truth = oracle::truth_of(query);
    require_agreement(query, truth, oracle::interval_answer(query, scalar), scalar);
    if (json) {
      fmt::print("{}\n", golden::answer_line(golden::make_case(query, scalar)));
      any = true;
      continue;
    }
    fmt::print("{}{}", any ? "\n" : "", explanation(query, truth, scalar));
    any = true;
  }
  if (!any) throw golden::InputError(lines.where(), "", "no question given: expected JSON lines");
}

}  // namespace

void add_explain(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("explain", "The exact answer to questions (JSON lines), in words and numbers");
  auto input = std::make_shared<std::string>("-");
  auto json = std::make_shared<bool>(false);
  command->add_option("file", *input, "The questions, or - for standard input")->capture_default_str();
  command->add_flag("--json", *json, "One {\"id\",\"expect\",\"exact\"} line a question");
  command->callback([input, json, &exit] {
    explain(*input, *json);
    exit = kCertified;
  });
}

}  // namespace contact::tool
