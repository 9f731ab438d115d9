// The second oracle: MPFR intervals with outward rounding.
#include "oracle/truth/interval_oracle.hpp"

#include <limits>

#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/interval.hpp"

namespace contact::oracle {
namespace {

constexpr mpfr_prec_t kFirstPrecision = 192;

}  // namespace

std::optional<RoundedAnswer> interval_answer_within(int most, const Query& query, Scalar scalar) {
  const DefaultEnvironment environment;
  for (mpfr_prec_t precision = kFirstPrecision; precision <= most; precision *= 2) {
    try {
      return std::visit([&](const auto& shapes) { return interval_answer(shapes, query.distances, scalar, precision); },
                        query.shapes);
    } catch (const Undecided&) {
    }
  }
  return std::nullopt;
}

RoundedAnswer interval_answer(const Query& query, Scalar scalar) {
  return *interval_answer_within(std::numeric_limits<int>::max(), query, scalar);
}

}  // namespace contact::oracle
