// The exact answer to a question, as exact numbers, and its correct rounding.
#include "oracle/truth.hpp"

namespace contact::oracle {

Truth truth_of(const Query& query) {
  Truth truth = truth_with(query, CGAL::ZERO, CGAL::ZERO);
  truth.at_alarm = truth.spheres ? truth.spheres->at_alarm() : truth.cubes->at_alarm();
  truth.at_zero = truth.spheres ? truth.spheres->at_zero() : truth.cubes->at_zero();
  return truth;
}

Truth truth_with(const Query& query, CGAL::Sign at_alarm, CGAL::Sign at_zero) {
  Truth truth{at_alarm, at_zero, std::nullopt, std::nullopt};
  if (const Balls* balls = query.balls())
    truth.spheres.emplace(*balls, query.distances);
  else
    truth.cubes.emplace(*query.boxes(), query.distances);
  return truth;
}

Expectation expectation(const Truth& truth, Scalar scalar) {
  Expectation expected{truth.hit(), std::nullopt};
  if (!truth.hit() || !truth.spheres) return expected;
  const SphereTruth& spheres = *truth.spheres;
  Contact contact{};
  contact.degenerate = spheres.degenerate();
  for (int axis = 0; axis < 3; ++axis) {
    contact.normal[axis] = round_to_nearest(spheres.normal(axis), scalar);
    contact.point1[axis] = round_to_nearest(spheres.point(0, axis, PointOn::nearest_surface), scalar);
    contact.point2[axis] = round_to_nearest(spheres.point(1, axis, PointOn::nearest_surface), scalar);
  }
  contact.value = round_to_nearest(spheres.value(true), scalar);
  expected.contact = contact;
  return expected;
}

std::vector<FieldNumber> numbers(const SphereTruth& spheres) {
  std::vector<FieldNumber> all{{"value", spheres.value(true)}};
  for (int axis = 0; axis < 3; ++axis) all.push_back({"normal", spheres.normal(axis)});
  for (int axis = 0; axis < 3; ++axis) all.push_back({"point1", spheres.point(0, axis, PointOn::nearest_surface)});
  for (int axis = 0; axis < 3; ++axis) all.push_back({"point2", spheres.point(1, axis, PointOn::nearest_surface)});
  return all;
}

std::vector<FieldDistance> rounding_distances(const Truth& truth, Scalar scalar) {
  std::vector<FieldDistance> least;
  if (!truth.hit() || !truth.spheres) return least;
  for (const auto& [field, number] : numbers(*truth.spheres)) {
    const Boundary boundary = nearest_boundary(number, scalar);
    const Rational ulps = distance_in_ulps(number, boundary);
    if (CGAL::is_zero(ulps)) continue;  // a tie
    const bool first = least.empty() || least.back().field != field;
    if (!first && least.back().ulps <= ulps) continue;
    if (!first) least.pop_back();
    least.push_back({field, ulps, floor_log2(number.plus(-boundary.at)) - floor_log2(boundary.ulp)});
  }
  return least;
}

Witness witness(const Truth& truth, Scalar scalar) {
  Witness w;
  if (truth.spheres) {
    w.distance2 = dyadic_string(truth.spheres->distance2());
    w.reach = dyadic_string(truth.spheres->reach());
    w.margin_ulps = round_to_nearest(truth.spheres->margin(scalar), Scalar::binary64);
  } else {
    for (std::size_t axis = 0; axis < 3; ++axis) w.gap[axis] = dyadic_string(truth.cubes->gap()[axis]);
  }
  return w;
}

}  // namespace contact::oracle
