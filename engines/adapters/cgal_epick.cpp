// CGAL's Exact_predicates_inexact_constructions_kernel: an exact comparison with a reach^2 that its user rounded;
// do_intersect of a sphere of this squared radius and an Iso_cuboid_3; squared_distance of points, segments, triangles
// and planes; do_intersect of a triangle and a segment or an Iso_cuboid_3.
#include <CGAL/Bbox_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include "engines/adapters/adapter.hpp"

namespace contact::adapters {

// Beyond the scale the rounded reach^2 overflows, which ends the process in its conversion to a rational, or
// underflows.
std::string declaration() {
  return R"({"engine":{"name":"cgal-epick","version":")" CGAL_VERSION_STR
         R"("},"scalar":"binary64","pairs":["sphere_sphere","sphere_cube","sphere_capsule","capsule_capsule",)"
         R"("sphere_triangle","ray_sphere","sphere_plane","capsule_plane","ray_triangle","triangle_line",)"
         R"("cube_triangle","triangle_triangle","cube_plane","triangle_plane"],)"
         R"("conventions":{"scale":{"min":1e-150,"max":1e150}},)"
         R"("pair_conventions":{"ray_sphere":{"shapes":"centered"},"ray_triangle":{"shapes":"centered"},"cube_triangle":{"margin":"none"}},)"
         R"("claims":["overlap"]})";
}

void answer(const Question& q, Answer& said) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  const auto point = [](const double* x) { return Kernel::Point_3(x[0], x[1], x[2]); };
  const auto segment = [&](const Shape& capsule) {
    return Kernel::Segment_3(point(capsule.numbers), point(capsule.numbers + 3));
  };
  const auto triangle = [&](const Shape& x) {
    return Kernel::Triangle_3(point(x.vertex(0)), point(x.vertex(1)), point(x.vertex(2)));
  };
  const auto line = [&](const Shape& x) { return Kernel::Segment_3(point(x.start()), point(x.end)); };
  // CGAL counts a segment that lies in the plane of a triangle, and has no word on triangles without an inside.
  const auto crosses = [&](const Kernel::Segment_3& s, const Kernel::Triangle_3& t) {
    const auto beside = [&](const Kernel::Point_3& p) { return !CGAL::coplanar(t[0], t[1], t[2], p); };
    return (beside(s.source()) || beside(s.target())) && CGAL::do_intersect(s, t);
  };
  const double reach = q.alarm + q.a.radius + q.b.radius;
  const double reach2 = reach * reach;
  const auto cuboid = [&](const Shape& x) { return Kernel::Iso_cuboid_3(point(x.numbers), point(x.numbers + 3)); };
  if (q.pair == CONTACT_SPHERE_CUBE)
    return said.overlap(CGAL::do_intersect(Kernel::Sphere_3(point(q.a.center), reach2), cuboid(q.b)));
  if (q.pair == CONTACT_CUBE_TRIANGLE) return said.overlap(CGAL::do_intersect(cuboid(q.a), triangle(q.b)));
  if (q.pair == CONTACT_TRIANGLE_TRIANGLE)
    return said.overlap(CGAL::squared_distance(triangle(q.a), triangle(q.b)) <= reach2);
  if (q.pair == CONTACT_SPHERE_CAPSULE)
    return said.overlap(CGAL::squared_distance(point(q.a.center), segment(q.b)) <= reach2);
  if (q.pair == CONTACT_CAPSULE_CAPSULE)
    return said.overlap(CGAL::squared_distance(segment(q.a), segment(q.b)) <= reach2);
  if (q.pair == CONTACT_SPHERE_TRIANGLE)
    return said.overlap(CGAL::squared_distance(point(q.a.center), triangle(q.b)) <= reach2);
  if (q.pair == CONTACT_RAY_SPHERE) return said.overlap(CGAL::squared_distance(line(q.a), point(q.b.center)) <= reach2);
  if (q.pair == CONTACT_RAY_TRIANGLE) return said.overlap(crosses(line(q.a), triangle(q.b)));
  if (q.pair == CONTACT_TRIANGLE_LINE) return said.overlap(crosses(line(q.b), triangle(q.a)));
  if (q.b.kind == Kind::plane) {
    const double* x = q.b.numbers;
    const Kernel::Plane_3 plane(x[0], x[1], x[2], -x[3]);
    const auto near = [&](const Kernel::Point_3& p) {
      return plane.has_on_negative_side(p) || CGAL::squared_distance(p, plane) <= reach2;
    };
    if (q.pair == CONTACT_SPHERE_PLANE) return said.overlap(near(point(q.a.center)));
    const auto any_near = [&](const auto& corners, int count) {
      bool any = false;
      for (int i = 0; i < count; ++i) any = any || near(corners[i]);
      return said.overlap(any);
    };
    if (q.pair == CONTACT_CAPSULE_PLANE) return any_near(segment(q.a), 2);
    if (q.pair == CONTACT_CUBE_PLANE) return any_near(cuboid(q.a), 8);
    return any_near(triangle(q.a), 3);
  }
  said.overlap(CGAL::compare_squared_distance(point(q.a.center), point(q.b.center), reach2) != CGAL::LARGER);
}

}  // namespace contact::adapters
