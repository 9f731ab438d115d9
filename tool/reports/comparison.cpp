// What two reports differ in.
#include "tool/reports/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "golden/query_id.hpp"

namespace contact::tool {
namespace {

/// The id of the first question whose answer differs.
std::string first_difference(std::string_view before, std::string_view now) {
  constexpr std::size_t kEach = golden::kIdLength + 8;
  for (std::size_t i = 0; i + kEach <= std::min(before.size(), now.size()); i += kEach) {
    if (before.substr(i, golden::kIdLength) != now.substr(i, golden::kIdLength)) return "questions that are others";
    if (before.substr(i, kEach) != now.substr(i, kEach)) return std::string(now.substr(i, golden::kIdLength));
  }
  return "a question that no report lists";
}

std::string listed(std::string_view title, const std::vector<ChangedFailure>& failures) {
  if (failures.empty()) return {};
  std::string text = fmt::format("{}: {}\n", title, failures.size());
  for (std::size_t i = 0; i < std::min(failures.size(), kNamedFailures); ++i)
    text += fmt::format("  {}\n", failures[i].text());
  if (failures.size() > kNamedFailures) text += fmt::format("  and {} more\n", failures.size() - kNamedFailures);
  return text;
}

}  // namespace

std::string ChangedFailure::text() const {
  return fmt::format("{} {}: {}{}", failure.id, failure.family, failure.what, was ? ", and was: " + *was : "");
}

Comparison::Comparison(const SavedReport& older, const SavedReport& newer) {
  compare_families(older, newer);
  compare_bits(older, newer);
  if (older.required == newer.required)
    compare_failures(older, newer);
  else
    notes_.push_back(fmt::format("Failures are not compared: {} was required, and now {}.", name(older.required),
                                 name(newer.required)));
  for (const SavedReport* report : {&older, &newer})
    if (report->failure_count != report->failures.size())
      not_listed_.push_back(fmt::format("{} lists {} of its {} failures: the others are not compared.", report->file(),
                                        report->failures.size(), report->failure_count));
}

std::string_view Comparison::word() const {
  if (change_.worse) return change_.better ? "MIXED" : "WORSE";
  return change_.better ? "BETTER" : "NO CHANGE";
}

std::string Comparison::sentence() const {
  if (change_.worse && change_.better) return "MIXED: some became worse and some better.";
  return fmt::format("{}{}.", word(), change_.worse || change_.better ? "" : " that counts");
}

std::vector<std::string> Comparison::notes() const {
  std::vector<std::string> all = notes_;
  all.insert(all.end(), not_listed_.begin(), not_listed_.end());
  return all;
}

std::string Comparison::text() const {
  std::string text;
  if (changed_ != 0) text += table_.text() + "\n";
  std::string below;
  for (const auto* lines : {&alone_, &notes_})
    for (const std::string& line : *lines) below += line + "\n";
  below += listed("New or worse failures", fresh_) + listed("Failures gone", gone_);
  for (const std::string& note : not_listed_) below += note + "\n";
  if (!below.empty()) text += below + "\n";
  return text + sentence() + "\n";
}

void Comparison::compare_bits(const SavedReport& older, const SavedReport& newer) {
  for (const SavedReport* report : {&older, &newer})
    if (report->answers.empty() && !(older.answers.empty() && newer.answers.empty()))
      notes_.push_back(
          fmt::format("{} does not say what the bits of its answers are: certify --determinism does.", report->file()));
  if (older.answers.empty() || newer.answers.empty()) return;
  std::map<std::string, const SavedAnswers*> before;
  for (const SavedAnswers& one : older.answers) before.emplace(one.title, &one);
  std::size_t differ = 0;
  std::size_t both = 0;
  std::string first;
  for (const SavedAnswers& now : newer.answers) {
    const auto it = before.find(now.title);
    if (it == before.end()) continue;
    ++both;
    if (it->second->sha256 == now.sha256) continue;
    if (differ++ == 0) first = fmt::format("{} in {}", first_difference(it->second->each, now.each), now.title);
  }
  if (differ != 0)
    same_bits_ = SameBits::differ;
  else if (both == older.answers.size() && both == newer.answers.size())
    same_bits_ = SameBits::same;
  notes_.push_back(differ == 0 ? "The reports have the same bits for every question that both were asked."
                               : fmt::format("The bits of the answers differ in {} {}, first in {}.", differ,
                                             differ == 1 ? "family" : "families", first));
}

void Comparison::compare_families(const SavedReport& older, const SavedReport& newer) {
  table_.row(
      {"family", "cases", "level", "missed", "false", "not finite", "unanswered", "beyond", "correctly rounded"});
  std::map<std::string, const SavedFamily*> before;
  for (const SavedFamily& f : older.families) before.emplace(f.title, &f);
  for (const SavedFamily& f : newer.families) {
    const auto it = before.find(f.title);
    if (it == before.end()) {
      alone_.push_back(fmt::format("{} ({} cases) is judged in the new report alone.", f.title, f.cases));
      continue;
    }
    compare_family(*it->second, f);
    before.erase(it);
  }
  for (const SavedFamily& f : older.families)
    if (before.contains(f.title))
      alone_.push_back(fmt::format("{} ({} cases) is judged in the old report alone.", f.title, f.cases));
}

void Comparison::compare_family(const SavedFamily& old, const SavedFamily& now) {
  bool differs = false;
  Change change;
  const auto cell = [&](const std::string& before, const std::string& after) {
    differs = differs || before != after;
    return before == after ? after : before + " -> " + after;
  };
  const auto count = [&](std::uint64_t before, std::uint64_t after) {
    change.became(before < after, after < before);
    return cell(std::to_string(before), std::to_string(after));
  };
  change.became(old.level < now.level, now.level < old.level);
  if (old.fields == now.fields)
    change.became(now.correctly_rounded<old.correctly_rounded, now.correctly_rounded> old.correctly_rounded);
  std::vector<std::string> cells{now.title,
                                 cell(std::to_string(old.cases), std::to_string(now.cases)),
                                 cell(std::string(name(old.level)), std::string(name(now.level))),
                                 count(old.missed_hits, now.missed_hits),
                                 count(old.false_hits, now.false_hits),
                                 count(old.not_finite, now.not_finite),
                                 count(old.unanswered, now.unanswered),
                                 count(old.beyond_bound, now.beyond_bound),
                                 cell(old.share_rounded(), now.share_rounded())};
  families_[now.title] = change;
  change_.became(change.worse, change.better);
  if (!differs) return;
  ++changed_;
  table_.row(std::move(cells));
}

void Comparison::compare_failures(const SavedReport& older, const SavedReport& newer) {
  // Of families that both judge: what became of the others is not known. Nor is what became of other fresh questions.
  const bool same_fresh = older.fresh == newer.fresh;
  if (!same_fresh && older.fresh_failure_count + newer.fresh_failure_count != 0)
    notes_.emplace_back("Failures on fresh questions are not compared: the reports asked others.");
  const auto by_id = [&](const SavedReport& report) {
    std::map<std::string, const Failure*> found;
    for (const auto* failures : {&report.failures, &report.fresh_failures})
      for (const Failure& f : *failures)
        if ((!f.fresh || same_fresh) && families_.contains(family_title(f.pair, f.family, f.scalar)))
          found.emplace(f.id, &f);
    return found;
  };
  const std::map<std::string, const Failure*> before = by_id(older);
  const std::map<std::string, const Failure*> after = by_id(newer);
  for (const auto& [id, f] : before)
    if (!after.contains(id)) gone_.push_back({*f});
  for (const auto& [id, f] : after) {
    const auto it = before.find(id);
    if (it == before.end())
      fresh_.push_back({*f});
    else if (f->level > it->second->level)
      fresh_.push_back({*f, it->second->what});
  }
  change_.became(!fresh_.empty(), !gone_.empty());
}

}  // namespace contact::tool
