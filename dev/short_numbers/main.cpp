// The kernels of production on numbers of few bits, every question of some grids against exact integers.
//   tiny_kernels quick|whole [KERNEL...]     "one pair", or "one pair 6" for one of its numbers of bits
// Prints lines of columns, told apart by the first: total, kind, place, and wrong. Exit status 1 where something is
// wrong, or where something that should happen never did.
#include <algorithm>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "dev/short_numbers/kernels.hpp"

namespace contact::kernel::tiny {
namespace {

template <class... Columns>
void print(const Columns&... columns) {
  std::string line;
  const auto add = [&line](const auto& column) {
    if (!line.empty()) line += '\t';
    if constexpr (std::is_arithmetic_v<std::decay_t<decltype(column)>>)
      line += std::to_string(column);
    else
      line += column;
  };
  (add(columns), ...);
  std::puts(line.c_str());
}

template <class Counts>
std::uint64_t sum(const Counts& counts) {
  return std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
}

bool right(const NamedKernel& kernel, bool whole) {
  Outcome total;
  for (const Grid& grid : grids(kernel.bits, whole)) {
    const Outcome outcome = ask_all(grid, kernel.bits, kernel.answer);
    print("grid", kernel.name, kernel.bits, grid.name, outcome.questions, sum(outcome.settled), sum(outcome.left),
          outcome.wrong);
    for (const std::string& text : outcome.first_wrong) print("wrong", kernel.name, kernel.bits, grid.name, text);
    total.add(outcome);
  }
  print("total", kernel.name, kernel.bits, total.questions, total.decided[0], total.decided[1], total.decided[2],
        sum(total.settled), sum(total.left), total.wrong);
  for (const auto& [kind, counts] : total.kinds) print("kind", kernel.name, kernel.bits, kind, counts[0], counts[1]);
  if (kernel.places != nullptr)
    for (const auto& [place, outcomes] : kernel.places->reached())
      print("place", kernel.name, kernel.bits, std::get<0>(place), std::get<1>(place), std::get<2>(place), outcomes.yes,
            outcomes.no);
  std::fflush(stdout);

  bool all = total.wrong == 0;
  const auto happens = [&](const std::string& what, std::uint64_t count) {
    if (count == 0) print("never", kernel.name, kernel.bits, what);
    all = all && count != 0;
  };
  if (kernel.bits > 5) {  // 32 u is 1 there, and the filter of one pair decides nothing
    happens("hit", total.decided[0]);
    happens("miss", total.decided[1]);
  }
  happens("no decision", total.decided[2]);
  for (std::size_t k = 0; k < kNumbers && kernel.computes; ++k) {
    happens("number " + std::to_string(k) + " settled", total.settled[k]);
    happens("number " + std::to_string(k) + " left", total.left[k]);
  }
  return all;
}

}  // namespace
}  // namespace contact::kernel::tiny

int main(int argc, char** argv) {
  using namespace contact::kernel::tiny;
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.empty() || (arguments[0] != "quick" && arguments[0] != "whole")) {
    std::fputs("tiny_kernels quick|whole [KERNEL...]\n", stderr);
    return 2;
  }
  bool all = true;
  const bool whole = arguments[0] == "whole";
  std::size_t asked = 0;
  for (const auto& kernels : {one_pair_kernels(), one_vector_kernels(), batch_kernels()})
    for (const NamedKernel& kernel : kernels) {
      const auto named = [&](const std::string& name) {
        return std::find(arguments.begin() + 1, arguments.end(), name) != arguments.end();
      };
      const bool wanted = arguments.size() == 1
                              ? whole || kernel.quick
                              : named(kernel.name) || named(kernel.name + " " + std::to_string(kernel.bits));
      if (!wanted) continue;
      ++asked;
      all = right(kernel, whole) && all;
    }
  return all && asked != 0 ? 0 : 1;
}
