// The exact numbers that a golden file records: what `witness` says, without rationals where the nearest points are given.
#pragma once

#include "oracle/truth/truth.hpp"

namespace contact::oracle {

/// The texts of the witness of a question, its margin left at 0. Of spheres and boxes every number is an integer times
/// a common power of two; D, reach and the gaps are sums and products of such integers (GMP), so nothing is rounded.
/// Domain: every number of the question finite and inside the domain.
[[nodiscard]] Witness quick_witness(const Query& query);

}  // namespace contact::oracle
