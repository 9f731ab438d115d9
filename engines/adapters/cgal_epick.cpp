// CGAL's Exact_predicates_inexact_constructions_kernel: an exact comparison with a reach^2 that its user rounded.
#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

// Beyond the scale the rounded reach^2 overflows, which ends the process in its conversion to a rational, or
// underflows.
std::string declaration() {
  return R"({"engine":{"name":"cgal-epick","version":")" CGAL_VERSION_STR
         R"("},"scalar":"binary64","pairs":["sphere_sphere"],)"
         R"("conventions":{"scale":{"min":1e-150,"max":1e150}},"claims":["overlap"]})";
}

void answer(const Question& q, Answer& said) {
  using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
  const auto point = [](const double* x) { return Point(x[0], x[1], x[2]); };
  const double reach = q.alarm + q.a[3] + q.b[3];
  said.overlap(CGAL::compare_squared_distance(point(q.a), point(q.b), reach * reach) != CGAL::LARGER);
}

}  // namespace contact::adapters
