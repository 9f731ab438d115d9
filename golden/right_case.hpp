// The right case of a question, from the exact oracle; and whether a case that stands somewhere is that one.
#pragma once

#include <cstdint>
#include <string_view>

#include "golden/dataset.hpp"
#include "oracle/truth/truth.hpp"

namespace contact::golden {

/// The case of a question: id, flags, expectation and witnesses, all from the exact oracle.
[[nodiscard]] Case make_case(const Query& query, Scalar scalar);

/// Whether the family's generator makes the question of this id at this place of a dataset: for DatasetReader.
[[nodiscard]] bool is_made(const DatasetHeader& header, std::uint64_t index, std::string_view id);

/// Compares what a case of the family `invalid` says with the first field outside the domain. Throws InputError.
void check_rejection(const Case& c, const formats::Location& where);

/// Whether a case says this answer and these exact numbers, word for word.
[[nodiscard]] bool says(const Case& c, const Expectation& right, const oracle::Witness& exact);

/// Compares a case with what the oracle says. Throws formats::InputError naming the field, the value found and the
/// right one.
void check_case(const Case& c, Scalar scalar, const oracle::Truth& truth, const formats::Location& where);

}  // namespace contact::golden
