// The report as one self-contained HTML page: what is said stands in the page itself; tool/page/report.js adds the
// charts and the views in space, from the same data that --json writes.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>

#include "formats/program.hpp"
#include "golden/dataset.hpp"
#include "oracle/truth/truth.hpp"
#include "tool/reports/page.hpp"
#include "tool/reports/report.hpp"
#include "tool/run/environment.hpp"

namespace contact::tool {
namespace {

using page::for_html;

std::string cell(std::uint64_t n) { return n == 0 ? "<td>.</td>" : fmt::format("<td>{}</td>", n); }
std::string bad_cell(std::uint64_t n) { return n == 0 ? "<td>.</td>" : fmt::format("<td class=bad>{}</td>", n); }

std::string verdict_mark(const Report& report) {
  if (report.certified()) return "<span class=ok>✓ certified</span>";
  return report.right() ? "<span class=bad>✕ too little judged</span>" : "<span class=bad>✕ refuted</span>";
}

std::string row(const FamilyReport& f, bool allow_unsupported) {
  const FieldCount all = f.all_fields();
  return fmt::format("<tr><th scope=row>{}</th>", for_html(f.title())) + cell(f.cases) + cell(f.hits) +
         bad_cell(f.missed_hits) + bad_cell(f.false_hits) + cell(f.unanswered()) + bad_cell(f.incomplete) +
         bad_cell(f.not_finite) + cell(all.at(Grade::correctly_rounded)) + cell(all.at(Grade::faithful)) +
         cell(all.at(Grade::bounded)) + bad_cell(all.at(Grade::beyond_bound)) +
         fmt::format("<td>{}</td><td>{}</td></tr>\n", all.worst_id.empty() ? "" : fmt::format("{:.3g}", all.worst),
                     name(f.level(allow_unsupported)));
}

std::string summary(const std::vector<Report>& reports) {
  std::string html =
      "<div class=wide tabindex=0><table class=board><thead><tr><th>engine<th>verdict<th>level reached<th>hits"
      "<th>misses<th>missed hits<th>false hits<th>missing fields<th>not finite<th>numbers<th>correctly "
      "rounded<th>beyond bound<th>lengths fit from<th>normals fit from<th>fresh<th>fresh wrong</tr></thead><tbody>\n";
  for (const Report& report : reports) {
    const FamilyReport all = report.total();
    const FieldCount fields = all.all_fields();
    html += fmt::format("<tr><th scope=row><a href=\"#{0}\">{0}</a></th><td>{1}</td><td>{2}</td>",
                        for_html(report.engine.name), verdict_mark(report), name(all.level(report.allow_unsupported))) +
            cell(all.decided.hits) + cell(all.decided.misses) + bad_cell(all.missed_hits) + bad_cell(all.false_hits) +
            bad_cell(all.incomplete) + bad_cell(all.not_finite) + cell(fields.judged()) +
            cell(fields.at(Grade::correctly_rounded)) + bad_cell(fields.at(Grade::beyond_bound)) +
            fmt::format("<td>{}</td><td>{}</td>", fit_of(all.everyday).length, fit_of(all.everyday).angle) +
            cell(report.fresh_judged()) + bad_cell(report.fresh_failures) + "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string listed(std::string_view title, const std::vector<std::string>& lines) {
  if (lines.empty()) return {};
  std::string html = fmt::format("<h3>{}</h3>\n<ul>\n", title);
  for (const std::string& line : lines) html += "<li>" + for_html(line) + "</li>\n";
  return html + "</ul>\n";
}

/// One square of the matrix. What is wrong is a number, what is right a sign: colour says nothing that they do not.
std::string square(std::size_t grade, std::uint64_t wrong, const std::string& says) {
  constexpr std::array<std::string_view, 3> kSigns{"●", "◐", "○"};
  return fmt::format("<td class=g{} title=\"{}\">{}</td>", grade, says,
                     grade < kSigns.size() ? std::string(kSigns[grade]) : std::to_string(wrong));
}

std::string decision_square(const FamilyReport& f, bool allow_unsupported) {
  const std::uint64_t left_out = f.cases - f.judged(allow_unsupported);
  const std::uint64_t unanswered = f.unanswered() - left_out + f.outside_domain;
  // Cases, each once: where two conventions differ, one may miss a hit by `overlap` and claim a false one by `contact`.
  const auto at = [&](Level level) { return f.levels[static_cast<std::size_t>(level)]; };
  const std::uint64_t wrong = at(Level::conservative) + at(Level::none) - left_out;
  return square(
      wrong == 0 ? 0 : 3, wrong,
      wrong == 0
          ? fmt::format("all {} decisions right", f.judged(allow_unsupported))
          : fmt::format("of {} cases {} missed hits, {} false hits, {} with missing fields, {} without a right answer",
                        f.cases, f.missed_hits, f.false_hits, f.incomplete, unanswered));
}

std::string field_square(const FieldCount& c, Field field) {
  if (c.judged() == 0) return "<td></td>";
  std::size_t worst = 0;
  std::string says;
  for (std::size_t i = 0; i < c.grades.size(); ++i) {
    if (c.grades[i] == 0) continue;
    worst = i;
    says += fmt::format("{}{} {}", says.empty() ? "" : ", ", c.grades[i], name(static_cast<Grade>(i)));
  }
  return square(worst, c.at(Grade::beyond_bound) + c.at(Grade::not_finite),
                fmt::format("{}: {}{}", name(field), says,
                            c.worst_id.empty() ? "" : fmt::format("; worst {:.3g} ulps", c.worst)));
}

/// Families by fields, a table a pair: what the worst answer of each reaches, for questions in either scalar.
std::string matrix(const Report& report) {
  using Row = std::map<Scalar, FamilyReport>;
  std::map<Pair, std::vector<std::pair<std::string, Row>>> pairs;
  for (const FamilyReport& f : report.families) {
    if (f.fresh) continue;
    auto& rows = pairs[f.pair];
    auto at = std::find_if(rows.begin(), rows.end(), [&](const auto& r) { return r.first == f.family; });
    if (at == rows.end()) at = rows.insert(at, {f.family, {}});
    at->second[f.scalar].merge(f);
  }
  std::string html = "<div class=matrix>\n";
  for (const auto& [pair, rows] : pairs) {
    std::map<Scalar, FamilyReport> totals;
    for (const auto& [family, by_scalar] : rows)
      for (const auto& [scalar, f] : by_scalar) totals[scalar].merge(f);
    std::string scalars;
    std::string heads;
    std::map<Scalar, std::vector<Field>> columns;
    for (const Scalar scalar : kScalars) {
      if (!totals.contains(scalar)) continue;
      for (const Field field : oracle::kFields)
        if (totals[scalar].fields[static_cast<std::size_t>(field)].judged() != 0) columns[scalar].push_back(field);
      scalars += fmt::format("<th colspan={}>{}", columns[scalar].size() + 1, name(scalar));
      heads += "<th title=\"hit or miss\">hit";
      for (const Field field : columns[scalar])
        heads += fmt::format("<th title={0}>{1}", name(field),
                             field == Field::point1   ? "p1"
                             : field == Field::point2 ? "p2"
                                                      : name(field));
    }
    html += fmt::format(
        "<div class=wide tabindex=0><table><caption>{}</caption><thead><tr><th>{}</tr><tr><th>family{}</tr></thead>"
        "<tbody>\n",
        name(pair), scalars, heads);
    for (const auto& [family, by_scalar] : rows) {
      html += fmt::format("<tr><th scope=row>{}</th>", for_html(family));
      for (const Scalar scalar : kScalars) {
        if (!totals.contains(scalar)) continue;
        const auto f = by_scalar.find(scalar);
        html += f == by_scalar.end() ? "<td></td>" : decision_square(f->second, report.allow_unsupported);
        for (const Field field : columns[scalar])
          html += f == by_scalar.end() ? "<td></td>"
                                       : field_square(f->second.fields[static_cast<std::size_t>(field)], field);
      }
      html += "</tr>\n";
    }
    html += "</tbody></table></div>\n";
  }
  return html +
         "</div>\n<p class=key><span class=g0>●</span> correctly rounded, or decided right <span class=g1>◐</span> "
         "faithful <span class=g2>○</span> within the bound <span class=g3>12</span> so many wrong: beyond the bound, "
         "decided wrong, or a field missing <span class=g4>12</span> so many wrong, some not even finite</p>\n";
}

std::string counts(const Report& report) {
  std::string html =
      "<details><summary>All counts</summary><div class=wide tabindex=0><table class=counts><thead><tr><th>family"
      "<th>cases<th>hits<th>missed<th>false<th>no answer<th>missing fields<th>not finite<th>correctly "
      "rounded<th>faithful<th>bounded"
      "<th>beyond bound<th>worst (ulps)<th>level</tr></thead><tbody>\n";
  for (const bool fresh : {false, true}) {
    const FamilyReport sum = fresh ? report.fresh_total() : report.total();
    for (const FamilyReport& f : report.families)
      if (f.fresh == fresh) html += row(f, report.allow_unsupported);
    if (!fresh || sum.cases != 0) html += row(sum, report.allow_unsupported);
  }
  return html +
         "</tbody></table></div><p>The columns from <em>correctly rounded</em> to <em>beyond bound</em> count fields: "
         "normal, point1, point2 and value of every contact.</p></details>\n";
}

/// A number as in JSON, without the quotes around what JSON has no number for.
std::string shown(double x) {
  std::string text = formats::number(x);
  std::erase(text, '"');
  return text;
}

/// A number of the right answer beside the claimed one, a line each; where they differ the claimed one is marked, unless others are as
/// right.
std::string number_rows(std::string_view title, const std::vector<std::string>& right,
                        const std::vector<std::string>& claimed, const std::string& error, bool marked = true) {
  const auto lines = [marked](const std::vector<std::string>& texts, const std::vector<std::string>& other) {
    std::string html;
    for (std::size_t i = 0; i < texts.size(); ++i) {
      const bool differs = marked && (i >= other.size() || other[i] != texts[i]);
      html += fmt::format("{}{}{}{}", i == 0 ? "" : "<br>", differs ? "<mark>" : "", for_html(texts[i]),
                          differs ? "</mark>" : "");
    }
    return html.empty() ? "–" : html;
  };
  return fmt::format("<tr><th scope=row>{}</th><td>{}</td><td>{}</td><td>{}</td></tr>\n", title, lines(right, right),
                     claimed.empty() ? "–" : lines(claimed, right), error);
}

std::string numbers_table(const WorstCase& w, const oracle::Declaration& declared) {
  const Claim right = w.right(declared);
  const auto said = [](const std::optional<bool>& overlap) {
    return overlap ? std::vector<std::string>{*overlap ? "hit" : "miss"} : std::vector<std::string>{};
  };
  const auto contact_said = [&](const Claim& claim) {
    return said(claim.speaks_of_contact ? std::optional(claim.contact.has_value()) : std::nullopt);
  };
  const auto vector = [](const Claim& claim, auto member) {
    std::vector<std::string> texts;
    if (claim.contact && (*claim.contact).*member)
      for (const double x : *((*claim.contact).*member)) texts.push_back(shown(x));
    return texts;
  };
  const auto value = [](const Claim& claim) {
    return claim.contact && claim.contact->value ? std::vector<std::string>{shown(*claim.contact->value)}
                                                 : std::vector<std::string>{};
  };
  const auto error = [&](Field field) -> std::string {
    if (w.verdict.missing.has(aspect(field))) return "missing field";
    const auto& verdict = w.verdict.at(field);
    if (!verdict) return "";
    if (verdict->grade == Grade::correctly_rounded || verdict->grade == Grade::not_finite)
      return std::string(name(verdict->grade));
    return verdict->too_many ? "more than declared" : fmt::format("{:.4g} ulps", verdict->error);
  };
  const auto decision = [&](Aspect asked, oracle::Decision d) {
    constexpr std::array<std::string_view, 4> kNames{"", "right", "missed hit", "false hit"};
    return std::string(w.verdict.missing.has(asked) ? "missing field" : kNames[static_cast<std::size_t>(d)]);
  };
  std::string rows =
      number_rows("overlap", said(right.overlap), said(w.claim.overlap), decision(Aspect::overlap, w.verdict.overlap)) +
      number_rows("contact", contact_said(right), contact_said(w.claim), decision(Aspect::contact, w.verdict.contact));
  const std::array vectors{
      std::pair{Field::normal, &ContactClaim::normal}, std::pair{Field::point1, &ContactClaim::point1},
      std::pair{Field::point2, &ContactClaim::point2}, std::pair{Field::point, &ContactClaim::point}};
  for (const auto& entry : vectors) {
    const auto texts = vector(right, entry.second);
    const auto claimed = vector(w.claim, entry.second);
    if (!texts.empty() || !claimed.empty()) rows += number_rows(name(entry.first), texts, claimed, error(entry.first));
  }
  const auto points = [](const Claim& claim) {
    std::vector<std::string> texts;
    if (claim.contact)
      for (const ManifoldPoint& point : claim.contact->points)
        texts.push_back(fmt::format("({}, {}, {}) deep {}", shown(point.at[0]), shown(point.at[1]), shown(point.at[2]),
                                    shown(point.depth)));
    return texts;
  };
  if (!points(w.claim).empty())
    rows += number_rows("points", points(right), points(w.claim), error(Field::points), false);
  if (!value(right).empty() || !value(w.claim).empty())
    rows += number_rows("value", value(right), value(w.claim), error(Field::value));
  return "<div class=wide tabindex=0><table class=numbers><thead><tr><th><th>right<th>claimed<th>error</tr></thead>"
         "<tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string worst_case(const WorstCase& w, std::size_t index, const oracle::Declaration& declared) {
  std::string html = fmt::format("<article data-case={}><h4>{}</h4>\n<p>{}, numbers in {}", index, for_html(w.what()),
                                 name(w.query.pair), name(w.scalar));
  if (w.query.has_distance() && inside_domain(w.query)) {
    html += fmt::format(": √D − reach is {} ulps of reach ({})",
                        formats::number(oracle::margin_ulps(oracle::truth_of(w.query), declared.scalar)),
                        name(declared.scalar));
  }
  return html + fmt::format(".</p>\n<div class=sides><figure class=view></figure>\n{}</div>\n{}</article>\n",
                            numbers_table(w, declared), page::command_to_copy(golden::query_line(w.query, w.scalar)));
}

/// {"normal":"first-to-second",...} as a list of terms.
std::string declaration(const Report& report) {
  const auto parsed = [](const Conventions& conventions) {
    return formats::parse_object(engines::conventions_text(conventions), {"conventions", 0});
  };
  const auto conventions = parsed(report.engine.declared.conventions);
  const DeclaredBounds& bounds = report.engine.declared.bounds;
  std::string html = "<h3>What the engine declares</h3>\n<dl>";
  const auto term = [&](std::string_view key, const std::string& value) {
    html += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>", key, for_html(value));
  };
  term("scalar", std::string(name(report.engine.declared.scalar)));
  term("claims", fmt::format("{}", fmt::join(report.engine.declared.claimed().names(), ", ")));
  const auto text = [](const auto& value) {
    return value.is_string() ? value.template get<std::string>() : value.dump();
  };
  for (const auto& [key, value] : conventions.items()) term(key, text(value));
  for (const auto& [pair, own] : report.engine.pair_conventions)
    for (const auto of_pair = parsed(own); const auto& [key, value] : of_pair.items())
      if (!conventions.contains(key) || conventions[key] != value)
        term(fmt::format("{} of {}", key, name(pair)), text(value));
  term("bounds", fmt::format("normal {}, points {}, value {} ulps", bounds.normal, bounds.point, bounds.value));
  if (report.engine.declared.rounds_orientation) term("rounds", std::string(oracle::kRoundsNames[0]));
  return html + "</dl>\n";
}

/// From which tolerance on it would pass, and the questions that stand in the way.
std::string fitness(const Report& report) {
  std::string html = listed("Fitness", report.fitness());
  const auto questions = report.in_the_way();
  if (questions.empty()) return html;
  html += "<details><summary>These questions need the largest tolerance</summary>\n";
  for (const InTheWay& one : questions)
    html += fmt::format("<p>{}</p>{}\n", for_html(one.what), page::command_to_copy(one.question));
  return html + "</details>\n";
}

std::string section(const Report& report) {
  std::string html =
      fmt::format("<section id=\"{0}\"><h2>{0} {1} {2}</h2>\n<p class=verdict>{3}</p>\n", for_html(report.engine.name),
                  for_html(report.engine.version), verdict_mark(report), for_html(report.sentence()));
  html += listed("Diagnosis", report.diagnosis()) + fitness(report);
  html += "<h3>Families and fields</h3>\n" + matrix(report) + counts(report);
  html += "<div class=charts></div>\n";
  if (!report.right() && !report.worst.empty()) {
    html += "<h3>The worst cases</h3>\n";
    for (std::size_t i = 0; i < report.worst.size(); ++i)
      html += worst_case(report.worst[i], i, report.engine.declared_for(report.worst[i].query.pair));
  }
  if (report.repeats) html += listed("Asked again", report.repeats->lines());
  html += listed("Not judged", report.left_out()) + listed("Baseline", report.baseline_lines()) + declaration(report);
  return html + "<script type=\"application/json\" class=data>" + page::inside_script(json_text(report, false)) +
         "</script></section>\n";
}

/// Where and under which floating-point modes the report was made.
std::string made_on() {
  const auto here = environment();
  const auto text = [&](const char* key) { return for_html(here.at(key).get<std::string>()); };
  return fmt::format("{}, {}; {}, rounding {}, subnormal results {}, subnormal inputs {}", text("processor"),
                     text("system"), text("compiler"), text("rounding"), text("subnormal_results"),
                     text("subnormal_inputs"));
}

}  // namespace

std::string html_text(const std::vector<Report>& reports) {
  const Report& first = reports.front();
  std::string html = "<p>Each engine held against the exact answer.</p>\n";
  if (reports.size() > 1) html += summary(reports);
  // Beside one engine's verdict nothing comes first; of several it tells them apart.
  const std::string scales = "<h2>Error against scale</h2>\n<div id=scales></div>\n";
  if (reports.size() > 1) html += scales;
  for (const Report& report : reports) html += section(report);
  if (reports.size() == 1) html += scales;
  return page::whole(fmt::format("{} {}", first.certified() ? "✓" : "✕", first.engine.name), html,
                     fmt::format("Judged by contact-oracle {} on {}.", formats::version(), made_on()), true);
}

}  // namespace contact::tool
