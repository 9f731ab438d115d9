// exam: questions without answers, made from a key that is used once: new, take, close.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <memory>
#include <random>

#include "engines/hosts/recording.hpp"
#include "formats/output_file.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/demand.hpp"
#include "tool/commands/engine_options.hpp"
#include "tool/reports/certificate_files.hpp"
#include "tool/reports/report_files.hpp"
#include "tool/run/date.hpp"
#include "tool/run/exam.hpp"
#include "tool/run/parts.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"
#include "tool/run/profiles.hpp"

namespace contact::tool {
namespace {

using formats::InputError;

struct NewOptions {
  std::string output;
  std::string key;
  std::string profile;
  std::vector<std::string> pairs;
  std::vector<std::string> families;
  std::uint64_t count = 0;
  std::string scalar;
  std::optional<std::uint64_t> seed;
  bool commit = false;
};

constexpr std::uint64_t kQuestionsOfAFamily = 100;

/// The families of an exam: those that are named, else all but what the profile leaves out.
std::vector<Source> sources_of(const NewOptions& o, std::uint64_t seed) {
  const Profile* profile = o.profile.empty() ? nullptr : &profile_of(o.profile);
  const Scalar scalar = !o.scalar.empty() ? named(kScalars, o.scalar) : profile ? profile->scalar : Scalar::binary64;
  const std::uint64_t count = o.count != 0 ? o.count : profile ? profile->count : kQuestionsOfAFamily;
  const auto left_out = profile ? profile->left_out : std::span<const std::string_view>(kOutOfTheDomain);
  if (std::find(o.families.begin(), o.families.end(), "invalid") != o.families.end())
    throw InputError({"exam new", 0}, "--family", "invalid has questions outside the domain, and an exam has none");
  std::vector<std::string> unknown = o.families;
  std::vector<Source> sources;
  for (const Pair pair : kPairs) {
    if (!o.pairs.empty() && std::find(o.pairs.begin(), o.pairs.end(), name(pair)) == o.pairs.end()) continue;
    for (const golden::Family& family : golden::families_of(pair)) {
      std::erase(unknown, family.name);
      const bool is_named = std::find(o.families.begin(), o.families.end(), family.name) != o.families.end();
      const bool is_out = std::find(left_out.begin(), left_out.end(), family.name) != left_out.end();
      if (o.families.empty() ? !is_out : is_named)
        sources.push_back({pair, scalar, std::string(family.name), count, std::nullopt, &family, seed});
    }
  }
  if (!unknown.empty())
    throw InputError({"exam new", 0}, "--family",
                     fmt::format("unknown family '{}'; `contact-oracle families` lists them", unknown.front()));
  return sources;
}

std::string chance(std::size_t digits) {
  std::random_device device;
  std::string text;
  while (text.size() < digits) text += fmt::format("{:08x}", static_cast<std::uint32_t>(device()));
  return text.substr(0, digits);
}

void make_new(const NewOptions& o) {
  if (std::filesystem::exists(o.key))
    throw InputError({o.key, 0}, "--key", "is there already, and may belong to an exam that is not closed");
  ExamFile exam(o.output);
  formats::OutputFile key_file(o.key);
  ExamKey key;
  key.terms = {chance(64), issue_date(), o.profile, o.commit};
  key.sources = sources_of(o, seed_or_fresh(o.seed));
  const ExamDigest questions = exam_digest(key.sources, key.terms.nonce);
  key.questions = questions.sha256;
  const std::string commitment = commitment_of(key.sources, key.terms);
  exam.write(key, questions);
  key_file.write(key_text(key));
  // The key first: questions without one could not be judged.
  key_file.commit();
  exam.commit();
  // The line is data, for a tag or a mail.
  if (o.commit) keep_output_for_data();
  say("{}: {} questions of {} families\n{}: keep it to yourself until the exam is closed\ncommitment {}\n", o.output,
      questions.count, key.sources.size(), o.key, commitment);
  if (o.commit) fmt::print("{}\n", published_line(commitment, questions.sha256));
}

struct TakeOptions {
  std::string exam;
  std::string output;
  EngineOptions engine;
};

void take(const TakeOptions& o) {
  require_used(o.engine, false);
  require_apart({o.output}, {o.exam, o.engine.library});
  const Exam exam = read_exam(o.exam);
  formats::OutputFile answers(o.output);
  engines::Recording engine(make_engine(o.engine));
  const engines::EngineInfo& info = engine.info();
  Progress progress(o.exam, exam.all.size());
  constexpr std::size_t kTogetherHere = 32;
  std::vector<engines::Question> asked;
  for (std::size_t i = 0; i < exam.all.size(); i += kTogetherHere) {
    throw_if_interrupted();
    asked.clear();
    const std::size_t end = std::min(i + kTogetherHere, exam.all.size());
    for (std::size_t k = i; k < end; ++k) {
      const auto& [question, scalar] = exam.all[k];
      if (engine_takes(info, question.query.pair, scalar) &&
          !oracle::not_served(question.query, info.declared_for(question.query.pair)))
        asked.push_back(question);
    }
    static_cast<void>(engine.answer(asked));
    progress.add(end - i);
  }
  answers.write(engine.results());
  answers.commit();
  say("{}: {} of {} questions answered by {} {}\n", o.output, engine.answers(), exam.all.size(), info.name,
      info.version);
}

struct CloseOptions {
  std::string key;
  std::string exam;
  EngineOptions engine;  ///< of which only the results file is given
  DemandOptions demand;
  bool allow_unsupported = false;
  ReportOptions reports;
  CertificateOptions certificate;
};

void require_same(const std::string& file, const ExamKey& key) {
  const Exam exam = read_exam(file);
  if (exam.commitment != commitment_of(key.sources, key.terms))
    throw InputError({file, 1}, "commitment", "is not that of the key: another exam, or it was changed");
  if (exam.questions != key.questions)
    throw InputError({file, 1}, "questions", "are not those of the key: the exam was changed");
}

void write_key(const std::string& path, const std::string& text) {
  formats::OutputFile file(path);
  file.write(text);
  file.commit();
}

/// Marks a key as used. Where nothing comes of it, not even a verdict that somebody could have seen, it is as it was.
class Use {
 public:
  Use(std::string path, const ExamKey& key, const std::string& answers)
      : path_(std::move(path)), before_(formats::read_text(path_)) {
    ExamKey used = key;
    used.used_on = issue_date();
    used.used_for = answers;
    write_key(path_, key_text(used));
  }
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;
  ~Use() {
    if (stands_) return;
    try {
      write_key(path_, before_);
    } catch (const std::exception& error) {
      say_error("contact-oracle: {}\n", error.what());
    }
  }
  void let_stand() { stands_ = true; }

 private:
  std::string path_;
  std::string before_;
  bool stands_ = false;
};

int close(const CloseOptions& o) {
  require_apart({o.reports.html, o.reports.json, o.reports.junit, o.reports.markdown, o.certificate.certificate},
                {o.key, o.exam, o.engine.results});
  const HeldKey held(o.key);
  const ExamKey key = read_key(o.key);
  if (!key.used_on.empty())
    throw InputError({o.key, 0}, "used",
                     fmt::format("this key was used on {}, for the answers with SHA-256 {}: an exam is closed once",
                                 key.used_on, key.used_for));
  if (const std::string day = issue_date(); day < key.terms.issued)
    throw InputError({o.key, 0}, "issued", fmt::format("a day to come: today is {}, got {}", day, key.terms.issued));
  if (!o.exam.empty()) require_same(o.exam, key);
  ReportFiles files(o.reports);
  CertificateFiles certificate(o.certificate, o.engine);
  std::vector<Subject> subjects;
  subjects.push_back({make_engine(o.engine), {}});
  Report& report = subjects.front().report;
  report.engine = subjects.front().engine->info();
  certificate.name(key.sources);
  report.allow_unsupported = o.allow_unsupported;
  set_demand(o.demand, report, key.terms.profile);
  Stop stop;
  Oracles oracles;
  std::vector<Report> reports{report};
  bool is_used = false;
  {
    Use use(o.key, key, digest_of_file(o.engine.results));
    merge(reports, judge_part(key.sources, subjects, stop, oracles), true);
    const std::size_t unknown = reports.front().unknown_answers.size();
    if (unknown != 0 && unknown == engines::count_recorded(o.engine.results))
      throw InputError({o.engine.results, 0}, "", "answers no question of this exam");
    is_used = reports.front().judged() != 0 && !reports.front().harness_invalid();
    if (is_used) use.let_stand();
  }
  if (!is_used) {
    say("{} stays as it is: no answer {}\n", o.key, reports.front().judged() == 0 ? "was judged" : "claims anything");
    files.write(reports);
    return files.print(reports, false);
  }
  // First what cannot be made again.
  certificate.write(reports.front(), key.sources, oracles, nullptr, key.terms);
  files.write(reports);
  const int exit = files.print(reports, false);
  certificate.tell();
  say("{} is used, and its seed {}\n{}\n", o.key,
      o.certificate.certificate.empty() ? "is in it" : "stands in the certificate",
      key.terms.asked_for_line
          ? fmt::format("the line to hold it against: {}",
                        published_line(commitment_of(key.sources, key.terms), key.questions))
          : "nothing was published before the answers: `exam new --commit` prints a line for that");
  return exit;
}

}  // namespace

void add_exam(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "exam", "Questions that nobody has seen: set an exam, take it, close it\nAn exam is closed once, by its key.");
  command->require_subcommand(1);

  auto* set = command->add_subcommand("new", "Write questions without answers, and the key that they come from");
  auto o = std::make_shared<NewOptions>();
  set->add_option("-o,--output", o->output, "The exam, *.jsonl, *.h5 or *.npz")->type_name("FILE")->required();
  set->add_option("--key", o->key, "The key, *.json: keep it until the exam is closed")->type_name("FILE")->required();
  set->add_option("--profile", o->profile,
                  "Families, how many questions of each, scalar, and the tolerance to judge by")
      ->check(CLI::IsMember(kProfileNames));
  set->add_option("--pair", o->pairs, "Only these pairs")->delimiter(',')->check(CLI::IsMember(names_of(kPairs)));
  set->add_option("--family", o->families, "Only these families")->delimiter(',');
  set->add_option("--count", o->count, "Questions of each family (default: the profile's, or 100)")->check(kFromOne);
  set->add_option("--scalar", o->scalar, "The questions' number format (default: the profile's, or binary64)")
      ->check(CLI::IsMember(names_of(kScalars)));
  set->add_option("--seed", o->seed, "The seed (default: random); there is chance besides")->check(kFromZero);
  set->add_flag(
      "--commit", o->commit,
      "Print one line to publish before there are answers, in a tag or a mail: `verify --commitment` compares "
      "the certificate with it");
  set->callback([o, &exit] {
    make_new(*o);
    exit = kCertified;
  });

  auto* taken = command->add_subcommand("take", "Ask an engine the questions of an exam and write its answers");
  auto t = std::make_shared<TakeOptions>();
  taken->add_option("exam", t->exam, "What `exam new` wrote")->required();
  taken->add_option("-o,--output", t->output, "The answers, a results file")->type_name("FILE")->required();
  add_engine_options(*taken, t->engine, false);
  taken->callback([t, &exit] {
    take(*t);
    exit = kCertified;
  });

  auto* closed = command->add_subcommand("close", "Judge the answers to an exam, once, and reveal its seed");
  auto c = std::make_shared<CloseOptions>();
  c->engine.parsed = closed;
  closed->add_option("--key", c->key, "The exam's key, which is marked as used")->type_name("FILE")->required();
  closed->add_option("--results", c->engine.results, "The answers, a results file")->type_name("FILE")->required();
  closed->add_option("--exam", c->exam, "The exam: compared with the key")->type_name("FILE");
  closed->add_flag("--allow-unsupported", c->allow_unsupported,
                   "Leave out questions that the engine answers with \"unsupported\"");
  add_demand_options(*closed, c->demand);
  add_report_options(*closed, c->reports);
  closed->add_option("--certificate", c->certificate.certificate, "Write a certificate, which `verify` checks offline")
      ->type_name("FILE");
  closed->callback([c, &exit] { exit = close(*c); });
}

}  // namespace contact::tool
