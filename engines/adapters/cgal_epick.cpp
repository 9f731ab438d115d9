// CGAL's Exact_predicates_inexact_constructions_kernel: an exact comparison with a reach^2 that its user rounded;
// do_intersect of a sphere of this squared radius and an Iso_cuboid_3.
#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

// Beyond the scale the rounded reach^2 overflows, which ends the process in its conversion to a rational, or
// underflows.
std::string declaration() {
  return R"({"engine":{"name":"cgal-epick","version":")" CGAL_VERSION_STR
         R"("},"scalar":"binary64","pairs":["sphere_sphere","sphere_cube"],)"
         R"("conventions":{"scale":{"min":1e-150,"max":1e150}},"claims":["overlap"]})";
}

void answer(const Question& q, Answer& said) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto point = [](const double* x) { return Kernel::Point_3(x[0], x[1], x[2]); };
  if (q.pair == CONTACT_SPHERE_CUBE) {
    const double reach = q.alarm + q.a[3];
    const Kernel::Iso_cuboid_3 box(point(q.b), point(q.b + 3));
    said.overlap(CGAL::do_intersect(Kernel::Sphere_3(point(q.a), reach * reach), box));
    return;
  }
  const double reach = q.alarm + q.a[3] + q.b[3];
  said.overlap(CGAL::compare_squared_distance(point(q.a), point(q.b), reach * reach) != CGAL::LARGER);
}

}  // namespace contact::adapters
