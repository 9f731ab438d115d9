// The exact truth of two cores.
#pragma once

#include <initializer_list>

#include "oracle/truth/core.hpp"
#include "oracle/truth/exact_truth.hpp"

namespace contact::oracle {

using EnclosedCore = Core<Enclosed>;
template <class Shape>
[[nodiscard]] EnclosedCore enclosed_core(const Shape& shape) {
  const CGAL::Protect_FPU_rounding<true> upward;
  return core_of([](double x) { return Enclosed(x); }, shape);
}

struct ExactCore : Core<Rational> {
  EnclosedCore enclosed;
};
template <class Shape>
[[nodiscard]] ExactCore exact_core(const Shape& shape) {
  return {core_of([](double x) { return Rational(x); }, shape), enclosed_core(shape)};
}
// What is left to be divided by in a core of this shape is divided by here.
[[nodiscard]] ExactCore exact_core(const Obb& box);
[[nodiscard]] EnclosedCore enclosed_core(const Obb& box);
/// Domain: no half-space.
[[nodiscard]] ExactCore exact_core(const Convex& convex);
[[nodiscard]] ExactCore exact_core(const std::vector<Point>& vertices, std::span<const Feature> features,
                                   const std::vector<Point>& outward = {});
/// Of the hull of some points.
[[nodiscard]] ExactCore exact_hull(const std::vector<Point>& points, double radius = 0);
[[nodiscard]] ExactCore exact_core(const Hull& hull);
template <HullOfVertices Shape>
[[nodiscard]] ExactCore exact_core(const Shape& shape) {
  return exact_core(Hull{{shape.vertices.begin(), shape.vertices.end()}, radius_of(shape)});
}
template <HullOfVertices Shape>
[[nodiscard]] EnclosedCore enclosed_core(const Shape& shape) {
  return exact_core(shape).enclosed;
}

/// Encloses two cores anew, on one scale on which products of doubles stay in their range: intervals only compare lengths of one question.
void enclose_in_range(ExactCore& first, ExactCore& second);

/// What is said of cores that meet: what the pair had agreed before there were rules for all, where the first core is a point, or both are
/// segments; or those for any two convex shapes.
enum class Rules { of_the_pair, of_all };
[[nodiscard]] ExactTruth truth_of_cores(const ExactCore& first, const ExactCore& second, Distances distances,
                                        Rules rules);
/// Over the half-space n.x <= offset.
[[nodiscard]] ExactTruth truth_of_cores(const ExactCore& first, const Point& n, const Rational& offset,
                                        Distances distances);

/// Whether intervals of doubles tell that two cores without an inside are apart.
[[nodiscard]] bool are_surely_apart(const EnclosedCore& first, const EnclosedCore& second);
/// The square of the distance of two cores, 0 where they meet.
[[nodiscard]] Rational squared_distance(const ExactCore& first, const ExactCore& second);
/// The least number that makes whole numbers of all coordinates: of quotients most of the time would go into common divisors.
[[nodiscard]] Whole common_denominator(std::initializer_list<const std::vector<Point>*> all);
/// The largest coordinate of some points.
[[nodiscard]] Rational largest_coordinate(const std::vector<Point>& points);
/// How to leave a core with an inside through each of its faces, for a point of it.
[[nodiscard]] std::vector<WayOut> ways_out(const Point& inside, const ExactCore& solid);

}  // namespace contact::oracle
