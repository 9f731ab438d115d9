// How many questions a second pass through a pipe: the host of engine processes and the example engine in C, without a
// judge.
#include <benchmark/benchmark.h>

#include "engines/hosts/subprocess.hpp"
#include "golden/families.hpp"

namespace {

constexpr std::uint64_t kQuestions = 1'000'000;
constexpr std::uint64_t kTogether = 1024;  // as certify asks

void questions_through_a_pipe(benchmark::State& state) {
  using namespace contact;
  const golden::Family& generic = *golden::find_family(Pair::sphere_sphere, "generic");
  std::vector<engines::Question> questions;
  for (std::uint64_t i = 0; i < kTogether; ++i)
    questions.push_back({"", golden::generate_query(Pair::sphere_sphere, generic, Scalar::binary64, 42, i)});
  engines::SubprocessOptions options;
  options.command = {CONTACT_PLAIN_PIPE};
  const auto engine = engines::make_subprocess(options);
  for ([[maybe_unused]] const auto run : state)
    for (std::uint64_t asked = 0; asked < kQuestions; asked += kTogether)
      for (const Claim& claim : engine->answer(questions))
        if (claim.status != Claim::Status::answered || !claim.overlap)
          state.SkipWithError("a question was not answered");
  const std::uint64_t asked = (kQuestions + kTogether - 1) / kTogether * kTogether;
  state.SetItemsProcessed(static_cast<std::int64_t>(asked) * state.iterations());
}
BENCHMARK(questions_through_a_pipe)->Unit(benchmark::kSecond)->UseRealTime()->Iterations(1);

}  // namespace
