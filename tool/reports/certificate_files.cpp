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

CertificateFiles::CertificateFiles(CertificateOptions options, EngineOptions engine)
    : options_(std::move(options)), engine_(std::move(engine)) {
  if (options_.none()) return;
  const bool recorded = !engine_.results.empty();  // then the answers are a file already
  if (!recorded && options_.record.empty())
    options_.record = std::filesystem::path(options_.certificate).replace_extension(".answers.jsonl").string();
  if (options_.record == options_.certificate)
    throw formats::InputError({options_.record, 0}, "", "the certificate and the answers are two files");
  if (!recorded) answers_ = std::make_unique<formats::OutputFile>(options_.record);
  if (options_.certificate.empty()) return;
  try {
    static_cast<void>(nlohmann::json(engine_.command).dump());
  } catch (const nlohmann::json::exception&) {
    throw formats::InputError({options_.certificate, 0}, "--engine-command",
                              "is not UTF-8, so no certificate can state it");
  }
  issued_ = issue_date();
  certificate_ = std::make_unique<formats::OutputFile>(options_.certificate);
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
  const std::string& results = answers_ != nullptr ? options_.record : engine_.results;
  const std::string text = answers_ != nullptr ? recording_->results() : "";
  std::string certificate;
  if (certificate_ != nullptr) {
    if (baseline != nullptr && report.failures.size() != report.failure_count)
      throw formats::InputError({options_.certificate, 0}, "accepted",
                                fmt::format("{} failures, and a report lists {}: too many to accept one by one",
                                            report.failure_count, report.failures.size()));
    const std::filesystem::path folder = folder_of(options_.certificate);
    const std::filesystem::path common = common_folder(sources);
    Stated stated{issued_, environment(), provenance(engine_, folder), "", {}, seen_from(folder, results), exam};
    if (!common.empty()) stated.folder = seen_from(folder, common);
    for (const Source& source : sources)
      stated.names.push_back(source.dataset ? seen_from(common, *source.dataset) : "");
    const std::string digest = answers_ != nullptr ? formats::Sha256().add(text).hex() : digest_of_file(results);
    const std::uint64_t count = answers_ != nullptr ? recording_->answers() : engines::count_recorded(results);
    certificate = certificate_text(statement({report, sources, oracles, baseline, digest, count}, stated));
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
    say("\nCertificate: {}, of the answers in {}\n", options_.certificate,
        answers_ != nullptr ? options_.record : engine_.results);
  else if (answers_ != nullptr)
    say("\nAnswers: {}\n", options_.record);
}

}  // namespace contact::tool
