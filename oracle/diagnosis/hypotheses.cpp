// The causes of wrong answers: what a question looks like to a formula, and the tables put together.
#include "oracle/diagnosis/hypotheses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "oracle/diagnosis/formulas.hpp"

namespace contact::oracle {
namespace {

using NearestPoints = std::array<Numbers, 2>;

NearestPoints nearest_points(const Balls& balls) {
  return {formulas::numbers_of(balls.a.center), formulas::numbers_of(balls.b.center)};
}
NearestPoints nearest_points(const BallAndBox& shapes) {
  const auto& [ball, box] = shapes;
  return {formulas::numbers_of(ball.center), formulas::numbers_of(ball.center.cwiseMax(box.min).cwiseMin(box.max))};
}
template <class A>
NearestPoints nearest_points(const Two<A, Capsule>& shapes) {
  const AxisInReals first(shapes.a);
  const AxisInReals second(shapes.b);
  const auto [s, t] = nearest_parameters(first, second);
  return {first.at(s), second.at(t)};
}

Real radius_of(const Box& /*box*/) { return 0; }
Real radius_of(const auto& shape) { return shape.radius; }

/// How deep a centre is in a box.
Real depth_of(const BallAndBox& shapes) {
  const auto& [ball, box] = shapes;
  Real least = std::numeric_limits<Real>::infinity();
  for (Eigen::Index i = 0; i < 3; ++i)
    least = std::min({least, Real{ball.center[i]} - box.min[i], Real{box.max[i]} - ball.center[i]});
  return std::max(least, Real{0});
}

}  // namespace

Facts::Facts(const Query& of, const Truth& true_of_it, Scalar engine_scalar, std::optional<Numbers> normal_said)
    : query(&of),
      truth(&true_of_it),
      scalar(engine_scalar),
      spheres(of.has_numbers()),
      region(Region::beyond),
      alarm(of.distances.alarm),
      contact(of.distances.contact),
      said_normal(normal_said) {
  bool inside = false;
  bool coincident = false;
  if (spheres) {
    std::visit(
        [&]<class Shapes>(const Shapes& shapes) {
          if constexpr (!std::same_as<Shapes, Boxes>) {
            center = nearest_points(shapes);
            radius = {radius_of(shapes.a), radius_of(shapes.b)};
          }
          if constexpr (std::same_as<Shapes, BallAndBox>) depth = depth_of(shapes);
        },
        of.shapes);
    settle();
    inside = of.balls() != nullptr ? distance <= std::abs(radius[0] - radius[1]) : depth > 0;
    coincident = truth->coincident();
  } else {
    const auto& [a, b] = *of.boxes();
    min = {formulas::numbers_of(a.min), formulas::numbers_of(b.min)};
    max = {formulas::numbers_of(a.max), formulas::numbers_of(b.max)};
    const auto in = [](const Box& x, const Box& y) {
      return (x.min.array() >= y.min.array()).all() && (x.max.array() <= y.max.array()).all();
    };
    inside = in(a, b) || in(b, a);
  }
  if (truth->at_alarm == Side::beyond) return;
  if (coincident)
    region = Region::coincident;
  else if (truth->at_alarm == Side::at)
    region = alarm == 0 ? Region::touching : Region::at_alarm;
  else if (truth->at_zero != Side::within)
    region = Region::near;
  else
    region = inside ? Region::inside : Region::overlapping;
}

void Facts::settle() {
  if (!spheres) return;
  delta = formulas::along(center[1], -1, center[0]);
  settle_from_delta();
}

void Facts::settle_from_delta() {
  D = formulas::dot(delta, delta);
  distance = std::sqrt(D);
  n = D > 0 ? formulas::times(1 / distance, delta) : said_normal.value_or(Numbers{});
}

Real Facts::gap(std::size_t axis) const { return std::max(min[0][axis] - max[1][axis], min[1][axis] - max[0][axis]); }
Real Facts::widest_gap() const { return std::max({gap(0), gap(1), gap(2)}); }

Said Said::at_most(Real x, Real y) {
  constexpr Real kLastBits =
      16 * std::numeric_limits<Real>::epsilon();  // what roundings of a formula's steps can change
  const Real near = kLastBits * std::max(std::abs(x), std::abs(y));
  if (!(std::abs(x - y) > near)) return std::nullopt;
  return hit(x < y);
}

std::span<const Cause> causes() {
  static const std::vector<Cause> all = [] {
    std::vector<Cause> made;
    for (const auto table :
         {formulas::wrong_inputs, formulas::wrong_decisions, formulas::wrong_box_decisions, formulas::wrong_features,
          formulas::wrong_normals, formulas::wrong_points, formulas::wrong_values, formulas::wrong_arithmetic})
      for (Cause& cause : table()) made.push_back(std::move(cause));
    if (made.size() > kMostCauses) throw std::length_error("more causes than kMostCauses");
    return made;
  }();
  return all;
}

std::size_t cause_index(std::string_view id) {
  const auto all = causes();
  const auto it = std::find_if(all.begin(), all.end(), [&](const Cause& c) { return c.id == id; });
  if (it == all.end()) throw std::out_of_range("no cause '" + std::string(id) + "'");
  return static_cast<std::size_t>(it - all.begin());
}

Predictions predict(const Cause& cause, const Facts& facts) {
  Predictions said;
  if (cause.edit) {
    Facts f = facts;
    cause.edit(f);
    said.hit = formulas::within(f, f.alarm);
    if (!f.spheres) return said;
    said.value = formulas::right_value(f);
    if (f.D == 0) f.n = facts.n;  // it has no direction: any normal is right
    const bool has_direction = facts.D > 0 || facts.depth > 0;
    if (has_direction) said.normal = f.n;
    if (has_direction || f.D == 0) said.point = {formulas::surface(f, 0), formulas::surface(f, 1)};
    return said;
  }
  if (cause.hit) said.hit = cause.hit(facts);
  if (!facts.spheres) return said;
  if (cause.normal) said.normal = cause.normal(facts);
  if (cause.point) said.point = {cause.point(facts, 0), cause.point(facts, 1)};
  if (cause.value) said.value = cause.value(facts);
  return said;
}

}  // namespace contact::oracle
