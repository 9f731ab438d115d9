#include "golden/agreement.hpp"

#include <fmt/format.h>

#include "golden/dataset.hpp"
#include "oracle/truth/quick_witness.hpp"

namespace contact::golden {

void require_agreement(const Query& query, const oracle::RoundedAnswer& exact, const oracle::RoundedAnswer& second,
                       Scalar scalar, std::string_view second_name) {
  if (const auto differs = first_difference(exact, second))
    throw OracleFault(fmt::format("the exact oracle and the {} oracle differ in {} ({})\n{}", second_name, *differs,
                                  name(scalar), query_line(query, scalar)));
}

void check_stage(const Query& query, const oracle::Truth& truth, const oracle::StagedAnswer& staged, Scalar scalar) {
  const oracle::RoundedAnswer right = oracle::rounded_answer(truth, scalar);
  require_agreement(query, right, oracle::interval_answer(query, scalar), scalar);
  if (staged.stage == oracle::Stage::exact) return;
  const std::string_view stage = oracle::kStageNames[static_cast<std::size_t>(staged.stage)];
  require_agreement(query, right, oracle::rounded_answer(staged), scalar, stage);
  const oracle::Witness exact = oracle::witness(truth, scalar);
  std::optional<oracle::Witness> quick = oracle::quick_witness(query);
  if (quick) quick->margin_ulps = exact.margin_ulps;
  if ((quick && *quick != exact) || !staged.margin.allows(exact.margin_ulps))
    throw OracleFault(fmt::format("the exact oracle and the {} oracle differ in the witness ({})\n{}", stage,
                                  name(scalar), query_line(query, scalar)));
}

}  // namespace contact::golden
