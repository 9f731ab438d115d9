// Exams: questions without answers, made from a key that is used once. docs/exams.md
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "formats/arrays.hpp"
#include "tool/run/pipeline.hpp"

namespace contact::tool {

/// What an exam commits to beside its sources; its certificate has it too.
struct ExamTerms {
  std::string nonce{};                   ///< 64 hexadecimal digits of chance: the seed alone could be guessed
  std::string issued{};                  ///< a day
  std::string profile{};                 ///< empty: none
  bool asked_for_line = false;           ///< its line was asked for, to be published
  bool commits_to_nothing_else = false;  ///< as version 1 of keys: to generator, seed, nonce and sources alone
};

/// What an exam's questions come from, all of it kept by whoever sets the exam until it is closed.
struct ExamKey {
  ExamTerms terms;
  std::vector<Source> sources;  ///< generated ones, of one seed
  std::string questions;        ///< SHA-256 of the exam's lines behind the header
  std::string used_on;          ///< a day; empty: not yet
  std::string used_for;         ///< SHA-256 of the answers
};

/// The text of a SHA-256 in lower case; refused where it is none.
[[nodiscard]] std::string digest_at(const formats::Node& node);

/// SHA-256 of the text that says all of the questions: generator, seed, nonce, and the families with their counts; and
/// the terms.
[[nodiscard]] std::string commitment_of(const std::vector<Source>& sources, const ExamTerms& terms);

/// The one line that an examiner publishes before there are answers. Anybody who has it can compare a certificate with it.
[[nodiscard]] std::string published_line(const std::string& commitment, const std::string& questions);
/// What such a line says. Throws formats::InputError where it is none.
struct PublishedLine {
  std::string commitment;
  std::string questions;
};
[[nodiscard]] PublishedLine read_published_line(std::string_view line);

/// Calls visit for every question of an exam once, in an order in which families cannot be seen: that of the SHA-256 of
/// nonce and id.
using VisitExam = std::function<void(const engines::Question&, Scalar)>;
void for_each_exam_question(const std::vector<Source>& sources, const std::string& nonce, const VisitExam& visit);
/// SHA-256 of its lines, and how many they are.
struct ExamDigest {
  std::string sha256;
  std::uint64_t count = 0;
};
[[nodiscard]] ExamDigest exam_digest(const std::vector<Source>& sources, const std::string& nonce);

/// An exam on its way to its file, JSON lines or columns by what the name ends in: whole by commit(), or not at all.
class ExamFile {
 public:
  explicit ExamFile(const std::filesystem::path& path);
  void write(const ExamKey& key, const ExamDigest& questions);
  void commit() { file_.commit(); }

 private:
  std::optional<formats::ArraysForm> form_;
  formats::PendingFile file_;
};

/// A key's file, and the key in one. Throws formats::InputError where it is malformed, or was changed: it states what
/// it commits to.
[[nodiscard]] std::string key_text(const ExamKey& key);
[[nodiscard]] ExamKey read_key(const std::filesystem::path& path);

/// A key while it is put to use: nobody else can hold the same file meanwhile. Throws formats::InputError where
/// somebody does, or the file cannot be opened. It says nothing of copies.
class HeldKey {
 public:
  explicit HeldKey(const std::filesystem::path& path);
  HeldKey(const HeldKey&) = delete;
  HeldKey& operator=(const HeldKey&) = delete;
  ~HeldKey();

 private:
  int descriptor_ = -1;
};

/// The questions of an exam's file with their scalars, in its order. Throws formats::InputError where it is malformed,
/// or not what its header says.
struct ExamQuestion {
  engines::Question question;
  Scalar scalar;
};
struct Exam {
  std::string commitment;
  std::string questions;  ///< SHA-256 of its lines behind the header
  std::vector<ExamQuestion> all;
};
[[nodiscard]] Exam read_exam(const std::filesystem::path& path);

}  // namespace contact::tool
