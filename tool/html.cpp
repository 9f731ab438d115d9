// The report as one self-contained HTML page.
#include <fmt/format.h>

#include <map>

#include "golden/dataset.hpp"
#include "tool/report.hpp"

namespace contact::tool {
namespace {

constexpr std::string_view kStyle = R"(
:root{color-scheme:light dark;--ok:#0b6e4f;--bad:#b3261e;--line:#8884;--soft:#8881}
@media (prefers-color-scheme:dark){:root{--ok:#5fd3a6;--bad:#ff8f85}}
body{font:15px/1.5 system-ui,sans-serif;max-width:76rem;margin:2rem auto;padding:0 1rem}
h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}
.wide{overflow-x:auto}table{border-collapse:collapse;font-variant-numeric:tabular-nums}
th,td{padding:.25rem .7rem;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}
th:first-child,td:first-child{text-align:left}tbody tr:hover{background:var(--soft)}
.ok{color:var(--ok);font-weight:600}.bad{color:var(--bad);font-weight:600}
code{font-size:.85em;overflow-wrap:anywhere}li{margin:.4rem 0})";

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '&')
      out += "&amp;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string cell(std::uint64_t n) { return n == 0 ? "<td>.</td>" : fmt::format("<td>{}</td>", n); }
std::string bad_cell(std::uint64_t n) { return n == 0 ? "<td>.</td>" : fmt::format("<td class=bad>{}</td>", n); }

std::string row(const FamilyReport& f, bool allow_unsupported) {
  const FieldCount all = f.all_fields();
  return fmt::format("<tr><td>{}</td>", escaped(f.title())) + cell(f.cases) + cell(f.hits) + bad_cell(f.missed_hits) +
         bad_cell(f.false_hits) + cell(f.unanswered()) + bad_cell(f.not_finite) +
         cell(all.at(Grade::correctly_rounded)) + cell(all.at(Grade::faithful)) + cell(all.at(Grade::bounded)) +
         bad_cell(all.at(Grade::beyond_bound)) +
         fmt::format("<td>{}</td><td>{}</td></tr>\n", all.worst_id.empty() ? "" : fmt::format("{:.3g}", all.worst),
                     name(f.level(allow_unsupported)));
}

std::string summary(const std::vector<Report>& reports) {
  std::string html =
      "<div class=wide tabindex=0><table><thead><tr><th>engine<th>verdict<th>level reached<th>cases<th>missed hits"
      "<th>false hits<th>not finite<th>fields<th>correctly rounded<th>beyond bound</tr></thead><tbody>\n";
  for (const Report& report : reports) {
    const FamilyReport all = report.total();
    const FieldCount fields = all.all_fields();
    html += fmt::format("<tr><td><a href=\"#{0}\">{0}</a></td><td class={1}>{2}</td><td>{3}</td>",
                        escaped(report.engine.name), report.certified() ? "ok" : "bad",
                        report.certified() ? "certified" : "refuted", name(report.level())) +
            cell(all.cases) + bad_cell(all.missed_hits) + bad_cell(all.false_hits) + bad_cell(all.not_finite) +
            cell(fields.judged()) + cell(fields.at(Grade::correctly_rounded)) +
            bad_cell(fields.at(Grade::beyond_bound)) + "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string listed(std::string_view title, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string html = fmt::format("<p>{}:</p>\n<ul>\n", title);
  for (const std::string& line : lines) html += "<li>" + escaped(line) + "</li>\n";
  return html + "</ul>\n";
}

std::string section(const Report& report) {
  std::string html =
      fmt::format("<h2 id=\"{0}\">{0} {1} <span class={2}>{3}</span></h2>\n<p>{4}</p>\n", escaped(report.engine.name),
                  escaped(report.engine.version), report.certified() ? "ok" : "bad",
                  report.certified() ? "certified" : "refuted", escaped(report.sentence()));
  html += listed("Diagnosis", report.why.lines());
  html +=
      "<div class=wide tabindex=0><table><thead><tr><th>family<th>cases<th>hits<th>missed<th>false<th>no answer<th>not "
      "finite<th>correctly rounded"
      "<th>faithful<th>bounded<th>beyond bound<th>worst (ulps)<th>level</tr></thead><tbody>\n";
  for (const FamilyReport& f : report.families) html += row(f, report.allow_unsupported);
  html += row(report.total(), report.allow_unsupported) + "</tbody></table></div>\n";
  if (!report.certified() && !report.worst.empty()) {
    html += "<p>The worst cases, as lines for <code>contact-oracle explain</code>:</p>\n<ul>\n";
    for (const WorstCase& w : report.worst)
      html += fmt::format("<li>{}<br><code>{}</code></li>\n", escaped(w.what()),
                          escaped(golden::query_line(w.query, w.scalar)));
    html += "</ul>\n";
  }
  html += listed("Not judged", report.left_out()) + listed("Baseline", report.baseline_lines());
  return html;
}

}  // namespace

std::string html_text(const std::vector<Report>& reports) {
  std::string html = fmt::format(
      "<!doctype html>\n<html lang=en><meta charset=utf-8><meta name=viewport content=\"width=device-width\">\n"
      "<title>contact-oracle: {}</title>\n<style>{}</style>\n<h1>contact-oracle</h1>\n"
      "<p>Each engine held against the exact answer. The columns from <em>correctly rounded</em> to <em>beyond "
      "bound</em> count "
      "fields: normal, point1, point2 and value of every contact.</p>\n",
      escaped(reports.front().engine.name), kStyle);
  if (reports.size() > 1) html += summary(reports);
  for (const Report& report : reports) html += section(report);
  return html + "</html>\n";
}

}  // namespace contact::tool
