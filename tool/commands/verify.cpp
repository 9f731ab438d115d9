// verify: does a certificate say what its dataset and its answers say?
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <array>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "formats/whole_number.hpp"
#include "tool/commands/commands.hpp"
#include "tool/reports/certificate.hpp"
#include "tool/run/date.hpp"
#include "tool/run/determinism.hpp"
#include "tool/run/exam.hpp"
#include "tool/run/fresh.hpp"
#include "tool/run/parts.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

using formats::Node;
using nlohmann::json;

constexpr std::array<std::string_view, 5> kEngineKinds{"adapter", "built-in", "command", "library", "recorded"};
constexpr std::size_t kShown = 8;  // differences that are printed of each part of a certificate

struct VerifyOptions {
  std::string certificate;
  std::string dataset;
  std::string results;
  std::string level;
  std::string exam;
  std::string commitment;
};

/// A value as it is printed: its beginning, where it is long.
std::string shown(const json& value) {
  constexpr std::size_t kMost = 120;
  std::string text = value.dump();
  if (text.size() > kMost) text = text.substr(0, kMost) + "...";
  return text;
}

std::string text_at(const json& whole, const std::string& pointer) {
  const json::json_pointer at(pointer);
  return whole.contains(at) ? shown(whole.at(at)) : "nothing";
}

/// With every text made visible, as what is derived from files has them.
json visible(const json& value) {
  if (value.is_string()) return formats::visible(value.get_ref<const std::string&>());
  if (!value.is_structured()) return value;
  json shown = value;
  for (json& part : shown) part = visible(part);
  return shown;
}

std::vector<Difference> differences(const json& all_stated, const json& all_derived) {
  const json stated = visible(all_stated);
  const json derived = visible(all_derived);
  std::vector<Difference> found;
  for (const json& step : json::diff(stated, derived)) {
    const auto pointer = step.at("path").get<std::string>();
    found.push_back({pointer, text_at(stated, pointer), step.contains("value") ? shown(step.at("value")) : "nothing"});
  }
  return found;
}

/// Prints them part by part, in each the broad ones before the details that follow from them.
void print(std::vector<Difference> found) {
  const auto part = [](const Difference& d) { return d.pointer.substr(0, d.pointer.find('/', 1)); };
  const auto depth = [](const Difference& d) { return std::count(d.pointer.begin(), d.pointer.end(), '/'); };
  std::stable_sort(found.begin(), found.end(), [&](const Difference& x, const Difference& y) {
    return std::pair(part(x), depth(x)) < std::pair(part(y), depth(y));
  });
  for (std::size_t i = 0; i < found.size();) {
    const std::string name = part(found[i]);
    for (std::size_t shown = 0; i < found.size() && part(found[i]) == name && shown < kShown; ++i, ++shown)
      say("{}\n  stated   {}\n  derived  {}\n", name.empty() ? "(the whole)" : found[i].pointer, found[i].stated,
          found[i].derived);
    std::size_t more = 0;
    for (; i < found.size() && part(found[i]) == name; ++i) ++more;
    if (more != 0) say("and {} more in {}\n", more, name);
  }
}

/// A certificate as it was read, and the files that it names as they are found here.
class Certificate {
 public:
  explicit Certificate(const VerifyOptions& options) : options_(options), text_(options.certificate) {}

  [[nodiscard]] const json& stated() const { return text_.stated(); }
  [[nodiscard]] Node node() const { return text_.node(); }
  [[nodiscard]] std::vector<Difference> in_itself() const { return text_.in_itself(); }

  /// The questions, with the files where they are here.
  [[nodiscard]] std::vector<Source> sources() const {
    std::vector<Source> found;
    const auto stated = node().at("questions").at("sources").items();
    const std::size_t files = datasets(stated);
    std::optional<AskedFresh> asked;
    for (const Node& source : stated) {
      if (const auto file = source.find("file")) {
        const std::filesystem::path path = dataset(file->raw_text(), files);
        const golden::DatasetHeader h = golden::dataset_header(path);
        found.push_back({h.pair, h.scalar, h.family, h.count, path});
      } else {
        const Pair pair = golden::read_pair(source.at("pair"));
        const std::string family = source.at("family").text();
        const golden::Family* generator = golden::find_family(pair, family);
        if (generator == nullptr) source.at("family").refuse("this program has no such generator");
        found.push_back({pair, golden::read_scalar(source.at("scalar")), family, source.at("count").count(),
                         std::nullopt, generator, source.at("seed").count()});
        if (const auto fresh = source.find("fresh"); fresh && fresh->boolean()) {
          if (!asked) asked = AskedFresh{found.back().count, found.back().seed};
          found.pop_back();
        }
      }
    }
    // All that a run asks with this seed: a certificate may leave out none of it.
    if (asked)
      for (Source& source : fresh_beside(found, *asked)) found.push_back(std::move(source));
    if (!options_.dataset.empty() &&
        std::none_of(found.begin(), found.end(), [](const Source& source) { return source.dataset.has_value(); }))
      throw formats::InputError({options_.certificate, 0}, "--dataset",
                                "its questions were generated, and come from no file");
    return found;
  }

  [[nodiscard]] std::filesystem::path answers() const {
    return options_.results.empty() ? (folder() / node().at("answers").at("file").raw_text()).lexically_normal()
                                    : std::filesystem::path(options_.results);
  }

  /// What is there of the files that others are judged by: those whose bytes are not the ones that were bound.
  [[nodiscard]] std::vector<Difference> in_files() const {
    std::vector<Difference> found;
    const auto compare = [&](const std::string& pointer, const Node& stated, const std::filesystem::path& path) {
      if (const std::string digest = digest_of_file(path); digest != stated.text())
        found.push_back({pointer, stated.text(), fmt::format("{}, of {}", digest, path.string())});
    };
    const auto sources = node().at("questions").at("sources").items();
    const std::size_t files = datasets(sources);
    for (std::size_t i = 0; i < sources.size(); ++i)
      if (const auto file = sources[i].find("file"))
        compare(fmt::format("/questions/sources/{}/sha256", i), sources[i].at("sha256"),
                dataset(file->raw_text(), files));
    const auto compare_exam = [&](const auto& exam, std::string_view whose) {
      const auto stated = node().find("exam");
      if (!stated) throw formats::InputError({options_.certificate, 0}, "exam", "is a certificate of no exam");
      for (const auto& [key, is] : {std::pair("commitment", exam.commitment), {"questions", exam.questions}})
        if (const std::string said = stated->at(key).text(); said != is)
          found.push_back({fmt::format("/exam/{}", key), said, fmt::format("{}, of {}", is, whose)});
    };
    if (!options_.exam.empty()) compare_exam(read_exam(options_.exam), options_.exam);
    if (!options_.commitment.empty())
      compare_exam(read_published_line(options_.commitment), "the line that was published");
    compare("/answers/sha256", node().at("answers").at("sha256"), answers());
    return found;
  }

  /// What cannot be derived again: copied, but for the digests of an engine's files that are there.
  [[nodiscard]] Stated not_derived() {
    Stated stated;
    const Node issued = node().at("issued");
    stated.issued = day_at(issued);
    if (stated.issued > today()) issued.refuse("a day to come: today is " + today());
    static_cast<void>(node().at("environment"));
    stated.environment = text_.stated().at("environment");
    const Node engine = node().at("engine");
    const std::size_t kind = engine.at("kind").one_of(kEngineKinds);
    stated.engine = {{"kind", kEngineKinds[kind]}, {"files", json::array()}};
    const auto command = engine.find("command");
    if (command.has_value() != (kEngineKinds[kind] == "command"))
      engine.at("kind").refuse("a command line belongs to the kind \"command\", and to no other");
    if (command) stated.engine["command"] = command->text();
    for (const Node& file : engine.at("files").items()) stated.engine["files"].push_back(engine_file(file));
    const Node questions = node().at("questions");
    if (const auto folder = questions.find("folder")) stated.folder = folder->text();
    for (const Node& source : questions.at("sources").items()) {
      const auto file = source.find("file");
      if (file && node().find("exam")) file->refuse("an exam's questions are generated, and come from no file");
      stated.names.push_back(file ? file->text() : "");
    }
    if (node().at("found").find("same_bits"))
      not_checked_.emplace_back("whether the engine gave the same bits when it was asked again");
    stated.answers = node().at("answers").at("file").text();
    if (const auto exam = node().find("exam")) stated.exam = terms_at(*exam, stated.issued);
    return stated;
  }

  /// The failures that it accepts, as a report that lists them.
  [[nodiscard]] SavedReport accepted() const {
    SavedReport report{};
    report.path = options_.certificate;
    for (const Node& f : node().at("accepted").items())
      report.failures.push_back({f.at("id").text(), golden::read_pair(f.at("pair")),
                                 golden::read_scalar(f.at("scalar")), f.at("family").text(),
                                 static_cast<Level>(f.at("level").one_of(oracle::kLevelNames)), "", false,
                                 f.at("reason").text(), f.at("expires").text()});
    report.failure_count = report.failures.size();
    return report;
  }

  /// What stays unchecked, a line each, and how many of the engine's files were here to be checked: of the last
  /// not_derived().
  [[nodiscard]] const std::vector<std::string>& not_checked() const { return not_checked_; }
  [[nodiscard]] std::size_t engine_files() const { return engine_files_; }

  /// Whether its answers were recorded before it was made.
  [[nodiscard]] bool recorded() const { return node().at("engine").at("kind").text() == "recorded"; }

 private:
  [[nodiscard]] static std::size_t datasets(const std::vector<Node>& sources) {
    return static_cast<std::size_t>(std::count_if(sources.begin(), sources.end(),
                                                  [](const Node& source) { return source.find("file").has_value(); }));
  }

  [[nodiscard]] std::filesystem::path folder() const { return folder_of(options_.certificate); }

  [[nodiscard]] std::filesystem::path dataset(const std::string& name, std::size_t files) const {
    if (options_.dataset.empty())
      return (folder() / node().at("questions").at("folder").raw_text() / name).lexically_normal();
    if (files == 1 && !std::filesystem::is_directory(options_.dataset)) return options_.dataset;
    return std::filesystem::path(options_.dataset) / name;
  }

  static std::string day_at(const Node& node) {
    std::string day = node.text();
    if (!is_date(day)) node.refuse("expected a day, YYYY-MM-DD");
    return day;
  }

  /// What its commitment is derived from, and whether its line was published, which nothing here can say.
  ExamTerms terms_at(const Node& exam, const std::string& closed) {
    ExamTerms terms{digest_at(exam.at("nonce"))};
    const auto issued = exam.find("issued");
    terms.commits_to_nothing_else = !issued;
    if (issued) {
      terms.issued = day_at(*issued);
      if (terms.issued > closed) issued->refuse("it was closed on " + closed);
      if (const Node profile = exam.at("profile"); !profile.is_null()) terms.profile = profile.text();
      terms.asked_for_line = !exam.at("published").is_null();
    }
    if (!options_.commitment.empty())
      not_checked_.emplace_back("when the line was published that --commitment gives");
    else if (terms.asked_for_line)
      not_checked_.emplace_back("whether the line that the exam commits by was published: --commitment compares one");
    else
      not_checked_.emplace_back("that the exam was set before its answers: nothing was published");
    not_checked_.emplace_back("that its key was closed once: a copy can be closed again, for other answers");
    return terms;
  }

  json engine_file(const Node& stated) {
    const std::string digest = digest_at(stated.at("sha256"));
    if (const auto program = stated.find("program")) {
      not_checked_.push_back(fmt::format("the engine's program {}, which is known by its name alone", program->text()));
      return {{"program", program->text()}, {"sha256", digest}};
    }
    const std::string name = stated.at("file").raw_text();
    const bool there = std::filesystem::is_regular_file(folder() / name);
    if (!there) not_checked_.push_back(fmt::format("the engine's file {}: not here", name));
    engine_files_ += there ? 1 : 0;
    return {{"file", name}, {"sha256", there ? digest_of_file(folder() / name) : digest}};
  }

  VerifyOptions options_;
  CertificateText text_;
  std::size_t engine_files_ = 0;
  std::vector<std::string> not_checked_{
      "the environment and the day of issue",
      "that the answers are those of the engine that is named, and its name, version and kind"};
};

/// Judges the recorded answers as the run did that the certificate tells of.
Report judge_again(const Certificate& certificate, const std::vector<Source>& sources, Oracles& oracles,
                   const std::shared_ptr<const Baseline>& baseline, std::unique_ptr<engines::Engine> answers) {
  const Node found = certificate.node().at("found");
  const Node check = certificate.node().at("oracle").at("check");
  oracles.check = static_cast<Check>(check.one_of(kCheckNames));
  std::vector<Subject> subjects;
  subjects.push_back({std::move(answers), {}, baseline});
  Report& report = subjects.front().report;
  report.engine = subjects.front().engine->info();
  report.required = static_cast<Level>(found.at("required").one_of(oracle::kLevelNames));
  report.allow_unsupported = found.at("allow_unsupported").boolean();
  if (const Node within = found.at("within"); !within.is_null()) report.within = within.number();
  report.least_judged = found.at("least_judged").count();
  report.fresh = fresh_of(sources, certificate.recorded());
  report.engine.declared.tolerance.reset();
  if (const auto tolerance = found.find("tolerance"))
    report.engine.declared.tolerance = engines::read_tolerance(*tolerance);
  if (baseline != nullptr) report.accepted = baseline->accepted();
  Stop stop;
  std::vector<Report> reports{report};
  merge(reports, judge_part(sources, subjects, stop, oracles), true);
  if (const auto same = found.find("same_bits")) {
    // That it gave the same bits cannot be asked of a file; that these are the bits can, where they are the same.
    Repeats repeats = ask_once(published_of(sources), *subjects.front().engine, report.engine);
    if (!same->boolean()) repeats.sha256 = digest_at(found.at("answers_again"));
    constexpr std::size_t kMostWays = 64;  // of asking, more than there are
    const Node ways = found.at("ways");
    repeats.ways.assign(
        formats::require_whole_number<std::size_t>(ways.count(), ways.where(), "found.ways", 1, kMostWays), Way{});
    repeats.ways.back().differ = same->boolean() ? 0 : 1;
    reports.front().repeats = std::move(repeats);
  }
  return std::move(reports.front());
}

/// What of the answers, judged again, is not what the certificate states; the report of that judgement.
std::vector<Difference> in_judgement(Certificate& certificate, std::optional<Report>& report) {
  const std::vector<Source> sources = certificate.sources();
  const SavedReport accepted = certificate.accepted();
  // Each is put to use first, so that what is derived does not depend on the day; whether it has expired comes after.
  const auto baseline = accepted.failures.empty() ? nullptr : std::make_shared<const Baseline>(accepted, std::string());
  Oracles oracles;
  report = judge_again(certificate, sources, oracles, baseline,
                       engines::make_recorded(certificate.answers(), rows_of(sources)));
  Stated not_derived = certificate.not_derived();
  not_derived.names.resize(sources.size());
  json derived = statement({*report, sources, oracles, baseline.get(), digest_of_file(certificate.answers()),
                            engines::count_recorded(certificate.answers())},
                           not_derived);
  json stated = certificate.stated();
  stated.erase("sha256");
  std::vector<Difference> found = differences(stated, derived);
  for (std::size_t i = 0; i < accepted.failures.size(); ++i)
    if (const std::string& day = accepted.failures[i].expires; !is_date(day) || day < today())
      found.push_back({fmt::format("/accepted/{}/expires", i), day, "expired: today is " + today()});
  return found;
}

int verify(const VerifyOptions& options) {
  std::optional<Level> demanded;
  if (!options.level.empty()) demanded = static_cast<Level>(index_of(oracle::kLevelNames, options.level, "level"));
  Certificate certificate(options);
  std::vector<Difference> found = certificate.in_itself();
  const bool changed = !found.empty();
  std::optional<Report> report;
  std::string unfinished;
  try {
    std::vector<Difference> more = certificate.in_files();
    if (!more.empty())
      unfinished = "The answers are not judged again: the files are not those that the certificate is of.";
    else
      more = in_judgement(certificate, report);
    found.insert(found.end(), more.begin(), more.end());
  } catch (const formats::InputError& error) {
    // In a certificate that was changed nothing need fit together, and that it was changed says it all.
    if (!changed) throw;
    unfinished = error.what();
  }
  print(found);
  if (!unfinished.empty()) words() << unfinished << "\n";
  if (!found.empty()) {
    say("\nREFUTED: {} does not hold: {} {}.\n", options.certificate, found.size(),
        found.size() == 1 ? "statement differs" : "statements differ");
    return kRefuted;
  }
  for (const std::string& line : certificate.not_checked()) say("stated, not checked: {}\n", line);
  const std::size_t sources = published_of(certificate.sources()).size();
  const std::uint64_t fresh = report->fresh_total().cases;
  say("checked: the certificate itself; the questions of {} {}{} and {} recorded answers, judged again", sources,
      sources == 1 ? "source" : "sources",
      fresh == 0 ? "" : fmt::format(", {} fresh {}", fresh, fresh == 1 ? "one" : "ones"),
      certificate.node().at("answers").at("count").count());
  if (certificate.engine_files() != 0) say("; {} of the engine's files", certificate.engine_files());
  say("\n\nHOLDS: every statement of {} is true:\n  {}\n", options.certificate, report->sentence());
  if (!demanded) return kCertified;
  // What the answers reach may be more, or less, than was required of them when the certificate was made.
  Report at_level = *report;
  at_level.required = *demanded;
  at_level.engine.declared.tolerance.reset();
  if (at_level.certified()) return kCertified;
  const std::string lacks = fmt::format("{}", fmt::join(at_level.falls_short(), "; "));
  say("REFUTED: {} was required, and {}.\n", options.level,
      report->repeats && !report->repeats->same() ? "the engine gave other answers when it was asked again"
      : at_level.right()                          ? "what was judged is no certificate: " + lacks
                         : fmt::format("the certificate is of {}", name(report->level_but_accepted())));
  return kRefuted;
}

}  // namespace

void add_verify(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "verify", "Check a certificate offline\nAll that it says is derived again from the dataset and the answers.");
  auto options = std::make_shared<VerifyOptions>();
  command->add_option("certificate", options->certificate, "What certify --certificate wrote")->required();
  command
      ->add_option("--dataset", options->dataset,
                   "The folder that the names of the datasets begin in, or the one dataset (default: where the "
                   "certificate says, seen from its own folder)")
      ->type_name("FILE");
  command->add_option("--results", options->results, "The recorded answers (default: where the certificate says)")
      ->type_name("FILE");
  command->add_option("--exam", options->exam, "The exam that it should be of: what it commits to, and its questions")
      ->type_name("FILE");
  command
      ->add_option("--commitment", options->commitment,
                   "The line that `exam new --commit` printed and somebody published: that the exam is this one")
      ->type_name("LINE");
  command->add_option("--level", options->level, "Demand that it certifies this level, accepted failures left out")
      ->check(CLI::IsMember(kRequiredLevels));
  command->callback([options, &exit] { exit = verify(*options); });
}

}  // namespace contact::tool
