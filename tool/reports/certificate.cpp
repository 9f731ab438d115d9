// A certificate: what an engine answered to which questions, and what came of it.
#include "tool/reports/certificate.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string_view>

#include "engines/adapters.hpp"
#include "engines/hosts/subprocess.hpp"
#include "engines/protocol/results.hpp"
#include "formats/program.hpp"
#include "formats/sha256.hpp"
#include "golden/dataset.hpp"
#include "golden/query_id.hpp"
#include "tool/reports/table.hpp"
#include "tool/run/parts.hpp"

namespace contact::tool {
namespace {

using nlohmann::json;

constexpr std::string_view kDigestKey = "\n\"sha256\":\"";  // a line of its own: that of the certificate, and no other
constexpr std::size_t kDigits = 64;

/// SHA-256 of the questions of a source, a line each as `explain` reads it.
std::string questions_digest(const Source& source) {
  formats::Sha256 digest;
  for_each_question(source, [&](const engines::Question& question) {
    digest.add(golden::query_line(question.query, source.scalar)).add("\n");
  });
  return digest.hex();
}

json source_json(const Source& source, const std::string& file) {
  json stated{{"pair", name(source.pair)},
              {"scalar", name(source.scalar)},
              {"family", source.family},
              {"count", source.count},
              {"questions", questions_digest(source)}};
  if (source.fresh) stated["fresh"] = true;
  if (source.dataset) {
    stated["file"] = file;
    stated["sha256"] = digest_of_file(*source.dataset);
  } else {
    stated["generator"] = golden::kGenerator;
    stated["seed"] = source.seed;
  }
  return stated;
}

/// What an engine declares, and where it came from.
json engine_json(const engines::EngineInfo& info, const json& provenance) {
  json declared = json::parse("{" + engines::engine_text(info) + "}");
  json engine = declared.at("engine");
  declared.erase("engine");
  engine.update(declared);
  engine.update(provenance);
  return engine;
}

json fields_json(const FamilyReport& family) {
  json fields = json::object();
  for (const Field field : oracle::kFields) {
    const FieldCount& count = family.fields[static_cast<std::size_t>(field)];
    if (count.judged() == 0) continue;
    std::size_t worst = count.grades.size() - 1;
    while (count.grades[worst] == 0) --worst;
    fields[std::string(name(field))] = {{"judged", count.judged()},
                                        {"grade", name(static_cast<Grade>(worst))},
                                        {"worst_ulps", std::isfinite(count.worst) ? json(count.worst) : "Infinity"}};
  }
  return fields;
}

json missing_json(const FamilyReport& family) {
  json missing = json::object();
  for (std::size_t i = 0; i < family.missing.size(); ++i)
    if (family.missing[i] != 0) missing[std::string(kAspectNames[i])] = family.missing[i];
  return missing;
}

json length_json(double length) { return std::isfinite(length) ? json(length) : json("Infinity"); }

json counts_json(const FamilyReport& f, bool allow_unsupported) {
  using Status = Claim::Status;
  return {{"cases", f.cases},
          {"judged", f.judged(allow_unsupported)},
          {"accepted", f.accepted},
          {"hits", f.hits},
          {"missed_hits", f.missed_hits},
          {"false_hits", f.false_hits},
          {"farthest_false_hit",
           f.farthest_false_hit.question.empty() ? json(nullptr) : length_json(f.farthest_false_hit.off)},
          {"outside_domain", f.outside_domain},
          {"refused", f.refused},
          {"decided", {{"hits", f.decided.hits}, {"misses", f.decided.misses}}},
          {"missing_fields", missing_json(f)},
          {"not_finite", f.not_finite},
          {"level", name(f.level(allow_unsupported))},
          // A crash and a timeout leave nothing to record: to whoever reads the answers, they are missing.
          {"answers",
           {{"answered", f.with(Status::answered)},
            {"unsupported", f.with(Status::unsupported)},
            {"rejected", f.with(Status::rejected)},
            {"error", f.with(Status::error)},
            {"missing", f.with(Status::missing) + f.with(Status::timeout) + f.with(Status::crash)}}},
          {"fields", fields_json(f)}};
}

json found_json(const Report& report) {
  const FamilyReport all = report.total();
  const std::uint64_t given = all.cases + report.skipped_cases();
  json families = json::array();
  for (const FamilyReport& f : report.families) {
    json counts = counts_json(f, report.allow_unsupported);
    counts.update({{"source", f.source}, {"pair", name(f.pair)}, {"scalar", name(f.scalar)}, {"family", f.family}});
    families.push_back(std::move(counts));
  }
  json skipped = json::array();
  for (const Skipped& s : report.skipped) skipped.push_back({{"source", s.source}, {"why", s.why}, {"cases", s.cases}});
  json fresh = nullptr;
  if (report.fresh && !report.fresh->none.empty())
    fresh = {{"each", 0}, {"none", report.fresh->none}};
  else if (report.fresh)
    fresh = {{"each", report.fresh->each},
             {"seed", report.fresh->seed},
             {"given", report.fresh_total().cases + report.skipped_cases(true)},
             {"total", counts_json(report.fresh_total(), report.allow_unsupported)}};
  json found{{"required", name(report.required)},
             {"within", report.within ? json(*report.within) : json(nullptr)},
             {"least_judged", report.least_judged},
             {"falls_short", report.right() ? json(report.falls_short()) : json::array()},
             {"fresh", std::move(fresh)},
             {"allow_unsupported", report.allow_unsupported},
             {"certified", report.certified()},
             {"claims", report.engine.declared.claimed().names()},
             {"not_claimed", report.aspects_not_claimed().names()},
             {"one_answer", all.one_answer() ? json(*all.one_answer()) : json(nullptr)},
             {"level_but_accepted", name(report.level_but_accepted())},
             {"given", given},
             {"share_judged", percent(report.judged(), std::max<std::uint64_t>(given, 1), "{:.6g}")},
             {"total", counts_json(all, report.allow_unsupported)},
             {"families", std::move(families)},
             {"skipped", std::move(skipped)}};
  if (report.repeats) {
    found["same_bits"] = report.repeats->same();
    found["ways"] = report.repeats->ways.size();
    found["answers_again"] = report.repeats->sha256;
  }
  if (report.tolerance()) {
    found["tolerance"] = json::parse(engines::tolerance_object(*report.tolerance()));
    found["beyond_tolerance"] = report.all().fitness.beyond;
  }
  return found;
}

json accepted_json(const Report& report, const Baseline* baseline) {
  json accepted = json::array();
  for (const Failure& f : report.failures) {
    if (!f.accepted || baseline == nullptr) continue;
    const Acceptance& why = baseline->acceptance(f.id);
    accepted.push_back({{"id", f.id},
                        {"pair", name(f.pair)},
                        {"scalar", name(f.scalar)},
                        {"family", f.family},
                        {"level", name(f.level)},
                        {"reason", why.reason},
                        {"expires", why.expires}});
  }
  return accepted;
}

json oracle_json(const Oracles& oracles) {
  json decided = json::object();
  for (std::size_t i = 0; i < oracle::kStageNames.size(); ++i)
    decided[std::string(oracle::kStageNames[i])] = oracles.decided.answers[i];
  return {{"version", formats::version()},
          {"check", kCheckNames[static_cast<std::size_t>(oracles.check)]},
          {"decided", std::move(decided)},
          {"put_to_all_oracles", oracles.checked}};
}

std::string layout(const json& value, bool whole = false) {
  std::string text;
  if (value.is_object()) {
    for (const auto& [key, inner] : value.items())
      text += fmt::format("{}{}{}:{}", text.empty() ? "" : ",", whole ? "\n" : "", formats::json_string(key),
                          layout(inner));
    return "{" + text + (whole ? "\n}\n" : "}");
  }
  if (!value.is_array() || value.empty() || !value.front().is_object()) return value.dump();
  for (const json& inner : value) text += (text.empty() ? "\n" : ",\n") + layout(inner);
  return "[" + text + "]";
}

/// Where the digits of the digest begin.
std::size_t digest_place(const std::string& text, const formats::Location& where) {
  const std::size_t key = text.find(kDigestKey);
  const std::size_t begin = key + kDigestKey.size();
  if (key == std::string::npos || begin + kDigits >= text.size() || text[begin + kDigits] != '"')
    throw formats::InputError(where, "sha256", "expected a line of its own with 64 hexadecimal digits");
  return begin;
}

/// Absolute first: the standard library leaves the name of a file that is not there yet as relative as it is.
std::filesystem::path resolved(const std::filesystem::path& path) {
  std::error_code unreachable;  // then as it is named
  const std::filesystem::path absolute = std::filesystem::absolute(path);
  std::filesystem::path found = std::filesystem::weakly_canonical(absolute, unreachable);
  return unreachable ? absolute : found;
}

/// Not where it cannot be reached, or where a text is too long to be a name.
bool is_file(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::is_regular_file(path, none);
}

/// The file that a shell would start for a name without a slash.
std::filesystem::path on_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/usr/bin:/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::filesystem::path file = std::filesystem::path(folder.empty() ? "." : folder) / program;
    if (is_file(file) && ::access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

}  // namespace

json statement(const Judged& judged, const Stated& stated) {
  const Report& report = judged.report;
  json sources = json::array();
  for (std::size_t i = 0; i < judged.sources.size(); ++i)
    sources.push_back(source_json(judged.sources[i], stated.names[i]));
  json questions{{"sources", std::move(sources)}};
  if (!stated.folder.empty()) questions["folder"] = stated.folder;
  json whole{{"format", "contact-oracle/certificate"},
             {"version", 1},
             {"issued", stated.issued},
             {"environment", stated.environment},
             {"oracle", oracle_json(judged.oracles)},
             {"engine", engine_json(report.engine, stated.engine)},
             {"questions", std::move(questions)},
             {"answers",
              {{"file", stated.answers},
               {"sha256", judged.answers_sha256},
               {"count", judged.answers},
               {"to_no_question", report.unknown_answers.size()}}},
             {"found", found_json(report)},
             {"accepted", accepted_json(report, judged.baseline)}};
  if (const ExamTerms& exam = stated.exam; !exam.nonce.empty()) {
    const std::string commitment = commitment_of(judged.sources, exam);
    const std::string asked = exam_digest(judged.sources, exam.nonce).sha256;
    whole["exam"] = {{"nonce", exam.nonce}, {"commitment", commitment}, {"questions", asked}};
    if (!exam.commits_to_nothing_else)
      whole["exam"].update({{"issued", exam.issued},
                            {"profile", exam.profile.empty() ? json() : json(exam.profile)},
                            {"published", exam.asked_for_line ? json(published_line(commitment, asked)) : json()}});
  }
  return whole;
}

std::string certificate_text(json statement) {
  statement["sha256"] = std::string(kDigits, '0');
  std::string text = layout(statement, true);
  const formats::Location where{"certificate", 0};
  return text.replace(digest_place(text, where), kDigits, certificate_digest(text, where));
}

std::string certificate_digest(const std::string& text, const formats::Location& where) {
  std::string blank = text;
  blank.replace(digest_place(text, where), kDigits, kDigits, '0');
  return formats::Sha256().add(blank).hex();
}

CertificateText::CertificateText(const std::filesystem::path& path)
    : where_{path.string(), 0}, text_(formats::read_text(path)) {
  json_ = formats::parse_object(text_, where_);
  const formats::Node root = node();
  if (const formats::Node format = root.at("format"); format.text() != "contact-oracle/certificate")
    format.refuse("expected \"contact-oracle/certificate\", what certify --certificate writes");
  if (const formats::Node version = root.at("version"); version.count() != 1)
    version.refuse("this program reads version 1");
  static_cast<void>(root.at("sha256").text());
}

std::vector<Difference> CertificateText::in_itself() const {
  std::vector<Difference> found;
  const std::string digest = certificate_digest(text_, where_);
  if (const std::string said = node().at("sha256").text(); said != digest)
    found.push_back({"/sha256", said, digest + ": the certificate was changed"});
  json content = json_;
  content.erase("sha256");
  if (found.empty() && certificate_text(std::move(content)) != text_)
    found.push_back({"", "these bytes", "others: the form is not the canonical one"});
  return found;
}

json provenance(const EngineOptions& options, const std::filesystem::path& folder) {
  json files = json::array();
  const auto add = [&](const char* key, const std::string& name, const std::filesystem::path& file) {
    files.push_back({{key, name}, {"sha256", digest_of_file(file)}});
  };
  if (!options.results.empty()) return {{"kind", "recorded"}, {"files", std::move(files)}};
  if (!options.library.empty()) {
    add("file", seen_from(folder, options.library), options.library);
    return {{"kind", "library"}, {"files", std::move(files)}};
  }
  if (const engines::Adapter* adapter = engines::find_adapter(options.engine)) {
    for (const std::filesystem::path& file : engines::files_of(*adapter)) add("file", seen_from(folder, file), file);
    return {{"kind", "adapter"}, {"files", std::move(files)}};
  }
  if (options.command.empty()) {
    add("program", "contact-oracle", "/proc/self/exe");
    return {{"kind", "built-in"}, {"files", std::move(files)}};
  }
  const std::vector<std::string> words = engines::split_words(options.command);
  for (const std::string& word : words) {
    const bool by_name = &word == &words.front() && word.find('/') == std::string::npos;
    if (by_name) {
      if (const auto found = on_path(word); !found.empty()) add("program", word, found);
    } else if (is_file(word)) {
      add("file", seen_from(folder, word), word);
    }
  }
  return {{"kind", "command"}, {"command", options.command}, {"files", std::move(files)}};
}

std::filesystem::path common_folder(const std::vector<Source>& sources) {
  std::filesystem::path common;
  for (const Source& source : sources) {
    if (!source.dataset) continue;
    const std::filesystem::path folder = folder_of(*source.dataset);
    if (common.empty()) common = folder;
    std::filesystem::path shared;
    const auto end = std::mismatch(common.begin(), common.end(), folder.begin(), folder.end()).first;
    for (auto step = common.begin(); step != end; ++step) shared /= *step;
    common = shared;
  }
  return common;
}

std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& path) {
  return resolved(path).lexically_relative(folder).generic_string();
}

std::filesystem::path folder_of(const std::filesystem::path& file) { return resolved(file).parent_path(); }

}  // namespace contact::tool
