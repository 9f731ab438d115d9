// A certificate: what an engine answered to which questions, and what came of it, bound together by digests.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "formats/json.hpp"
#include "tool/commands/engine_options.hpp"
#include "tool/run/exam.hpp"
#include "tool/run/pipeline.hpp"

namespace contact::tool {

/// What a certificate states that its dataset and its answers cannot say again, and the names of its files.
struct Stated {        // NOLINT(bugprone-exception-escape): the destructor of JSON allocates, and would end the program
  std::string issued;  ///< a day
  nlohmann::json environment;      ///< that of the run
  nlohmann::json engine;           ///< where it came from: provenance()
  std::string folder;              ///< that the names of the datasets begin in, seen from the certificate's
  std::vector<std::string> names;  ///< of the datasets, in the order of the sources; empty for a generated one
  std::string answers;             ///< the results file, seen from the certificate's folder
  ExamTerms exam{};                ///< without a nonce where the questions are of no exam
};

/// What a run did, whether the engine was asked or its answers were read.
struct Judged {
  const Report& report;
  const std::vector<Source>& sources;
  const Oracles& oracles;
  const Baseline* baseline;  ///< nullptr: none
  std::string answers_sha256;
  std::uint64_t answers;  ///< how many the results file holds
};

/// The whole statement, its own digest left out.
[[nodiscard]] nlohmann::json statement(const Judged& judged, const Stated& stated);

/// The one text of a statement: keys in the order of their bytes, no spaces, a line for each key and for each object
/// in an array, and the digest put in. It is the SHA-256 of this very text with 64 zeros in its own place.
[[nodiscard]] std::string certificate_text(nlohmann::json statement);
/// The digest that a certificate's text has, whatever it says of itself. Throws formats::InputError where the text has
/// no place for it.
[[nodiscard]] std::string certificate_digest(const std::string& text, const formats::Location& where);

/// One thing that a certificate states and that is otherwise.
struct Difference {
  std::string pointer;  ///< of JSON
  std::string stated;
  std::string derived;
};

/// A certificate as it was read.
class CertificateText {
 public:
  /// Throws formats::InputError where it is none, or one of another version.
  explicit CertificateText(const std::filesystem::path& path);

  [[nodiscard]] const nlohmann::json& stated() const { return json_; }
  [[nodiscard]] formats::Node node() const { return {json_, where_}; }
  /// What is wrong with the text alone: its digest, or its form.
  [[nodiscard]] std::vector<Difference> in_itself() const;

 private:
  formats::Location where_;
  std::string text_;
  nlohmann::json json_;
};

/// "kind", "command" and "files" of an engine: the program and every file that its command names, with their digests.
/// A program that is found by its name alone (python3) is stated as "program"; a "file" is seen from `folder`.
[[nodiscard]] nlohmann::json provenance(const EngineOptions& options, const std::filesystem::path& folder);

/// The deepest folder that all datasets of a run lie in; empty where there is none.
[[nodiscard]] std::filesystem::path common_folder(const std::vector<Source>& sources);
/// A path as seen from a folder.
[[nodiscard]] std::string seen_from(const std::filesystem::path& folder, const std::filesystem::path& path);
/// The folder that a file stands in, or will stand in.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& file);

}  // namespace contact::tool
