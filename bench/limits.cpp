// What the machine allows: the same bytes as the batch kernels move, with next to no arithmetic; STREAM's triad; two
// threads against one; and how soon the command answers.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "limits.cpp"
#include "kernel/batch_targets.hpp"
// foreach_target.h includes this file once a target, so it comes before the rest.
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace contact::bench {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<double>;

/// Reads `read` columns and writes their sums to the `write` columns behind them: a row a pair, or with an `index` 5
/// rows for 12 pairs, one after the other. A flag a row, and its index.
void move_columns(double* const* column, std::size_t read, std::size_t write, std::size_t size, std::uint8_t* flag,
                  std::uint32_t* index) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::size_t row = 0;
  for (std::size_t i = 0; i < size; i += lanes) {
    auto sum = hn::Load(d, column[0] + i);
    for (std::size_t k = 1; k < read; ++k) sum = hn::Add(sum, hn::Load(d, column[k] + i));
    if (index != nullptr && i / lanes % 12 >= 5) continue;
    for (std::size_t k = 0; k < write; ++k) hn::Store(sum, d, column[read + k] + row);
    // The sum of positive numbers: nothing is known of it to the compiler.
    const auto bytes = static_cast<std::uint8_t>(hn::AllTrue(d, hn::Gt(sum, hn::Zero(d))));
    for (std::size_t k = 0; k < lanes; ++k) flag[row + k] = bytes;
    if (index != nullptr)
      for (std::size_t k = 0; k < lanes; ++k) index[row + k] = static_cast<std::uint32_t>(i + k);
    row += lanes;
  }
}

void triad(const double* b, const double* c, double* a, std::size_t size) {
  const D d;
  for (std::size_t i = 0; i < size; i += hn::Lanes(d))
    hn::Store(hn::Add(hn::Load(d, b + i), hn::Mul(hn::Set(d, 3), hn::Load(d, c + i))), d, a + i);
}

}  // namespace HWY_NAMESPACE
}  // namespace contact::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <map>
#include <vector>

#include "columns.hpp"
#include "contact/batch.hpp"
#include "places.hpp"
#include "questions.hpp"

namespace contact::bench {

HWY_EXPORT(move_columns);
HWY_EXPORT(triad);

namespace {

struct Memory {
  static constexpr std::size_t kColumns = 24;
  Columns columns;
  std::array<double*, kColumns> column{};
  std::vector<std::uint8_t> flag;
  std::vector<std::uint32_t> index;

  explicit Memory(std::size_t size) : columns(kColumns, size), flag(size), index(size) {
    for (std::size_t k = 0; k < column.size(); ++k) column[k] = columns[k].data();
  }
};

Memory& memory(std::size_t size) {
  static std::map<std::size_t, Memory> made;
  return made.try_emplace(size, size).first->second;
}

struct Traffic {
  const char* name;
  std::size_t read;
  std::size_t write;
  bool index;
};
/// What a call of the batch API reads and writes a pair.
constexpr std::array<Traffic, 13> kTraffic{{{"test", 8, 0, false},
                                            {"compute", 8, 10, false},
                                            {"hits", 8, 10, true},
                                            {"cubes", 12, 0, false},
                                            {"sphere_cube_test", 10, 0, false},
                                            {"sphere_cube_compute", 10, 10, false},
                                            {"sphere_cube_hits", 10, 10, true},
                                            {"sphere_capsule_test", 11, 0, false},
                                            {"sphere_capsule_compute", 11, 10, false},
                                            {"sphere_capsule_hits", 11, 10, true},
                                            {"capsules_test", 14, 0, false},
                                            {"capsules_compute", 14, 10, false},
                                            {"capsules_hits", 14, 10, true}}};

void compute_in_threads(benchmark::State& state) {
  constexpr std::size_t kPairs = 1 << 12;
  auto spheres = make_questions<Ball, Ball>(kPairs);
  const auto out = spheres.contacts();
  if (state.thread_index() == 0) kernel::use_instruction_set("");
  for ([[maybe_unused]] auto _ : state)
    batch::compute_sphere_sphere(spheres.a(), spheres.b(), {.alarm = 0, .contact = 0}, out);
  state.SetItemsProcessed(static_cast<std::int64_t>(kPairs) * state.iterations());
}
BENCHMARK(compute_in_threads)->Name("Threads/compute")->Threads(1)->Threads(2)->UseRealTime();

#ifdef CONTACT_COMMAND
void explain_one_question(benchmark::State& state) {
  constexpr const char* kCommand =
      R"(echo '{"a":{"center":[0,0,0],"radius":0.5},"b":{"center":[1,1e-9,0],"radius":0.5},)"
      R"("alarm":0,"contact":0}' | )" CONTACT_COMMAND " explain > /dev/null";
  const auto spent = [] {  // processor time of shell and command: a wall clock would measure the machine's load
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  };
  const auto start = std::chrono::steady_clock::now();
  for ([[maybe_unused]] auto _ : state) {
    const double before = spent();
    if (std::system(kCommand) != 0) state.SkipWithError("explain failed");
    state.SetIterationTime(spent() - before);
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  state.counters["wall"] = wall.count() / static_cast<double>(state.iterations());
}
BENCHMARK(explain_one_question)->Name("Startup/explain")->Unit(benchmark::kMillisecond)->UseManualTime()->MinTime(0.2);
#endif

[[maybe_unused]] const bool registered = [] {
  benchmark::AddCustomContext("compiler", CONTACT_COMPILER);
  for (const Place& place : kPlaces) {
    for (const Traffic& t : kTraffic)
      at_place(std::string("Limit/") + t.name, place, [&t](std::size_t n) {
        Memory& m = memory(n);
        HWY_DYNAMIC_DISPATCH(move_columns)
        (m.column.data(), t.read, t.write, n, m.flag.data(), t.index ? m.index.data() : nullptr);
      });
    at_place("Limit/triad", place, [](std::size_t n) {
      const Memory& m = memory(n);
      HWY_DYNAMIC_DISPATCH(triad)(m.column[0], m.column[1], m.column[2], n);
    });
  }
  return true;
}();

}  // namespace
}  // namespace contact::bench
#endif  // HWY_ONCE
