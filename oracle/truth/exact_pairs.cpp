// Where the exact truth of each pair comes from, and whether its cores meet.
#include <algorithm>
#include <cstddef>

#include "oracle/truth/casts.hpp"
#include "oracle/truth/cores.hpp"
#include "oracle/truth/crossings.hpp"

namespace contact::oracle {
namespace {

ExactTruth truth(const Balls& balls, Distances distances) {
  const Vector3& a = balls.a.center;
  const Vector3& b = balls.b.center;
  Cores cores{{point_of(a), point_of(b)},
              {Rational(balls.a.radius), Rational(balls.b.radius)},
              {Rational(a.cwiseAbs().maxCoeff()), Rational(b.cwiseAbs().maxCoeff())}};
  return {DistanceTruth(std::move(cores), distances)};
}

/// On each axis the gap max(min1 - max2, min2 - max1).
ExactTruth truth(const Boxes& boxes, Distances distances) {
  std::array<Rational, 3> gap;
  for (int axis = 0; axis < 3; ++axis)
    gap[static_cast<std::size_t>(axis)] = std::max(Rational(boxes.a.min[axis]) - Rational(boxes.b.max[axis]),
                                                   Rational(boxes.b.min[axis]) - Rational(boxes.a.max[axis]));
  return {GapTruth(std::move(gap), Rational(distances.alarm))};
}

ExactTruth truth(const RayAndTriangle& shapes, Distances /*distances*/) {
  return {truth_of_crossing(exact_core(shapes.a), shapes.b, -1)};
}
ExactTruth truth(const TriangleAndLine& shapes, Distances /*distances*/) {
  return {truth_of_crossing(exact_core(shapes.b), shapes.a, 1)};
}

template <class A, class B>
ExactTruth truth(const Two<A, B>& shapes, Distances distances) {
  const auto& [a, b] = shapes;
  if constexpr (std::same_as<A, Cast>) {
    return {truth_of_cast(shapes)};
  } else if constexpr (std::same_as<B, Plane>) {
    return truth_of_cores(exact_core(a), point_of(b.normal), Rational(b.offset), distances);
  } else {
    static_assert(kCoresAreSimple<A, B>);
    return truth_of_cores(exact_core(a), exact_core(b), distances, Rules::of_the_pair);
  }
}

ExactTruth truth(const Convexes& shapes, Distances distances) {
  if (const auto* plane = std::get_if<Plane>(&shapes.b.shape))
    return truth_of_cores(exact_core(shapes.a), point_of(plane->normal), Rational(plane->offset), distances);
  ExactCore a = exact_core(shapes.a);
  ExactCore b = exact_core(shapes.b);
  enclose_in_range(a, b);
  return truth_of_cores(a, b, distances, Rules::of_all);
}

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
Meet meet(const Convexes& shapes) {
  const ExactTruth exact = truth(shapes, {0, 0});
  return std::get<DistanceTruth>(exact.numbers).degenerate() ? Meet::touching : Meet::no;
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

ExactTruth exact_truth(const Shapes& shapes, Distances distances) {
  return std::visit([&](const auto& two) { return truth(two, distances); }, shapes);
}

Meet cores_meet(const Shapes& shapes) {
  return std::visit([](const auto& two) { return meet(two); }, shapes);
}

}  // namespace contact::oracle
