// CGAL: compare_squared_distance in the kernel with inexact constructions, which gets the squared reach rounded, and in
// the one with exact constructions; numbers by to_double, since neither kernel has square roots.
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <cmath>
#include <stdexcept>
#include <type_traits>

#include "peers/peers.hpp"

namespace contact::bench {
namespace {

template <class Kernel>
struct Cgal {
  using Number = typename Kernel::FT;
  using Point = typename Kernel::Point_3;
  static Point point(const Vector3& v) { return {v[0], v[1], v[2]}; }

  static bool test(const Balls& p) {
    const Number reach2 = squared_reach(p);
    return CGAL::compare_squared_distance(point(p.a.center), point(p.b.center), reach2) != CGAL::LARGER;
  }
  static bool compute(const Balls& p, Contact& out) {
    const typename Kernel::Vector_3 delta(point(p.a.center), point(p.b.center));
    const Number d2 = delta.squared_length();
    // Where numbers are exact, comparing them is exact too.
    if (std::is_same_v<Number, double> ? !test(p) : d2 > squared_reach(p)) return false;
    const double s = std::sqrt(CGAL::to_double(d2));
    out.normal = Vector3(CGAL::to_double(delta.x()), CGAL::to_double(delta.y()), CGAL::to_double(delta.z())) / s;
    out.point1 = p.a.center + p.a.radius * out.normal;
    out.point2 = p.b.center - p.b.radius * out.normal;
    out.value = s - CGAL::to_double(Number(p.a.radius) + Number(p.b.radius));
    return true;
  }
  // Of these its users have squared distances, and compare.
  static bool test(const BallAndCapsule& p) {
    return CGAL::squared_distance(point(p.a.center), segment(p.b)) <= squared(Number(p.a.radius) + Number(p.b.radius));
  }
  static bool test(const Capsules& p) {
    return CGAL::squared_distance(segment(p.a), segment(p.b)) <= squared(Number(p.a.radius) + Number(p.b.radius));
  }
  static bool test(const BallAndTriangle& p) {
    return CGAL::squared_distance(point(p.a.center), triangle(p.b)) <= squared(Number(p.a.radius));
  }
  static bool test(const TriangleAndLine& p) {
    return CGAL::do_intersect(typename Kernel::Segment_3(point(p.b.start), point(p.b.end)), triangle(p.a));
  }
  static bool test(const Boxes& p) {
    const typename Kernel::Iso_cuboid_3 a(point(p.a.min), point(p.a.max), 0);
    const typename Kernel::Iso_cuboid_3 b(point(p.b.min), point(p.b.max), 0);
    return CGAL::do_intersect(a, b);
  }

 private:
  static typename Kernel::Segment_3 segment(const Capsule& capsule) {
    return {point(capsule.start), point(capsule.end)};
  }
  static typename Kernel::Triangle_3 triangle(const Triangle& t) {
    return {point(t.vertices[0]), point(t.vertices[1]), point(t.vertices[2])};
  }
  static Number squared(const Number& x) { return x * x; }
  static Number squared_reach(const Balls& p) {
    const Number reach = Number(p.a.radius) + Number(p.b.radius);
    const Number squared = reach * reach;
    // Asked to compare with an infinite number, the exact predicate behind the filter ends the process.
    if constexpr (std::is_same_v<Number, double>)
      if (!std::isfinite(squared)) throw std::overflow_error("the squared reach overflows");
    return squared;
  }
};

}  // namespace

std::vector<Peer> cgal_peers() {
  const Conventions conventions{.margin = Margin::none};
  return {make_peer("CGAL Epick", conventions, false,
                    std::make_shared<Cgal<CGAL::Exact_predicates_inexact_constructions_kernel>>()),
          make_peer("CGAL Epeck", conventions, true,
                    std::make_shared<Cgal<CGAL::Exact_predicates_exact_constructions_kernel>>())};
}

}  // namespace contact::bench
