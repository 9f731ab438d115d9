// The exact numbers that a golden file records, without rationals where the nearest points are given.
#pragma once

#include <optional>

#include "oracle/truth/truth.hpp"

namespace contact::oracle {

/// The texts of the witness of a question, its margin left at 0. Of spheres and axis-aligned boxes every number is an integer times
/// a common power of two; D, reach and the gaps are sums and products of such integers (GMP), so nothing is rounded. Nothing of other
/// pairs, whose texts come from the exact truth alone: `witness`.
/// Domain: every number of the question finite and inside the domain.
[[nodiscard]] std::optional<Witness> quick_witness(const Query& query);

}  // namespace contact::oracle
