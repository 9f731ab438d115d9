// The first stage: pairs of doubles with a radius of error. It proves an answer, or has none.
#include "oracle/truth/double_double_oracle.hpp"

#include <utility>

#include "oracle/truth/default_environment.hpp"

namespace contact::oracle {
namespace {

std::optional<DoubleDoubleCase> answer(const Query& query, Scalar scalar, bool with_margin) {
  const DefaultEnvironment environment;
  return std::visit(
      [&](const auto& shapes) { return double_double_case(shapes, query.distances, scalar, with_margin); },
      query.shapes);
}

}  // namespace

std::optional<RoundedAnswer> double_double_answer(const Query& query, Scalar scalar) {
  auto found = answer(query, scalar, false);
  if (!found) return std::nullopt;
  return std::move(found->answer);
}

std::optional<DoubleDoubleCase> double_double_case(const Query& query, Scalar scalar) {
  return answer(query, scalar, true);
}

}  // namespace contact::oracle
