// What `certify --certificate` and `--record` write: the certificate, and the answers that it is of.
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <string>

#include "engines/hosts/recording.hpp"
#include "formats/output_file.hpp"
#include "tool/reports/certificate.hpp"

namespace contact::tool {

struct CertificateOptions {
  std::string certificate;
  std::string record;  ///< the answers; empty: beside the certificate

  [[nodiscard]] bool none() const { return certificate.empty() && record.empty(); }
  /// The answers' file; empty where none is written, as answers that are recorded already are a file.
  [[nodiscard]] std::string answers(bool recorded) const;
};

void add_certificate_options(CLI::App& command, CertificateOptions& options);

/// The files are opened before the work, so that a name that cannot be written is refused at once.
class CertificateFiles {
 public:
  CertificateFiles(CertificateOptions options, EngineOptions engine);

  /// The engine to ask in the place of `engine`: one that keeps the answers, where they are to be written.
  [[nodiscard]] std::unique_ptr<engines::Engine> watched(std::unique_ptr<engines::Engine> engine);
  /// The engine that was given, of which nothing is kept.
  [[nodiscard]] engines::Engine& unwatched(engines::Engine& engine) const;
  /// Puts down how the certificate names what it is of. Throws formats::InputError where a name is not UTF-8.
  void name(const std::vector<Source>& sources);
  /// Writes what is asked for. Precondition: name() was called, with the same sources. `exam`: the terms of its key,
  /// where the questions are an exam's. Throws formats::InputError where there are more failures than a report lists
  /// and some are accepted.
  void write(const Report& report, const std::vector<Source>& sources, const Oracles& oracles, const Baseline* baseline,
             const ExamTerms& exam = {});
  /// Says what was written.
  void tell() const;

 private:
  [[nodiscard]] const std::string& results() const;  ///< the file of the answers

  CertificateOptions options_;
  EngineOptions engine_;
  Stated stated_;
  std::unique_ptr<formats::OutputFile> answers_;
  std::unique_ptr<formats::OutputFile> certificate_;
  engines::Recording* recording_ = nullptr;
};

}  // namespace contact::tool
