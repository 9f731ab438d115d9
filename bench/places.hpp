// Where the data of a benchmark is: numbers of pairs that fit in the second level cache, in the third, and in neither.
#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <string>

#include "kernel/batch.hpp"

namespace contact::bench {

struct Place {
  const char* name;
  std::size_t pairs;
};
inline constexpr std::array<Place, 3> kPlaces{{{"L2", 1 << 12}, {"L3", 1 << 17}, {"memory", 1 << 22}}};

/// What a state's times are divided by.
inline void count(benchmark::State& state, std::size_t pairs) {
  state.counters["time/pair"] = benchmark::Counter(
      static_cast<double>(pairs), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Registers work(pairs) for a place, with an instruction set's vectors, or the best there are. Processor time: what
/// else the machine does is not counted.
template <class Work>
void at_place(const std::string& name, const Place& place, Work work, const std::string& instruction_set = "") {
  const auto run = [work, instruction_set, n = place.pairs, ready = false](benchmark::State& state) mutable {
    kernel::use_instruction_set(instruction_set);
    if (!ready) work(n);  // makes the data
    ready = true;
    for ([[maybe_unused]] auto _ : state) work(n);
    count(state, n);
  };
  benchmark::RegisterBenchmark((name + "/" + place.name).c_str(), run);
}

template <class Work>
void at_every_place(const std::string& name, Work work, const std::string& instruction_set = "") {
  for (const Place& place : kPlaces) at_place(name, place, work, instruction_set);
}

}  // namespace contact::bench
