// The exact numbers that a golden file records, as integers on one grid: what `witness` says, without rationals.
#include "oracle/truth/quick_witness.hpp"

#include "oracle/truth/default_environment.hpp"
#include "oracle/truth/grid.hpp"

namespace contact::oracle {

Witness quick_witness(const Query& query) {
  const DefaultEnvironment environment;
  return std::visit([&](const auto& shapes) { return quick_witness(shapes, query.distances); }, query.shapes);
}

}  // namespace contact::oracle
