// Sums of doubles, exactly.
#include "contact/exact_sum.hpp"

#include <algorithm>

#include "kernel/exact.hpp"

namespace contact {
namespace {

struct Sum {
  explicit Sum(std::initializer_list<double> terms) : grid(terms) {
    for (const double term : terms) total += grid(term);
  }
  kernel::Grid grid;
  kernel::Integer total = 0;
};

}  // namespace

int sign_of_sum(std::initializer_list<double> terms) { return Sum(terms).total.sign(); }

double rounded_sum(std::initializer_list<double> terms, int exponent) {
  // Beyond this every sum is 0 or infinite, whatever its terms; nearer, no shift is long and no exponent overflows.
  constexpr int kBeyond = 1 << 13;
  const Sum sum(terms);
  return kernel::round_integer(sum.total, sum.grid.exponent() + std::clamp(exponent, -kBeyond, kBeyond));
}

}  // namespace contact
