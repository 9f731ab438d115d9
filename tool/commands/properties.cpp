// properties: the laws asked of any engine, with counterexamples that a person can read.
#include <fmt/format.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>

#include "engines/hosts/subprocess.hpp"
#include "formats/output_file.hpp"
#include "golden/agreement.hpp"
#include "golden/dataset_writer.hpp"
#include "golden/query_id.hpp"
#include "golden/right_case.hpp"
#include "tool/commands/commands.hpp"
#include "tool/commands/demand.hpp"
#include "tool/commands/engine_options.hpp"
#include "tool/commands/json_output.hpp"
#include "tool/reports/law_report.hpp"
#include "tool/run/pipeline.hpp"
#include "tool/run/printing.hpp"
#include "tool/run/process.hpp"

namespace contact::tool {
namespace {

namespace fs = std::filesystem;

struct PropertiesOptions {
  EngineOptions engine;
  DemandOptions demand;
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
constexpr std::array kLawLevels{name(Level::bounded), name(Level::correctly_rounded)};

/// A word as a shell reads it back, on one visible line: $'\x1b' where it must be.
std::string shell_word(const std::string& word) {
  if (formats::visible(word) == word) return engines::quoted_word(word);
  std::string text = "$'";
  for (const char c : word)
    text += c == '\'' || c == '\\' ? fmt::format("\\{}", c)
            : c >= ' ' && c <= '~' ? std::string(1, c)
                                   : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
  return text + "'";
}

/// The command that repeats a run: every option that was given, but for those that it states itself, the law, which
/// each violation adds, and the files that this run writes.
std::string command_again(const CLI::App& command, const PropertiesOptions& o, std::uint64_t seed) {
  constexpr std::array<std::string_view, 6> kOwn{"--cases", "--seed", "--law", "--save", "--junit", "--json"};
  std::string text = "contact-oracle properties";
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (std::find(kOwn.begin(), kOwn.end(), name) != kOwn.end()) continue;
    for (const std::string& value : option->results()) text += fmt::format(" {}={}", name, shell_word(value));
  }
  return text + fmt::format(" --cases={} --seed={}", o.cases, seed);
}

/// The cases of a regression file so far; none where there is no such file yet.
struct Regression {
  golden::DatasetHeader header;
  std::vector<golden::Case> cases;
};
std::optional<Regression> read_regression(const fs::path& path) {
  if (!fs::exists(path)) return std::nullopt;
  golden::DatasetReader reader(path, golden::is_made);
  Regression found{reader.header(), {}};
  if (found.header.family != kRegression)
    throw formats::InputError({path.string(), 1}, "family",
                              fmt::format("expected \"{}\", the family of saved counterexamples, got \"{}\"",
                                          kRegression, found.header.family));
  while (auto c = reader.next()) found.cases.push_back(std::move(*c));
  return found;
}

/// The same of the file beside `path` that is named by pair and scalar, and holds no other questions.
fs::path beside(fs::path path, Pair pair, Scalar scalar) {
  return path.replace_extension(fmt::format(".{}{}.jsonl", name(pair), scalar == Scalar::binary32 ? ".f32" : ""));
}
std::optional<Regression> read_beside(const fs::path& path, Pair pair, Scalar scalar) {
  const fs::path file = beside(path, pair, scalar);
  std::optional<Regression> found = read_regression(file);
  const auto require = [&](const std::string& field, std::string_view expected, std::string_view got) {
    if (expected != got)
      throw formats::InputError({file.string(), 1}, field,
                                fmt::format("expected \"{}\", as the file's name says, got \"{}\"", expected, got));
  };
  if (found) require("pair", name(pair), name(found->header.pair));
  if (found) require("scalar", name(scalar), name(found->header.scalar));
  return found;
}

/// The questions of every violation, each once, into `path`; those of another pair or scalar than stands there go to a
/// file beside it. What lies outside the domain has no place in such a file.
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
    const fs::path file = first ? fs::path(path) : beside(path, pair, scalar);
    std::optional<Regression> regression = first ? there : read_beside(path, pair, scalar);
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
    say("Saved {} new cases in {}, which holds {}\n", added, file.string(), regression->cases.size());
  }
}

void write(const std::unique_ptr<formats::OutputFile>& file, const std::string& text) {
  if (file == nullptr) return;
  file->write(text);
  file->commit();
}

int properties(const CLI::App& command, const PropertiesOptions& o) {
  for (const char* option : {"--list", "--table"})
    if (command.count(option) != 0) require_alone(command, option);
  if (o.table) {
    fmt::print("<!-- laws:begin -->\n{}<!-- laws:end -->\n", proptests::law_table());
    return kCertified;
  }
  if (o.list) {
    for (const proptests::Law& law : proptests::laws()) fmt::print("{:<26}{}\n", law.name, law.sentence);
    return kCertified;
  }
  require_used(o.engine, false);
  std::vector<std::string_view> names;
  for (const proptests::Law& law : proptests::laws()) names.push_back(law.name);
  for (const std::string& law : o.laws) static_cast<void>(index_of(names, law, "law"));
  proptests::RunOptions run;
  run.correctly_rounded = o.demand.level == name(Level::correctly_rounded);
  run.seed = seed_or_fresh(o.seed);
  run.cases = o.cases;
  run.names = o.laws;
  if (!o.save.empty() && !golden::names_dataset(o.save))
    throw formats::InputError({"properties", 0}, "--save",
                              fmt::format("the name of a dataset ends in .jsonl, .h5 or .npz, got '{}'", o.save));
  if (!o.save.empty()) static_cast<void>(read_regression(o.save));  // refused before the work
  JsonOutput json(o.json);
  const auto junit = o.junit.empty() ? nullptr : std::make_unique<formats::OutputFile>(o.junit);
  if (!o.save.empty()) static_cast<void>(formats::PendingFile(o.save));  // as is a place where nothing can be written

  auto engine = make_engine(o.engine);
  const Scalar scalar = engine->info().declared.scalar;
  if (!o.save.empty())
    for (const Pair pair : kPairs) static_cast<void>(read_beside(o.save, pair, scalar));
  run.tolerance = demanded_tolerance(o.demand, engine->info().declared.tolerance);
  run.truth = [scalar](const Query& query) {
    oracle::Truth truth = oracle::truth_of(query);
    golden::require_agreement(query, oracle::rounded_answer(truth, scalar), oracle::interval_answer(query, scalar),
                              scalar);
    return truth;
  };
  Progress progress(engine->info().name, o.cases * (o.laws.empty() ? names.size() : o.laws.size()));
  run.after_case = [&] {
    throw_if_interrupted();
    progress.add(1);
  };
  run.restart = [&] { return make_engine(o.engine); };
  LawRun done{proptests::run_laws(engine, run), run.seed, o.cases, command_again(command, o, run.seed)};
  const auto write_json = [&] {
    json.write(json_text(done));
    json.commit();
  };
  if (!json.alone()) write_json();
  write(junit, junit_text(done));
  if (!json.alone()) words() << terminal_text(done);
  say_decimals(engine->decimals(), "the answers");
  if (!o.save.empty()) save(o.save, done.result);
  if (json.alone()) write_json();  // behind all files: nobody may read it
  if (done.result.holds()) return kCertified;
  return done.result.ever_answered ? kRefuted : kHarnessInvalid;
}

}  // namespace

void add_properties(CLI::App& app, int& exit) {
  auto* command = app.add_subcommand("properties",
                                     "Ask an engine every law, and shrink what it violates\n"
                                     "The laws are those of docs/properties.md. What violates one is shrunk to what a "
                                     "person can read.");
  auto options = std::make_shared<PropertiesOptions>();
  add_engine_options(*command, options->engine, false);
  add_demand_options(*command, options->demand, kLawLevels,
                     "Held to its declared bounds, or to correct rounding, bit for bit");
  command->add_option("--law", options->laws, "Only these laws; --list shows them")->delimiter(',');
  command->add_option("--seed", options->seed, "The seed (default: random, printed)")->check(kFromZero);
  command->add_option("--cases", options->cases, "Cases a law")->capture_default_str()->check(kFromOne);
  {
    const Heading heading(*command, "Reports");
    command
        ->add_option("--save", options->save,
                     "Add the shrunk counterexamples to this golden file, made where it is not there; one of another "
                     "pair goes to a file beside it")
        ->type_name("FILE");
    add_json_option(*command, options->json, "The report as JSON", FileOfJson::behind_space_too);
    command->add_option("--junit", options->junit, "Write the report as JUnit XML, a test case a law")
        ->type_name("FILE");
  }
  command->add_flag("--list", options->list, "List the laws");
  command->add_flag("--table", options->table, "The table of docs/properties.md")->group("");
  command->callback([options, command, &exit] { exit = properties(*command, *options); });
}

}  // namespace contact::tool
