// How many questions a second are judged: by the stages of the oracle and by the exact path alone, in memory and
// through the whole pipeline, all on the same questions in one run.
#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <filesystem>

#include "golden/dataset_writer.hpp"
#include "golden/families.hpp"
#include "golden/right_case.hpp"
#include "oracle/judge/judge.hpp"
#include "oracle/truth/staged_oracle.hpp"
#include "tool/run/pipeline.hpp"

namespace {

using namespace contact;

constexpr std::uint64_t kQuestions = 4096;
constexpr std::uint64_t kCases = 300'000;  // of a file
constexpr std::uint64_t kSeed = 7;

struct Asked {
  std::vector<engines::Question> questions;
  std::vector<Claim> claims;
};

/// Questions of a family with production's answers.
Asked asked(std::string_view family) {
  Asked all;
  const golden::Family& made_by = *golden::find_family(Pair::sphere_sphere, family);
  for (std::uint64_t i = 0; i < kQuestions; ++i)
    all.questions.push_back({"", golden::generate_query(Pair::sphere_sphere, made_by, Scalar::binary64, kSeed, i)});
  all.claims = engines::make_built_in("production")->answer(all.questions);
  return all;
}

void count(benchmark::State& state, std::uint64_t questions) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(questions));
}

void expect_right(benchmark::State& state, const oracle::Verdict& verdict) {
  if (verdict.level() != oracle::Level::correctly_rounded) state.SkipWithError("an answer was not correctly rounded");
}

void judged_in_stages(benchmark::State& state, const char* family) {
  const Asked all = asked(family);
  const oracle::Declaration declared;
  oracle::StageCounts decided;
  for ([[maybe_unused]] const auto run : state)
    for (std::size_t i = 0; i < all.questions.size(); ++i) {
      const Query& query = all.questions[i].query;
      const oracle::StagedAnswer answer = oracle::staged_answer(query, Scalar::binary64);
      decided.add(answer.stage);
      expect_right(state, oracle::judge(query, answer.truth, all.claims[i], declared, &answer.expected));
    }
  count(state, kQuestions);
  const auto sum = static_cast<double>(decided.answers[0] + decided.answers[1] + decided.answers[2]);
  for (std::size_t i = 0; i < decided.answers.size(); ++i)
    state.counters[std::string(oracle::kStageNames[i])] = static_cast<double>(decided.answers[i]) / sum;
}

void judged_by_the_exact_path_alone(benchmark::State& state, const char* family) {
  const Asked all = asked(family);
  const oracle::Declaration declared;
  for ([[maybe_unused]] const auto run : state)
    for (std::size_t i = 0; i < all.questions.size(); ++i) {
      const Query& query = all.questions[i].query;
      const oracle::Truth truth = oracle::truth_of(query);
      const Expectation expected = oracle::expectation(truth, Scalar::binary64);
      expect_right(state, oracle::judge(query, truth, all.claims[i], declared, &expected));
    }
  count(state, kQuestions);
}

BENCHMARK_CAPTURE(judged_by_the_exact_path_alone, generic, "generic")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judged_in_stages, generic, "generic")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judged_in_stages, touching, "touching")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(judged_in_stages, near_touching, "near_touching")->Unit(benchmark::kMillisecond);

/// A dataset in every form that is measured, written once and removed at the end.
struct Files {
  Files() {
    golden::DatasetHeader header;
    header.family = "generic";
    header.seed = kSeed;
    header.count = kCases;
    const auto text = golden::create_dataset(path(".jsonl"), header);
    const auto columns = golden::create_dataset(path(".h5"), header);
    const golden::Family& generic = *golden::find_family(header.pair, header.family);
    for (std::uint64_t i = 0; i < kCases; ++i) {
      const golden::Case c =
          golden::make_case(golden::generate_query(header.pair, generic, header.scalar, kSeed, i), header.scalar);
      const std::string line = golden::to_line(c);
      text->write(c, line);
      columns->write(c, line);
    }
    text->commit();
    columns->commit();
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  ~Files() {
    for (const char* extension : {".jsonl", ".h5"}) std::filesystem::remove(path(extension));
  }

  static std::filesystem::path path(const std::string& extension) {
    return std::filesystem::temp_directory_path() / ("contact-oracle-bench" + extension);
  }
};

void certify(benchmark::State& state, const std::vector<tool::Source>& sources, std::size_t most_threads) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, most_threads);
  std::uint64_t questions = 0;
  std::uint64_t of_run = 0;
  for (const tool::Source& source : sources) {
    questions += source.count;
    of_run += source.size();
  }
  for ([[maybe_unused]] const auto run : state) {
    std::vector<tool::Subject> subjects;
    subjects.push_back({engines::make_built_in("production"), {}});
    subjects.front().report.engine = subjects.front().engine->info();
    tool::Stop never;
    tool::Oracles oracles;
    for (const tool::Source& source : sources) tool::judge_source(source, subjects, never, oracles, of_run);
    if (subjects.front().report.level_but_accepted() != oracle::Level::correctly_rounded)
      state.SkipWithError("an answer was not correctly rounded");
  }
  count(state, questions);
}
std::size_t threads_of(const benchmark::State& state) { return static_cast<std::size_t>(state.range(0)); }

void certified_from(benchmark::State& state, const char* extension) {
  static const Files files;
  certify(state, {{Pair::sphere_sphere, Scalar::binary64, "generic", kCases, Files::path(extension)}},
          threads_of(state));
}
BENCHMARK_CAPTURE(certified_from, json_lines, ".jsonl")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();
BENCHMARK_CAPTURE(certified_from, columns, ".h5")
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

void certified_as_generated(benchmark::State& state) {
  certify(state,
          {{Pair::sphere_sphere, Scalar::binary64, "generic", kCases, std::nullopt,
            golden::find_family(Pair::sphere_sphere, "generic"), kSeed}},
          threads_of(state));
}
BENCHMARK(certified_as_generated)
    ->Arg(1)
    ->Arg(2)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

/// The first questions of every family of every pair, each family judged as if it were `certify --generate 150000`: so
/// many of them are put to all oracles, and to the diagnosis.
void certified_as_generated_of_all(benchmark::State& state) {
  constexpr std::uint64_t kEach = 1000;
  std::vector<tool::Source> sources;
  for (const Pair pair : kPairs)
    for (const golden::Family& family : golden::families_of(pair)) {
      if (family.outside_domain) continue;
      sources.push_back({pair, Scalar::binary64, std::string(family.name), kEach, std::nullopt, &family, kSeed});
      sources.back().whole = 150'000;
    }
  certify(state, sources, 1);
}
BENCHMARK(certified_as_generated_of_all)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->Iterations(1)
    ->Repetitions(1);

}  // namespace
