// A user's question of any bytes is refused or explained, and the oracles agree on it.
#include <nlohmann/json.hpp>
#include "formats/input_error.hpp"
#include "fuzz/fuzz.hpp"
#include "golden/agreement.hpp"
#include "golden/dataset.hpp"
#include "tool/reports/explanation.hpp"

namespace contact::fuzz::explain {
namespace {

void try_input(Bytes bytes) {
  const formats::Location where{"question", 1};
  try {
    const auto json = formats::parse_object(text_of(bytes), where);
    const auto [query, scalar, decimals] = golden::read_query(formats::Node(json, where));
    const oracle::Truth truth = oracle::truth_of(query);
    golden::check_stage(query, truth, oracle::staged_answer(query, scalar), scalar);
    require(tool::explanation(query, truth, scalar).find(truth.hit() ? "HIT" : "MISS") != std::string::npos,
            "an explanation without a decision");
    // The line that explain is given back for a question explains the same question.
    const std::string line = golden::query_line(query, scalar);
    const auto again = formats::parse_object(line, where);
    require(golden::query_line(golden::read_query(formats::Node(again, where)).query, scalar) == line, line);
  } catch (const formats::InputError&) {
  }
}

const Target target("explain", try_input);

}  // namespace
}  // namespace contact::fuzz::explain
