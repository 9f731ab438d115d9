// Several reports, each against the one before it, as a table at a terminal and as a page.
#include "tool/reports/history.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "formats/json.hpp"
#include "formats/program.hpp"
#include "golden/dataset.hpp"
#include "tool/reports/fitness.hpp"
#include "tool/reports/page.hpp"

namespace contact::tool {
namespace {

using page::for_html;

std::uint64_t wrong_decisions(const SavedFamily& f) { return f.missed_hits + f.false_hits; }

/// Whether everyday questions were asked, and the report says what they need.
bool says_fitness(const SavedFamily& f) { return f.everyday && f.everyday->answers != 0; }

/// What everyday numbers need of each measure, and how many answers no tolerance allows.
std::vector<std::string> fitness_cells(const SavedFamily& f) {
  std::vector<std::string> cells(oracle::kMeasures.size() + 1, "-");
  if (!says_fitness(f)) return cells;
  std::transform(f.everyday->needs.begin(), f.everyday->needs.end(), cells.begin(), rounded_up);
  cells.back() = or_dot(f.everyday->never);
  return cells;
}

std::string bits(SameBits same) {
  constexpr std::array<std::string_view, 3> kWords{".", "others", "the same"};
  return std::string(kWords[static_cast<std::size_t>(same)]);
}

/// The place of each, its engine and version, and its file where another has the same.
std::vector<std::string> labels_of(const std::vector<SavedReport>& reports) {
  std::vector<std::string> labels;
  const auto several = [&](auto of, const SavedReport& report) {
    return std::count_if(reports.begin(), reports.end(),
                         [&](const SavedReport& other) { return of(other) == of(report); }) > 1;
  };
  const auto who = [](const SavedReport& r) { return r.who(); };
  const auto with_file = [](const SavedReport& r) {
    return fmt::format("{} ({})", r.who(), formats::visible(r.path.filename().string()));
  };
  for (const SavedReport& r : reports)
    labels.push_back(fmt::format("{} {}", labels.size() + 1,
                                 !several(who, r)         ? who(r)
                                 : !several(with_file, r) ? with_file(r)
                                                          : fmt::format("{} ({})", r.who(), r.file())));
  return labels;
}

std::string html_details(std::string_view title, const std::string& inside) {
  return inside.empty() ? inside : fmt::format("<details><summary>{}</summary>\n{}</details>\n", title, inside);
}

std::string html_list(const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string html = "<ul>\n";
  for (const std::string& line : lines) html += fmt::format("<li>{}</li>\n", for_html(line));
  return html + "</ul>\n";
}

/// The first cell is the head of the row.
std::string html_row(const std::vector<std::string>& cells) {
  std::string html = fmt::format("<tr><th scope=row>{}</th>", for_html(cells.front()));
  for (std::size_t i = 1; i < cells.size(); ++i) html += fmt::format("<td>{}</td>", for_html(cells[i]));
  return html + "</tr>\n";
}

std::string html_table(std::string_view kind, const std::vector<std::string>& heads, const std::string& rows) {
  std::string html = fmt::format("<div class=wide tabindex=0><table class={}><thead><tr>", kind);
  for (const std::string& one : heads) html += fmt::format("<th scope=col>{}</th>", for_html(one));
  return html + "</tr></thead><tbody>\n" + rows + "</tbody></table></div>\n";
}

const std::vector<std::string> kCountHeads{"cases",      "level",      "missed hits",  "false hits",
                                           "not finite", "unanswered", "beyond bound", "correctly rounded"};

std::vector<std::string> count_cells(const SavedFamily& f) {
  return {std::to_string(f.cases), std::string(name(f.level)), or_dot(f.missed_hits),  or_dot(f.false_hits),
          or_dot(f.not_finite),    or_dot(f.unanswered),       or_dot(f.beyond_bound), f.share_rounded()};
}

const SavedFamily* find_family(const SavedReport& report, const std::string& title) {
  const auto it = std::find_if(report.families.begin(), report.families.end(),
                               [&](const SavedFamily& f) { return f.title == title; });
  return it == report.families.end() ? nullptr : &*it;
}

/// Of a family in a report, held against the report before it.
Change change_of(const std::vector<Comparison>& steps, std::size_t report, const std::string& title) {
  if (report == 0) return {};
  const auto& families = steps[report - 1].families();
  const auto it = families.find(title);
  return it == families.end() ? Change{} : it->second;
}

/// "better", "worse", both or nothing.
std::string words(const Change& change) {
  return fmt::format("{}{}{}", change.better ? "better" : "", change.better && change.worse ? ", " : "",
                     change.worse ? "worse" : "");
}

std::string level_cell(const SavedFamily* f, const Change& change) {
  if (f == nullptr) return "<td title=\"not judged\">–</td>";
  // Of questions that have no numbers no level asks for more than decisions.
  constexpr std::array<std::string_view, oracle::kLevelNames.size()> kColours{"g0", "g1", "g2", "g3", "g5", "g4"};
  const bool is_best = f->fields == 0 && f->level == oracle::Level::decisions;
  std::string says;
  const std::vector<std::string> cells = count_cells(*f);
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i] != ".") says += fmt::format("{}{} {}", says.empty() ? "" : ", ", kCountHeads[i], cells[i]);
  if (change.better || change.worse) says += "; than before: " + words(change);
  return fmt::format("<td class={} title=\"{}\">{}{}{}</td>",
                     kColours[is_best ? 0 : static_cast<std::size_t>(f->level)], says, name(f->level),
                     change.better ? " ▲" : "", change.worse ? " ▼" : "");
}

/// Some of the questions of a step.
std::string html_failures(std::string_view title, const std::vector<ChangedFailure>& failures) {
  std::string html;
  for (std::size_t i = 0; i < std::min(failures.size(), kNamedFailures); ++i) {
    const Failure& f = failures[i].failure;
    html += fmt::format("<p>{}</p>{}\n", for_html(failures[i].text()),
                        f.question ? page::command_to_copy(golden::query_line(*f.question, f.scalar)) : "");
  }
  if (failures.size() > kNamedFailures) html += fmt::format("<p>and {} more</p>\n", failures.size() - kNamedFailures);
  return html_details(fmt::format("{}: {}", title, failures.size()), html);
}

/// What is drawn of each report; null where it does not say.
std::string chart_data(const std::vector<SavedReport>& reports, const std::vector<std::string>& labels,
                       bool one_engine) {
  std::string charts;
  const auto chart = [&](std::string_view what, bool logarithmic, auto value) {
    std::string values;
    for (const SavedReport& report : reports) {
      const std::optional<double> x = value(report.total);
      values += fmt::format("{}{}", values.empty() ? "" : ",", x ? formats::number(*x) : "null");
    }
    charts += fmt::format(R"({}{{"what":"{}","logarithmic":{},"values":[{}]}})", charts.empty() ? "" : ",\n", what,
                          logarithmic, values);
  };
  constexpr std::array<std::string_view, oracle::kMeasures.size()> kWhat{
      "values and coordinates fit from (length)", "normals fit from (radians)", "decisions fit from (length)"};
  for (std::size_t i = 0; i < kWhat.size(); ++i)
    chart(kWhat[i], true,
          [&](const SavedFamily& f) { return says_fitness(f) ? std::optional(f.everyday->needs[i]) : std::nullopt; });
  chart("numbers correctly rounded (%)", false, [](const SavedFamily& f) {
    return f.fields == 0
               ? std::nullopt
               : std::optional(100.0 * static_cast<double>(f.correctly_rounded) / static_cast<double>(f.fields));
  });
  chart("wrong decisions (missed and false hits)", true,
        [](const SavedFamily& f) { return std::optional(static_cast<double>(wrong_decisions(f))); });
  std::string names;
  for (const std::string& label : labels) names += (names.empty() ? "" : ",") + formats::json_string(label);
  return fmt::format("{{\"one_engine\":{},\"labels\":[{}],\"charts\":[\n{}]}}", one_engine, names, charts);
}

}  // namespace

History::History(std::vector<SavedReport> reports) : reports_(std::move(reports)), labels_(labels_of(reports_)) {
  for (std::size_t i = 1; i < reports_.size(); ++i) steps_.emplace_back(reports_[i - 1], reports_[i]);
}

bool History::same_bits() const {
  return std::all_of(steps_.begin(), steps_.end(),
                     [](const Comparison& step) { return step.same_bits() == SameBits::same; });
}

Table History::table() const {
  Table table;
  table.row({"report", "verdict", "against the one before", "level", "failures", "wrong decisions", "correctly rounded",
             "lengths", "angles", "decisions", "none allows", "bits"});
  for (std::size_t i = 0; i < reports_.size(); ++i) {
    const SavedReport& r = reports_[i];
    std::vector<std::string> cells{labels_[i],
                                   std::string(r.outcome()),
                                   i == 0 ? "" : std::string(steps_[i - 1].word()),
                                   std::string(name(r.total.level)),
                                   or_dot(r.failure_count),
                                   or_dot(wrong_decisions(r.total)),
                                   r.total.share_rounded()};
    for (std::string& cell : fitness_cells(r.total)) cells.push_back(std::move(cell));
    cells.push_back(i == 0 ? "" : bits(steps_[i - 1].same_bits()));
    table.row(std::move(cells));
  }
  table.drop_empty_columns();
  return table;
}

std::vector<std::string> History::notes() const {
  std::vector<std::string> lines{
      fmt::format("Lengths, angles and decisions: from which tolerance on {}, pass.", kEveryday)};
  if (std::any_of(reports_.begin(), reports_.end(),
                  [](const SavedReport& r) { return says_fitness(r.total) && r.total.everyday->never != 0; }))
    lines.emplace_back("None allows: how many answers to such questions no tolerance allows.");
  const auto differ = [&](auto of) {
    return std::any_of(reports_.begin(), reports_.end(),
                       [&](const SavedReport& other) { return of(other) != of(reports_.front()); });
  };
  if (differ([](const SavedReport& r) { return r.engine; }))
    lines.emplace_back("These are reports of different engines, not of versions of one.");
  if (!differ([](const SavedReport& r) { return r.demand(); })) return lines;
  lines.emplace_back(
      "The reports were judged by different demands: a question may fail in one alone although both "
      "answers are as good.");
  for (std::size_t i = 0; i < reports_.size(); ++i)
    lines.push_back(fmt::format("{} was judged by {}.", labels_[i], reports_[i].demand()));
  return lines;
}

std::string History::text() const {
  std::string below;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const std::string step = fmt::format("{} against {}", i + 2, i + 1);
    if (const std::size_t alone = steps_[i].alone().size(); alone != 0)
      below += fmt::format("{}: {} {} judged in one of the two reports alone.\n", step, alone,
                           alone == 1 ? "family is" : "families are");
    for (const std::string& note : steps_[i].notes()) below += fmt::format("{}: {}\n", step, note);
  }
  if (!below.empty()) below += "\n";
  for (const std::string& line : notes()) below += line + "\n";
  return fmt::format("{}\n{}\nThe last against the one before it: {}\n", table().text(), below,
                     steps_.back().sentence());
}

std::string History::families_html() const {
  std::vector<std::string> heads{"family"};
  heads.insert(heads.end(), labels_.begin(), labels_.end());
  std::vector<std::string> count_heads{"family", "report"};
  count_heads.insert(count_heads.end(), kCountHeads.begin(), kCountHeads.end());
  count_heads.emplace_back("against the one before");
  std::set<std::string> titles;
  for (const SavedReport& r : reports_)
    for (const SavedFamily& f : r.families) titles.insert(f.title);
  std::string levels;
  std::string counts;
  std::string last_pair;
  for (const std::string& title : titles) {
    const std::string pair = title.substr(0, title.find('/'));
    if (pair != last_pair)
      levels += fmt::format("<tr class=pair><th scope=rowgroup colspan={}>{}</th></tr>\n", heads.size(), pair);
    last_pair = pair;
    levels += fmt::format("<tr><th scope=row>{}</th>", for_html(title.substr(pair.size() + 1)));
    for (std::size_t i = 0; i < reports_.size(); ++i) {
      const SavedFamily* f = find_family(reports_[i], title);
      const Change change = change_of(steps_, i, title);
      levels += level_cell(f, change);
      if (f == nullptr) continue;
      std::vector<std::string> cells{title, labels_[i]};
      for (std::string& cell : count_cells(*f)) cells.push_back(std::move(cell));
      cells.push_back(words(change));
      counts += html_row(cells);
    }
    levels += "</tr>\n";
  }
  return "<h3>Level reached by family</h3>\n" + html_table("levels", heads, levels) +
         "<p class=key><span>▲</span> better than in the report before <span>▼</span> worse <span>▲ ▼</span> some of "
         "it better, some worse <span>–</span> not judged</p>\n" +
         html_details("All counts", html_table("counts", count_heads, counts));
}

std::string History::steps_html() const {
  std::string html;
  for (std::size_t i = 0; i < steps_.size(); ++i) {
    const Comparison& step = steps_[i];
    html += fmt::format("<h3>{} against {}</h3>\n<p class=verdict>{}</p>\n", for_html(labels_[i + 1]),
                        for_html(labels_[i]), step.sentence());
    html += html_list(step.notes()) +
            html_details(fmt::format("Judged in one of the two reports alone: {}", step.alone().size()),
                         html_list(step.alone())) +
            html_failures("Newly failing, or worse than before", step.fresh()) +
            html_failures("Newly right", step.gone());
  }
  return html;
}

std::string History::html() const {
  std::vector<std::string> engines;
  for (const SavedReport& r : reports_)
    if (std::find(engines.begin(), engines.end(), r.engine) == engines.end()) engines.push_back(r.engine);
  const std::string title =
      fmt::format("{} {}", engines.size() == 1 ? "History of" : "Comparison of engines:", fmt::join(engines, ", "));
  const Table of_reports = table();
  const auto& lines = of_reports.rows();
  std::string body;
  for (std::size_t i = 1; i < lines.size(); ++i) body += html_row(lines[i]);
  std::string said;
  for (std::size_t i = 0; i < reports_.size(); ++i)
    said += fmt::format("<div><dt>{}, {}</dt><dd>{}</dd></div>\n", for_html(labels_[i]), for_html(reports_[i].file()),
                        for_html(reports_[i].verdict));
  return page::whole(title,
                     fmt::format("<p>Each report held against the one before it.</p>\n<h2>{}</h2>\n", for_html(title)) +
                         html_table("board", lines.front(), body) + html_list(notes()) +
                         "<div id=history class=charts></div>\n" + families_html() + steps_html() +
                         "<h3>What each report says</h3>\n<dl>" + said +
                         "</dl>\n<script type=\"application/json\" class=history>" +
                         page::inside_script(chart_data(reports_, labels_, engines.size() == 1)) + "</script>\n",
                     fmt::format("Compared by contact-oracle {}.", formats::version()), false);
}

}  // namespace contact::tool
