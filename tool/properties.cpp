// properties: the laws asked of any engine, with counterexamples that a person can read.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "golden/dataset_writer.hpp"
#include "golden/output_file.hpp"
#include "golden/query_id.hpp"
#include "tool/commands.hpp"
#include "tool/engine_options.hpp"
#include "tool/law_report.hpp"
#include "tool/pipeline.hpp"
#include "tool/process.hpp"

namespace contact::tool {
namespace {

namespace fs = std::filesystem;

struct Options {
  EngineOptions engine;
  std::string level = "bounded";
  std::vector<std::string> laws;
  std::optional<std::uint64_t> seed;
  std::uint64_t cases = 1000;
  std::string save;
  std::string junit;
  std::string json;
  bool list = false;
  bool table = false;
};

constexpr std::string_view kRegression = "regression";

/// The command that repeats a run.
std::string command_again(const Options& o, std::uint64_t seed) {
  std::string text = "contact-oracle properties";
  const auto add = [&](std::string_view option, const std::string& value) {
    if (!value.empty()) text += fmt::format(" {} '{}'", option, value);
  };
  add("--engine", o.engine.engine);
  add("--engine-command", o.engine.command);
  add("--engine-library", o.engine.library);
  if (o.engine.points != "nearest_surface") add("--points", o.engine.points);
  if (o.level != "bounded") add("--level", o.level);
  return text + fmt::format(" --cases {} --seed {}", o.cases, seed);
}

/// The cases of a regression file so far; none where there is no such file yet.
struct Regression {
  golden::DatasetHeader header;
  std::vector<golden::Case> cases;
};
std::optional<Regression> read_regression(const fs::path& path) {
  if (!fs::exists(path)) return std::nullopt;
  golden::DatasetReader reader(path);
  Regression found{reader.header(), {}};
  if (found.header.family != kRegression)
    throw golden::InputError({path.string(), 1}, "family",
                             fmt::format("expected \"{}\", the family of saved counterexamples, got \"{}\"",
                                         kRegression, found.header.family));
  while (auto c = reader.next()) found.cases.push_back(std::move(*c));
  return found;
}

/// The questions of every violation, each once, into `path`; those of another pair or scalar than stands there go to a
/// file beside it that is named by pair and scalar. What lies outside the domain has no place in such a file.
void save(const std::string& path, const proptests::RunResult& result) {
  const Scalar scalar = result.engine.declared.scalar;
  std::map<Pair, std::vector<Query>> questions;
  std::vector<Pair> order;
  for (const proptests::LawResult& r : result.laws) {
    if (!r.violation) continue;
    for (const Query& query : r.violation->queries) {
      if (outside_domain(query)) continue;
      if (!questions.contains(query.pair)) order.push_back(query.pair);
      questions[query.pair].push_back(query);
    }
  }
  std::optional<Regression> there = read_regression(path);
  for (const Pair pair : order) {
    const bool first = there ? there->header.pair == pair && there->header.scalar == scalar : pair == order.front();
    fs::path file = path;
    std::optional<Regression> regression = there;
    if (!first) {
      file.replace_extension(fmt::format(".{}{}.jsonl", name(pair), scalar == Scalar::binary32 ? ".f32" : ""));
      regression = read_regression(file);
    }
    if (!regression) {
      regression = Regression{};
      regression->header.pair = pair;
      regression->header.scalar = scalar;
      regression->header.family = kRegression;
    }
    std::set<std::string> ids;
    for (const golden::Case& c : regression->cases) ids.insert(c.id);
    std::size_t added = 0;
    for (const Query& query : questions[pair])
      if (ids.insert(golden::query_id(query)).second) {
        regression->cases.push_back(golden::make_case(query, scalar));
        ++added;
      }
    regression->header.count = regression->cases.size();
    const auto output = golden::create_dataset(file, regression->header);
    for (const golden::Case& c : regression->cases) output->write(c, golden::to_line(c));
    output->commit();
    fmt::print("Saved {} new cases in {}, which holds {}\n", added, file.string(), regression->cases.size());
  }
}

void write(const std::unique_ptr<golden::OutputFile>& file, const std::string& text) {
  if (file == nullptr) return;
  file->write(text);
  file->commit();
}

int properties(const Options& o) {
  if (o.table) {
    fmt::print("<!-- laws:begin -->\n{}<!-- laws:end -->\n", proptests::law_table());
    return kCertified;
  }
  if (o.list) {
    for (const proptests::Law& law : proptests::laws()) fmt::print("{:<26}{}\n", law.name, law.sentence);
    return kCertified;
  }
  if (!o.engine.results.empty())
    throw golden::InputError({"properties", 0}, "--results",
                             "laws ask questions of their own: give an engine that answers");
  std::vector<std::string_view> names;
  for (const proptests::Law& law : proptests::laws()) names.push_back(law.name);
  for (const std::string& law : o.laws) static_cast<void>(index_of(names, law, "law"));
  static constexpr std::array<std::string_view, 2> kLevels{"bounded", "correctly-rounded"};
  proptests::RunOptions run;
  run.correctly_rounded = index_of(kLevels, o.level, "level for properties") == 1;
  std::random_device entropy;
  run.seed = o.seed.value_or((static_cast<std::uint64_t>(entropy()) << 20) ^ entropy());
  run.cases = o.cases;
  run.names = o.laws;
  if (!o.save.empty()) static_cast<void>(read_regression(o.save));  // refused before the work
  const auto json = o.json.empty() ? nullptr : std::make_unique<golden::OutputFile>(o.json);
  const auto junit = o.junit.empty() ? nullptr : std::make_unique<golden::OutputFile>(o.junit);

  auto engine = make_engine(o.engine);
  const Scalar scalar = engine->info().declared.scalar;
  run.truth = [scalar](const Query& query) {
    oracle::Truth truth = oracle::truth_of(query);
    require_agreement(query, truth, oracle::interval_answer(query, scalar), scalar);
    return truth;
  };
  Progress progress(engine->info().name, o.cases * (o.laws.empty() ? names.size() : o.laws.size()));
  run.after_case = [&] {
    throw_if_interrupted();
    progress.add(1);
  };
  run.restart = [&] { return make_engine(o.engine); };
  LawRun done{proptests::run_laws(engine, run), run.seed, o.cases, command_again(o, run.seed)};
  write(json, json_text(done));
  write(junit, junit_text(done));
  fmt::print("{}", terminal_text(done));
  if (!o.save.empty()) save(o.save, done.result);
  if (done.result.holds()) return kCertified;
  return done.result.ever_answered ? kRefuted : kHarnessInvalid;
}

}  // namespace

void add_properties(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand(
      "properties",
      "Ask an engine every law of docs/properties.md, and shrink what it violates to what a person can read");
  auto options = std::make_shared<Options>();
  add_engine_options(*command, options->engine);
  command
      ->add_option("--level", options->level,
                   "bounded: held to its declared bounds; correctly-rounded: to correct rounding, bit for bit")
      ->capture_default_str();
  command->add_option("--law", options->laws, "Only these laws; --list shows them")->delimiter(',');
  command->add_option("--seed", options->seed, "The seed (default: random, printed)")->check(kFromZero);
  command->add_option("--cases", options->cases, "Cases a law")->capture_default_str()->check(kFromOne);
  command->add_option(
      "--save", options->save,
      "Add the shrunk counterexamples to this golden file, made where it is not there; one of another pair "
      "goes to a file beside it");
  command->add_option("--junit", options->junit, "Write the report as JUnit XML, a test case a law");
  command->add_option("--json", options->json, "Write the report as JSON");
  command->add_flag("--list", options->list, "List the laws");
  command->add_flag("--table", options->table, "The table of docs/properties.md")->group("");
  command->callback([options, &exit] { exit = properties(*options); });
}

}  // namespace contact::tool
