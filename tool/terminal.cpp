// The report for a person at a terminal: the table by family, the worst cases, the verdict; and the scoreboard.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "golden/dataset.hpp"
#include "tool/report.hpp"
#include "tool/table.hpp"

namespace contact::tool {
namespace {

std::string cell(std::uint64_t n) { return n == 0 ? "." : std::to_string(n); }

}  // namespace

std::string terminal_text(const Report& report) {
  Table table;
  table.row({"family", "cases", "hits", "missed", "false", "no answer", "not finite", "correctly rounded", "faithful",
             "bounded", "beyond", "worst (ulps)", "its id"});
  const auto add = [&](const FamilyReport& f) {
    const FieldCount all = f.all_fields();
    table.row({f.title(), cell(f.cases), cell(f.hits), cell(f.missed_hits), cell(f.false_hits), cell(f.unanswered()),
               cell(f.not_finite), cell(all.at(Grade::correctly_rounded)), cell(all.at(Grade::faithful)),
               cell(all.at(Grade::bounded)), cell(all.at(Grade::beyond_bound)),
               all.worst_id.empty() ? "" : fmt::format("{:.3g}", all.worst), all.worst_id});
  };
  for (const FamilyReport& f : report.families) add(f);
  if (report.families.size() > 1) add(report.total());

  std::string text = fmt::format("{} ({}), required: {}\n\n", report.who(), name(report.engine.declared.scalar),
                                 name(report.required));
  text += table.text();
  text +=
      "\nThe columns from 'correctly rounded' to 'beyond' count fields: normal, point1, point2 and value of every "
      "contact.\n";
  const FamilyReport all = report.total();
  std::string levels;
  for (const Field field : oracle::kFields) {
    const FieldCount& c = all.fields[static_cast<std::size_t>(field)];
    if (c.judged() != 0)
      levels +=
          fmt::format("  {} {:.4g} %", name(field),
                      100.0 * static_cast<double>(c.at(Grade::correctly_rounded)) / static_cast<double>(c.judged()));
  }
  if (!levels.empty()) text += "Correctly rounded by field:" + levels + "\n";
  const auto listed = [&](std::string_view title, const std::vector<std::string>& lines) {
    if (!lines.empty()) text += fmt::format("\n{}:\n  {}\n", title, fmt::join(lines, "\n  "));
  };
  listed("Not judged", report.left_out());
  if (!report.certified() && !report.worst.empty()) {
    text += "\nThe worst cases, as lines for `contact-oracle explain`:\n";
    for (const WorstCase& w : report.worst)
      text += fmt::format("  # {}\n  {}\n", w.what(), golden::query_line(w.query, w.scalar));
  }
  listed("Diagnosis", report.why.lines());
  listed("Baseline", report.baseline_lines());
  return text + "\n" + report.sentence() + "\n";
}

std::string scoreboard_text(const std::vector<Report>& reports) {
  Table summary;
  summary.row({"engine", "verdict", "level reached", "cases", "missed hits", "false hits", "not finite", "fields",
               "correctly rounded", "beyond bound"});
  for (const Report& report : reports) {
    const FamilyReport all = report.total();
    const FieldCount fields = all.all_fields();
    const double share = fields.judged() == 0 ? 0
                                              : 100.0 * static_cast<double>(fields.at(Grade::correctly_rounded)) /
                                                    static_cast<double>(fields.judged());
    summary.row({report.engine.name, report.certified() ? "certified" : "REFUTED", std::string(name(report.level())),
                 cell(all.cases), cell(all.missed_hits), cell(all.false_hits), cell(all.not_finite),
                 cell(fields.judged()), fmt::format("{:.1f} %", share), cell(fields.at(Grade::beyond_bound))});
  }
  // Family by family, in the order of the first engine that judged it.
  std::vector<std::string> order;
  std::map<std::string, std::vector<std::string>> rows;
  for (std::size_t i = 0; i < reports.size(); ++i)
    for (const FamilyReport& f : reports[i].families) {
      auto& row = rows[f.title()];
      if (row.empty()) {
        order.push_back(f.title());
        row.resize(reports.size(), "-");
      }
      row[i] = f.missed_hits + f.false_hits + f.not_finite == 0
                   ? "."
                   : fmt::format("{}/{}/{}", f.missed_hits, f.false_hits, f.not_finite);
    }
  Table families;
  std::vector<std::string> head{"missed hits / false hits / not finite"};
  for (const Report& report : reports) head.push_back(report.engine.name);
  families.row(head);
  for (const std::string& family : order) {
    std::vector<std::string> cells{family};
    cells.insert(cells.end(), rows[family].begin(), rows[family].end());
    families.row(std::move(cells));
  }
  std::string text = summary.text() + "\n" + families.text() +
                     "\n.  none      -  not judged: the file holds numbers that the engine's scalar does not\n\n";
  for (const Report& report : reports) {
    text += report.sentence() + "\n";
    for (const std::string& d : report.why.lines()) text += "  " + d + "\n";
  }
  return text;
}

}  // namespace contact::tool
