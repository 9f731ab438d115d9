// What an earlier run left in its --json report.
#include "tool/reports/saved_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "engines/protocol/results.hpp"
#include "golden/dataset.hpp"
#include "tool/reports/fitness.hpp"
#include "tool/reports/table.hpp"
#include "tool/run/date.hpp"

namespace contact::tool {
namespace {

using formats::Node;
using oracle::Field;
using oracle::Level;

Level level_of(const Node& node) { return static_cast<Level>(node.one_of(oracle::kLevelNames)); }

/// "pair", "family" and "scalar" as one title, which nothing before it in the list has. `titles` are those, each with the
/// number that was last put behind it.
std::string read_title(const Node& node, std::map<std::string, std::size_t>& titles) {
  const std::string title = family_title(golden::read_pair(node.at("pair")), node.at("family").text(),
                                         golden::read_scalar(node.at("scalar")));
  std::string own = title;
  while (!titles.try_emplace(own, 1).second) own = fmt::format("{} ({})", title, ++titles.at(title));
  return own;
}

SavedFamily read_counts(std::string title, const Node& node) {
  SavedFamily family{std::move(title),
                     node.at("cases").count(),
                     node.at("missed_hits").count(),
                     node.at("false_hits").count(),
                     node.at("not_finite").count(),
                     0,
                     0,
                     0,
                     0,
                     level_of(node.at("level"))};
  for (const std::string_view status : std::span(kStatusNames).subspan<1>())  // all but `answered`
    family.unanswered += node.at("answers").at(status).count();
  const Node fields = node.at("fields");
  for (const Field field : oracle::kFields)
    if (const auto counts = fields.find(oracle::name(field))) {
      family.fields += counts->at("judged").count();
      family.correctly_rounded += counts->at("correctly_rounded").count();
      family.beyond_bound += counts->at("beyond_bound").count();
    }
  // Reports of before 0.2.0 say more of questions without numbers.
  if (family.fields == 0) family.level = std::max(family.level, Level::decisions);
  if (const auto everyday = node.find("everyday")) {
    family.everyday = SavedFitness{everyday->at("answers").count(), everyday->at("never").count(), {}};
    for (std::size_t i = 0; i < oracle::kMeasures.size(); ++i)
      family.everyday->needs[i] = everyday->at("needs").at(oracle::kMeasureNames[i]).at("from").number();
  }
  return family;
}

/// "reason" and "expires" of a failure, or of a report for all its failures: what is absent stays as it is.
void read_acceptance(const Node& node, Failure& into) {
  if (const auto reason = node.find("reason")) {
    into.reason = reason->text();
    if (into.reason.empty()) reason->refuse("a reason says why");
  }
  if (const auto expires = node.find("expires")) {
    into.expires = expires->text();
    if (!is_date(into.expires)) expires->refuse("expected a day, YYYY-MM-DD");
  }
}

Failure read_failure(const Node& node) {
  Failure failure{node.at("id").text(),     golden::read_pair(node.at("pair")), golden::read_scalar(node.at("scalar")),
                  node.at("family").text(), level_of(node.at("level")),         node.at("what").text()};
  read_acceptance(node, failure);
  if (node.find("a")) failure.question = golden::read_inputs(node, failure.pair);
  return failure;
}

}  // namespace

std::string family_title(Pair pair, std::string_view family, Scalar scalar) {
  return fmt::format("{}/{}{}", name(pair), family, scalar == Scalar::binary32 ? ".f32" : "");
}

std::string SavedFamily::share_rounded() const {
  if (fields == 0) return "-";
  return percent(correctly_rounded, fields, "{:.2f}");
}

std::string SavedReport::demand() const {
  if (tolerance) return "a tolerance of " + tolerance_text(*tolerance);
  return fmt::format("{}{}", name(required), within ? fmt::format(" within {}", *within) : "");
}

SavedReport read_report(const std::filesystem::path& path) {
  const std::string text = formats::read_text(path);
  const formats::Location where{path.string(), 0};
  // There may be a hundred thousand failures: none is kept as JSON.
  std::vector<Failure> failures;
  const auto json =
      formats::parse_object(text, where, [&](const std::string& key, std::size_t index, const nlohmann::json& element) {
        if (key != "failures") return true;
        failures.push_back(read_failure(Node(element, where, fmt::format("failures[{}]", index))));
        return false;
      });
  const Node report(json, where);
  if (const Node format = report.at("format"); format.text() != "contact-oracle/report")
    format.refuse("expected \"contact-oracle/report\", what certify --json writes");
  if (const Node version = report.at("version"); version.count() != 1) version.refuse("expected version 1");
  SavedReport saved{path,
                    report.at("engine").at("name").text(),
                    report.at("engine").at("version").text(),
                    level_of(report.at("required")),
                    report.at("verdict").text(),
                    {},
                    {},
                    report.at("failure_count").count()};
  std::map<std::string, std::size_t> titles;
  for (const Node& family : report.at("families").items())
    saved.families.push_back(read_counts(read_title(family, titles), family));
  titles.clear();
  if (const auto determinism = report.find("determinism"))
    for (const Node& source : determinism->at("sources").items())
      saved.answers.push_back({read_title(source, titles), source.at("sha256").text(), source.at("each").text()});
  saved.total = read_counts("", report.at("total"));
  if (const auto tolerance = report.find("tolerance"); tolerance && !tolerance->is_null())
    saved.tolerance = engines::read_tolerance(*tolerance);
  if (const auto within = report.find("within"); within && !within->is_null()) saved.within = within->number();
  Failure of_all{};
  read_acceptance(report, of_all);
  for (const Node& other : report.at("failures").items()) failures.push_back(read_failure(other));  // that is no object
  if (const auto fresh = report.find("fresh"); fresh && !fresh->is_null()) {
    if (const std::uint64_t each = fresh->at("each").count(); each != 0) {
      saved.fresh = AskedFresh{each, fresh->at("seed").count()};
      saved.fresh_failure_count = fresh->at("failure_count").count();
      for (const Node& failure : fresh->at("failures").items()) {
        saved.fresh_failures.push_back(read_failure(failure));
        saved.fresh_failures.back().fresh = true;
      }
    }
  }
  for (std::vector<Failure>* list : {&failures, &saved.fresh_failures})
    for (Failure& failure : *list) {
      if (failure.reason.empty()) failure.reason = of_all.reason;
      if (failure.expires.empty()) failure.expires = of_all.expires;
    }
  saved.failures = std::move(failures);
  return saved;
}

Baseline::Baseline(const SavedReport& report, const std::string& today)
    : path_(report.path.string()), engine_(report.engine) {
  const std::uint64_t count = report.failure_count + report.fresh_failure_count;
  std::vector<Failure> all = report.failures;
  all.insert(all.end(), report.fresh_failures.begin(), report.fresh_failures.end());
  if (count != all.size())
    throw formats::InputError({path_, 0}, "failures",
                              fmt::format("lists {} of {} failures: too many to accept one by one", all.size(), count));
  for (const Failure& f : all) {
    if (!f.expires.empty() && f.expires < today) {
      expired_.push_back(
          fmt::format("{} was accepted until {}{}{}", f.id, f.expires, f.reason.empty() ? "" : ": ", f.reason));
      continue;
    }
    const auto [it, is_new] = accepted_.try_emplace(f.id, Acceptance{f.level, f.reason, f.expires});
    // The question stands in a file of each scalar: what it may do in one it may do in the other.
    if (!is_new) it->second.level = std::max(it->second.level, f.level);
  }
}

std::optional<std::string> Baseline::unexplained() const {
  const auto it = std::find_if(accepted_.begin(), accepted_.end(), [](const auto& entry) {
    return entry.second.reason.empty() || entry.second.expires.empty();
  });
  return it == accepted_.end() ? std::nullopt : std::optional(it->first);
}

bool Baseline::accepts(const std::string& id, Level level) const {
  const auto it = accepted_.find(id);
  return it != accepted_.end() && level <= it->second.level;
}

}  // namespace contact::tool
