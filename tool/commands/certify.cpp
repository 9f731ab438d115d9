// certify: engines held against golden files, or against questions generated on the spot.
#include <fmt/format.h>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <iterator>
#include <map>
#include <memory>
#include <set>

#include "golden/right_case.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/demand.hpp"
#include "tool/commands/engine_options.hpp"
#include "tool/reports/certificate_files.hpp"
#include "tool/reports/report_files.hpp"
#include "tool/run/cluster.hpp"
#include "tool/run/date.hpp"
#include "tool/run/fresh.hpp"
#include "tool/run/parts.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

constexpr std::uint64_t kUsualParts = 64;

struct CertifyOptions {
  std::vector<std::string> paths;
  EngineOptions engine;
  std::vector<std::string> families;
  std::string failures_of;  ///< a report
  DemandOptions demand;
  bool allow_unsupported = false;
  std::uint64_t generate = 0;
  std::vector<std::string> pairs;
  std::optional<std::uint64_t> fresh;
  std::optional<std::uint64_t> seed;
  ReportOptions reports;
  std::string baseline;
  bool fail_fast = false;
  double max_time = 0;  ///< seconds; 0: no limit
  std::string parts;    ///< folder
  std::uint64_t shards = kUsualParts;
  std::string shard;
  bool stats = false;
  bool determinism = false;
  std::string check = std::string(kCheckNames.front());
  CertificateOptions certificate;
  std::string accept_reason;
  std::string accept_until;
};

[[noreturn]] void refuse(const std::string& problem) { throw formats::InputError({"certify", 0}, "", problem); }

bool wanted(const CertifyOptions& options, const std::string& family) {
  if (options.families.empty()) return family != golden::kInvalidFamily;
  return std::find(options.families.begin(), options.families.end(), family) != options.families.end();
}

std::vector<Source> datasets(const CertifyOptions& options) {
  std::vector<std::filesystem::path> paths(options.paths.begin(), options.paths.end());
  if (paths.empty()) paths.emplace_back(golden_folder());
  std::vector<Source> sources;
  std::vector<std::string> seen;
  for (const auto& path : golden::dataset_files(paths)) {
    const golden::DatasetHeader h = golden::dataset_header(path);
    if (h.count == 0 && !h.shard)
      throw formats::InputError({path.string(), 1}, "count", "the dataset holds no case, got 0");
    seen.push_back(h.family);
    if (wanted(options, h.family)) sources.push_back({h.pair, h.scalar, h.family, h.count, path});
  }
  for (const std::string& family : options.families)
    if (std::find(seen.begin(), seen.end(), family) == seen.end())
      refuse(fmt::format("no dataset given holds the family '{}'", family));
  if (sources.empty())
    refuse(fmt::format("nothing to judge in {}: the family 'invalid' is judged only when named, --family invalid",
                       paths.front().string()));
  return sources;
}

std::vector<Source> generated(const CertifyOptions& options, std::uint64_t seed) {
  if (!options.paths.empty()) refuse("--generate makes its own questions: give no dataset");
  std::vector<Pair> pairs;
  for (const std::string& pair : options.pairs) pairs.push_back(named(kPairs, pair));
  if (pairs.empty()) pairs.assign(kPairs.begin(), kPairs.end());
  for (const std::string& family : options.families)
    if (std::none_of(pairs.begin(), pairs.end(),
                     [&](Pair pair) { return golden::find_family(pair, family) != nullptr; }))
      refuse(fmt::format("unknown family '{}'; `contact-oracle families` lists them", family));
  std::vector<Source> sources;
  for (const Pair pair : pairs)
    for (const golden::Family& family : golden::families_of(pair))
      for (const Scalar scalar : kScalars)
        if (wanted(options, std::string(family.name)))
          sources.push_back({pair, scalar, std::string(family.name), options.generate, std::nullopt, &family, seed});
  return sources;
}

/// The questions of a report's failures, as one source a family; with datasets those of them that stand there.
std::vector<Source> failed_before(const CertifyOptions& options) {
  SavedReport report = read_report(options.failures_of);
  report.failures.insert(report.failures.end(), report.fresh_failures.begin(), report.fresh_failures.end());
  report.failure_count += report.fresh_failure_count;
  const auto refuse_report = [&](const std::string& problem) {
    throw formats::InputError({options.failures_of, 0}, "failures", problem);
  };
  if (report.failures.empty()) refuse_report("lists none: nothing failed that could be asked again");
  std::map<std::pair<std::string, Scalar>, std::optional<Query>> questions;
  std::set<std::pair<Pair, Scalar>> kinds;
  for (const Failure& f : report.failures) {
    questions[{f.id, f.scalar}] = options.paths.empty() ? f.question : std::nullopt;
    kinds.emplace(f.pair, f.scalar);
  }
  for (const auto& path :
       golden::dataset_files(std::vector<std::filesystem::path>(options.paths.begin(), options.paths.end()))) {
    golden::DatasetReader reader(path, golden::is_made);
    if (!kinds.contains({reader.header().pair, reader.header().scalar})) continue;
    while (const auto c = reader.next()) {
      throw_if_interrupted();
      const auto it = questions.find({c->id, reader.header().scalar});
      if (it != questions.end()) it->second = c->query;
    }
  }
  std::vector<Source> sources;
  std::map<std::string, std::vector<Query>> lists;  // by family_title
  std::set<std::string> taken;                      // family_title and id
  for (const Failure& f : report.failures) {
    if (!options.families.empty() && !wanted(options, f.family)) continue;
    const std::optional<Query>& question = questions.at({f.id, f.scalar});
    if (!question && options.paths.empty())
      refuse_report(fmt::format("lists {} without its question, as older versions did: give the datasets too", f.id));
    const std::string title = family_title(f.pair, f.family, f.scalar);
    if (!question || !taken.insert(title + " " + f.id).second) continue;
    if (!lists.contains(title)) sources.push_back({f.pair, f.scalar, f.family, 0, std::nullopt});
    lists[title].push_back(*question);
  }
  for (Source& source : sources) {
    source.listed =
        std::make_shared<const std::vector<Query>>(lists.at(family_title(source.pair, source.family, source.scalar)));
    source.count = source.listed->size();
  }
  if (sources.empty())
    refuse_report(options.families.empty()
                      ? "lists none that stands in these datasets"
                      : fmt::format("lists none of the family {}{}", fmt::join(options.families, " or "),
                                    options.paths.empty() ? "" : " that stands in these datasets"));
  if (Cluster::is_first())
    say("asked again: {} of the {} failures in {}, and nothing else\n", taken.size(), report.failure_count,
        options.failures_of);
  return sources;
}

/// How many fresh questions of each family are asked beside datasets, and from which seed. With a baseline they are
/// those that it was made with, as the failures that it accepts are failures on them.
AskedFresh fresh_to_ask(const CertifyOptions& options, bool scoreboard) {
  std::optional<AskedFresh> before;
  if (!options.baseline.empty()) before = read_report(options.baseline).fresh;
  const bool recorded = !options.engine.results.empty();
  const std::uint64_t usual = recorded                    ? 0
                              : !options.baseline.empty() ? (before ? before->each : 0)
                              : scoreboard                ? kFreshOfScoreboard
                                                          : kFreshEach;
  const std::uint64_t each = options.fresh.value_or(usual);
  if (each == 0) {
    if (options.seed)
      refuse(fmt::format("--seed chooses fresh questions, and none is asked{}",
                         options.fresh ? ": --fresh is 0"
                         : recorded    ? " of recorded answers"
                                       : ": the baseline was made with none; --fresh asks some"));
    return {0, 0};
  }
  if (recorded && !options.seed)
    refuse("recorded answers cannot be asked anything new: give --fresh the --seed that they were recorded with, or 0");
  const bool cut = !options.parts.empty() || Cluster::size() > 1;
  if (cut && !options.seed && !before)
    refuse("fresh questions in parts need --seed: every part has the same; --fresh 0 leaves them out");
  return {each, options.seed ? *options.seed : before ? before->seed : seed_or_fresh(std::nullopt)};
}

/// The failures to accept; what has expired of them is said on standard error.
std::shared_ptr<const Baseline> read_baseline(const CertifyOptions& options) {
  if (options.baseline.empty()) return nullptr;
  if (!options.accept_until.empty() && !is_date(options.accept_until))
    refuse(fmt::format("--accept-until: expected a day, YYYY-MM-DD, got '{}'", options.accept_until));
  SavedReport saved = read_report(options.baseline);
  for (Failure& f : saved.failures) {
    if (f.reason.empty()) f.reason = formats::visible(options.accept_reason);  // as what the baseline says
    if (f.expires.empty()) f.expires = options.accept_until;
  }
  auto baseline = std::make_shared<const Baseline>(saved, issue_date());
  constexpr std::size_t kShown = 5;
  const auto& expired = baseline->expired();
  if (Cluster::is_first())
    for (std::size_t i = 0; i < expired.size() && i <= kShown; ++i)
      say_error("{}: {}\n", options.baseline,
                i < kShown ? expired[i] : fmt::format("and {} more have expired", expired.size() - kShown));
  if (const auto id = baseline->unexplained(); id && !options.certificate.certificate.empty())
    throw formats::InputError(
        {options.baseline, 0}, "failures",
        fmt::format("a certificate says why a failure is accepted and until when, and {} has no "
                    "\"reason\" or no \"expires\": add them, or --accept-reason and --accept-until",
                    *id));
  return baseline;
}

std::vector<std::string> outputs_of(const CertifyOptions& options) {
  const ReportOptions& reports = options.reports;
  return {reports.html,
          reports.json,
          reports.junit,
          reports.markdown,
          options.certificate.certificate,
          options.certificate.answers(!options.engine.results.empty())};
}

/// CertifyOptions that would do nothing, or lose what they are given, are refused before the work.
void require_used(const CLI::App& command, const CertifyOptions& options, bool scoreboard) {
  require_used(options.engine, true);
  if (scoreboard)
    for (const char* one : {"--json", "--junit", "--markdown", "--fail-fast"})
      if (command.count(one) != 0)
        refuse(fmt::format("{} is one engine's, and this is the scoreboard: give the engine", one));
  if (!options.shard.empty())
    for (const char* whole : {"--shards", "--report", "--json", "--junit", "--markdown"})
      if (command.count(whole) != 0)
        refuse(fmt::format("{} is of the whole run, and --shard judges a part of it, for `merge`", whole));
  if (command.count("--shards") != 0 && options.parts.empty() && Cluster::size() == 1)
    refuse("--shards cuts a run that --parts keeps, or that several processes share, and this is neither");
  std::vector<std::string> read = options.paths;
  for (const std::string& file :
       {options.baseline, options.failures_of, options.engine.results, options.engine.library})
    read.push_back(file);
  require_apart(outputs_of(options), read);
}

/// A certificate tells of one whole run in one process, from which all answers came.
void require_whole(const CertifyOptions& options, bool scoreboard) {
  if (!options.failures_of.empty() && (!options.parts.empty() || !options.certificate.certificate.empty()))
    refuse("--failures-of asks a few questions again: leave out --parts and --certificate");
  if (options.certificate.none()) return;
  if (scoreboard) refuse("--certificate and --record are one engine's: give the engine");
  if (!options.parts.empty() || Cluster::size() > 1)
    refuse(
        "--certificate and --record are of one whole run: a run in parts keeps no answers. Judge a results file in "
        "one run, by --results");
  if (!options.certificate.certificate.empty() && (options.fail_fast || options.max_time > 0))
    refuse("--certificate is of a whole run, which --fail-fast and --max-time may end early");
}

/// Few questions may leave some of the usual parts empty, but a file is not kept for each of many that are.
void require_filled(std::uint64_t parts, const std::vector<Source>& sources) {
  std::uint64_t questions = 0;
  for (const Source& source : sources) questions += source.count;
  if (parts > std::max(questions, kUsualParts))
    refuse(fmt::format("--shards: {} parts are more than the {} questions", parts, questions));
}

/// Only an engine that answers here, and all of whose answers are seen by one process, can be asked again.
void require_askable(const CertifyOptions& options, bool scoreboard) {
  if (scoreboard) refuse("--determinism asks one engine again: give the engine");
  if (!options.engine.results.empty()) refuse("--determinism asks again, and a results file has been answered once");
  if (options.fail_fast || options.max_time > 0)
    refuse("--determinism asks all questions again, and --fail-fast and --max-time may end early");
  if (!options.parts.empty() || Cluster::size() > 1)
    refuse("--determinism compares the answers of one whole run: --parts and several processes cut it");
}

std::vector<Subject> subjects(const CertifyOptions& options, bool scoreboard, std::optional<std::uint64_t> rows,
                              const Stop& stop, CertificateFiles& certificate) {
  if (scoreboard && !options.baseline.empty()) refuse("--baseline is one engine's: give the engine");
  const std::shared_ptr<const Baseline> baseline = read_baseline(options);
  std::vector<Subject> found;
  if (scoreboard) {
    for (const engines::BuiltIn& e : engines::built_in_engines())
      if (e.on_scoreboard) found.push_back({engines::make_built_in(e.name, computed_points(options.engine)), {}});
  } else {
    EngineOptions chosen = options.engine;
    chosen.rows = rows;
    found.push_back({certificate.watched(make_engine(chosen, [&stop] { stop.check(); })), {}});
  }
  for (Subject& subject : found) {
    subject.report.engine = subject.engine->info();
    set_demand(options.demand, subject.report);
    subject.report.allow_unsupported = options.allow_unsupported;
    subject.baseline = baseline;
    if (baseline != nullptr) subject.report.accepted = baseline->accepted();
    if (baseline != nullptr && baseline->engine() != subject.report.engine.name)
      throw formats::InputError({options.baseline, 0}, "engine.name",
                                fmt::format("accepts failures of '{}', and the engine is '{}'", baseline->engine(),
                                            subject.report.engine.name));
  }
  return found;
}

/// Parts that are kept in a folder, so that work which was interrupted goes on from those that are finished.
class Kept {
 public:
  Kept(const std::string& folder, const std::vector<Source>& sources, const Report& report)
      : folder_(folder), run_(folder.empty() ? "" : run_text(sources, report)) {
    if (folder.empty()) return;
    make_folder(folder_, "--parts");
  }

  /// The bytes of a part that is there. Throws InputError where it is damaged, or of another run.
  [[nodiscard]] std::optional<std::string> find(golden::Shard part) const {
    if (folder_.empty() || !std::filesystem::exists(folder_ / part_name(part))) return std::nullopt;
    const PartFile file = read_part(folder_ / part_name(part));
    require_run(file, run_, "what is asked for now");
    return pack(file.content);
  }
  void keep(golden::Shard part, const std::string& bytes) const {
    if (!folder_.empty()) write_part(folder_ / part_name(part), part, run_, bytes);
  }

 private:
  std::filesystem::path folder_;
  std::string run_;
};

/// Standard error: how long it took, and how much memory. (Not in the report, which is the same every time.)
void print_stats(const std::vector<Report>& reports, std::chrono::steady_clock::duration taken,
                 const Oracles& oracles) {
  const double seconds = std::chrono::duration<double>(taken).count();
  const auto cases = static_cast<double>(reports.front().all().cases);
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  const auto cpu = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  say_error("{:.0f} questions in {:.1f} s, {:.0f} a second of processor time; {:.0f} MB at most\n", cases, seconds,
            cases / (cpu(used.ru_utime) + cpu(used.ru_stime)), static_cast<double>(used.ru_maxrss) / 1024);
  std::vector<std::string> stages;
  for (std::size_t i = 0; i < oracle::kStageNames.size(); ++i)
    stages.push_back(fmt::format("{} {}", oracle::kStageNames[i], oracles.decided.answers[i]));
  say_error("decided by stage: {}; {} of them put to all oracles\n", fmt::format("{}", fmt::join(stages, ", ")),
            oracles.checked);
}

/// What is asked: questions that are made now, those that failed before, or datasets and fresh questions beside them.
struct Asked {
  std::vector<Source> sources;
  std::optional<Fresh> fresh;
};
Asked asked(const CertifyOptions& options, bool scoreboard) {
  const bool made = options.generate != 0;
  const bool again = !options.failures_of.empty();
  if (options.fresh && (made || again))
    refuse(fmt::format(
        "--fresh asks new questions beside those of datasets, and {}",
        made ? "--generate asks nothing but such" : "--failures-of asks what failed before and nothing else"));
  if (options.seed && again) refuse("--seed chooses new questions, and --failures-of asks those that failed before");
  if (again && !made) return {failed_before(options), {}};
  if (made) {
    if (!options.seed && (!options.parts.empty() || Cluster::size() > 1))
      refuse("--generate in parts needs --seed: every part has the same");
    const std::uint64_t seed = seed_or_fresh(options.seed);
    if (Cluster::is_first()) say("seed {}\n", seed);
    return {generated(options, seed), {}};
  }
  std::vector<Source> sources = datasets(options);
  std::vector<Source> beside = fresh_beside(sources, fresh_to_ask(options, scoreboard));
  if (!beside.empty() && Cluster::is_first())
    say("fresh questions: {} of each family, seed {}\n", beside.front().count, beside.front().seed);
  sources.insert(sources.end(), std::make_move_iterator(beside.begin()), std::make_move_iterator(beside.end()));
  const std::optional<Fresh> fresh = fresh_of(sources, !options.engine.results.empty());
  return {std::move(sources), fresh};
}

/// The verdict of one part alone.
int say_part(const Report& found, golden::Shard part) {
  const std::uint64_t questions = found.judged() + found.fresh_judged();
  // What is enough to certify is asked of the whole.
  const bool wrong = questions != 0 && found.failure_count + found.unreached != found.all().accepted;
  say("part {} of {}: {} questions judged, {}; `merge` gives the verdict\n", part.index, part.of, questions,
      wrong ? "and not all is right" : "and nothing is wrong");
  return wrong ? kRefuted : kCertified;
}

int certify(const CLI::App& command, const CertifyOptions& options) {
  const bool of_datasets = options.generate == 0 && options.failures_of.empty();
  const bool scoreboard = options.engine.none() && options.paths.empty() && of_datasets;
  require_used(command, options, scoreboard);
  const tbb::global_control threads(
      tbb::global_control::max_allowed_parallelism,
      options.engine.jobs > 0 ? options.engine.jobs
                              : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  Stop stop;
  stop.at_first_failure = options.fail_fast;
  require_whole(options, scoreboard);
  if (options.determinism) require_askable(options, scoreboard);
  CertificateFiles certificate(options.certificate, options.engine);
  const auto [sources, fresh] = asked(options, scoreboard);
  std::vector<std::string> read;  // also those in a folder
  for (const Source& source : sources)
    if (source.dataset) read.push_back(source.dataset->string());
  require_apart(outputs_of(options), read);
  std::vector<Subject> judged = subjects(options, scoreboard, rows_of(sources), stop, certificate);
  for (Subject& subject : judged) subject.report.fresh = fresh;
  certificate.name(sources);
  const bool in_parts = !options.parts.empty() || Cluster::size() > 1;
  if (in_parts && options.shard.empty()) require_filled(options.shards, sources);
  if (stop.at_first_failure && in_parts) refuse("--fail-fast ends one run; parts are judged each for itself");
  if (!options.parts.empty() && scoreboard) refuse("--parts keeps what one engine did: give the engine");
  const Kept kept(options.parts, sources, judged.front().report);
  if (options.max_time > 0)
    stop.deadline = Stop::Clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(options.max_time * 1000));
  Oracles oracles;
  oracles.check = static_cast<Check>(index_of(kCheckNames, options.check, "check"));
  if (options.engine.none() && !scoreboard && Cluster::is_first()) say("no engine is named: production is judged\n");
  if (options.paths.empty() && of_datasets) static_cast<void>(chosen_folder(""));
  const std::vector<Source>& all = sources;
  const auto judged_part = [&](golden::Shard part) { return judge_part(cut(all, part), judged, stop, oracles); };
  const auto judge = [&](golden::Shard part) {
    if (auto bytes = kept.find(part)) return *std::move(bytes);
    std::string bytes = pack(judged_part(part));
    if (stop.why.empty()) kept.keep(part, bytes);
    return bytes;
  };
  std::vector<Report> reports;
  for (const Subject& subject : judged) reports.push_back(subject.report);
  const auto begin = std::chrono::steady_clock::now();
  const auto say_stats = [&] {
    if (options.stats) print_stats(reports, std::chrono::steady_clock::now() - begin, oracles);
  };

  if (!options.shard.empty()) {
    const golden::Shard part = golden::read_shard(options.shard, {"certify", 0}, "--shard");
    merge(reports, unpack(judge(part)), true);
    say_stats();
    return say_part(reports.front(), part);
  }
  std::optional<ReportFiles> files;
  if (Cluster::is_first()) files.emplace(options.reports);
  // One process that keeps nothing has no use for parts.
  if (!in_parts)
    merge(reports, judged_part({0, 1}), true);
  else
    Cluster::in_order(
        options.shards,
        [&](std::uint64_t i) {
          return judge({i, options.shards});
        },
        [&](std::uint64_t i, const std::string& bytes) { merge(reports, unpack(bytes), i == 0); });
  if (!files) return kCertified;
  for (Report& report : reports)
    if (report.unreached != 0) report.unknown_answers.clear();
  if (options.determinism && stop.why.empty())
    reports.front().repeats = ask_again(published_of(sources), certificate.unwatched(*judged.front().engine),
                                        reports.front().engine, other_hosts(options.engine, [&stop] { stop.check(); }));
  say_stats();
  for (const Subject& subject : judged) say_decimals(subject.engine->decimals(), "the answers");
  files->write(reports);
  const bool is_stated = reports.front().judged() != 0 && !reports.front().harness_invalid();
  if (is_stated) certificate.write(reports.front(), sources, oracles, judged.front().baseline.get());
  const int exit = files->print(reports, scoreboard);
  if (is_stated) certificate.tell();
  return exit;
}

}  // namespace

void add_certify(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("certify",
                                     "Judge an engine by golden files; without one, the scoreboard\n"
                                     "Without an engine production is judged; with no dataset either, the built-in "
                                     "engines on the committed golden files.");
  auto options = std::make_shared<CertifyOptions>();
  command->add_option("datasets", options->paths, fmt::format("Golden files or folders (default: {})", kCommitted));
  std::optional<Heading> heading;
  add_engine_options(*command, options->engine, true);
  heading.emplace(*command, "Questions");
  command->add_option("--family", options->families, "Only these families")->delimiter(',');
  auto* failures = command
                       ->add_option("--failures-of", options->failures_of,
                                    "Only what failed before: the failures that this JSON report lists, of these "
                                    "datasets where any are given")
                       ->type_name("FILE");
  auto* generate = command
                       ->add_option("--generate", options->generate,
                                    "Instead of golden files: this many generated questions a family and scalar")
                       ->check(kFromOne)
                       ->excludes(failures);
  command->add_option("--pair", options->pairs, "With --generate: only these pairs")
      ->delimiter(',')
      ->needs(generate)
      ->check(CLI::IsMember(names_of(kPairs)));
  command
      ->add_option(
          "--fresh", options->fresh,
          fmt::format("Beside golden files: ask this many new questions of each of their families, because anybody "
                      "can know published answers; 0: none (default: {}; {} on the scoreboard; with a "
                      "baseline those that it was made with)",
                      kFreshEach, kFreshOfScoreboard))
      ->check(kCount);
  command->add_option("--seed", options->seed, "The seed of new questions (default: random, printed)")
      ->check(kFromZero);
  command
      ->add_option("--check", options->check,
                   "Which questions are put to all oracles: a sample of each source of more than 4096, or all")
      ->capture_default_str()
      ->check(CLI::IsMember(kCheckNames));
  heading.reset();
  add_demand_options(*command, options->demand);
  heading.emplace(*command, "What passes");
  command->add_flag("--allow-unsupported", options->allow_unsupported,
                    "Leave out questions that the engine answers with \"unsupported\"");
  command->add_flag("--determinism", options->determinism,
                    "Ask again: in the same order, in another, one at a time, many at once, from several threads and "
                    "processes; every answer must have the same bits");
  auto* baseline =
      command
          ->add_option("--baseline", options->baseline,
                       "A JSON report of this engine: its failures are accepted, only new ones and worse ones fail")
          ->type_name("FILE");
  command
      ->add_option("--accept-reason", options->accept_reason,
                   "Why failures are accepted, where the baseline gives no reason")
      ->type_name("REASON")
      ->needs(baseline);
  command
      ->add_option("--accept-until", options->accept_until,
                   "The last day of the acceptance, YYYY-MM-DD, where the baseline names none")
      ->type_name("DAY")
      ->needs(baseline);
  heading.reset();
  add_report_options(*command, options->reports);
  add_certificate_options(*command, options->certificate);
  heading.emplace(*command, "Long runs");
  command->add_flag("--fail-fast", options->fail_fast, "Stop at the first failure; the questions left are missing");
  command
      ->add_option("--max-time", options->max_time,
                   "Stop after so many seconds; the questions left are missing, which is never a pass")
      ->check(kSeconds);
  auto* parts = command
                    ->add_option("--parts", options->parts,
                                 "A folder that keeps what each part of the run found: a run that was interrupted "
                                 "goes on from there")
                    ->type_name("FOLDER");
  command->add_option("--shards", options->shards, "Into how many parts the run is cut")
      ->capture_default_str()
      ->check(kFromOne);
  command->add_option("--shard", options->shard, "Judge only part I (from 0) of N, for `merge`")
      ->type_name("I/N")
      ->needs(parts);
  command->add_flag("--stats", options->stats,
                    "Say on standard error how long it took, how much memory, and which oracle decided how often");
  command->callback([options, command, &exit] { exit = certify(*command, *options); });
}

}  // namespace contact::tool
