// Sums of doubles, exactly.
#include "contact/exact_sum.hpp"

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
  const Sum sum(terms);
  return kernel::round_integer(sum.total, sum.grid.exponent() + exponent);
}

}  // namespace contact
