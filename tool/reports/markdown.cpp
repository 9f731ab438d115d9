// The report as Markdown, for the summary of a CI job.
#include <fmt/format.h>

#include <string>

#include "golden/dataset.hpp"
#include "tool/reports/report.hpp"

namespace contact::tool {
namespace {

/// Whether `text` begins with the rest of :name:, which GitHub shows as a picture.
bool ends_a_picture(std::string_view text) {
  const auto end = text.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_+-");
  return end != 0 && end != std::string_view::npos && text[end] == ':';
}

/// Text for a line of Markdown: what an engine or a file is called must not become markup, a link, a picture or a call
/// to somebody. Those that no backslash prevents a space without a width does.
std::string for_markdown(std::string_view text) {
  constexpr std::string_view kNoWidth = "&#8203;";
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const std::string_view rest = text.substr(i + 1);
    const bool is_address = (c == ':' && rest.starts_with("//")) || (c == '.' && text.substr(0, i).ends_with("www"));
    if (is_address || std::string_view("\\`*_{}[]<>#|~&$!").find(c) != std::string_view::npos) out += '\\';
    out += c;
    if (c == '@' || (c == ':' && ends_a_picture(rest))) out += kNoWidth;
  }
  return out;
}

std::string or_nothing(std::uint64_t n) { return n == 0 ? "" : std::to_string(n); }

}  // namespace

std::string markdown_text(const Report& report) {
  std::string text =
      fmt::format("## {} {}\n\n{}\n", report.certified() ? ":white_check_mark:" : ":x:", for_markdown(report.who()),
                  for_markdown(report.sentence()));
  const auto listed = [&](std::string_view title, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    text += fmt::format("\n**{}**\n\n", title);
    for (const std::string& line : lines) text += fmt::format("- {}\n", for_markdown(line));
  };
  listed("Diagnosis", report.diagnosis());
  text +=
      "\n| family | cases | hits | missed | false | no answer | missing fields | not finite | correctly rounded | "
      "faithful | bounded | beyond | worst (ulps) | level "
      "|\n|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|--:|---|\n";
  const auto row = [&](const FamilyReport& f) {
    const FieldCount all = f.all_fields();
    text += fmt::format(
        "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", for_markdown(f.title()), f.cases,
        or_nothing(f.hits), or_nothing(f.missed_hits), or_nothing(f.false_hits), or_nothing(f.unanswered()),
        or_nothing(f.incomplete), or_nothing(f.not_finite), or_nothing(all.at(Grade::correctly_rounded)),
        or_nothing(all.at(Grade::faithful)), or_nothing(all.at(Grade::bounded)),
        or_nothing(all.at(Grade::beyond_bound)), all.worst_id.empty() ? "" : fmt::format("{:.3g}", all.worst),
        name(f.level(report.allow_unsupported)));
  };
  for (const bool fresh : {false, true}) {
    for (const FamilyReport& f : report.families)
      if (f.fresh == fresh) row(f);
    if (!fresh || report.fresh_total().cases != 0) row(fresh ? report.fresh_total() : report.total());
  }
  listed("Fitness", report.fitness());
  if (report.repeats) listed("Asked again", report.repeats->lines());
  listed("Not judged", report.left_out());
  listed("Baseline", report.baseline_lines());
  if (!report.right() && !report.worst.empty()) {
    text += "\nThe worst cases, as lines for `contact-oracle explain`:\n\n```\n";
    for (const WorstCase& w : report.worst)
      text += fmt::format("# {}\n{}\n", w.what(), golden::query_line(w.query, w.scalar));
    text += "```\n";
  }
  return text;
}

}  // namespace contact::tool
