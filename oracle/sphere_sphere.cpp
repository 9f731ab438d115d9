// What is exactly true of two spheres.
#include <algorithm>
#include <cstddef>

#include "oracle/default_environment.hpp"
#include "oracle/truth.hpp"

namespace contact::oracle {
namespace {

Rational square(const Rational& x) { return x * x; }
std::size_t index(int i) { return static_cast<std::size_t>(i); }

/// +1 where the contact point lies from the centre along the normal, -1 against it, 0 at the centre.
Rational side(int sphere, PointOn on) {
  if (on == PointOn::center) return Rational(0);
  return (sphere == 0) == (on == PointOn::nearest_surface) ? Rational(1) : Rational(-1);
}

}  // namespace

SphereTruth::Numbers::Numbers(const Balls& balls, Distances distances)
    : radius{Rational(balls.a.radius), Rational(balls.b.radius)}, contact(distances.contact), distance2(0) {
  for (int axis = 0; axis < 3; ++axis) {
    center[0][index(axis)] = Rational(balls.a.center[axis]);
    center[1][index(axis)] = Rational(balls.b.center[axis]);
    delta[index(axis)] = center[1][index(axis)] - center[0][index(axis)];
    distance2 += square(delta[index(axis)]);
  }
  radii = radius[0] + radius[1];
  reach = Rational(distances.alarm) + radii;
}

const SphereTruth::Numbers& SphereTruth::exact() const {
  if (!exact_) {
    const DefaultEnvironment environment;
    exact_.emplace(balls_, distances_);
  }
  return *exact_;
}

bool SphereTruth::degenerate() const {
  const DefaultEnvironment environment;
  return balls_.a.center == balls_.b.center;
}

// Both sides of sqrt(D) <= reach are >= 0, so their squares stand in the same order.
CGAL::Sign SphereTruth::at_alarm() const { return CGAL::sign(exact().distance2 - square(exact().reach)); }
CGAL::Sign SphereTruth::at_zero() const { return CGAL::sign(exact().distance2 - square(exact().radii)); }

Exact SphereTruth::normal(int axis) const {
  if (degenerate()) return Rational(axis == 0 ? 1 : 0);
  return {Rational(0), exact().delta[index(axis)] / exact().distance2, exact().distance2};
}

Exact SphereTruth::point(int sphere, int axis, PointOn on) const {
  if (degenerate()) return point_for(sphere, axis, on, Vector3::UnitX());
  const Rational along =
      side(sphere, on) * exact().radius[index(sphere)] * exact().delta[index(axis)] / exact().distance2;
  return {exact().center[index(sphere)][index(axis)], along, exact().distance2};
}

Rational SphereTruth::point_for(int sphere, int axis, PointOn on, const Vector3& normal) const {
  const DefaultEnvironment environment;
  return exact().center[index(sphere)][index(axis)] +
         side(sphere, on) * exact().radius[index(sphere)] * Rational(normal[axis]);
}

Exact SphereTruth::midpoint(int axis) const {
  const Rational centers = exact().center[0][index(axis)] + exact().center[1][index(axis)];
  const Rational radii = exact().radius[0] - exact().radius[1];
  if (degenerate()) return (centers + radii * Rational(axis == 0 ? 1 : 0)) / Rational(2);
  return {centers / Rational(2), radii * exact().delta[index(axis)] / exact().distance2 / Rational(2),
          exact().distance2};
}

Exact SphereTruth::value(bool less_contact) const {
  return {less_contact ? -exact().radii - exact().contact : -exact().radii, Rational(1), exact().distance2};
}

Exact SphereTruth::margin(Scalar scalar) const {
  return Exact(-exact().reach, Rational(1), exact().distance2).scaled(Rational(1) / ulp(exact().reach, scalar));
}

Exact SphereTruth::value_scale() const {
  const Rational larger = std::max(exact().radii, exact().contact);
  const Exact distance(Rational(0), Rational(1), exact().distance2);
  return distance.compare(larger) == CGAL::LARGER ? distance : Exact(larger);
}

Rational SphereTruth::point_scale(int sphere) const {
  Rational scale = exact().radius[index(sphere)];
  for (const Rational& c : exact().center[index(sphere)]) scale = std::max(scale, Rational(CGAL::abs(c)));
  return scale;
}

}  // namespace contact::oracle
