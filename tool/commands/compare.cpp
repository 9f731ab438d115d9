// compare: what became better or worse between two reports.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <map>
#include <memory>

#include "golden/query_id.hpp"
#include "tool/commands/commands.hpp"
#include "tool/reports/saved_report.hpp"
#include "tool/reports/table.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::size_t kShown = 20;  // questions of a kind that are named

/// What two reports differ in.
class Comparison {
 public:
  Comparison(const SavedReport& older, const SavedReport& newer) {
    families(older, newer);
    bits(older, newer);
    if (older.required == newer.required)
      failures(older, newer);
    else
      notes_.push_back(fmt::format("Failures are not compared: {} was required, and now {}.", name(older.required),
                                   name(newer.required)));
    for (const SavedReport* report : {&older, &newer})
      if (report->failure_count != report->failures.size())
        notes_.push_back(fmt::format("{} lists {} of its {} failures: the others are not compared.",
                                     report->path.string(), report->failures.size(), report->failure_count));
  }

  [[nodiscard]] bool worse() const { return worse_; }
  /// Whether both reports say what the bits of their answers are, and these are the same.
  [[nodiscard]] bool same_bits() const { return same_bits_; }

  [[nodiscard]] std::string text() const {
    std::string text;
    if (changed_ != 0) text += table_.text() + "\n";
    for (const std::string& note : notes_) text += note + "\n";
    if (!notes_.empty()) text += "\n";
    if (worse_ && better_) return text + "MIXED: some became worse and some better.\n";
    if (worse_) return text + "WORSE.\n";
    return text + (better_ ? "BETTER.\n" : "NO CHANGE that counts.\n");
  }

 private:
  void bits(const SavedReport& older, const SavedReport& newer) {
    for (const SavedReport* report : {&older, &newer})
      if (report->answers.empty() && !(older.answers.empty() && newer.answers.empty()))
        notes_.push_back(fmt::format("{} does not say what the bits of its answers are: certify --determinism does.",
                                     report->path.string()));
    if (older.answers.empty() || newer.answers.empty()) return;
    std::map<std::string, const SavedAnswers*> before;
    for (const SavedAnswers& one : older.answers) before.emplace(one.title, &one);
    std::size_t differ = 0;
    std::string first;
    for (const SavedAnswers& now : newer.answers) {
      const auto it = before.find(now.title);
      if (it == before.end() || it->second->sha256 == now.sha256) continue;
      if (differ++ == 0) first = fmt::format("{} in {}", first_difference(it->second->each, now.each), now.title);
    }
    same_bits_ = differ == 0 && older.answers.size() == newer.answers.size();
    notes_.push_back(differ == 0 ? "The answers to what both were asked have the same bits."
                                 : fmt::format("The bits of the answers differ in {} {}, first in {}.", differ,
                                               differ == 1 ? "family" : "families", first));
  }

  /// The id of the first question whose answer differs.
  static std::string first_difference(std::string_view before, std::string_view now) {
    constexpr std::size_t kEach = golden::kIdLength + 8;
    for (std::size_t i = 0; i + kEach <= std::min(before.size(), now.size()); i += kEach) {
      if (before.substr(i, golden::kIdLength) != now.substr(i, golden::kIdLength)) return "questions that are others";
      if (before.substr(i, kEach) != now.substr(i, kEach)) return std::string(now.substr(i, golden::kIdLength));
    }
    return "a question that no report lists";
  }

  void families(const SavedReport& older, const SavedReport& newer) {
    table_.row(
        {"family", "cases", "level", "missed", "false", "not finite", "unanswered", "beyond", "correctly rounded"});
    std::map<std::string, const SavedFamily*> before;
    for (const SavedFamily& f : older.families) before.emplace(f.title, &f);
    for (const SavedFamily& f : newer.families) {
      const auto it = before.find(f.title);
      if (it == before.end()) {
        notes_.push_back(fmt::format("{} ({} cases) is judged in the new report alone.", f.title, f.cases));
        continue;
      }
      family(*it->second, f);
      before.erase(it);
    }
    for (const SavedFamily& f : older.families)
      if (before.contains(f.title))
        notes_.push_back(fmt::format("{} ({} cases) is judged in the old report alone.", f.title, f.cases));
  }

  void family(const SavedFamily& old, const SavedFamily& now) {
    bool differs = false;
    const auto cell = [&](const std::string& before, const std::string& after) {
      differs = differs || before != after;
      return before == after ? after : before + " -> " + after;
    };
    const auto count = [&](std::uint64_t before, std::uint64_t after) {
      became(before < after, after < before);
      return cell(std::to_string(before), std::to_string(after));
    };
    const auto rounded = [](const SavedFamily& f) {
      return f.fields == 0 ? std::string("-")
                           : fmt::format("{:.2f} %", 100.0 * static_cast<double>(f.correctly_rounded) /
                                                         static_cast<double>(f.fields));
    };
    became(old.level < now.level, now.level < old.level);
    if (old.fields == now.fields)
      became(now.correctly_rounded<old.correctly_rounded, now.correctly_rounded> old.correctly_rounded);
    std::vector<std::string> cells{now.title,
                                   cell(std::to_string(old.cases), std::to_string(now.cases)),
                                   cell(std::string(name(old.level)), std::string(name(now.level))),
                                   count(old.missed_hits, now.missed_hits),
                                   count(old.false_hits, now.false_hits),
                                   count(old.not_finite, now.not_finite),
                                   count(old.unanswered, now.unanswered),
                                   count(old.beyond_bound, now.beyond_bound),
                                   cell(rounded(old), rounded(now))};
    if (!differs) return;
    ++changed_;
    table_.row(std::move(cells));
  }

  void failures(const SavedReport& older, const SavedReport& newer) {
    std::map<std::string, const Failure*> before;
    for (const Failure& f : older.failures) before.emplace(f.id, &f);
    std::map<std::string, const Failure*> after;
    for (const Failure& f : newer.failures) after.emplace(f.id, &f);
    std::vector<std::string> gone;
    std::vector<std::string> fresh;
    for (const auto& [id, f] : before)
      if (!after.contains(id)) gone.push_back(fmt::format("{} {}: {}", id, f->family, f->what));
    for (const auto& [id, f] : after) {
      const auto it = before.find(id);
      if (it == before.end())
        fresh.push_back(fmt::format("{} {}: {}", id, f->family, f->what));
      else if (f->level > it->second->level)
        fresh.push_back(fmt::format("{} {}: {}, and was: {}", id, f->family, f->what, it->second->what));
    }
    became(!fresh.empty(), !gone.empty());
    list("New or worse failures", fresh);
    list("Failures gone", gone);
  }

  void list(std::string_view title, const std::vector<std::string>& lines) {
    if (lines.empty()) return;
    notes_.push_back(fmt::format("{}: {}", title, lines.size()));
    for (std::size_t i = 0; i < std::min(lines.size(), kShown); ++i) notes_.push_back("  " + lines[i]);
    if (lines.size() > kShown) notes_.push_back(fmt::format("  and {} more", lines.size() - kShown));
  }

  void became(bool worse, bool better) {
    worse_ = worse_ || worse;
    better_ = better_ || better;
  }

  Table table_;
  std::vector<std::string> notes_;
  std::size_t changed_ = 0;
  bool same_bits_ = false;
  bool worse_ = false;
  bool better_ = false;
};

}  // namespace

void add_compare(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "compare", "What became better or worse between two JSON reports of certify; exit 1 where anything became worse");
  struct Paths {
    std::string older;
    std::string newer;
    bool same_bits = false;
  };
  auto paths = std::make_shared<Paths>();
  command->add_option("old", paths->older, "The earlier report")->required();
  command->add_option("new", paths->newer, "The later report")->required();
  command->add_flag(
      "--same-bits", paths->same_bits,
      "Exit 1 too where the reports do not show the same bits in every answer: both of certify --determinism");
  command->callback([paths, &exit] {
    const SavedReport older = read_report(paths->older);
    const SavedReport newer = read_report(paths->newer);
    fmt::print("old  {}\nnew  {}\n\n", older.verdict, newer.verdict);
    const Comparison comparison(older, newer);
    fmt::print("{}", comparison.text());
    const bool other_bits = paths->same_bits && !comparison.same_bits();
    if (other_bits) fmt::print("REFUTED: --same-bits, and that is not shown.\n");
    exit = comparison.worse() || other_bits ? kRefuted : kCertified;
  });
}

}  // namespace contact::tool
