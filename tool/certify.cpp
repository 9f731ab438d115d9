// certify: engines held against golden files, or against questions generated on the spot.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <chrono>
#include <memory>
#include <random>

#include "golden/output_file.hpp"
#include "tool/commands.hpp"
#include "tool/engine_options.hpp"
#include "tool/pipeline.hpp"
#include "tool/process.hpp"

namespace contact::tool {
namespace {

struct Options {
  std::vector<std::string> paths;
  EngineOptions engine;
  std::string level = "bounded";
  std::vector<std::string> families;
  bool allow_unsupported = false;
  std::uint64_t generate = 0;
  std::vector<std::string> pairs;
  std::optional<std::uint64_t> seed;
  std::string report;
  std::string junit;
  std::string json;
  std::string markdown;
  std::string baseline;
  bool fail_fast = false;
  double max_time = 0;  ///< seconds; 0: no limit
};

[[noreturn]] void refuse(const std::string& problem) { throw golden::InputError({"certify", 0}, "", problem); }

bool wanted(const Options& options, const std::string& family) {
  if (options.families.empty()) return family != golden::kInvalidFamily;
  return std::find(options.families.begin(), options.families.end(), family) != options.families.end();
}

std::vector<Source> datasets(const Options& options) {
  std::vector<std::filesystem::path> paths(options.paths.begin(), options.paths.end());
  if (paths.empty()) paths.emplace_back(golden_folder());
  std::vector<Source> sources;
  std::vector<std::string> seen;
  for (const auto& path : golden::dataset_files(paths)) {
    const golden::DatasetReader reader(path);
    const golden::DatasetHeader& h = reader.header();
    if (h.count == 0 && !h.shard)
      throw golden::InputError({path.string(), 1}, "count", "the dataset holds no case, got 0");
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

std::vector<Source> generated(const Options& options, std::uint64_t seed) {
  if (!options.paths.empty()) refuse("--generate makes its own questions: give no dataset");
  std::vector<std::string_view> pair_names;
  pair_names.reserve(kPairs.size());
  for (const Pair pair : kPairs) pair_names.push_back(name(pair));
  std::vector<Pair> pairs;
  for (const std::string& pair : options.pairs) pairs.push_back(kPairs[index_of(pair_names, pair, "pair")]);
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

std::vector<Subject> subjects(const Options& options, bool scoreboard, const Stop& stop) {
  if (scoreboard && !options.baseline.empty()) refuse("--baseline is one engine's: give the engine");
  std::shared_ptr<const Baseline> baseline;
  if (!options.baseline.empty()) baseline = std::make_shared<Baseline>(read_report(options.baseline));
  std::vector<Subject> found;
  if (scoreboard) {
    for (const engines::BuiltIn& e : engines::built_in_engines())
      if (e.on_scoreboard) found.push_back({engines::make_built_in(e.name, computed_points(options.engine)), {}});
  } else {
    found.push_back({make_engine(options.engine, [&stop] { stop.check(); }), {}});
  }
  for (Subject& subject : found) {
    subject.report.engine = subject.engine->info();
    subject.report.required = static_cast<Level>(index_of(oracle::kLevelNames, options.level, "level"));
    subject.report.allow_unsupported = options.allow_unsupported;
    if (subject.report.required == Level::none) refuse("--level none asks for nothing");
    subject.report.baseline = baseline;
    if (baseline != nullptr && baseline->engine() != subject.report.engine.name)
      throw golden::InputError({options.baseline, 0}, "engine.name",
                               fmt::format("accepts failures of '{}', and the engine is '{}'", baseline->engine(),
                                           subject.report.engine.name));
  }
  return found;
}

/// A report's file, opened before the work so that a name that cannot be written is refused at once.
std::unique_ptr<golden::OutputFile> opened(const std::string& path) {
  return path.empty() ? nullptr : std::make_unique<golden::OutputFile>(path);
}

void write(const std::unique_ptr<golden::OutputFile>& file, const std::string& text) {
  if (file == nullptr) return;
  file->write(text);
  file->commit();
}

int certify(const Options& options) {
  const bool scoreboard = options.engine.none() && options.paths.empty() && options.generate == 0;
  const tbb::global_control threads(
      tbb::global_control::max_allowed_parallelism,
      options.engine.jobs > 0 ? options.engine.jobs
                              : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  Stop stop;
  stop.at_first_failure = options.fail_fast;
  std::vector<Subject> judged = subjects(options, scoreboard, stop);
  std::vector<Source> sources;
  if (options.generate != 0) {
    std::random_device entropy;
    const std::uint64_t seed = options.seed.value_or((static_cast<std::uint64_t>(entropy()) << 20) ^ entropy());
    fmt::print("seed {}\n", seed);
    sources = generated(options, seed);
  } else {
    sources = datasets(options);
  }
  const auto json = opened(options.json);
  const auto junit = opened(options.junit);
  const auto markdown = opened(options.markdown);
  const auto report = opened(options.report);
  if (options.max_time > 0)
    stop.deadline = Stop::Clock::now() + std::chrono::milliseconds(static_cast<std::int64_t>(options.max_time * 1000));
  for (const Source& source : sources) judge_source(source, judged, stop);

  std::vector<Report> reports;
  for (Subject& subject : judged) {
    if (subject.report.unreached == 0) subject.report.unknown_answers = subject.engine->unasked();
    reports.push_back(std::move(subject.report));
  }
  const Report& first = reports.front();
  write(json, json_text(first));
  write(junit, junit_text(first));
  write(markdown, markdown_text(first));
  write(report, html_text(reports));
  fmt::print("{}", scoreboard ? scoreboard_text(reports) : terminal_text(first));
  if (!options.report.empty()) fmt::print("\nReport: {}\n", options.report);
  if (first.judged() == 0) refuse("no case was judged: see what was skipped, and why");
  if (first.harness_invalid()) return kHarnessInvalid;
  return first.certified() ? kCertified : kRefuted;
}

}  // namespace

void add_certify(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "certify",
      "Hold an engine against golden files; with neither engine nor dataset, the scoreboard of the built-in engines");
  auto options = std::make_shared<Options>();
  command->add_option("datasets", options->paths, "Golden files or folders (default: golden/)");
  add_engine_options(*command, options->engine);
  command
      ->add_option("--level", options->level,
                   "Required level: correctly-rounded, faithful, bounded, decisions, conservative")
      ->capture_default_str();
  command->add_option("--family", options->families, "Only these families")->delimiter(',');
  command->add_flag("--allow-unsupported", options->allow_unsupported,
                    "Leave out questions that the engine answers with \"unsupported\"");
  auto* generate = command
                       ->add_option("--generate", options->generate,
                                    "Instead of golden files: this many generated questions a family and scalar")
                       ->check(kFromOne);
  command->add_option("--pair", options->pairs, "With --generate: only these pairs")->delimiter(',')->needs(generate);
  command->add_option("--seed", options->seed, "With --generate: the seed (default: random, printed)")
      ->check(kFromZero)
      ->needs(generate);
  command->add_option("--baseline", options->baseline,
                      "A JSON report of this engine: its failures are accepted, only new ones and worse ones fail");
  command->add_flag("--fail-fast", options->fail_fast, "Stop at the first failure; the questions left are missing");
  command
      ->add_option("--max-time", options->max_time,
                   "Stop after so many seconds; the questions left are missing, which is never a pass")
      ->check(kSeconds);
  command->add_option("--report", options->report, "Write the report as HTML");
  command->add_option("--junit", options->junit, "Write the report as JUnit XML");
  command->add_option("--json", options->json, "Write the report as JSON");
  command->add_option("--markdown", options->markdown, "Write the report as Markdown, for the summary of a CI job");
  command->callback([options, &exit] { exit = certify(*options); });
}

}  // namespace contact::tool
