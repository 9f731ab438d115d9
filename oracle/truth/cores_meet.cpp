// Whether the cores of two shapes meet: quick where they surely do not, else exact.
#include "oracle/truth/casts.hpp"
#include "oracle/truth/cores.hpp"

namespace contact::oracle {
namespace meeting {
namespace {

template <class A, class B>
Meet meet(const Two<A, B>& shapes) {
  const auto& [a, b] = shapes;
  if constexpr (std::same_as<A, Cast>) {
    return starts_inside(shapes) ? Meet::inside : Meet::no;
  } else if constexpr (std::same_as<B, Plane>) {
    return Meet::no;  // D = 0 is no exception there
  } else {
    if (are_surely_apart(enclosed_core(a), enclosed_core(b))) return Meet::no;
    return CGAL::is_zero(squared_distance(exact_core(a), exact_core(b))) ? Meet::touching : Meet::no;
  }
}
Meet meet(const Balls& balls) { return balls.a.center == balls.b.center ? Meet::touching : Meet::no; }
Meet meet(const BallAndBox& shapes) {
  const auto c = shapes.a.center.array();
  const auto min = shapes.b.min.array();
  const auto max = shapes.b.max.array();
  if (!((min <= c).all() && (c <= max).all())) return Meet::no;
  return (min < c).all() && (c < max).all() ? Meet::inside : Meet::touching;
}
Meet meet(const Boxes& /*boxes*/) { return Meet::no; }
Meet meet(const RayAndTriangle& /*shapes*/) { return Meet::no; }
Meet meet(const TriangleAndLine& /*shapes*/) { return Meet::no; }

}  // namespace
}  // namespace meeting

Meet cores_meet(const Shapes& shapes) {
  return std::visit([](const auto& two) { return meeting::meet(two); }, shapes);
}

}  // namespace contact::oracle
