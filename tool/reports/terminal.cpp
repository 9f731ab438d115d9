// The report for a person at a terminal: the table by family, the worst cases, the verdict; and the scoreboard.
#include <fmt/color.h>
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "golden/dataset.hpp"
#include "tool/reports/report.hpp"
#include "tool/reports/table.hpp"

namespace contact::tool {
namespace {

constexpr std::size_t kMostRows = 12;  // of a table; what has no row of its own is added up

const fmt::text_style kGood = fmt::fg(fmt::terminal_color::green);
const fmt::text_style kBad = fmt::fg(fmt::terminal_color::red);
const fmt::text_style kHead = fmt::emphasis::bold;

std::string styled(const fmt::text_style& style, const std::string& text, bool colour) {
  return colour ? fmt::format(style, "{}", text) : text;
}

/// What is wrong stands out.
fmt::text_style style_of(const std::string& head, const std::string& cell) {
  if (head == cell) return kHead;
  if (cell == "certified") return kGood;
  if (cell == "REFUTED" || cell == "too little") return kBad;
  const bool counts_wrong = head.starts_with("missed") || head.starts_with("false") || head.starts_with("beyond") ||
                            head == "no answer" || head == "missing fields" || head == "not finite";
  return counts_wrong && cell != "." ? kBad : fmt::text_style();
}

std::uint64_t wrong(const FamilyReport& f) {
  return f.missed_hits + f.false_hits + f.unanswered() + f.incomplete + f.not_finite +
         f.all_fields().at(Grade::beyond_bound);
}

/// Families that fall short, the worst first, as many as there is room for, then the others added up by pair. A few
/// families all have their row.
std::vector<std::pair<std::string, FamilyReport>> rows_of(const Report& report) {
  std::vector<FamilyReport> families;
  std::vector<FamilyReport> fresh;
  for (const FamilyReport& f : report.families) (f.fresh ? fresh : families).push_back(f);
  const auto level = [&](const FamilyReport& f) { return f.level(report.allow_unsupported); };
  const auto short_of = [&](const FamilyReport& f) {
    if (report.tolerance()) return f.fitness.answers != 0 && !f.within_tolerance(report.allow_unsupported);
    return level(f) > (f.with_numbers == 0 ? std::max(report.required, Level::decisions) : report.required);
  };
  const auto worse = [&](const FamilyReport& x, const FamilyReport& y) {
    return std::tuple(short_of(x), level(x), wrong(x)) > std::tuple(short_of(y), level(y), wrong(y));
  };
  std::stable_sort(families.begin(), families.end(), worse);
  const std::size_t shown =
      families.size() <= kMostRows
          ? families.size()
          : std::min(kMostRows, static_cast<std::size_t>(std::count_if(families.begin(), families.end(), short_of)));
  std::vector<std::pair<std::string, FamilyReport>> rows;
  for (std::size_t i = 0; i < shown; ++i) rows.emplace_back(families[i].title(), families[i]);
  std::map<Pair, std::pair<std::size_t, FamilyReport>> others;
  for (std::size_t i = shown; i < families.size(); ++i) {
    auto& pair = others[families[i].pair];
    ++pair.first;
    pair.second.merge(families[i]);
  }
  for (const auto& [pair, sum] : others)
    rows.emplace_back(fmt::format("{} ({} {})", name(pair), sum.first, shown == 0 ? "families" : "others"), sum.second);
  if (rows.size() > 1) rows.emplace_back("total", report.total());
  // Of fresh questions those families that fall short where only they do; of one family its own row says it.
  std::stable_sort(fresh.begin(), fresh.end(), worse);
  if (fresh.size() > 1)
    for (std::size_t i = 0; i < std::min(kMostRows, fresh.size()) && short_of(fresh[i]); ++i)
      if (std::none_of(families.begin(), families.end(), [&](const FamilyReport& f) {
            return short_of(f) && f.pair == fresh[i].pair && f.scalar == fresh[i].scalar && f.family == fresh[i].family;
          }))
        rows.emplace_back(fresh[i].title(), fresh[i]);
  if (!fresh.empty()) rows.emplace_back("fresh questions", report.fresh_total());
  return rows;
}

}  // namespace

std::string terminal_text(const Report& report, bool colour) {
  Table table;
  table.row({"family", "cases", "hits", "missed", "false", "no answer", "missing fields", "not finite",
             "correctly rounded", "faithful", "bounded", "beyond", "worst (ulps)", "level"});
  for (const auto& [title, f] : rows_of(report)) {
    const FieldCount all = f.all_fields();
    table.row({title, or_dot(f.cases), or_dot(f.hits), or_dot(f.missed_hits), or_dot(f.false_hits),
               or_dot(f.unanswered()), or_dot(f.incomplete), or_dot(f.not_finite),
               or_dot(all.at(Grade::correctly_rounded)), or_dot(all.at(Grade::faithful)),
               or_dot(all.at(Grade::bounded)), or_dot(all.at(Grade::beyond_bound)),
               all.worst_id.empty() ? "" : fmt::format("{:.3g}", all.worst),
               std::string(name(f.level(report.allow_unsupported)))});
  }
  table.drop_empty_columns();

  std::string text =
      styled(kHead,
             fmt::format("{} ({}), required: {}", report.who(), name(report.engine.declared.scalar), report.demand()),
             colour) +
      "\n\n" + table.text(colour ? style_of : Table::Style());
  const FamilyReport all = report.all();
  std::string levels;
  for (const Field field : oracle::kFields) {
    const FieldCount& c = all.fields[static_cast<std::size_t>(field)];
    if (c.judged() != 0)
      levels += fmt::format("  {} {}", name(field), percent(c.at(Grade::correctly_rounded), c.judged(), "{:.4g}"));
  }
  if (!levels.empty())
    text +=
        "\nThe columns from 'correctly rounded' on count fields: normal, point1, point2 and value of every contact."
        "\nCorrectly rounded by field:" +
        levels + "\n";
  const auto listed = [&](const std::string& title, const std::vector<std::string>& lines) {
    if (!lines.empty())
      text += fmt::format("\n{}\n  {}\n", styled(kHead, title + ":", colour), fmt::join(lines, "\n  "));
  };
  listed("Fitness", report.fitness());
  if (const auto questions = report.in_the_way(); !questions.empty()) {
    text += "\n" + styled(kHead, "These questions need the largest tolerance:", colour) + "\n";
    for (const InTheWay& one : questions) text += fmt::format("  # {}\n  {}\n", one.what, one.question);
  }
  if (report.repeats) listed("Asked again", report.repeats->lines());
  listed("Not judged", report.left_out());
  if (!report.right() && !report.worst.empty()) {
    text += "\n" + styled(kHead, "The worst cases, as lines for `contact-oracle explain`:", colour) + "\n";
    for (const WorstCase& w : report.worst)
      text += fmt::format("  # {}\n  {}\n", styled(kBad, w.what(), colour), golden::query_line(w.query, w.scalar));
  }
  listed("Diagnosis", report.diagnosis());
  listed("Baseline", report.baseline_lines());
  return text + "\n" + styled(report.certified() ? kGood : kBad, report.sentence(), colour) + "\n";
}

std::string scoreboard_text(const std::vector<Report>& reports, bool colour) {
  Table summary;
  summary.row({"engine", "verdict", "level reached", "hits", "misses", "missed hits", "false hits", "missing fields",
               "not finite", "numbers", "correctly rounded", "beyond bound", "lengths fit from", "normals fit from",
               "fresh", "fresh wrong"});
  for (const Report& report : reports) {
    const FamilyReport all = report.total();
    const FieldCount fields = all.all_fields();
    const Fit fit = fit_of(all.everyday);
    summary.row({report.engine.name, std::string(report.outcome()),
                 std::string(name(all.level(report.allow_unsupported))), or_dot(all.decided.hits),
                 or_dot(all.decided.misses), or_dot(all.missed_hits), or_dot(all.false_hits), or_dot(all.incomplete),
                 or_dot(all.not_finite), or_dot(fields.judged()),
                 percent(fields.at(Grade::correctly_rounded), std::max<std::uint64_t>(fields.judged(), 1), "{:.1f}"),
                 or_dot(fields.at(Grade::beyond_bound)), fit.length, fit.angle, or_dot(report.fresh_judged()),
                 or_dot(report.fresh_failures)});
  }
  // Family by family: those where most is wrong, of all engines together, come first.
  struct Row {
    std::uint64_t wrong = 0;
    std::vector<std::string> cells;
  };
  std::map<std::string, Row> rows;
  for (std::size_t i = 0; i < reports.size(); ++i)
    for (const FamilyReport& f : reports[i].families) {
      if (f.fresh) continue;
      Row& row = rows[f.title()];
      if (row.cells.empty()) row.cells.assign(reports.size(), "-");
      const std::uint64_t here = f.missed_hits + f.false_hits + f.incomplete + f.not_finite;
      row.wrong += here;
      row.cells[i] = here == 0 ? "." : fmt::format("{}/{}/{}", f.missed_hits, f.false_hits, f.not_finite);
    }
  std::vector<std::pair<std::string, Row>> worst(rows.begin(), rows.end());
  std::stable_sort(worst.begin(), worst.end(),
                   [](const auto& x, const auto& y) { return x.second.wrong > y.second.wrong; });
  const auto is_wrong = [](const auto& row) { return row.second.wrong != 0; };
  const auto all_wrong = static_cast<std::size_t>(std::count_if(worst.begin(), worst.end(), is_wrong));
  const std::size_t shown = std::min(kMostRows, all_wrong);
  Table families;
  std::vector<std::string> head{"missed hits / false hits / not finite"};
  for (const Report& report : reports) head.push_back(report.engine.name);
  families.row(head);
  for (std::size_t i = 0; i < shown; ++i) {
    std::vector<std::string> cells{worst[i].first};
    cells.insert(cells.end(), worst[i].second.cells.begin(), worst[i].second.cells.end());
    families.row(std::move(cells));
  }
  summary.drop_empty_columns();
  std::string text =
      summary.text(colour ? style_of : Table::Style()) + "\n" + families.text(colour ? style_of : Table::Style()) +
      "\n.  none      -  not judged: the file holds numbers that the engine's scalar does not\n" +
      "fit from: the length, or the angle in radians, that --tolerance must allow for everyday numbers\n" +
      fmt::format("{}: more than anybody would state\n", kBeyond) +
      fmt::format("and {} families with less that is wrong, {} with nothing; --report shows all\n\n", all_wrong - shown,
                  worst.size() - all_wrong);
  for (const Report& report : reports) {
    text += styled(report.certified() ? kGood : kBad, report.sentence(), colour) + "\n";
    for (const std::string& d : report.diagnosis()) text += "  " + d + "\n";
  }
  return text;
}

}  // namespace contact::tool
