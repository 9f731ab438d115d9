// What `certify --certificate` and `--record` write.
#include "tool/reports/certificate_files.hpp"
#include "formats/sha256.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "golden/query_id.hpp"
#include "tool/run/date.hpp"
#include "tool/run/environment.hpp"
#include "tool/run/parts.hpp"
#include "tool/run/printing.hpp"

namespace contact::tool {
namespace {

/// JSON cannot state a name that is not UTF-8, and who verifies would look for another.
void require_utf8(const nlohmann::json& stated, const std::string& file, const std::string& what) {
  try {
    static_cast<void>(stated.dump());
  } catch (const nlohmann::json::exception&) {
    throw formats::InputError({file, 0}, what, "is not UTF-8, so no certificate can state it");
  }
}

}  // namespace

void add_certificate_options(CLI::App& command, CertificateOptions& options) {
  command
      .add_option("--certificate", options.certificate,
                  "Write a certificate, which `verify` checks offline, and beside it the engine's answers: F.json "
                  "and F.answers.jsonl")
      ->type_name("FILE")
      ->group("Reports");
  command.add_option("--record", options.record, "Write the engine's answers as a results file, which --results reads")
      ->type_name("FILE")
      ->group("Reports")
      ->excludes("--results");
}

std::string CertificateOptions::answers(bool recorded) const {
  if (!record.empty() || recorded || certificate.empty()) return record;
  return std::filesystem::path(certificate).replace_extension(".answers.jsonl").string();
}

CertificateFiles::CertificateFiles(CertificateOptions options, EngineOptions engine)
    : options_(std::move(options)), engine_(std::move(engine)) {
  if (options_.none()) return;
  const bool recorded = !engine_.results.empty();  // then the answers are a file already
  options_.record = options_.answers(recorded);
  if (options_.record == options_.certificate)
    throw formats::InputError({options_.record, 0}, "", "the certificate and the answers are two files");
  if (!recorded) answers_ = std::make_unique<formats::OutputFile>(options_.record);
  if (options_.certificate.empty()) return;
  require_utf8(engine_.command, options_.certificate, "--engine-command");
  stated_.issued = issue_date();
  certificate_ = std::make_unique<formats::OutputFile>(options_.certificate);
}

const std::string& CertificateFiles::results() const { return answers_ != nullptr ? options_.record : engine_.results; }

void CertificateFiles::name(const std::vector<Source>& sources) {
  if (certificate_ == nullptr) return;
  const std::filesystem::path folder = folder_of(options_.certificate);
  const std::filesystem::path common = common_folder(sources);
  require_utf8(provenance(engine_, folder), options_.certificate, "the name of an engine's file");
  stated_.answers = seen_from(folder, results());
  require_utf8(stated_.answers, results(), "its name");
  if (!common.empty()) stated_.folder = seen_from(folder, common);
  require_utf8(stated_.folder, common.string(), "its name");
  for (const Source& source : sources) {
    stated_.names.push_back(source.dataset ? seen_from(common, *source.dataset) : "");
    if (source.dataset) require_utf8(stated_.names.back(), source.dataset->string(), "its name");
  }
}

std::unique_ptr<engines::Engine> CertificateFiles::watched(std::unique_ptr<engines::Engine> engine) {
  if (answers_ == nullptr) return engine;
  auto recording = std::make_unique<engines::Recording>(std::move(engine));
  recording_ = recording.get();
  return recording;
}

engines::Engine& CertificateFiles::unwatched(engines::Engine& engine) const {
  return recording_ != nullptr ? recording_->recorded() : engine;
}

void CertificateFiles::write(const Report& report, const std::vector<Source>& sources, const Oracles& oracles,
                             const Baseline* baseline, const ExamTerms& exam) {
  const std::string text = answers_ != nullptr ? recording_->results() : "";
  std::string certificate;
  if (certificate_ != nullptr) {
    if (baseline != nullptr && report.failures.size() != report.failure_count)
      throw formats::InputError({options_.certificate, 0}, "accepted",
                                fmt::format("{} failures, and a report lists {}: too many to accept one by one",
                                            report.failure_count, report.failures.size()));
    stated_.environment = environment();
    stated_.engine = provenance(engine_, folder_of(options_.certificate));
    stated_.exam = exam;
    const std::string digest = answers_ != nullptr ? formats::Sha256().add(text).hex() : digest_of_file(results());
    const std::uint64_t count = answers_ != nullptr ? recording_->answers() : engines::count_recorded(results());
    certificate = certificate_text(statement({report, sources, oracles, baseline, digest, count}, stated_));
  }
  // The answers first: a certificate never lies beside answers that it is not of.
  if (answers_ != nullptr) {
    answers_->write(text);
    answers_->commit();
  }
  if (certificate_ != nullptr) {
    certificate_->write(certificate);
    certificate_->commit();
  }
}

void CertificateFiles::tell() const {
  if (certificate_ != nullptr)
    say("\nCertificate: {}, of the answers in {}\n", options_.certificate, results());
  else if (answers_ != nullptr)
    say("\nAnswers: {}\n", options_.record);
}

}  // namespace contact::tool
